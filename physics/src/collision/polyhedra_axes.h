// Along which axis two polyhedra are farthest apart, or overlap least: over faces, and over the
// edge pairs whose arcs cross on the Gauss map [Gregorius 2013]. Faces and edges that cannot beat
// the best axis found so far are passed over by balls inside the shapes, and the search ends early
// at an axis that provably no other one beats.
#pragma once

#include "collision/axes_kernel.h"
#include "collision/placed_polyhedron.h"

namespace plumb::inline PLUMB_ABI::detail {

struct PolyhedraAxes {
  FaceAxis face_a, face_b;  // of either one; minus infinity where it is surely no better
  EdgesAxis edges;          // by the edges' own numbers; -1: none beats the faces
  [[nodiscard]] Num separation() const {
    return std::max(edges.separation, std::max(face_a.separation, face_b.separation));
  }
};

// Returns false, with the gap and the axis noted in `out`, when the shapes are more than the margin
// [m] apart. `out.axis` is looked at first, and left as what should be looked at first next time.
bool find_axes(const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num margin, Contacts& out,
               PolyhedraAxes& axes);

}  // namespace plumb::inline PLUMB_ABI::detail
