// What a substep leaves to a contact row's bodies when its impulses are known.
#pragma once

#include "solver/contact_row.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// load: normal impulse of the row in the substep; sliding: the part of it that slides.
inline void note_load(WorldState& world, ContactRow<Real>& row, Real load, Real sliding) {
  // What a turntable carries has the velocity of the middle of the substep: nothing to correct.
  if (row.drive.z != Real(0) && sliding < load) sliding = Real(0);
  for (const std::uint32_t body : {row.body_a, row.body_b}) {
    SubstepBody& s = world.substep[body];
    if (!s.constrained) continue;
    s.load += load;
    s.sliding_load += sliding;
  }
  row.at_rest = load > Real(0);
  // Between two dynamic bodies the shift of the trapezoid would not keep their angular momentum.
  if (row.both_dynamic && load > Real(0)) {
    world.substep[row.body_a].contacts_changed = true;
    world.substep[row.body_b].contacts_changed = true;
  }
}

// A change in which points carry load marks both bodies, whose velocities then jump rather than
// ramp.
inline void note_loaded_points(WorldState& world, ContactRow<Real>& row) {
  const unsigned loaded = loaded_points(world, row);
  if (loaded == row.loaded) return;
  row.loaded = loaded;
  if (world.substep[row.body_a].constrained) world.substep[row.body_a].contacts_changed = true;
  if (world.substep[row.body_b].constrained) world.substep[row.body_b].contacts_changed = true;
}

inline void close_row(WorldState& world, ContactRow<Real>& row) {
  for (int i = 0; i < row.count; ++i) {
    row.points[i].impulse_sum += row.points[i].impulse;
    row.points[i].friction1_sum += row.points[i].friction1;
    row.points[i].friction2_sum += row.points[i].friction2;
  }
  note_loaded_points(world, row);
}

}  // namespace plumb::inline PLUMB_ABI::detail
