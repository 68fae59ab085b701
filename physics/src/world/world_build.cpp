// Building and taking apart: bodies, colliders, settings.
#include <algorithm>

#include "effects/effect_world.h"
#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "world/forced.h"
#include "world/inputs.h"
#include "world/joint_world.h"
#include "world/pair_changes.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

void remove_collider(WorldState& world, std::uint32_t slot) {
  ColliderInfo& collider = world.colliders.info[slot];
  BodyInfo& owner = world.bodies.info[collider.body];
  world.pairs.remove_if([&](const Pair& pair) {
    if (pair.collider_a() != slot && pair.collider_b() != slot) return false;
    note_pair_end(world, pair);
    return true;
  });
  world.trees.of(collider).remove(collider.proxy);
  std::erase(owner.colliders, slot);
  std::erase_if(owner.collider_ids, [slot](ColliderId id) { return id.index == slot; });
  std::erase(world.query_list, slot);
  count_collider(world.counts, collider.component, static_cast<std::uint32_t>(-1));
  world.contact_data.excluded_colliders.forget(slot);
  world.colliders.destroy(slot);
}

}  // namespace
}  // namespace detail

PhysicsWorld::PhysicsWorld(const WorldSettings& settings)
    : state_(std::make_unique<detail::WorldState>()) {
  if (check(settings).ok()) state_->settings = settings;
}
PhysicsWorld::~PhysicsWorld() = default;
PhysicsWorld::PhysicsWorld(PhysicsWorld&&) noexcept = default;
PhysicsWorld& PhysicsWorld::operator=(PhysicsWorld&&) noexcept = default;

Created<BodyId> PhysicsWorld::create_body(const RigidBody& body) {
  detail::WorldState& world = *state_;
  if (world.stepping) return {{}, detail::inside_step()};
  if (const Status status = detail::check_body(body); !status) return {{}, status};
  detail::note_input(world, InputKind::CreateBody, 0,
                     [&](auto& out) { detail::append(out, body); });

  const std::uint32_t slot = world.bodies.create();
  detail::BodyInfo& info = world.bodies.info[slot];
  const std::uint32_t dense = info.dense;
  info.type = body.type;
  if (body.type == MotionType::Kinematic) ++world.counts.kinematic;
  info.locks = body.locks;
  info.can_sleep = body.can_sleep;
  info.continuous = body.continuous;
  info.user_data = body.user_data;
  if (body.mass.has_value()) {
    info.has_own_mass = true;
    info.properties = *body.mass;
  }
  world.bodies.pose[dense].x = detail::to_inner_position(body.pose.position);
  world.bodies.pose[dense].q = detail::normalized(detail::to_inner(body.pose.orientation));
  world.bodies.mass[dense].gravity_scale = body.gravity_scale;
  world.bodies.force[dense].linear_damping = body.linear_damping;
  world.bodies.force[dense].angular_damping = body.angular_damping;
  detail::update_mass(world, slot);
  detail::BodyVelocity& velocity = world.bodies.velocity[dense];
  const MotionLocks& k = body.locks;
  velocity.v = {k.linear_x ? Real(0) : body.linear_velocity.x(),
                k.linear_y ? Real(0) : body.linear_velocity.y(),
                k.linear_z ? Real(0) : body.linear_velocity.z()};
  velocity.w = {k.angular_x ? Real(0) : body.angular_velocity.x(),
                k.angular_y ? Real(0) : body.angular_velocity.y(),
                k.angular_z ? Real(0) : body.angular_velocity.z()};
  world.bodies.momentum[dense].L =
      detail::angular_momentum_of(world.bodies.mass[dense], world.bodies.pose[dense].q, velocity.w);
  const bool moves =
      body.type == MotionType::Dynamic ||
      (body.type == MotionType::Kinematic &&
       (body.linear_velocity.squaredNorm() > 0 || body.angular_velocity.squaredNorm() > 0));
  if (moves) world.bodies.wake(slot);
  const BodyId id{slot, info.generation};
  if (body.type == MotionType::Dynamic && !body.starts_awake) detail::put_to_sleep(world, slot);
  return {id, {}};
}

Status PhysicsWorld::destroy_body(BodyId body) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(body)) return detail::stale_body();
  detail::note_input(world, InputKind::DestroyBody, body.value(), [](auto&) {});
  const std::uint32_t slot = body.index;
  detail::wake_body(world, slot);
  detail::wake_around(world, slot);
  if (!world.joints.empty()) detail::remove_joints_of(world, slot);
  if (world.effects != nullptr) detail::remove_effects_of(world, slot);
  const std::vector<std::uint32_t> colliders = world.bodies.info[slot].colliders;
  for (const std::uint32_t collider : colliders) detail::remove_collider(world, collider);
  world.contact_data.excluded_bodies.forget(slot);
  if (world.bodies.info[slot].type == MotionType::Kinematic) --world.counts.kinematic;
  std::erase(world.moved, slot);
  world.bodies.destroy(slot);
  return {};
}

