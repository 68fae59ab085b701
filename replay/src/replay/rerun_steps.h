// A world brought to a recorded step by doing again what was done.
#pragma once

#include "replay/load.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// Whether a recording can be simulated again by this build at all.
Outcome check_replayable(const std::string& path, const Recording& recording);

// The world as the kept snapshot has it.
Outcome restore(const std::string& path, const Recording& recording, PhysicsWorld& world);

// Gives the step's inputs and steps; says why when the world does not take them.
Outcome step_again(const Recording& recording, const RecordedStep& step, PhysicsWorld& world);

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
