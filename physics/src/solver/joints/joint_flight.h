// A group of joined bodies none of which touches anything, through one substep.
#pragma once

#include "solver/joints/joint_system.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// What it does depends on nothing outside of the group: groups may fly in any order, or at once.
void fly_joint_group(WorldState& world, JointPiece& piece);

}  // namespace plumb::inline PLUMB_ABI::detail
