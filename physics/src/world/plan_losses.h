// What is lost where an item of the plan is forced off: a bound, by the numbers of the scene.
#pragma once

#include <string>

#include "world/plan_tally.h"

namespace plumb::inline PLUMB_ABI::detail {

// For an item that the scene calls for.
std::string loss_of(const WorldState& world, const PlanTally& tally, PlanItem item);

}  // namespace plumb::inline PLUMB_ABI::detail
