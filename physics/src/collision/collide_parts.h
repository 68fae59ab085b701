// Pairs in which a shape has parts: meshes and heightfields against convex shapes, compounds
// against everything.
#pragma once

#include "collision/collide.h"
#include "collision/part_manifolds.h"

namespace plumb::inline PLUMB_ABI::detail {

// All manifolds of a pair, of any two shapes: part 0 for two shapes without parts. Placements,
// margin and signs as for collide(). Parts are in ascending order and keep their number while the
// contact stays: the plane that is touched, whatever triangles it is made of; the edge or corner;
// the child of a compound. Surfaces do not collide with surfaces or half-spaces. `held`: the pair
// had contacts in the last step. Returns whether there is any.
bool collide_parts(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                   const Transform& xb, Real margin, PartManifolds& out, bool held = false);

// The one with the deepest point.
bool collide_deepest_part(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                          const Transform& xb, Real margin, Manifold& out);

// As closest_points() and cast_ray(). A surface is hit from its front only; it has no inside.
Proximity closest_parts(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                        const Transform& xb);
bool cast_ray_parts(const CollisionShape& shape, NumRotation q, NumVec origin, NumVec direction,
                    Num max_fraction, NumRayHit& hit);

}  // namespace plumb::inline PLUMB_ABI::detail
