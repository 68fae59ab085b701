// The normals that an edge of a surface may be touched along are an arc: from the normal of its
// triangle to that of its neighbour.
#pragma once

#include "collision/convex_core.h"

namespace plumb::inline PLUMB_ABI::detail {

struct EdgeArc {
  NumVec corner;    // [m] of the edge
  NumVec along;     // unit: the edge
  NumVec from, to;  // unit, perpendicular to the edge, less than half a turn about it apart
};

struct ArcRoom {
  NumVec normal;  // unit, on the arc
  Num room;       // [m] of the core along it over the edge's line
};

// The direction on the arc in which the core has the most room, ends included. The best of all
// where the two are apart or overlap by less than the core curves; of deeper ones the best valley
// of those that quarters of the arc tell apart. Stops where there is more than `enough` [m].
ArcRoom most_room_on_arc(const ConvexCore& core, const EdgeArc& arc, Num enough);

}  // namespace plumb::inline PLUMB_ABI::detail
