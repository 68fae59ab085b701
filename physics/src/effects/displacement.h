// The part of a body that lies below a plane: its volume, the centre of it, and the waterline.
//
// Triangles: those of the surface, cut at the plane, with a point o of the plane as the apex of a
// tetrahedron each. The lid in the plane gives nothing, because o lies in it, and need not be
// built:
//   V = 1/6 sum a . (b x c),  integral r dV = sum V_i (a + b + c)/4
// exact for every closed surface, convex or not [Mirtich 1996]. The moments of the waterline area
// are those of the cut triangles' projections with the sign turned, because the surface is closed.
// Balls are spherical caps; figures of revolution are summed over slices across their axis, each a
// segment of a circle in closed form, by Gauss's rule between the places where it stops being
// smooth (1e-6 of the volume).
#pragma once

#include "effects/body_surface.h"

namespace plumb::inline PLUMB_ABI::detail {

// In the axes and from the origin of the surface.
struct Displacement {
  double volume = 0;                 // [m^3]
  NumVec first{0, 0, 0};             // [m^4] integral r dV
  double area = 0;                   // [m^2] of the waterline
  NumVec line{0, 0, 0};              // [m^3] integral r dA over it
  Symmetric3<double> line_second{};  // [m^4] integral r r^T dA
};
// Below: normal . r <= level; normal unit.
Displacement displaced_below(const BodySurface& surface, NumVec normal, double level);

}  // namespace plumb::inline PLUMB_ABI::detail
