// The cores with a round side, in their own frame: cylinder and cone about the y axis, as figures
// of revolution of a rectangle and a triangle.
#pragma once

#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {

// `half` of a cone or cylinder: (radius, half length, radius) [m].

// Radius of the largest ball inside a cone [m]: the inscribed circle of the triangle through its
// axis, area over half the circumference.
inline Num cone_inner_radius(NumVec half) {
  const Num height = Num(2) * half.y;
  return half.x * height / (half.x + std::sqrt(half.x * half.x + height * height));
}

// Farthest point of a cylinder or cone core in a direction [m]. Along the axis all points of the
// flat end are equally far; the one on the x axis is given.
inline NumVec support_of_round(const CollisionShape& shape, NumVec d) {
  const NumVec half = to_num(shape.half);
  const Num aside = std::sqrt(d.x * d.x + d.z * d.z);
  NumVec rim{half.x, half.y, Num(0)};
  if (aside > Num(0)) rim = {half.x * (d.x / aside), half.y, half.x * (d.z / aside)};
  if (shape.type == ShapeType::Cylinder) {
    if (d.y < Num(0)) rim.y = -half.y;
    return rim;
  }
  // Apex: half.y d.y; base rim: -half.y d.y + radius |d aside|.
  if (Num(2) * half.y * d.y > half.x * aside) return {Num(0), half.y, Num(0)};
  rim.y = -half.y;
  return rim;
}

}  // namespace plumb::inline PLUMB_ABI::detail
