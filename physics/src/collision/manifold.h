// The contact of one pair of convex shapes: up to four points that share a normal.
#pragma once

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

}  // namespace plumb::inline PLUMB_ABI::detail
