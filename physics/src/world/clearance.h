// Pairs that were found apart need not be looked at again before their bodies may have come as near
// as contacts are made at. A pair remembers how far apart it was, bodies how far they have moved:
// most pairs whose bounds overlap are settled by a subtraction. No result depends on it.
#pragma once

#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// Finalize calls it for what has moved: from `before` to its pose, turned by `turn` [world axes].
void note_travel(WorldState& world, std::uint32_t dense, const BodyPose& before, Rotation turn);

// A body was put elsewhere, given another shape or velocity: nothing is known of it until its pairs
// have been looked at.
void forget_travel(WorldState& world, std::uint32_t body);

// After all pairs have been looked at: what fell asleep, or stands still where it was put, has
// moved no more.
void end_travels(WorldState& world);

// Takes from the pair's gap what its bodies have moved; whether the rest is surely wider than what
// contacts are made within in this step (reach_of in narrowphase.cpp) of a margin of kMarginSlops.
bool stays_clear(const WorldState& world, Pair& pair);

// The same for the boxes of its colliders in the broadphase: a body knows how much room they leave
// it. Whether it surely stays in them for one step more, in which nothing but gravity acts on it;
// the reach of its colliders is then that of an earlier step, where it is not worth renewing.
bool stays_in_boxes(WorldState& world, std::uint32_t body);
// They have been looked at: all of its colliders' reach lies within by at least `room` [m], and if
// `to_turn` that of balls in which they can turn.
void note_room(WorldState& world, std::uint32_t body, PosReal room, bool to_turn);
// [m] by which one box lies inside another, at least; negative if it does not.
PosReal room_in(const WorldAabb& outer, const WorldAabb& inner);

// [m] how far two boxes lie apart along the axis on which they do most; at most 0 if they overlap.
Real gap_of(const WorldAabb& a, const WorldAabb& b);

}  // namespace plumb::inline PLUMB_ABI::detail
