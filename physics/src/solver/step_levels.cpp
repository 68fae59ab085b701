#include "solver/step_levels.h"

#include <algorithm>
#include <cmath>

#include "solver/plain_bodies.h"
#include "world/forced.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

int most_halvings(int substeps) {
  int halvings = 0;
  for (; substeps % 2 == 0 && substeps / 2 >= tolerance::kFewestSubsteps; substeps /= 2) ++halvings;
  return halvings;
}

int halvings_for(const WorldState& world, int wanted, Real approach, Real longest) {
  int halvings = std::min(wanted, most_halvings(world.settings.substeps));
  for (; halvings > 0; --halvings) {
    const Real h = static_cast<Real>(1 << halvings) * world.h;
    const Real blow = Real(0.5) * h * approach;  // [m]
    if (blow <= step_tolerance_of(world.settings) && h <= longest) break;
  }
  return halvings;
}

void coarsen_row(const WorldState& world, ContactRow<Real>& row, int halvings) {
  const Real longer = static_cast<Real>(1 << halvings);
  for (int i = 0; i < row.count; ++i) {
    row.points[i].impulse *= longer;
    row.points[i].friction1 *= longer;
    row.points[i].friction2 *= longer;
  }
  row.negligible *= longer;
  row.cut_unit *= longer;
  soften_row(world, row, longer * world.h);
}

void refine_row(ContactRow<Real>& row, int halvings) {
  const Real shorter = Real(1) / static_cast<Real>(1 << halvings);
  for (int i = 0; i < row.count; ++i) {
    row.points[i].impulse *= shorter;
    row.points[i].friction1 *= shorter;
    row.points[i].friction2 *= shorter;
  }
}

StepErrors::StepErrors(WorldState& world, const StepGroup& group)
    : world_(world),
      group_(group),
      on_(step_tolerance_of(world.settings) > Real(0) && group.number != kTogether) {}

template <class Task>
void StepErrors::for_bodies(Task&& task) const {
  for_bodies_of(group_, [&](std::uint32_t i) {
    if (world_.substep[i].constrained) task(i);
  });
}

void StepErrors::note_substep() {
  if (!on_) return;
  for_bodies([&](std::uint32_t i) {
    const SubstepBody& s = world_.substep[i];
    StepError& error = world_.step_errors[i];
    const Vec dv = world_.bodies.velocity[i].v - s.v_start;
    const Vec dL = world_.bodies.momentum[i].L - s.L_start;
    if (first_) {
      error = {dv, Real(0), dL};
      return;
    }
    const Real far = world_.bodies.extent[world_.bodies.slot_of[i]].radius;
    error.sum += length(dv - error.dv) + far * length(s.I_inverse * (dL - error.dL));
    error.dv = dv;
    error.dL = dL;
  });
  first_ = false;
}

std::uint32_t StepErrors::settle() {
  if (!on_) return 0;
  std::uint32_t bodies = 0;
  const Real allowed = step_tolerance_of(world_.settings);
  const int most = most_halvings(world_.settings.substeps);
  for_bodies([&](std::uint32_t i) {
    ++bodies;
    StepLevel& level = world_.bodies.info[world_.bodies.slot_of[i]].level;
    Real error = group_.h * world_.step_errors[i].sum;
    // Its wish for fewer has been granted: from here on it is calm at the new level, or is not.
    if (level.calm_steps >= tolerance::kCalmSteps && level.halvings == group_.halvings)
      level.calm_steps = 0;
    int halvings = group_.halvings;
    if (error < tolerance::kCalmShare * allowed) {
      level.calm_steps =
          static_cast<std::uint8_t>(std::min(level.calm_steps + 1, tolerance::kCalmSteps));
      if (level.calm_steps == tolerance::kCalmSteps) halvings = std::min(halvings + 1, most);
    } else {
      level.calm_steps = 0;
      for (; halvings > 0 && !(error <= allowed); error *= Real(0.5)) --halvings;
    }
    level.halvings = static_cast<std::uint8_t>(halvings);
  });
  return bodies;
}

void forget_levels_together(WorldState& world) {
  for (std::uint32_t i = world.bodies.awake_begin; i < world.bodies.awake_end; ++i)
    if (world.substep[i].constrained && world.groups.group_of[i] == kTogether)
      world.bodies.info[world.bodies.slot_of[i]].level = {};
}

}  // namespace plumb::inline PLUMB_ABI::detail
