// Contact points of a capsule on a polyhedron, once the direction between them is known.
#pragma once

#include "collision/face_overlay.h"
#include "collision/segment.h"

namespace plumb::inline PLUMB_ABI::detail {

// How the capsule's axis lies to the polyhedron, in the polyhedron's frame.
struct AxisProximity {
  NumVec normal;   // unit, from the polyhedron to the axis
  Num distance;    // [m] along it, negative when the axis dips in
  NumVec on_axis;  // the closest (or deepest) point of the axis
};

// Points at both ends of what the axis has above `face`, or the one at on_axis if those do not
// contain the closest. `thickness` [m]: half thickness of the thinner shape.
void add_capsule_contacts(const FacePolygon& face, const Segment& axis, Num radius,
                          const AxisProximity& proximity, Num thickness, Num margin, Contacts& out);

// Depth of an axis that passes through a polyhedron: faces, and edges against the axis.
class PlacedPolyhedron;
AxisProximity deepest_of_axis(const PlacedPolyhedron& polyhedron, const Segment& axis,
                              Num thickness);

}  // namespace plumb::inline PLUMB_ABI::detail
