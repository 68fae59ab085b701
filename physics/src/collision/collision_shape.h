// A shape as the collision routines see it: a core (point, segment, box, polyhedron, plane) grown
// by a radius. Cylinder, cone: see shapes.h.
#pragma once

#include <memory>

#include "math/quaternion.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI::detail {

enum class ShapeType : std::uint8_t {
  Sphere,
  Capsule,
  Box,
  Hull,
  HalfSpace,
  Cylinder,
  Cone,
  // Made of parts: pairs with these go through collide_parts().
  Mesh,
  Heightfield,
  Compound
};
inline constexpr int kShapeTypeCount = 7;  // of one part
constexpr bool has_parts(ShapeType type) { return type >= ShapeType::Mesh; }
// Surfaces have a front and no inside.
constexpr bool is_surface(ShapeType type) {
  return type == ShapeType::Mesh || type == ShapeType::Heightfield;
}

struct MeshData;
struct CompoundData;

struct CollisionShape {
  ShapeType type = ShapeType::Sphere;
  Real radius = 0;      // [m] of the ball the core is grown by; 0 for a half-space
  Vec half{0, 0, 0};    // [m] half extents of the core of a box, capsule (0, half_length, 0),
                        // cylinder or cone (radius, half_length, radius)
  Vec normal{0, 1, 0};  // half-space: outward unit normal
  Real offset = 0;      // [m] half-space
  // Shared geometry, kept alive by `owner`.
  const HullGeometry* hull = nullptr;
  const MeshData* mesh = nullptr;
  const HeightfieldGeometry* heightfield = nullptr;
  const CompoundData* compound = nullptr;
  Vec scale{1, 1, 1};  // mesh
  std::shared_ptr<const void> owner;
};

// Whether a core has a round side (cylinder or cone).
constexpr bool is_curved(ShapeType type) {
  return type == ShapeType::Cylinder || type == ShapeType::Cone;
}

// Precondition: the shape passed check_shape().
CollisionShape make_collision_shape(const Shape& shape);
// Whether a shape is finite, in range and has volume.
Status check_shape(const Shape& shape);

struct Aabb {
  Vec lower, upper;  // [m]
};
// Tight bounds of the placed shape, world axes, relative to the same reference as the placement.
// A half-space gives bounds of +-1e30 m (kUnbounded) on the axes on which it has no end.
inline constexpr Real kUnbounded = Real(1e30);
Aabb bounds_of(const CollisionShape& shape, const Transform& placement);
// Radius about the shape's own origin that contains it [m]; kUnbounded for a half-space.
Real bounding_radius(const CollisionShape& shape);
// Smallest thickness [m]: a body that moves less than about half of it cannot pass unseen.
Real smallest_thickness(const CollisionShape& shape);
// Farthest point of the core (without the radius) in a direction, shape frame [m].
Vec support(const CollisionShape& shape, Vec direction);

}  // namespace plumb::inline PLUMB_ABI::detail
