#include "world/body_sweep.h"

#include "motion/rotation_flow.h"
#include "world/forced.h"

namespace plumb::inline PLUMB_ABI::detail {

Sweep sweep_of_step(const WorldState& world, std::uint32_t dense, PosVec reference) {
  const BodyStore& bodies = world.bodies;
  const BodyPose& pose = bodies.pose[dense];
  Sweep sweep = resting_at(cast<Num>(pose.x - reference), normalized(to_num(pose.q)));
  if (dense < bodies.awake_begin || dense >= bodies.awake_end) return sweep;
  const BodyDelta& delta = world.delta[dense];
  const BodyMass& mass = bodies.mass[dense];
  const BodyForce& force = bodies.force[dense];
  const Num dt = static_cast<Num>(world.dt);
  const NumVec expected = dt * to_num(bodies.velocity[dense].w);
  sweep.travel = to_num(delta.dp);
  if (!(mass.mass > Real(0))) {  // kinematic
    sweep.turn = expected;
    return sweep;
  }
  const NumRotation turned = normalized(to_num(delta.dq));
  if (!flies_free(world, dense)) {
    sweep.turn = turn_between(sweep.start, turned * sweep.start, expected);
    return sweep;
  }
  sweep.start = normalized(conjugate(turned) * sweep.start);  // it has turned already
  if (flies_a_parabola(world, dense)) {
    sweep.bend = (Num(0.5) * dt * dt) * to_num(world.substep[dense].acceleration);
    sweep.travel = sweep.travel - sweep.bend;
  }
  const bool steady = mass.angular_locks != 0 || force.angular_damping > Real(0) ||
                      length_squared(force.torque) > Real(0) ||
                      rotation_of(world.settings) != RotationMethod::Exact ||
                      lacks_gyroscopic_term(world.settings, mass) ||
                      classify_inertia(mass.inverse_moments) == RotationKind::Isotropic;
  if (steady) {
    sweep.turn = turn_between(sweep.start, turned * sweep.start, expected);
  } else {
    sweep.tumbles = true;
    sweep.momentum = dt * to_num(bodies.momentum[dense].L);
    sweep.inverse_moments = to_num(mass.inverse_moments);
  }
  return sweep;
}

}  // namespace plumb::inline PLUMB_ABI::detail
