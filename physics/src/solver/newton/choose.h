// Which islands call for the accurate solver (ContactSolver::Auto), from what the rows carried in
// the last substep: a few comparisons a row, where its impulses are stored anyway.
//
//   mass      a body lies on one that is kLightest times lighter: heard at once
//   load      a contact presses a body with more than kMostLoad times its weight: what lies on it
//             is heavy, or many
//   overlap   bodies are pressed into one another: the fast solver does not carry what is there
//
// What strikes presses for a step or two, what carries goes on: load and overlap are heard after
// kStepsToBeLoad steps. A body that was heard stays with the accurate solver for a while, so that
// the two do not take turns.
#pragma once

#include <cstdint>

#include "plumb/precision.h"
#include "solver/contact_row.h"

namespace plumb::inline PLUMB_ABI::detail {
struct WorldState;

namespace newton {

struct Island;

enum class Call : std::uint8_t { None, Mass, Load, Overlap };

struct Calls {
  std::uint32_t mass = 0, load = 0, overlap = 0;  // rows, in the last step
};

// Looks at the rows of one world; made once a step.
class CallsOfRows {
 public:
  explicit CallsOfRows(const WorldState& world);
  [[nodiscard]] bool listens() const { return g_ > Real(0); }
  [[nodiscard]] Call of(const ContactRow<Real>& row) const;

 private:
  const WorldState& world_;
  Vec gravity_;  // [m/s^2]
  Real g_;       // [m/s^2]; 0: nothing has a weight to be carried, or the settings do not ask
};

// After the last substep: counts the calls, of_row[k] of row k, on their bodies.
void hear_calls(WorldState& world, const Call* of_row);

// Columns, chains and trees: factored with hardly any fill.
bool is_tree(const Island& island);
// Whether a called island may be begun, and how many factorizations a step it gets where so many
// islands share the step.
bool is_within_means(const Island& island);
std::uint32_t budget_of(const Island& island, std::uint32_t islands);

// The island's bodies go back to the fast solver and are not heard for a while.
void hear_no_more(WorldState& world, const Island& island);
// After the last substep: what took more than its share too often is heard no more.
void note_effort(WorldState& world, const Island& island);

// Whether any body that is awake is with the accurate solver.
bool is_called(WorldState& world);

}  // namespace newton
}  // namespace plumb::inline PLUMB_ABI::detail
