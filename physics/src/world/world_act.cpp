// Acting on bodies: forces, impulses, velocities, poses.
#include <cmath>

#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "world/body_sweep.h"
#include "world/inputs.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

// Wakes a dynamic body for something that acts on it; says why when that makes no sense.
Status ready_to_act(PhysicsWorld& self, WorldState& world, BodyId body, const Vec3& value) {
  if (world.stepping) return inside_step();
  if (!self.is_valid(body)) return stale_body();
  if (!all_finite(value)) return {StatusCode::NotFinite, "the vector is not finite"};
  if (world.bodies.info[body.index].type != MotionType::Dynamic)
    return {StatusCode::WrongMotionType, "forces and impulses act on dynamic bodies only"};
  if (world.bodies.info[body.index].disabled)
    return {StatusCode::WrongMotionType,
            "the body is quarantined: its state had become non-finite"};
  return {};
}

void push_velocity(WorldState& world, std::uint32_t dense, Vec impulse, Vec angular_impulse) {
  const BodyMass& m = world.bodies.mass[dense];
  BodyVelocity& velocity = world.bodies.velocity[dense];
  velocity.v += multiply_each(m.inverse_mass, impulse);
  Vec& L = world.bodies.momentum[dense].L;
  L += angular_impulse;
  if (m.angular_locks != 0)  // what a lock takes up is gone
    L = {(m.angular_locks & 1u) != 0 ? Real(0) : L.x, (m.angular_locks & 2u) != 0 ? Real(0) : L.y,
         (m.angular_locks & 4u) != 0 ? Real(0) : L.z};
  velocity.w = angular_velocity_of(m, world.bodies.pose[dense].q, L);
}

Vec arm_to(const WorldState& world, std::uint32_t dense, const Pos3& p_W) {
  return cast<Real>(to_inner_position(p_W) - world.bodies.pose[dense].x);
}
Vec arm_to_body_point(const WorldState& world, std::uint32_t body, const Vec3& p_B) {
  const BodyInfo& info = world.bodies.info[body];
  const Rotation R_WB = world.bodies.pose[info.dense].q * conjugate(info.R_BP);
  return rotate(R_WB, to_inner(p_B) - info.center_B);
}

}  // namespace
}  // namespace detail

using detail::WorldState;

Status PhysicsWorld::apply_force(BodyId body, const Vec3& force) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, force); !status) return status;
  detail::note_input(world, InputKind::ApplyForce, body.value(),
                     [&](auto& out) { detail::append(out, force); });
  detail::wake_body(world, body.index);
  world.bodies.force[world.bodies.info[body.index].dense].force += detail::to_inner(force);
  return {};
}

Status PhysicsWorld::apply_force_at(BodyId body, const Vec3& force, const Pos3& p_W) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, force); !status) return status;
  if (!detail::all_finite(p_W)) return {StatusCode::NotFinite, "the point is not finite [m]"};
  detail::note_input(world, InputKind::ApplyForceAt, body.value(), [&](auto& out) {
    detail::append(out, force);
    detail::append_position(out, p_W);
  });
  detail::wake_body(world, body.index);
  const std::uint32_t dense = world.bodies.info[body.index].dense;
  world.bodies.force[dense].force += detail::to_inner(force);
  world.bodies.force[dense].torque +=
      cross(detail::arm_to(world, dense, p_W), detail::to_inner(force));
  return {};
}

Status PhysicsWorld::apply_force_at_body_point(BodyId body, const Vec3& force, const Vec3& p_B) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, force); !status) return status;
  if (!detail::all_finite(p_B)) return {StatusCode::NotFinite, "the point is not finite [m]"};
  detail::note_input(world, InputKind::ApplyForceAtBodyPoint, body.value(), [&](auto& out) {
    detail::append(out, force);
    detail::append(out, p_B);
  });
  detail::wake_body(world, body.index);
  const std::uint32_t dense = world.bodies.info[body.index].dense;
  world.bodies.force[dense].force += detail::to_inner(force);
  world.bodies.force[dense].torque +=
      cross(detail::arm_to_body_point(world, body.index, p_B), detail::to_inner(force));
  return {};
}

Status PhysicsWorld::apply_torque(BodyId body, const Vec3& torque) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, torque); !status)
    return status;
  detail::note_input(world, InputKind::ApplyTorque, body.value(),
                     [&](auto& out) { detail::append(out, torque); });
  detail::wake_body(world, body.index);
  world.bodies.force[world.bodies.info[body.index].dense].torque += detail::to_inner(torque);
  return {};
}

