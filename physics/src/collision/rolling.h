// How the surface at a contact goes on when a shape rolls.
#pragma once

#include "collision/collision_shape.h"

namespace plumb::inline PLUMB_ABI::detail {

// Distance [m] from a surface point, against the outward normal, to the point that keeps its height
// while the shape rolls there: the centre of a sphere, the axis of a capsule or of the round side
// of a cylinder or cone, the core of what is rounded. `point` and `normal` (unit) in the shape's
// frame.
Real rolling_radius(const CollisionShape& shape, Vec point, Vec normal);

}  // namespace plumb::inline PLUMB_ABI::detail
