// Level of detail in time (WorldSettings::step_tolerance): islands that err by less than the
// tolerance with half of the world's substeps, a quarter, ... take no more.
//
//   what a step errs by   e = h sum |d_k - d_(k-1)| [m] over its substeps h, where rows changed
//                         the velocity of a body's farthest point by d_k in substep k. Rows that go
//                         on pushing as they did are followed exactly by the trapezoid; of a jump
//                         it is not known when within the substep it was; what varies smoothly has
//                         differences ~ h^2, and e is of second order like the scheme's error.
//   what is to come       a pair that begins to touch with an approach v jumps by v: h v / 2
//   stiffness             no contact gets softer: what lies there sinks no deeper with fewer
//   substeps finer                 in the next step, by as many doublings as the error asks for
//   coarser               one halving, after some steps in a row with errors far below the
//   tolerance
//
// Levels are powers of two, and rows keep their impulses as those of the world's substep: changing
// the level scales them exactly, no velocity changes, and no energy is gained.
#pragma once

#include <vector>

#include "solver/step_groups.h"
#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

// How often a world's substeps may be halved.
int most_halvings(int substeps);
// How often those of an island are: `wanted` by its bodies, with the fastest approach [m/s] of what
// begins to touch, and the longest substep [s] that its contacts bear.
int halvings_for(const WorldState& world, int wanted, Real approach, Real longest);

// Makes a row that was built for the world's substep one for substeps of 2^halvings that length.
void coarsen_row(const WorldState& world, ContactRow<Real>& row, int halvings);
// Its impulses are again those of the world's substep.
void refine_row(ContactRow<Real>& row, int halvings);

// What the substeps of a group tell of their errors; nothing unless the settings ask for it.
class StepErrors {
 public:
  StepErrors(WorldState& world, const StepGroup& group);
  void note_substep();
  // After the last one: what their bodies want next. Returns how many bodies the group has.
  std::uint32_t settle();

 private:
  template <class Task>
  void for_bodies(Task&& task) const;

  WorldState& world_;
  const StepGroup& group_;
  bool on_;
  bool first_ = true;
};

// Bodies that go together have all substeps.
void forget_levels_together(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
