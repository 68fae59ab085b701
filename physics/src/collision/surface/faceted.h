// Cylinders and cones with flat sides, for contacts with triangles: every other pair treats them as
// truly round. The polygon lies half in and half out of the circle, at most 0.24 % of the radius.
#pragma once

#include <memory>

#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI::detail {

// Sizes as in Cylinder and Cone, without rounding. Null where the shape is too flat for a hull.
std::shared_ptr<const HullGeometry> faceted_cylinder(Real half_length, Real radius);
std::shared_ptr<const HullGeometry> faceted_cone(Real half_length, Real radius);

}  // namespace plumb::inline PLUMB_ABI::detail
