// A triangle of a surface with what it must know of its neighbours.
//
// Which contact normals are real: at a point of a surface a body can only be touched along a
// direction n from which the whole neighbourhood of the point lies downhill (n . (x - p) <= 0), the
// polar of the tangent cone. Inside a triangle that is the triangle's normal; on an edge the arc
// between the normals of its two triangles, if the edge is a ridge, and nothing but the common
// normal if it is flat; at a corner what all edges that meet there leave over. A direction outside
// of this cone belongs to a closer place on a neighbour, which then gives the contact. Contacts
// kept to these cones are the same whatever the triangles a plane is cut into: no ghost collisions.
#pragma once

#include <cmath>
#include <cstdint>

#include "collision/surface/surface_tolerances.h"
#include "plumb/triangle_mesh.h"

namespace plumb::inline PLUMB_ABI::detail {

// Made in two steps: the plane for all that come near, the neighbours for those that touch.
struct SurfaceTriangle {
  std::uint32_t id;
  NumVec corner[3];  // [m] counter-clockwise from the front
  NumVec normal;     // unit
  Num offset;        // [m] normal . x of the plane
  // --- from here on by SurfaceSource::complete() ---
  EdgeKind kind[3];  // of the edge from corner k to the next
  NumVec beyond[3];  // convex edges: normal of the neighbour
  std::uint32_t corner_id[3], edge_id[3];

  [[nodiscard]] NumVec along(int k) const { return corner[(k + 1) % 3] - corner[k]; }
  [[nodiscard]] bool is_sharp(int k) const {
    return kind[k] == EdgeKind::Convex || kind[k] == EdgeKind::Open;
  }
  [[nodiscard]] bool has_sharp_edge() const { return is_sharp(0) || is_sharp(1) || is_sharp(2); }
  [[nodiscard]] Num height(NumVec p) const { return dot(normal, p) - offset; }
};

// Where on a triangle a point lies.
struct SurfaceFeature {
  enum class Kind { Face, Edge, Corner };
  Kind kind = Kind::Face;
  int index = 0;  // of the edge or the corner
};

struct ClosestOnTriangle {
  NumVec point;
  SurfaceFeature feature;
};
// By Voronoi regions of the triangle [Ericson 2005, 5.1.5].
ClosestOnTriangle closest_on_triangle(const SurfaceTriangle& t, NumVec p);

// The normal by its longest cross product: of the three, the one of the two sides that meet at the
// largest angle loses least.
NumVec doubled_area(NumVec a, NumVec b, NumVec c);

// How two triangles meet over the edge from v0 to v1: normal and far corner of each. `noise` [m]:
// how far a corner may be off by rounding.
EdgeKind kind_of_edge(NumVec v0, NumVec v1, NumVec normal_a, NumVec far_a, NumVec normal_b,
                      NumVec far_b, Num noise);

// Whether an edge's cone holds a unit vector. Only for edges; snapping to the normal of the
// triangle is the caller's.
bool edge_allows(const SurfaceTriangle& t, int k, NumVec n);

// What a surface tells of the neighbourhood of a triangle.
class SurfaceSource {
 public:
  // Fills in what a triangle knows of its neighbours.
  virtual void complete(SurfaceTriangle& t) const = 0;
  // Whether the cone of a corner holds a unit vector: no edge that meets there rises along it.
  [[nodiscard]] virtual bool corner_allows(const SurfaceTriangle& t, int corner,
                                           NumVec n) const = 0;

 protected:
  ~SurfaceSource() = default;
};

}  // namespace plumb::inline PLUMB_ABI::detail
