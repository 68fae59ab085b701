// Poses and velocities of a joint's bodies: read, changed by impulses along its rows, written.
#pragma once

#include "motion/rotation_flow.h"
#include "solver/joints/joint_poses.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// Where body k of a joint is.
inline Moved moved_now(const WorldState& world, const JointBlock& block, int k) {
  const BodyDelta& delta = world.delta[block.body[k]];
  if (block.moves[k] || block.body[k] == 0 || block.elapsed == Real(0)) return {delta.dp, delta.dq};
  const BodyVelocity& velocity = world.bodies.velocity[block.body[k]];
  return {delta.dp + block.elapsed * velocity.v,
          from_rotation_vector(block.elapsed * velocity.w) * delta.dq};
}

inline BlockVelocities read_velocities(const WorldState& world, const JointBlock& block) {
  BlockVelocities u;
  for (int k = 0; k < block.bodies; ++k) {
    const BodyVelocity& velocity = world.bodies.velocity[block.body[k]];
    u.v[k] = velocity.v;
    u.w[k] = velocity.w;
  }
  return u;
}
// Bodies that are not dynamic may stand in many joints; they are never written.
inline void write_velocities(WorldState& world, const JointBlock& block, const BlockVelocities& u) {
  for (int k = 0; k < block.bodies; ++k) {
    if (!block.moves[k]) continue;
    BodyVelocity& velocity = world.bodies.velocity[block.body[k]];
    velocity.v = u.v[k];
    velocity.w = u.w[k];
  }
}
inline Real row_rate(const JointBlock& block, int row, const BlockVelocities& u) {
  Real sum = 0;
  for (int k = 0; k < block.bodies; ++k) {
    const BodyJacobian& J = block.J[row * block.bodies + k];
    sum += dot(J.linear, u.v[k]) + dot(J.angular, u.w[k]);
  }
  return sum;
}
inline void apply_impulses(const JointBlock& block, const Real* impulse, BlockVelocities& u) {
  for (int k = 0; k < block.bodies; ++k) {
    if (!block.moves[k]) continue;
    Vec linear{0, 0, 0}, angular{0, 0, 0};
    for (int i = 0; i < block.rows; ++i) {
      const BodyJacobian& J = block.J[i * block.bodies + k];
      linear += impulse[i] * J.linear;
      angular += impulse[i] * J.angular;
    }
    u.v[k] += multiply_each(block.inverse_mass[k], linear);
    u.w[k] += block.inverse_inertia[k] * angular;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
