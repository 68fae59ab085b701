// From the world to the numbers of an island, and back; once a substep.
#pragma once

#include "solver/newton/newton_solver.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

void fill_island(const WorldState& world, const Solver& solver, Island& island);
// Impulses go back to rows and joints.
void store_island(WorldState& world, Island& island);

// --- joints (joint_part.cpp) ---
void fill_joints(const WorldState& world, const Solver& solver, Island& island);
void store_joints(WorldState& world, const Island& island);

}  // namespace plumb::inline PLUMB_ABI::detail::newton
