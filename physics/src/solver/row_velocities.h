// What one row reads of its bodies, and writes to them, in a pass over the rows.
#pragma once

#include "solver/contact_kernel.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

inline RowVelocities<Real> read_velocities(const WorldState& world, const ContactRow<Real>& row) {
  const BodyVelocity& a = world.bodies.velocity[row.body_a];
  const BodyVelocity& b = world.bodies.velocity[row.body_b];
  RowVelocities<Real> u{a.v, a.w, b.v, b.w, {}, {}};
  place_arms(row, delta_of_a(world, row).dp, delta_of_b(world, row).dp, u);
  return u;
}
// Bodies that are not dynamic may stand in many rows of a colour; they are never written.
inline void write_velocities(WorldState& world, const ContactRow<Real>& row,
                             const RowVelocities<Real>& u) {
  if (world.substep[row.body_a].constrained) {
    world.bodies.velocity[row.body_a].v = u.va;
    world.bodies.velocity[row.body_a].w = u.wa;
  }
  if (world.substep[row.body_b].constrained) {
    world.bodies.velocity[row.body_b].v = u.vb;
    world.bodies.velocity[row.body_b].w = u.wb;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
