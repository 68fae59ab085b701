// What a substep leaves to a contact row's bodies when its impulses are known.
#pragma once

#include "solver/contact_kernel.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// load: normal impulse of the row in the substep; sliding: the part of it that slides.
inline void note_load(WorldState& world, ContactRow<Real>& row, Real load, Real sliding) {
  // What a turntable carries has the velocity of the middle of the substep: nothing to correct.
  if (row.drive.z != Real(0) && sliding < load) sliding = Real(0);
  for (const std::uint32_t body : {row.body_a, row.body_b}) {
    if (!world.substep[body].constrained) continue;
    world.bodies.velocity[body].load += load;
    world.bodies.velocity[body].sliding_load += sliding;
  }
  row.at_rest = load > Real(0);
  // Between two dynamic bodies the shift of the trapezoid would not keep their angular momentum.
  if (row.both_dynamic && load > Real(0)) {
    world.contacts_changed[row.body_a] = 1;
    world.contacts_changed[row.body_b] = 1;
  }
}

// A change in which points carry load marks both bodies, whose velocities then jump rather than
// ramp.
inline void close_row(WorldState& world, ContactRow<Real>& row) {
  if (!end_substep(row)) return;
  if (world.substep[row.body_a].constrained) world.contacts_changed[row.body_a] = 1;
  if (world.substep[row.body_b].constrained) world.contacts_changed[row.body_b] = 1;
}

}  // namespace plumb::inline PLUMB_ABI::detail
