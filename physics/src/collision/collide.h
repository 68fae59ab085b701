// Narrowphase: the contact manifold of two placed shapes, and the distance between them.
#pragma once

#include "collision/collision_shape.h"
#include "collision/collision_tolerances.h"
#include "collision/manifold.h"

namespace plumb::inline PLUMB_ABI::detail {

// Points with a separation above `margin` are left out [m, >= 0]. Placements are relative to a
// common reference point near A (so that single precision suffices anywhere in the world).
// Returns whether there is any point. Symmetric: swapping the shapes negates the normal.
// HalfSpace against HalfSpace never collides.
// `memory`, where given, is looked at first and left as what was found now; it saves time and
// changes no result (see separating_face.h).
bool collide(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
             const Transform& xb, Real margin, Manifold& out, PairMemory* memory = nullptr);

// Closest points of two shapes that do not overlap; distance 0 where they do.
struct Proximity {
  Real distance;   // [m] >= 0, surface to surface
  Vec on_a, on_b;  // [m] closest points, same frame as the placements
  Vec normal;      // unit, from A to B (a valid unit vector also when touching)
};
Proximity closest_points(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                         const Transform& xb);

// First hit of the ray origin + t direction, 0 <= t <= max_fraction, from outside; a ray that
// starts inside hits at t = 0 with normal = -direction (unit).
struct RayHit {
  Real fraction;
  Vec normal;  // unit, outward
};
bool cast_ray(const CollisionShape& shape, const Transform& placement, Vec origin, Vec direction,
              Real max_fraction, RayHit& hit);

// The same in double precision, the origin relative to the shape.
struct NumRayHit {
  Num fraction;
  NumVec normal;  // unit, outward
};
bool cast_ray(const CollisionShape& shape, NumRotation q, NumVec origin, NumVec direction,
              Num max_fraction, NumRayHit& hit);

}  // namespace plumb::inline PLUMB_ABI::detail
