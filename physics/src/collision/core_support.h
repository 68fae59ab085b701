// Farthest points of a shape's core in double precision: what sweeps and casts ask of a shape. A
// kind of shape that is not named here is asked through support(), so that new ones work at once.
#pragma once

#include "collision/collision_shape.h"
#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {

// The first of the corners that are farthest in a direction [m].
inline NumVec farthest_corner(const HullGeometry& hull, NumVec d) {
  const std::vector<Vec3>& corners = hull.vertices();
  std::size_t farthest = 0;
  Num best = dot(to_num(corners[0]), d);
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Num along = dot(to_num(corners[i]), d);
    if (along > best) best = along, farthest = i;
  }
  return to_num(corners[farthest]);
}

// Farthest point of the core (without the radius) in a direction, shape frame [m].
inline NumVec core_support(const CollisionShape& shape, NumVec d) {
  switch (shape.type) {
    case ShapeType::Sphere:
      return {0, 0, 0};
    case ShapeType::Capsule:
    case ShapeType::Box: {
      const NumVec half = to_num(shape.half);
      return {d.x < Num(0) ? -half.x : half.x, d.y < Num(0) ? -half.y : half.y,
              d.z < Num(0) ? -half.z : half.z};
    }
    case ShapeType::Hull:
      return farthest_corner(*shape.hull, d);
    default:
      return to_num(support(shape, cast<Real>(d)));
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