Status PhysicsWorld::apply_impulse(BodyId body, const Vec3& impulse) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, impulse); !status)
    return status;
  detail::note_input(world, InputKind::ApplyImpulse, body.value(),
                     [&](auto& out) { detail::append(out, impulse); });
  detail::wake_body(world, body.index);
  detail::push_velocity(world, world.bodies.info[body.index].dense, detail::to_inner(impulse),
                        {0, 0, 0});
  return {};
}

Status PhysicsWorld::apply_impulse_at(BodyId body, const Vec3& impulse, const Pos3& p_W) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, impulse); !status)
    return status;
  if (!detail::all_finite(p_W)) return {StatusCode::NotFinite, "the point is not finite [m]"};
  detail::note_input(world, InputKind::ApplyImpulseAt, body.value(), [&](auto& out) {
    detail::append(out, impulse);
    detail::append_position(out, p_W);
  });
  detail::wake_body(world, body.index);
  const std::uint32_t dense = world.bodies.info[body.index].dense;
  detail::push_velocity(world, dense, detail::to_inner(impulse),
                        cross(detail::arm_to(world, dense, p_W), detail::to_inner(impulse)));
  return {};
}

Status PhysicsWorld::apply_impulse_at_body_point(BodyId body, const Vec3& impulse,
                                                 const Vec3& p_B) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, impulse); !status)
    return status;
  if (!detail::all_finite(p_B)) return {StatusCode::NotFinite, "the point is not finite [m]"};
  detail::note_input(world, InputKind::ApplyImpulseAtBodyPoint, body.value(), [&](auto& out) {
    detail::append(out, impulse);
    detail::append(out, p_B);
  });
  detail::wake_body(world, body.index);
  detail::push_velocity(
      world, world.bodies.info[body.index].dense, detail::to_inner(impulse),
      cross(detail::arm_to_body_point(world, body.index, p_B), detail::to_inner(impulse)));
  return {};
}

Status PhysicsWorld::apply_angular_impulse(BodyId body, const Vec3& impulse) {
  WorldState& world = *state_;
  if (const Status status = detail::ready_to_act(*this, world, body, impulse); !status)
    return status;
  detail::note_input(world, InputKind::ApplyAngularImpulse, body.value(),
                     [&](auto& out) { detail::append(out, impulse); });
  detail::wake_body(world, body.index);
  detail::push_velocity(world, world.bodies.info[body.index].dense, {0, 0, 0},
                        detail::to_inner(impulse));
  return {};
}

Status PhysicsWorld::set_pose(BodyId body, const Pose& pose) {
  WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(body)) return detail::stale_body();
  if (const Status status = detail::check_pose(pose); !status) return status;
  detail::note_input(world, InputKind::SetPose, body.value(), [&](auto& out) {
    detail::append_position(out, pose.position);
    detail::append(out, pose.orientation);
  });
  detail::BodyInfo& info = world.bodies.info[body.index];
  if (info.type == MotionType::Dynamic) detail::wake_body(world, body.index);
  detail::wake_around(world, body.index);  // what rested on it
  const detail::Rotation R_WB = detail::normalized(detail::to_inner(pose.orientation));
  detail::BodyPose& inner = world.bodies.pose[info.dense];
  inner.q = normalized(R_WB * info.R_BP);
  inner.x =
      detail::to_inner_position(pose.position) + detail::cast<PosReal>(rotate(R_WB, info.center_B));
  // The velocities stay; the angular momentum follows the new orientation.
  world.bodies.momentum[info.dense].L = angular_momentum_of(world.bodies.mass[info.dense], inner.q,
                                                            world.bodies.velocity[info.dense].w);
  for (const std::uint32_t collider : info.colliders) detail::update_proxy(world, collider, true);
  detail::wake_around(world, body.index);  // what it was put on
  return {};
}

namespace {

Status ready_for_velocity(const PhysicsWorld& self, const WorldState& world, BodyId body,
                          const Vec3& value) {
  if (world.stepping) return detail::inside_step();
  if (!self.is_valid(body)) return detail::stale_body();
  if (!detail::all_finite(value)) return {StatusCode::NotFinite, "velocity is not finite"};
  if (world.bodies.info[body.index].type == MotionType::Static)
    return {StatusCode::WrongMotionType, "a static body cannot have a velocity: make it kinematic"};
  if (world.bodies.info[body.index].disabled)
    return {StatusCode::WrongMotionType,
            "the body is quarantined: its state had become non-finite"};
  return {};
}

}  // namespace

