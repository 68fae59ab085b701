// Why a text is no JSON, in the words of its author's slip: a comma too many, a comment, a key
// without quotes. The parser itself only knows which of its tokens it did not expect.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

struct JsonFault {
  std::size_t offset = 0;  // [byte] of the character to look at
  std::string what, remedy;
};

// read: [byte] how much of the text the parser had read when it gave up; message: its own words,
// for slips that are not among the known ones.
JsonFault explain_json_fault(std::string_view text, std::size_t read, const std::string& message);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