Created<ColliderId> PhysicsWorld::create_collider(BodyId body, const Collider& collider) {
  detail::WorldState& world = *state_;
  if (world.stepping) return {{}, detail::inside_step()};
  if (!is_valid(body)) return {{}, detail::stale_body()};
  detail::BodyInfo& owner = world.bodies.info[body.index];
  if (const Status status = detail::check_collider(collider, owner.type); !status)
    return {{}, status};
  // The mass that the body would have must be that of a body, and fit the number type.
  if (owner.type == MotionType::Dynamic && !owner.has_own_mass)
    if (const Status status = detail::check_added_mass(collider); !status) return {{}, status};
  detail::note_input(world, InputKind::CreateCollider, body.value(),
                     [&](auto& out) { detail::append(out, collider); });

  const std::uint32_t slot = world.colliders.create();
  detail::ColliderInfo& info = world.colliders.info[slot];
  info.body = body.index;
  info.component = collider;
  info.component.pose.orientation.normalize();
  info.component.one_way.stableNormalize();
  info.shape = detail::make_collision_shape(collider.shape);
  info.is_static = owner.type == MotionType::Static;
  owner.colliders.push_back(slot);
  owner.collider_ids.push_back(world.colliders.id(slot));
  detail::count_collider(world.counts, info.component, 1);
  // A body that was made asleep sleeps on while it is being built; one that lies on something
  // wakes.
  if (owner.island != detail::kNone &&
      (!world.islands[owner.island].pairs.empty() || world.islands[owner.island].bodies.size() > 1))
    detail::wake_body(world, body.index);
  info.asleep = owner.island != detail::kNone;
  if (owner.has_own_mass || collider.is_sensor || collider.density == 0) {
    detail::update_collider_frames(world, body.index);
  } else {
    detail::update_mass(world, body.index);
  }
  for (const std::uint32_t other : owner.colliders) detail::update_proxy(world, other, true);
  detail::wake_around(world, body.index);
  return {world.colliders.id(slot), {}};
}

Status PhysicsWorld::destroy_collider(ColliderId collider) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(collider)) return detail::stale_collider();
  detail::note_input(world, InputKind::DestroyCollider, collider.value(), [](auto&) {});
  const std::uint32_t body = world.colliders.info[collider.index].body;
  detail::wake_body(world, body);
  detail::wake_around(world, body);
  detail::remove_collider(world, collider.index);
  detail::update_mass(world, body);
  for (const std::uint32_t other : world.bodies.info[body].colliders)
    detail::update_proxy(world, other, true);
  return {};
}

Status PhysicsWorld::set_settings(const WorldSettings& settings) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (const Status status = check(settings); !status) return status;
  detail::note_input(world, InputKind::SetSettings, 0,
                     [&](auto& out) { detail::append(out, settings); });
  const bool forces = settings.forced != world.settings.forced;
  const bool falls_otherwise = settings.gravity != world.settings.gravity;
  const bool wake_all = falls_otherwise || forces || !detail::may_sleep(settings);
  world.settings = settings;
  if (wake_all) {
    for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot)
      if (world.bodies.info[slot].alive && world.bodies.info[slot].island != detail::kNone)
        detail::wake_body(world, slot);
  }
  if (falls_otherwise) {  // boxes reach as far as bodies may fall
    for (std::uint32_t slot = 0; slot < world.bodies.info.size(); ++slot)
      if (world.bodies.info[slot].alive) world.touched.push_back(slot);
  }
  if (forces) detail::remake_pairs(world, [](const detail::Pair&) { return true; });
  return {};
}

void PhysicsWorld::set_job_system(JobSystem* jobs) { state_->jobs = jobs; }

void PhysicsWorld::set_diagnostics(const StepDiagnostics& diagnostics) {
  state_->diagnostics = diagnostics;
  if (!diagnostics.ledger) state_->ledger = {};
  if (diagnostics.error_every != 0) return;
  state_->twin.reset();
  state_->twin_image = {};
}
const StepDiagnostics& PhysicsWorld::diagnostics() const { return state_->diagnostics; }

void PhysicsWorld::attach(StepObserver* observer) {
  if (observer == nullptr) return;
  state_->observers.push_back(observer);
  observer->on_attach(*this);
}
void PhysicsWorld::detach(StepObserver* observer) {
  std::erase(state_->observers, observer);
  if (state_->observers.empty()) state_->inputs.clear();
}

}  // namespace plumb::inline PLUMB_ABI
