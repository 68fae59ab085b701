// Handles. A handle is an index and a generation, never a pointer: a stale one is recognised.
#pragma once

#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

template <class Tag>
struct Id {
  std::uint32_t index = 0;
  std::uint32_t generation = 0;  // 0 is the null handle; live handles start at 1

  [[nodiscard]] constexpr bool is_null() const { return generation == 0; }
  constexpr explicit operator bool() const { return generation != 0; }
  friend constexpr bool operator==(const Id&, const Id&) = default;
  friend constexpr auto operator<=>(const Id&, const Id&) = default;

  // One number for maps, files and foreign languages.
  [[nodiscard]] constexpr std::uint64_t value() const {
    return (std::uint64_t{generation} << 32) | index;
  }
  static constexpr Id from_value(std::uint64_t v) {
    return {static_cast<std::uint32_t>(v & 0xffffffffu), static_cast<std::uint32_t>(v >> 32)};
  }
};

using BodyId = Id<struct BodyTag>;
using ColliderId = Id<struct ColliderTag>;
using JointId = Id<struct JointTag>;

}  // namespace plumb::inline PLUMB_ABI
