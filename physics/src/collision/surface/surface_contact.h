// Contacts of one convex shape with the triangles of a surface, in the surface's frame.
#pragma once

#include <algorithm>

#include "collision/convex_core.h"
#include "collision/part_manifolds.h"
#include "collision/surface/surface_triangle.h"

namespace plumb::inline PLUMB_ABI::detail {

// The convex shape, placed in the surface's frame.
struct ConvexOnSurface {
  const CollisionShape& shape;
  NumVec p;  // [m]
  NumRotation q;
  NumMatrix R;
  Num margin;     // [m] of the core
  Num rounding;   // [m] that the core of a box, hull, cylinder or cone is grown by
  Num thickness;  // [m] half of the smallest
  NumVec middle;  // [m]
  Num behind;     // [m] how far behind a triangle the middle may lie
  const SurfaceSource& surface;
};

// What one triangle gives.
struct TriangleContact {
  NumVec normal;          // unit, from the surface to the shape
  bool of_face;           // the normal is the triangle's
  std::uint32_t feature;  // names the edge or corner when it is not
  ContactCandidates candidates;
};

// Contact along the triangle's own normal, or along that of an edge or a corner if its cone holds
// it. False where there is none.
bool touch_sphere(const ConvexOnSurface& on, SurfaceTriangle& t, TriangleContact& out);
bool touch_capsule(const ConvexOnSurface& on, SurfaceTriangle& t, TriangleContact& out);
bool touch_polyhedron(const ConvexOnSurface& on, const PlacedPolyhedron& polyhedron,
                      SurfaceTriangle& t, TriangleContact& out);
// Cylinders and cones, truly round.
bool touch_round(const ConvexOnSurface& on, const ConvexCore& core, SurfaceTriangle& t,
                 TriangleContact& out);

// A contact of a sharp core becomes that of the shape that it is grown to. Points where the grown
// surface bulges beyond them go; the deepest stays.
void grow_contact(const ConvexOnSurface& on, const ConvexCore& core, TriangleContact& contact);

// Names of edge and corner contacts, apart from those of faces (see part_of_plane).
inline constexpr std::uint32_t kFeaturePart = 1U << 31;
std::uint32_t feature_part(const SurfaceTriangle& t, SurfaceFeature feature);
// The same for all coplanar triangles.
std::uint32_t plane_part(NumVec normal, NumVec point, Num cell);

// Which part of the triangle lies farthest along n, and how far [m].
inline SurfaceFeature farthest_part(const ConvexOnSurface& on, const SurfaceTriangle& t, NumVec n,
                                    Num& along) {
  using Kind = SurfaceFeature::Kind;
  const Num d[3] = {dot(n, t.corner[0]), dot(n, t.corner[1]), dot(n, t.corner[2])};
  along = std::max(d[0], std::max(d[1], d[2]));
  const Num level = along - kAttained * on.thickness;
  int count = 0, last = 0;
  for (int i = 0; i < 3; ++i)
    if (d[i] >= level) ++count, last = i;
  if (count == 3) return {Kind::Face, 0};
  if (count == 1) return {Kind::Corner, last};
  for (int k = 0; k < 3; ++k)
    if (d[k] >= level && d[(k + 1) % 3] >= level) return {Kind::Edge, k};
  return {Kind::Corner, last};
}
// Whether the cone of an edge or a corner holds n.
inline bool cone_allows(const ConvexOnSurface& on, const SurfaceTriangle& t, SurfaceFeature feature,
                        NumVec n) {
  if (feature.kind == SurfaceFeature::Kind::Face) return false;  // its own normal, or its back
  return feature.kind == SurfaceFeature::Kind::Edge ? edge_allows(t, feature.index, n)
                                                    : on.surface.corner_allows(t, feature.index, n);
}

// Snaps a direction to the triangle's normal where it is that one to kSnapAngle; else says whether
// the feature's cone holds it.
bool allow_normal(const ConvexOnSurface& on, const SurfaceTriangle& t, SurfaceFeature feature,
                  NumVec& n, bool& of_face);
// The triangle as a face for clipping.
void polygon_of(const SurfaceTriangle& t, FacePolygon& out);

// Adds a triangle's contact to the group of its plane.
void gather(PartManifolds& all, const ConvexOnSurface& on, const SurfaceTriangle& t,
            const TriangleContact& contact);

}  // namespace plumb::inline PLUMB_ABI::detail
