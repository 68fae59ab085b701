// Whether the plan chooses rightly: a step is taken again from the same snapshot with an item of
// the plan forced off, and forced on, and compared with the step as the plan had it.
//
//   chosen    the plan, or the step's own report, says that the item had work in this step
//   needless  chosen, but forced off nothing changes beyond the tolerance
//   missed    not chosen, but forced off something changes beyond the tolerance
//   by chance the same, but what changes is changed as much by roundings (twins.h): the scene
//             multiplies them, and the comparison cannot tell
//
// What saves work (kept manifolds, sleep) is the other way round: it is missed where taking it back
// changes something beyond the tolerance, and never needless.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::audit {

struct Count {
  std::uint32_t steps = 0;  // that were compared
  std::uint32_t chosen = 0, needless = 0, missed = 0, by_chance = 0;
  double off_change = 0;  // the greatest by forcing it off where it was not chosen (savings: was)
  double on_change = 0;   // the greatest by forcing it on where it was not chosen
};
using Counts = std::array<Count, kPlanItemCount>;

// What the audit looks at: what the engine chooses by itself, body by body, pair by pair, group by
// group or by reach. What a scene asks for outright is no choice.
bool is_audited(PlanItem item);
bool is_saving(PlanItem item);
// In body sizes a step (Gyroscopic: of a body's angular momentum; Sleeping: of the speed of what
// counts as resting) [-].
double tolerance_of(PlanItem item);

struct Sampling {
  int steps = 240;                   // of the run
  int every = 8;                     // of which one in so many is audited
  std::function<void()> progress{};  // called after each step, if there is one
};
// Steps the world along and adds to the counts.
void audit(PhysicsWorld& world, double dt, const Sampling& sampling, Counts& counts);

// A scene drawn by lot: two or three of piles, tumblers, bullets, rollers, whips, heavy on light,
// deep overlaps, spinners, air and water; the same on every machine.
void build_drawn_scene(PhysicsWorld& world, std::uint32_t seed);

}  // namespace plumb::inline PLUMB_ABI::audit
