// An explosion in numbers.
#pragma once

#include "collision/collision_tolerances.h"
#include "plumb/effects.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// The part of the front [-] that passes distance r [m] between two ages of the blast [s].
double share_of_front(const Explosion& blast, double r, double from, double to);
double impulse_at(const Explosion& blast, double r);  // [N s/m^2] of the whole front
double updraft_at(const Explosion& blast, NumVec from_center, NumVec up);  // [m/s^2]
NumVec up_of(const WorldState& world);                                     // unit

}  // namespace plumb::inline PLUMB_ABI::detail
