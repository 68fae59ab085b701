// The outside of a body as water and air meet it: what its solid colliders have for a surface, in
// the body's principal axes, from its centre of mass.
#pragma once

#include <memory>
#include <vector>

#include "collision/collision_tolerances.h"
#include "math/quaternion.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

struct SurfaceTriangle {
  NumVec a, b, c;  // [m] counter-clockwise seen from outside
};
struct SurfacePanel {
  NumVec center, normal;  // [m], unit outwards
  double area;            // [m^2]
};
struct SurfaceBall {
  NumVec center;  // [m]
  double radius;  // [m]
};
// A figure of revolution: the convex profile (r, y) grown by a ball of radius `rounding`.
struct SurfaceRound {
  NumVec center, axis;  // [m], unit
  struct {
    double r, y;  // [m]
  } profile[2];
  double rounding;  // [m]
};
// Closed surfaces of triangles, each with the factor by which its volume falls short of the true
// one (rounded boxes and hulls are taken with sharp edges).
struct SurfaceSolid {
  std::uint32_t begin, end;  // triangles
  double fill;               // [-] true volume / volume of the triangles
};

struct BodySurface {
  std::vector<SurfaceTriangle> triangles;
  std::vector<SurfaceSolid> solids;
  std::vector<SurfaceRound> rounds;
  std::vector<SurfaceBall> balls;
  std::vector<SurfacePanel> panels;  // all but balls
  double radius = 0;                 // [m] from the centre of mass to the farthest point
};

void make_surface(const WorldState& world, std::uint32_t body, BodySurface& out);
// Of one shape (a mesh: closed) in the body frame, instead of the colliders.
void make_surface(const Shape& shape, NumVec center_B, NumRotation R_BP, BodySurface& out);

// Within a step: made on first use, kept until the colliders or the mass of the body change.
const BodySurface& surface_of(WorldState& world, std::uint32_t body);
const BodySurface& hull_of(WorldState& world, std::uint32_t effect, const SurfaceMesh& mesh,
                           std::uint32_t body);

// The area that a body of attitude q shows in a direction [m^2]; exact for one convex collider.
double shown_area(const BodySurface& surface, NumRotation q, NumVec direction);

}  // namespace plumb::inline PLUMB_ABI::detail
