// What the narrowphase found, told: the counts of the step's report, and the bodies that lie deep
// in others, which are pushed out (solver/deep_bodies.h).
#pragma once

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// Counts the contacts, and notes the bodies that overlap deeply.
void report_contacts(WorldState& world);
// What lies on a body that is being pushed out, and on that, is pushed with it.
void spread_depth(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
