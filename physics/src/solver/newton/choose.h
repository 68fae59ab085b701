// Which islands call for the accurate solver (ContactSolver::Auto), from what the last step left:
// a few comparisons a contact.
//
//   mass      a body lies on one that is kLightest times lighter
//   load      contacts press a body with more than kMostLoad times its weight: what lies on it is
//             heavy, or many
//   overlap   bodies are pressed into one another: the fast solver does not carry what is there
//
// A body that has called stays with it for a while, so that the two solvers do not take turns.
#pragma once

#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {
struct WorldState;

namespace newton {

enum class Call : std::uint8_t { None, Mass, Load, Overlap };

struct Calls {
  std::uint32_t mass = 0, load = 0, overlap = 0;  // contacts
  [[nodiscard]] bool any() const { return mass + load + overlap > 0; }
};
Calls look_for_calls(const WorldState& world);

// Notes who calls. Returns whether any body is with the accurate solver.
bool choose_bodies(WorldState& world);

}  // namespace newton
}  // namespace plumb::inline PLUMB_ABI::detail
