// Which colliders meet, and what their surfaces do to each other.
#include <algorithm>
#include <cmath>

#include "world/joint_world.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

Real combine(CombineRule rule, Real a, Real b) {
  switch (rule) {
    case CombineRule::Average:
      return Real(0.5) * (a + b);
    case CombineRule::GeometricMean:
      return std::sqrt(a * b);
    case CombineRule::Minimum:
      return std::min(a, b);
    case CombineRule::Maximum:
      return std::max(a, b);
    case CombineRule::Multiply:
      return a * b;
  }
  return a;
}

bool filters_meet(const Filter& a, const Filter& b) {
  if (a.group != 0 && a.group == b.group) return a.group > 0;
  return (a.layers & b.collides_with) != 0 && (b.layers & a.collides_with) != 0;
}

bool runs(const Collider& collider) { return collider.surface_velocity != SurfaceVelocity{}; }
bool has_grain(const Material& m) { return m.grain_friction < 1 && m.grain.squaredNorm() > 0; }
bool is_one_way(const Collider& collider) { return collider.one_way.squaredNorm() > 0; }

// The combined numbers of two materials; the table of pairs has the last word.
void combine_materials(const MaterialTable& table, const Material& a, const Material& b,
                       Pair& pair) {
  static constexpr MaterialPair kNothing{};
  const MaterialPair* entry = table.find(a.kind, b.kind);
  const MaterialPair& own = entry != nullptr ? *entry : kNothing;
  pair.friction = own.friction.value_or(
      combine(std::max(a.friction_rule, b.friction_rule), a.friction, b.friction));
  pair.restitution = own.restitution.value_or(
      combine(std::max(a.restitution_rule, b.restitution_rule), a.restitution, b.restitution));
  pair.rolling = own.rolling_friction.value_or(std::max(a.rolling_friction, b.rolling_friction));
  pair.torsional =
      own.torsional_friction.value_or(std::max(a.torsional_friction, b.torsional_friction));
}

void leave_out_what_is_forced_off(const PlanChoices& forced, Pair& pair) {
  if (forced.off(PlanItem::Friction)) pair.friction = Real(0);
  if (forced.off(PlanItem::Restitution)) pair.restitution = Real(0);
  if (forced.off(PlanItem::RollingFriction)) pair.rolling = pair.torsional = Real(0);
  if (forced.off(PlanItem::SurfaceVelocity)) pair.driven = false;
  if (forced.off(PlanItem::AnisotropicFriction)) pair.grained = false;
  if (forced.off(PlanItem::Adhesion)) pair.adhesion = Real(0);
}

}  // namespace

bool may_meet(const WorldState& world, std::uint32_t collider_a, std::uint32_t collider_b) {
  const ColliderInfo& a = world.colliders.info[collider_a];
  const ColliderInfo& b = world.colliders.info[collider_b];
  if (a.body == b.body) return false;
  const MotionType type_a = world.bodies.info[a.body].type, type_b = world.bodies.info[b.body].type;
  // Sensors see whatever moves or is moved; for anything else something must give way.
  const MotionType least =
      a.component.is_sensor || b.component.is_sensor ? MotionType::Kinematic : MotionType::Dynamic;
  if (type_a < least && type_b < least) return false;
  if (a.component.is_sensor && b.component.is_sensor) return false;
  if (!world.joints.empty() && !a.component.is_sensor && !b.component.is_sensor &&
      joined_without_contact(world, a.body, b.body))
    return false;
  const ContactData& data = world.contact_data;
  if (!data.excluded_bodies.empty() && data.excluded_bodies.contains(a.body, b.body)) return false;
  if (!data.excluded_colliders.empty() && data.excluded_colliders.contains(collider_a, collider_b))
    return false;
  return filters_meet(a.component.filter, b.component.filter);
}

namespace {

Pair make_pair_unforced(const WorldState& world, std::uint64_t key) {
  Pair pair;
  pair.key = key;
  const ColliderInfo& a = world.colliders.info[pair.collider_a()];
  const ColliderInfo& b = world.colliders.info[pair.collider_b()];
  pair.body_a = a.body;
  pair.body_b = b.body;
  pair.sensor = a.component.is_sensor || b.component.is_sensor;
  combine_materials(world.contact_data.materials, a.component.material, b.component.material, pair);
  pair.slop = tolerance::kSlopFraction * std::min(a.thickness, b.thickness);
  pair.relative_to_b = world.bodies.info[a.body].type != MotionType::Dynamic;
  pair.driven = !pair.sensor && (runs(a.component) || runs(b.component));
  pair.grained =
      !pair.sensor && (has_grain(a.component.material) || has_grain(b.component.material));
  if (!pair.sensor)
    pair.adhesion = std::max(a.component.material.adhesion, b.component.material.adhesion);
  pair.one_way = !pair.sensor && (is_one_way(a.component) || is_one_way(b.component));
  pair.curved = is_curved(a.shape.type) || is_curved(b.shape.type);
  pair.on_surface = is_surface(a.shape.type) || is_surface(b.shape.type);
  return pair;
}

Pair with_memory(Pair pair, const Pair& old) {
  pair.first_contact = old.first_contact;
  pair.contact_count = old.contact_count;
  pair.began = old.began;
  pair.touching = old.touching;
  pair.was_touching = old.was_touching;
  pair.passage = pair.one_way ? old.passage : Passage::Apart;
  return pair;
}

}  // namespace

Pair make_pair(const WorldState& world, std::uint64_t key) {
  Pair pair = make_pair_unforced(world, key);
  leave_out_what_is_forced_off(world.settings.forced, pair);
  return pair;
}

Pair remake_pair(const WorldState& world, const Pair& old) {
  return with_memory(make_pair(world, old.key), old);
}

Pair without_forcing(const WorldState& world, const Pair& pair) {
  return with_memory(make_pair_unforced(world, pair.key), pair);
}

void count_collider(SceneCounts& counts, const Collider& collider, std::uint32_t change) {
  if (collider.is_sensor) counts.sensors += change;
  const Material& m = collider.material;
  if (m.restitution > 0) counts.restitution += change;
  if (m.rolling_friction > 0 || m.torsional_friction > 0) counts.turning += change;
  if (has_grain(m)) counts.grained += change;
  if (m.adhesion > 0) counts.adhesive += change;
  if (runs(collider)) counts.driven += change;
  if (is_one_way(collider)) counts.one_way += change;
}

}  // namespace plumb::inline PLUMB_ABI::detail
