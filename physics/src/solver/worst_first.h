// The contact resolver of the textbook (ContactSolver::WorstFirst), in place of the passes over the
// rows. Nothing is called in a world of the other solvers.
#pragma once

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

[[nodiscard]] bool resolves_worst_first(const WorldState& world);
// In a substep, after the drift: moves what penetrates apart, then lets what closes part.
void resolve_worst_first(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
