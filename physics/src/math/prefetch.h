// Asks for memory before it is needed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

// How many rows ahead what belongs to a row is asked for: a row takes some 100 ns, memory as long.
inline constexpr std::uint32_t kRowsAhead = 3;

// All of a record. Changes nothing but how long the next look at it takes.
template <class Record>
void prefetch(const Record& record) {
  constexpr std::size_t kLine = 64;  // [byte]
  const char* const at = reinterpret_cast<const char*>(&record);
  for (std::size_t k = 0; k < sizeof(Record); k += kLine) __builtin_prefetch(at + k);
}

}  // namespace plumb::inline PLUMB_ABI::detail
