// Changing colliders that live: shape, place, surface, density, and whether they sense.
#include "math/eigen_bridge.h"
#include "world/inputs.h"
#include "world/pair_changes.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

Status ready_to_change(const PhysicsWorld& self, const WorldState& world, ColliderId collider) {
  if (world.stepping) return inside_step();
  if (!self.is_valid(collider)) return stale_collider();
  return {};
}

bool adds_mass(const Collider& component) { return !component.is_sensor && component.density > 0; }

// Whether the body can do with what its collider is to become.
Status check_change(const WorldState& world, ColliderId collider, const Collider& changed) {
  const BodyInfo& owner = world.bodies.info[world.colliders.info[collider.index].body];
  if (owner.type != MotionType::Dynamic || owner.has_own_mass) return {};
  return check_added_mass(changed);
}

// Gives the collider its new fields, and the world's counts what follows from them.
void exchange(WorldState& world, ColliderInfo& collider, const Collider& changed) {
  count_collider(world.counts, collider.component, static_cast<std::uint32_t>(-1));
  collider.component = changed;
  count_collider(world.counts, collider.component, 1);
}

// A change of the surface alone.
void resurface(WorldState& world, std::uint32_t slot, const Collider& changed) {
  ColliderInfo& collider = world.colliders.info[slot];
  wake_with_neighbours(world, collider.body);
  exchange(world, collider, changed);
  remake_pairs(world, [slot](const Pair& pair) { return involves(pair, slot); });
}

// A change of what gives the body its extent and its mass.
void reform(WorldState& world, std::uint32_t slot, const Collider& changed) {
  ColliderInfo& collider = world.colliders.info[slot];
  const std::uint32_t body = collider.body;
  wake_with_neighbours(world, body);
  const PairsOfBody pairs(world, body);
  const bool weighs = adds_mass(collider.component) || adds_mass(changed);
  exchange(world, collider, changed);
  if (weighs && !world.bodies.info[body].has_own_mass) {
    update_mass(world, body);
  } else {
    update_collider_frames(world, body);
  }
  pairs.remake(world);
  refresh_boxes(world, body);
  wake_around(world, body);
}

// Contacts of a shape that is gone say nothing about its successor's.
void forget_impulses(WorldState& world, std::uint32_t slot) {
  for (const Pair& pair : world.pairs) {
    if (!involves(pair, slot)) continue;
    for (Contact& contact : contacts_of(pair, world.contacts)) {
      contact.at_rest = false;
      for (Real& impulse : contact.normal_impulse) impulse = 0;
      for (Vec& impulse : contact.friction_impulse) impulse = {0, 0, 0};
    }
  }
}

}  // namespace
}  // namespace detail

Status PhysicsWorld::set_shape(ColliderId collider, const Shape& shape) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  detail::ColliderInfo& info = world.colliders.info[collider.index];
  Collider changed = info.component;
  changed.shape = shape;
  const MotionType type = world.bodies.info[info.body].type;
  if (const Status status = detail::check_collider(changed, type); !status) return status;
  if (const Status status = detail::check_change(world, collider, changed); !status) return status;
  detail::note_input(world, InputKind::SetShape, collider.value(),
                     [&](auto& out) { detail::append_shape(out, shape); });
  info.shape = detail::make_collision_shape(shape);
  detail::reform(world, collider.index, changed);
  detail::forget_impulses(world, collider.index);
  return {};
}

Status PhysicsWorld::set_local_pose(ColliderId collider, const LocalPose& pose) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  if (const Status status = detail::check_local_pose(pose); !status) return status;
  detail::note_input(world, InputKind::SetLocalPose, collider.value(),
                     [&](auto& out) { detail::append(out, pose); });
  Collider changed = world.colliders.info[collider.index].component;
  changed.pose = pose;
  changed.pose.orientation.normalize();
  detail::reform(world, collider.index, changed);
  return {};
}

Status PhysicsWorld::set_density(ColliderId collider, double density) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  if (const Status status = detail::check_density(density); !status) return status;
  Collider changed = world.colliders.info[collider.index].component;
  changed.density = density;
  if (const Status status = detail::check_change(world, collider, changed); !status) return status;
  detail::note_input(world, InputKind::SetDensity, collider.value(),
                     [&](auto& out) { out.push_back(density); });
  detail::reform(world, collider.index, changed);
  return {};
}

Status PhysicsWorld::set_sensor(ColliderId collider, bool is_sensor) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  const detail::ColliderInfo& info = world.colliders.info[collider.index];
  if (info.component.is_sensor == is_sensor) return {};
  Collider changed = info.component;
  changed.is_sensor = is_sensor;
  if (const Status status = detail::check_change(world, collider, changed); !status) return status;
  detail::note_input(world, InputKind::SetSensor, collider.value(),
                     [&](auto& out) { out.push_back(is_sensor ? 1.0 : 0.0); });
  // What it met as the one it does not meet as the other; both are sought anew.
  detail::wake_with_neighbours(world, info.body);
  detail::end_pairs(
      world, [&](const detail::Pair& pair) { return detail::involves(pair, collider.index); });
  detail::reform(world, collider.index, changed);
  return {};
}

Status PhysicsWorld::set_material(ColliderId collider, const Material& material) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  if (const Status status = detail::check_material(material); !status) return status;
  detail::note_input(world, InputKind::SetMaterial, collider.value(),
                     [&](auto& out) { detail::append(out, material); });
  Collider changed = world.colliders.info[collider.index].component;
  changed.material = material;
  detail::resurface(world, collider.index, changed);
  return {};
}

Status PhysicsWorld::set_one_way(ColliderId collider, const Vec3& direction) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  if (const Status status = detail::check_one_way(direction); !status) return status;
  detail::note_input(world, InputKind::SetOneWay, collider.value(),
                     [&](auto& out) { detail::append(out, direction); });
  Collider changed = world.colliders.info[collider.index].component;
  changed.one_way = direction;
  changed.one_way.stableNormalize();
  detail::resurface(world, collider.index, changed);
  return {};
}

Status PhysicsWorld::set_user_data(ColliderId collider, std::uint64_t user_data) {
  detail::WorldState& world = *state_;
  if (const Status status = detail::ready_to_change(*this, world, collider); !status) return status;
  detail::note_input(world, InputKind::SetColliderUserData, collider.value(),
                     [&](auto& out) { detail::append_long(out, user_data); });
  world.colliders.info[collider.index].component.user_data = user_data;
  return {};
}

}  // namespace plumb::inline PLUMB_ABI
