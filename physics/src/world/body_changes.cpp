// Changing bodies that live: motion type, locks, damping, mass, and how they sleep.
#include "world/inputs.h"
#include "world/joint_world.h"
#include "world/pair_changes.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

Status ready_to_change(const PhysicsWorld& self, const WorldState& world, BodyId body) {
  if (world.stepping) return inside_step();
  if (!self.is_valid(body)) return stale_body();
  return {};
}

// Whether the body with all its colliders may be of that type.
Status check_change(const WorldState& world, const BodyInfo& info, MotionType type) {
  for (const std::uint32_t slot : info.colliders) {
    const Collider& component = world.colliders.info[slot].component;
    if (const Status status = check_shape_fits(component.shape, type); !status) return status;
    if (type != MotionType::Dynamic || info.has_own_mass) continue;
    if (const Status status = check_added_mass(component); !status) return status;
  }
  return {};
}

// Static colliders lie in a tree of their own.
void change_trees(WorldState& world, const BodyInfo& info) {
  for (const std::uint32_t slot : info.colliders) {
    ColliderInfo& collider = world.colliders.info[slot];
    const bool is_static = info.type == MotionType::Static;
    if (collider.is_static == is_static) continue;
    world.trees.of(collider).remove(collider.proxy);
    collider.proxy = AabbTree::kNull;
    collider.is_static = is_static;
    collider.asleep = false;
  }
}

void change_motion_type(WorldState& world, std::uint32_t body, MotionType type) {
  wake_with_neighbours(world, body);
  BodyInfo& info = world.bodies.info[body];
  if (info.type == MotionType::Kinematic) --world.counts.kinematic;
  if (type == MotionType::Kinematic) ++world.counts.kinematic;
  info.type = type;
  info.rest_time = 0;
  world.bodies.acceleration[body] = {0, 0, 0};
  refilter_pairs(world, [body](const Pair& pair) { return involves_body(pair, body); });
  const PairsOfBody pairs(world, body);
  BodyForce& force = world.bodies.force[info.dense];
  force.force = force.torque = {0, 0, 0};
  if (type == MotionType::Static) world.bodies.velocity[info.dense] = {};
  update_mass(world, body);
  pairs.remake(world);
  change_trees(world, info);
  refresh_boxes(world, body);
  if (!world.joints.empty()) rest_idle_joints(world);
  if (type == MotionType::Static) {
    world.bodies.rest(body);
  } else {
    wake_body(world, body);  // with what hangs on it
  }
}

}  // namespace
}  // namespace detail

Status PhysicsWorld::set_motion_type(BodyId body, MotionType type) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  if (const Status status = detail::check_motion_type(type); !status) return status;
  const detail::BodyInfo& info = world.bodies.info[body.index];
  if (info.disabled)
    return {StatusCode::WrongMotionType,
            "the body is quarantined: its state had become non-finite"};
  if (info.type == type) return {};
  if (const Status status = detail::check_change(world, info, type); !status) return status;
  detail::note_input(world, InputKind::SetMotionType, body.value(),
                     [&](auto& out) { out.push_back(static_cast<double>(type)); });
  detail::change_motion_type(world, body.index, type);
  return {};
}

Status PhysicsWorld::set_locks(BodyId body, const MotionLocks& locks) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  detail::note_input(world, InputKind::SetLocks, body.value(),
                     [&](auto& out) { detail::append(out, locks); });
  detail::wake_body(world, body.index);
  world.bodies.info[body.index].locks = locks;
  detail::update_locks(world, body.index);
  return {};
}

Status PhysicsWorld::set_damping(BodyId body, Real linear, Real angular) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  if (const Status status = detail::check_damping(linear, angular); !status) return status;
  detail::note_input(world, InputKind::SetDamping, body.value(), [&](auto& out) {
    out.push_back(detail::as_number(linear));
    out.push_back(detail::as_number(angular));
  });
  detail::BodyForce& force = world.bodies.force[world.bodies.info[body.index].dense];
  force.linear_damping = linear;
  force.angular_damping = angular;
  return {};
}

Status PhysicsWorld::set_gravity_scale(BodyId body, Real scale) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  if (const Status status = detail::check_gravity_scale(scale); !status) return status;
  detail::note_input(world, InputKind::SetGravityScale, body.value(),
                     [&](auto& out) { out.push_back(detail::as_number(scale)); });
  detail::wake_body(world, body.index);
  world.bodies.mass[world.bodies.info[body.index].dense].gravity_scale = scale;
  return {};
}

Status PhysicsWorld::set_can_sleep(BodyId body, bool can_sleep) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  detail::note_input(world, InputKind::SetCanSleep, body.value(),
                     [&](auto& out) { out.push_back(can_sleep ? 1.0 : 0.0); });
  world.bodies.info[body.index].can_sleep = can_sleep;
  if (!can_sleep) detail::wake_body(world, body.index);
  return {};
}

Status PhysicsWorld::set_continuous(BodyId body, bool continuous) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  detail::note_input(world, InputKind::SetContinuous, body.value(),
                     [&](auto& out) { out.push_back(continuous ? 1.0 : 0.0); });
  world.bodies.info[body.index].continuous = continuous;
  return {};
}

Status PhysicsWorld::set_user_data(BodyId body, std::uint64_t user_data) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, body); !status) return status;
  detail::note_input(world, InputKind::SetBodyUserData, body.value(),
                     [&](auto& out) { detail::append_long(out, user_data); });
  world.bodies.info[body.index].user_data = user_data;
  return {};
}

namespace detail {
namespace {

Status ready_for_mass(const PhysicsWorld& self, const WorldState& world, BodyId body) {
  if (const Status status = ready_to_change(self, world, body); !status) return status;
  if (world.bodies.info[body.index].type != MotionType::Dynamic)
    return {StatusCode::WrongMotionType, "only dynamic bodies have a mass"};
  return {};
}

void change_mass(WorldState& world, std::uint32_t body, const MassProperties* own) {
  wake_body(world, body);
  const PairsOfBody pairs(world, body);
  BodyInfo& info = world.bodies.info[body];
  info.has_own_mass = own != nullptr;
  if (own != nullptr) info.properties = *own;
  update_mass(world, body);
  pairs.remake(world);
  refresh_boxes(world, body);
}

}  // namespace
}  // namespace detail

Status PhysicsWorld::set_mass(BodyId body, const MassProperties& properties) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_for_mass(*this, world, body); !status) return status;
  if (const Status status = check(properties); !status) return status;
  detail::note_input(world, InputKind::SetMass, body.value(),
                     [&](auto& out) { detail::append(out, properties); });
  detail::change_mass(world, body.index, &properties);
  return {};
}

Status PhysicsWorld::derive_mass(BodyId body) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_for_mass(*this, world, body); !status) return status;
  for (const std::uint32_t slot : world.bodies.info[body.index].colliders)
    if (const Status status = detail::check_added_mass(world.colliders.info[slot].component);
        !status)
      return status;
  detail::note_input(world, InputKind::DeriveMass, body.value(), [](auto&) {});
  detail::change_mass(world, body.index, nullptr);
  return {};
}

}  // namespace plumb::inline PLUMB_ABI
