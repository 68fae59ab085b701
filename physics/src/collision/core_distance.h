// Distance of a point from a single core.
#pragma once

#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {

struct CoreDistance {
  Num distance;    // [m] from the core; cylinder, cone, half-space: negative inside, others: 0
  NumVec outward;  // unit: the direction in which it grows; zero inside of those others
};
// `point` in the shape's frame.
CoreDistance distance_to_core(const CollisionShape& shape, NumVec point);

}  // namespace plumb::inline PLUMB_ABI::detail
