// Which bodies moved so far in the step that they may have passed something: the continuous stage
// follows these along their paths.
#pragma once

#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// Slots of awake bodies of which some point moved by more than a fraction of their thickness,
// ascending. Reads what the substeps did (WorldState::delta).
StepList<std::uint32_t> bodies_that_moved_far(WorldState& world);
// How far some point of a body will get in a time [s], as it moves now [m].
Real path_ahead(const WorldState& world, std::uint32_t body, Real time);

}  // namespace plumb::inline PLUMB_ABI::detail
