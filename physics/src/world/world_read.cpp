// Reading a world: states, contacts, energy. Queries: world_queries.cpp.
#include "effects/effect_world.h"
#include "motion/body_motion.h"
#include "world/body_reading.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

BodyState state_in(const WorldState& world, std::uint32_t slot) {
  const BodyInfo& info = world.bodies.info[slot];
  return state_of(slot, info, world.bodies.is_awake(slot), world.bodies.pose[info.dense],
                  world.bodies.velocity[info.dense]);
}

void write_contact(const WorldState& world, const Pair& pair, const Contact& from,
                   ContactState& out) {
  const std::uint32_t reference =
      world.bodies.info[pair.relative_to_b ? pair.body_b : pair.body_a].dense;
  const PosVec origin = world.bodies.pose[reference].x;
  out = {};
  out.a = world.colliders.id(pair.collider_a());
  out.b = world.colliders.id(pair.collider_b());
  out.body_a = {pair.body_a, world.bodies.info[pair.body_a].generation};
  out.body_b = {pair.body_b, world.bodies.info[pair.body_b].generation};
  out.began = pair.began == static_cast<std::uint32_t>(world.step_count);
  out.normal = to_public(from.manifold.normal);
  out.point_count = from.manifold.count;
  for (int i = 0; i < from.manifold.count; ++i) {
    ContactState::Point& point = out.points[i];
    point.position = to_public_position(origin + cast<PosReal>(from.manifold.points[i].position));
    point.separation = from.manifold.points[i].separation;
    point.normal_impulse = from.step_normal_impulse[i];
    point.friction_impulse = to_public(from.step_friction_impulse[i]);
  }
}

// The next contact of a list of pairs from the cursor on; false at its end.
template <class Pairs>
bool next_in(const WorldState& world, const Pairs& pairs, const std::vector<Contact>& store,
             ContactCursor& at, ContactState& out) {
  for (; at.pair < pairs.size(); ++at.pair, at.contact = 0) {
    const Pair& pair = pairs[at.pair];
    if (!pair.was_touching || at.contact >= pair.contact_count) continue;
    write_contact(world, pair, store[pair.first_contact + at.contact++], out);
    return true;
  }
  return false;
}

ContactPoint* write_points(const WorldState& world, const Pair& pair,
                           const std::vector<Contact>& store, ContactPoint* out) {
  if (pair.contact_count == 0 || !pair.was_touching) return out;
  const std::uint32_t reference =
      world.bodies.info[pair.relative_to_b ? pair.body_b : pair.body_a].dense;
  const PosVec origin = world.bodies.pose[reference].x;
  for (const Contact& from : contacts_of(pair, store)) {
    for (int i = 0; i < from.manifold.count; ++i, ++out)
      *out = contact_point(origin, from.manifold.points[i].position, from.manifold.normal,
                           from.step_normal_impulse[i]);
  }
  return out;
}

}  // namespace
}  // namespace detail

