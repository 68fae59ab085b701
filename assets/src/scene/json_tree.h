// A JSON document that remembers the line of every key and value, so that errors found long after
// parsing can still name the place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "plumb/assets/result.h"
#include "scene/problems.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

struct JsonMember;

struct JsonNode {
  enum class Kind { Null, Boolean, Number, Text, Array, Object };

  Kind kind = Kind::Null;
  int line = 0;
  bool boolean = false;
  double number = 0;
  // Set for numbers written without point or exponent that fit; a sign is in `number`.
  bool is_unsigned = false;
  std::uint64_t integer = 0;
  std::string text;
  std::vector<JsonNode> items;
  std::vector<JsonMember> members;  // in the order of the file

  [[nodiscard]] const JsonMember* find(std::string_view key) const;
};

struct JsonMember {
  std::string key;
  int line = 0;
  JsonNode value;
};

// "a number", "a text", ... for messages.
const char* name_of(JsonNode::Kind kind);

// False if the text is no JSON; the reason is then in `problems`.
bool parse_json(std::string_view text, JsonNode& root, Problems& problems);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
