// The accurate solver of contacts and joints: a proximal semismooth Newton method, island by
// island, beside the soft-step solver and on the same manifolds, materials, drives and joints.
//
// Islands are found before the rows are coloured (islands.cpp); their rows have no colour and stand
// behind all others. In each substep an island is solved as a whole: once for the velocities with
// which the substep ends, and, where something overlaps, once more for those that also work the
// overlap off, with which it drifts. What pushes bodies apart leaves no velocity behind.
//
// Law: contact_law.h. Factor: body_matrix.h. Newton: newton_method.h. Ramp, outer iteration and
// fallback: proximal.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/newton/island.h"

namespace plumb::inline PLUMB_ABI::detail {
struct WorldState;

namespace newton {

struct IslandPlace {
  std::uint32_t island = 0xffffffffu;
  int body = kFixed;
};

struct Solver {
  std::vector<Island> islands;  // the first `count`; kept for their storage
  std::uint32_t count = 0;
  std::vector<IslandPlace> place;  // per dense index
  std::vector<std::uint32_t> parents;
  std::uint32_t too_large = 0;  // islands left to the fast solver
};

}  // namespace newton

// --- stages; nothing is called in a world of soft steps only ---
// Which islands are solved here. Before colouring.
void find_newton_islands(WorldState& world);
[[nodiscard]] bool in_newton_island(const WorldState& world, std::uint32_t dense);
// Rows and joints of the islands. After the rows are built.
void gather_newton_islands(WorldState& world);
// In a substep: velocities to drift with; after the drift, those that stay.
void solve_newton_islands(WorldState& world);
void settle_newton_islands(WorldState& world);
// After the last substep: what it took.
void report_newton_islands(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
