// Meshes, heightfields and compounds as collision shapes: checks, bounds and sizes.
#pragma once

#include "collision/collision_shape.h"
#include "collision/surface/static_bvh.h"

namespace plumb::inline PLUMB_ABI::detail {

// A compound's children, ready to collide.
struct CompoundData {
  struct Child {
    CollisionShape shape;
    Transform placed;  // in the compound's frame
  };
  std::vector<Child> children;
  StaticBvh tree;
  std::vector<std::uint32_t> order;  // child at each place of the tree
  Real radius = 0;                   // [m] about the compound's origin, around all
  Real thickness = 0;                // [m] of the thinnest child
};

Status check_mesh(const SurfaceMesh& shape);
Status check_heightfield(const Heightfield& shape);
Status check_compound(const Compound& shape);
CollisionShape make_mesh(const SurfaceMesh& shape);
CollisionShape make_heightfield(const Heightfield& shape);
CollisionShape make_compound(const Compound& shape);

Aabb composite_bounds(const CollisionShape& shape, const Transform& placement);
Real composite_radius(const CollisionShape& shape);
Real composite_thickness(const CollisionShape& compound);
// Of the convex hull of the whole.
Vec composite_support(const CollisionShape& shape, Vec direction);

// In double precision, for a child in place.
struct Placement {
  NumVec p;  // [m]
  NumRotation q;
};
inline Placement to_placement(const Transform& x) {
  return {cast<Num>(x.p), normalized(NumRotation{x.q.x, x.q.y, x.q.z, x.q.w})};
}

}  // namespace plumb::inline PLUMB_ABI::detail
