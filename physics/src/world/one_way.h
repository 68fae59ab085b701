// One-way colliders: from which side they are solid, and for whom. What a pair remembers is
// Pair::passage; all that happens is that the contacts of a passing pair are left out.
//
//   Apart    at its first contact a pair becomes Held if the other comes from within 60 degrees of
//            the solid side and does not overlap yet, else Passing
//   Held     until the shapes have parted, whichever way its contacts turn meanwhile
//   Passing  until the shapes do not overlap any more; then it is asked anew
#pragma once

#include <span>

#include "math/eigen_bridge.h"
#include "world/body_sweep.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// The passage of a one-way pair in this step, by the contacts found in it.
Passage passage_of(const WorldState& world, const Pair& pair, std::span<const Contact> contacts);

// Whether a meeting of two colliders seen by the continuous stage stops neither, because one of
// them lets the other through. normal: from A to B.
bool passes_one_way(const WorldState& world, std::uint32_t collider_a, std::uint32_t collider_b,
                    NumVec normal);

}  // namespace plumb::inline PLUMB_ABI::detail