bool PhysicsWorld::is_valid(BodyId body) const {
  const auto& info = state_->bodies.info;
  return body.index < info.size() && info[body.index].alive &&
         info[body.index].generation == body.generation;
}
bool PhysicsWorld::is_valid(ColliderId collider) const {
  const auto& info = state_->colliders.info;
  return collider.index < info.size() && info[collider.index].alive &&
         info[collider.index].generation == collider.generation;
}
BodyState PhysicsWorld::state(BodyId body) const {
  return is_valid(body) ? detail::state_in(*state_, body.index) : BodyState{};
}
Pose PhysicsWorld::pose(BodyId body) const {
  if (!is_valid(body)) return {};
  const detail::BodyInfo& info = state_->bodies.info[body.index];
  return detail::pose_of(info, state_->bodies.pose[info.dense]);
}
Vec3 PhysicsWorld::linear_velocity(BodyId body) const {
  if (!is_valid(body)) return Vec3::Zero();
  return detail::to_public(state_->bodies.velocity[state_->bodies.info[body.index].dense].v);
}
Vec3 PhysicsWorld::angular_velocity(BodyId body) const {
  if (!is_valid(body)) return Vec3::Zero();
  return detail::to_public(state_->bodies.velocity[state_->bodies.info[body.index].dense].w);
}
Vec3 PhysicsWorld::velocity_at(BodyId body, const Pos3& p_W) const {
  if (!is_valid(body)) return Vec3::Zero();
  const std::uint32_t dense = state_->bodies.info[body.index].dense;
  const detail::BodyVelocity& velocity = state_->bodies.velocity[dense];
  const detail::Vec arm =
      detail::cast<Real>(detail::to_inner_position(p_W) - state_->bodies.pose[dense].x);
  return detail::to_public(velocity.v + cross(velocity.w, arm));
}
Vec3 PhysicsWorld::angular_momentum(BodyId body) const {
  if (!is_valid(body)) return Vec3::Zero();
  return detail::to_public(state_->bodies.momentum[state_->bodies.info[body.index].dense].L);
}
Pos3 PhysicsWorld::center_of_mass(BodyId body) const {
  if (!is_valid(body)) return Pos3::Zero();
  return detail::to_public_position(state_->bodies.pose[state_->bodies.info[body.index].dense].x);
}
Vec3 PhysicsWorld::last_acceleration(BodyId body) const {
  return is_valid(body) ? detail::to_public(state_->bodies.acceleration[body.index]) : Vec3::Zero();
}
MassProperties PhysicsWorld::mass_properties(BodyId body) const {
  if (!is_valid(body) || state_->bodies.info[body.index].type != MotionType::Dynamic) return {};
  return state_->bodies.info[body.index].properties;
}
bool PhysicsWorld::is_awake(BodyId body) const {
  return is_valid(body) && state_->bodies.is_awake(body.index);
}
std::span<const ColliderId> PhysicsWorld::colliders_of(BodyId body) const {
  if (!is_valid(body)) return {};
  return state_->bodies.info[body.index].collider_ids;
}
BodyId PhysicsWorld::body_of(ColliderId collider) const {
  if (!is_valid(collider)) return {};
  const std::uint32_t slot = state_->colliders.info[collider.index].body;
  return {slot, state_->bodies.info[slot].generation};
}
Collider PhysicsWorld::collider(ColliderId collider) const {
  return is_valid(collider) ? state_->colliders.info[collider.index].component : Collider{};
}
RigidBody PhysicsWorld::body(BodyId body) const {
  RigidBody out;
  if (!is_valid(body)) return out;
  const detail::BodyInfo& info = state_->bodies.info[body.index];
  const detail::BodyForce& force = state_->bodies.force[info.dense];
  out.type = info.type;
  out.pose = pose(body);
  out.linear_velocity = linear_velocity(body);
  out.angular_velocity = angular_velocity(body);
  if (info.has_own_mass) out.mass = info.properties;
  out.locks = info.locks;
  out.linear_damping = force.linear_damping;
  out.angular_damping = force.angular_damping;
  out.gravity_scale = state_->bodies.mass[info.dense].gravity_scale;
  out.can_sleep = info.can_sleep;
  out.continuous = info.continuous;
  out.starts_awake = info.type != MotionType::Dynamic || is_awake(body);
  out.user_data = info.user_data;
  return out;
}
std::size_t PhysicsWorld::body_count() const { return state_->bodies.alive_count; }
const WorldSettings& PhysicsWorld::settings() const { return state_->settings; }
double PhysicsWorld::time() const { return state_->time; }
std::uint64_t PhysicsWorld::step_count() const { return state_->step_count; }
const StepReport& PhysicsWorld::last_report() const { return state_->report; }
Events PhysicsWorld::events() const {
  const detail::EventLists& lists = state_->published;
  return {lists.contacts, lists.hits,        lists.sensors,      state_->overlaps,
          lists.sleep,    lists.quarantined, lists.broken_joints};
}

void PhysicsWorld::copy_body_states(std::vector<BodyState>& out) const {
  out.resize(state_->bodies.alive_count);
  BodyState* next = out.data();
  for (std::uint32_t slot = 0; slot < state_->bodies.info.size(); ++slot)
    if (state_->bodies.info[slot].alive) *next++ = detail::state_in(*state_, slot);
}
void PhysicsWorld::copy_moved_body_states(std::vector<BodyState>& out) const {
  out.clear();
  for (const std::uint32_t slot : state_->moved) out.push_back(detail::state_in(*state_, slot));
}
void PhysicsWorld::copy_contacts(std::vector<ContactState>& out) const {
  out.clear();
  each_contact([&out](const ContactState& contact) { out.push_back(contact); });
}

bool PhysicsWorld::next_contact(ContactCursor& at, ContactState& out) const {
  if (at.island == 0) {
    if (detail::next_in(*state_, state_->pairs, state_->contacts, at, out)) return true;
    at = {1, 0, 0};
  }
  for (; at.island <= state_->islands.size(); at = {at.island + 1, 0, 0}) {
    const detail::SleepingIsland& island = state_->islands[at.island - 1];
    if (detail::next_in(*state_, island.pairs, island.contacts, at, out)) return true;
  }
  return false;
}

void PhysicsWorld::copy_contact_points(std::vector<ContactPoint>& out) const {
  std::size_t contacts = state_->contacts.size();
  for (const detail::SleepingIsland& island : state_->islands) contacts += island.contacts.size();
  out.resize(contacts * detail::Manifold::kMaxPoints);
  ContactPoint* end = out.data();
  for (const detail::Pair& pair : state_->pairs)
    end = detail::write_points(*state_, pair, state_->contacts, end);
  for (const detail::SleepingIsland& island : state_->islands)
    for (const detail::Pair& pair : island.pairs)
      end = detail::write_points(*state_, pair, island.contacts, end);
  out.resize(static_cast<std::size_t>(end - out.data()));
}

EnergyReport PhysicsWorld::energy() const {
  EnergyReport sum;
  const Eigen::Vector3d g = state_->settings.gravity.cast<double>();
  const detail::BodyStore& bodies = state_->bodies;
  for (const detail::BodyInfo& info : bodies.info) {
    if (!info.alive || info.type != MotionType::Dynamic || info.disabled) continue;
    const double scale = static_cast<double>(bodies.mass[info.dense].gravity_scale);
    detail::add_energy(sum, info.properties.mass, scale * g, bodies.pose[info.dense],
                       bodies.velocity[info.dense], bodies.momentum[info.dense].L);
  }
  if (state_->effects != nullptr) sum.effects = detail::effect_potential(*state_);
  return sum;
}

}  // namespace plumb::inline PLUMB_ABI
