#include "world/body_sweep.h"

#include "motion/rotation_flow.h"
#include "world/forced.h"

namespace plumb::inline PLUMB_ABI::detail {

namespace {

bool is_still(const BodyStore& bodies, std::uint32_t dense) {
  return dense < bodies.awake_begin || dense >= bodies.awake_end;
}

}  // namespace

Sweep path_of_step(const WorldState& world, std::uint32_t dense, PosVec reference) {
  Sweep sweep;
  sweep.centre = cast<Num>(world.bodies.pose[dense].x - reference);
  if (is_still(world.bodies, dense)) return sweep;
  sweep.travel = to_num(world.delta[dense].dp);
  if (!flies_a_parabola(world, dense)) return sweep;
  const Num dt = static_cast<Num>(world.dt);
  sweep.bend = (Num(0.5) * dt * dt) * to_num(world.substep[dense].acceleration);
  sweep.travel = sweep.travel - sweep.bend;
  return sweep;
}

void add_turn_of_step(const WorldState& world, std::uint32_t dense, Sweep& sweep) {
  const BodyStore& bodies = world.bodies;
  sweep.start = normalized(to_num(bodies.pose[dense].q));
  if (is_still(bodies, dense)) return;
  const BodyDelta& delta = world.delta[dense];
  const BodyMass& mass = bodies.mass[dense];
  const BodyForce& force = bodies.force[dense];
  const Num dt = static_cast<Num>(world.dt);
  const NumVec expected = dt * to_num(bodies.velocity[dense].w);
  if (!(mass.mass > Real(0))) {  // kinematic
    sweep.turn = expected;
    return;
  }
  const NumRotation turned = normalized(to_num(delta.dq));
  if (!flies_free(world, dense)) {
    sweep.turn = turn_between(sweep.start, turned * sweep.start, expected);
    return;
  }
  sweep.start = normalized(conjugate(turned) * sweep.start);  // it has turned already
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
}

Sweep sweep_of_step(const WorldState& world, std::uint32_t dense, PosVec reference) {
  Sweep sweep = path_of_step(world, dense, reference);
  add_turn_of_step(world, dense, sweep);
  return sweep;
}

}  // namespace plumb::inline PLUMB_ABI::detail
