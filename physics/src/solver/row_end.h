// What a substep leaves to a contact row's bodies when its impulses are known.
#pragma once

#include <algorithm>

#include "solver/contact_kernel.h"
#include "world/visible.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// Notes what a watched row bears [N s].
inline void note_pressing(ContactRow<Real>& row, Real impulse) {
  row.pressed = std::max(row.pressed, impulse);
  if (row.told_anew) row.pressed_anew = std::max(row.pressed_anew, impulse);
}
inline Real load_of(const ContactRow<Real>& row) {
  Real load = 0;
  for (int i = 0; i < row.count; ++i) load += row.points[i].impulse;
  return load;
}
// Whether a normal impulse [N s] in it moves its bodies visibly in this step.
inline bool shows(const WorldState& world, const ContactRow<Real>& row, Real impulse) {
  if (!(impulse > Real(0))) return false;
  const auto moves = [&](std::uint32_t body, const auto& inverse_mass, const auto& inverse_inertia,
                         Vec arm) {
    return parts_visibly(world.bodies.mass[body], impulse * multiply_each(inverse_mass, row.n),
                         impulse * (inverse_inertia * cross(arm, row.n)), world.dt);
  };
  return moves(row.body_a, row.inverse_mass_a, row.inverse_inertia_a, row.arm_a) ||
         moves(row.body_b, row.inverse_mass_b, row.inverse_inertia_b, row.arm_b);
}

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
  if (row.watched) note_pressing(row, load);
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
