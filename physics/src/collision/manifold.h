// The contact of one pair of convex shapes: up to four points that share a normal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

struct ManifoldPoint {
  Vec position;     // [m] midway between the two surfaces; world axes, from A's reference point
  Real separation;  // [m] along the normal; negative when the shapes overlap
  std::uint32_t feature;  // names the pair of features that met, stable from step to step
};

struct Manifold {
  static constexpr int kMaxPoints = 4;
  Vec normal{0, 1, 0};  // unit, from A towards B, world axes
  int count = 0;
  ManifoldPoint points[kMaxPoints]{};
};

// Which face of which of two polyhedra has the other one wholly in front of it; none: not known.
class SeparatingFace {
 public:
  SeparatingFace() = default;
  SeparatingFace(int face, bool of_second)
      : code_(static_cast<std::uint16_t>(2 * face + (of_second ? 2 : 1))) {}
  [[nodiscard]] bool is_known() const { return code_ != 0; }
  [[nodiscard]] bool of_second() const { return code_ % 2 == 0; }
  [[nodiscard]] std::size_t index() const { return (code_ - 1u) / 2; }
  [[nodiscard]] SeparatingFace swapped() const {
    return is_known() ? SeparatingFace(static_cast<int>(index()), !of_second()) : *this;
  }

 private:
  std::uint16_t code_ = 0;  // 1 + 2 face, + 1 if of the second
};

}  // namespace plumb::inline PLUMB_ABI::detail