Status PhysicsWorld::set_linear_velocity(BodyId body, const Vec3& velocity) {
  WorldState& world = *state_;
  if (const Status status = ready_for_velocity(*this, world, body, velocity); !status)
    return status;
  detail::note_input(world, InputKind::SetLinearVelocity, body.value(),
                     [&](auto& out) { detail::append(out, velocity); });
  const bool kinematic = world.bodies.info[body.index].type == MotionType::Kinematic;
  detail::wake_body(world, body.index);
  if (kinematic) detail::wake_around(world, body.index);
  const detail::BodyInfo& info = world.bodies.info[body.index];
  const MotionLocks& k = info.locks;
  world.bodies.velocity[info.dense].v = {k.linear_x ? Real(0) : velocity.x(),
                                         k.linear_y ? Real(0) : velocity.y(),
                                         k.linear_z ? Real(0) : velocity.z()};
  return {};
}

Status PhysicsWorld::move_kinematic(BodyId body, const Pose& target, double dt) {
  WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(body)) return detail::stale_body();
  if (const Status status = detail::check_pose(target); !status) return status;
  if (!std::isfinite(dt) || !(dt > 0))
    return {StatusCode::OutOfRange, "dt must be finite and positive [s]"};
  const detail::BodyInfo& info = world.bodies.info[body.index];
  if (info.type != MotionType::Kinematic)
    return {StatusCode::WrongMotionType, "only kinematic bodies are moved to a target"};
  const detail::BodyPose& pose = world.bodies.pose[info.dense];
  const detail::NumVec way =
      detail::cast<detail::Num>(detail::to_inner_position(target.position) - pose.x);
  const detail::NumRotation to = normalized(detail::to_num(detail::to_inner(target.orientation)));
  const detail::NumVec turn =
      detail::turn_between(normalized(detail::to_num(pose.q)), to, detail::NumVec{0, 0, 0});
  const Vec3 v = detail::to_public(detail::cast<Real>((1 / dt) * way));
  const Vec3 w = detail::to_public(detail::cast<Real>((1 / dt) * turn));
  if (!v.allFinite() || !w.allFinite())
    return {StatusCode::OutOfRange, "the target is too far for so short a time"};
  if (const Status status = set_linear_velocity(body, v); !status) return status;
  return set_angular_velocity(body, w);
}

Status PhysicsWorld::set_angular_velocity(BodyId body, const Vec3& velocity) {
  WorldState& world = *state_;
  if (const Status status = ready_for_velocity(*this, world, body, velocity); !status)
    return status;
  detail::note_input(world, InputKind::SetAngularVelocity, body.value(),
                     [&](auto& out) { detail::append(out, velocity); });
  const bool kinematic = world.bodies.info[body.index].type == MotionType::Kinematic;
  detail::wake_body(world, body.index);
  if (kinematic) detail::wake_around(world, body.index);
  const detail::BodyInfo& info = world.bodies.info[body.index];
  const MotionLocks& k = info.locks;
  const detail::Vec w{k.angular_x ? Real(0) : velocity.x(), k.angular_y ? Real(0) : velocity.y(),
                      k.angular_z ? Real(0) : velocity.z()};
  world.bodies.velocity[info.dense].w = w;
  world.bodies.momentum[info.dense].L =
      angular_momentum_of(world.bodies.mass[info.dense], world.bodies.pose[info.dense].q, w);
  return {};
}

Status PhysicsWorld::set_awake(BodyId body, bool awake) {
  WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(body)) return detail::stale_body();
  if (world.bodies.info[body.index].type == MotionType::Static)
    return {StatusCode::WrongMotionType, "a static body neither wakes nor sleeps"};
  detail::note_input(world, InputKind::SetAwake, body.value(),
                     [&](auto& out) { out.push_back(awake ? 1.0 : 0.0); });
  if (awake) {
    detail::wake_body(world, body.index);
  } else {
    detail::put_to_sleep(world, body.index);
  }
  return {};
}

}  // namespace plumb::inline PLUMB_ABI
