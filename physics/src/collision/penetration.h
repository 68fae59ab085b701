// The direction in which two convex cores have the most room, whether they overlap or not.
#pragma once

#include "collision/convex_core.h"

namespace plumb::inline PLUMB_ABI::detail {

struct RoomAxis {
  NumVec normal;      // unit, from A to B
  Num room;           // [m] of the cores along it: their distance, or minus their depth of overlap
  NumVec on_a, on_b;  // [m] points of the cores that have that room along the normal
  bool facing = false;  // whether those two face one another: on_b - on_a = room normal
};

// `best`: the most room of any direction. `preferred`: a direction that is perpendicular to a flat
// face and has at most kFacePreference x thickness less, that of A before that of B; else `best`.
// Returns false when the cores are farther apart than `reach` [m].
struct RoomAxes {
  RoomAxis preferred, best;
};
bool most_room(const ConvexCore& a, const ConvexCore& b, Num thickness, Num reach, RoomAxes& out);

// Finds points that face one another along an axis (and more room nearby, if there is any).
void refine_room(const ConvexCore& a, const ConvexCore& b, Num thickness, RoomAxis& axis);

}  // namespace plumb::inline PLUMB_ABI::detail
