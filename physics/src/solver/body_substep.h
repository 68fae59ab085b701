// How one body that rows hold goes through a substep.
#pragma once

#include "motion/body_motion.h"
#include "solver/body_kernel.h"
#include "solver/contact_row.h"
#include "world/forced.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

inline Rotation orientation_now(const WorldState& world, std::uint32_t i) {
  return world.delta[i].dq * world.bodies.pose[i].q;
}

// Forces act for a time [s]; damping is exact.
inline void kick(WorldState& world, std::uint32_t i, Real time) {
  SubstepBody& s = world.substep[i];
  BodyVelocity& velocity = world.bodies.velocity[i];
  const BodyForce& force = world.bodies.force[i];
  Vec& L = world.bodies.momentum[i].L;
  s.v_start = velocity.v;
  s.L_start = L;
  if (force.linear_damping > Real(0)) {
    const DampedMotion damped = damped_motion(force.linear_damping, time);
    velocity.v = damped.decay * velocity.v + damped.gain * s.acceleration;
  } else {
    velocity.v += time * s.acceleration;
  }
  if (force.angular_damping > Real(0)) {
    const DampedMotion damped = damped_motion(force.angular_damping, time);
    L = damped.decay * L + damped.gain * force.torque;
  } else {
    L += time * force.torque;
  }
  velocity.w = angular_velocity_of(world.bodies.mass[i], orientation_now(world, i), L);
  s.w_in = velocity.w;
}

// What the rows did to w becomes angular momentum, by the same inertia with which they saw the
// body.
inline void collect_momentum(WorldState& world, std::uint32_t i) {
  SubstepBody& s = world.substep[i];
  world.bodies.momentum[i].L += s.I * (world.bodies.velocity[i].w - s.w_in);
}

// Velocity to position, by the torque-free flow with L fixed.
inline void drift(WorldState& world, std::uint32_t i, Real h) {
  BodyVelocity& velocity = world.bodies.velocity[i];
  BodyDelta& delta = world.delta[i];
  collect_momentum(world, i);
  delta.dp += h * velocity.v;
  Rotation q = orientation_now(world, i);
  Vec& L = world.bodies.momentum[i].L;
  const Vec L_before = L;
  turn(world.settings, world.bodies.mass[i], q, L, h);
  world.substep[i].L_start += L - L_before;  // what turning changes is not lost to rows
  delta.dq = normalized(q * conjugate(world.bodies.pose[i].q));
  velocity.w = angular_velocity_of(world.bodies.mass[i], q, L);
  world.substep[i].w_in = velocity.w;
}

// The inertia as rows see it from here on.
inline void turn_inertia(WorldState& world, std::uint32_t i) {
  SubstepBody& s = world.substep[i];
  const Rotation q = orientation_now(world, i);
  s.I = world_inertia(world.bodies.mass[i], q);
  s.I_inverse = world_inverse_inertia(world.bodies.mass[i], q);
}

}  // namespace plumb::inline PLUMB_ABI::detail
