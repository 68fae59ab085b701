#include "collision/rolling.h"

namespace plumb::inline PLUMB_ABI::detail {

Real rolling_radius(const CollisionShape& shape, Vec point, Vec normal) {
  // A cone's radius is another one at each point of its side; taken too large it would press the
  // narrow part of a rolling cone into the floor.
  if (shape.type != ShapeType::Cylinder) return shape.radius;
  const Real across = std::hypot(normal.x, normal.z);
  const bool on_its_end = std::abs(normal.y) >= across;  // see ConvexCore::round_feature
  if (on_its_end) return shape.radius;
  // The normal of a surface of revolution meets its axis.
  const Vec core = point - shape.radius * normal;
  return shape.radius + std::min(std::hypot(core.x, core.z), shape.half.x) / across;
}

}  // namespace plumb::inline PLUMB_ABI::detail
