// Changing contact data between steps: belts, filters, the table of materials, excluded pairs. What
// is changed here is written into the pairs that exist, so that the step never looks anything up.
#include "world/contact_data.h"

#include "world/inputs.h"
#include "world/pair_changes.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

Status same_one() {
  return {StatusCode::OutOfRange, "a pair has two members: the same one was named twice"};
}

// Wakes every island in which two colliders of these kinds touch.
void wake_kinds(WorldState& world, std::uint64_t kinds) {
  for (std::size_t i = 0; i < world.islands.size(); ++i) {
    bool concerned = false;
    for (const Pair& pair : world.islands[i].pairs) {
      const Material& a = world.colliders.info[pair.collider_a()].component.material;
      const Material& b = world.colliders.info[pair.collider_b()].component.material;
      concerned |= unordered_key(a.kind, b.kind) == kinds;
    }
    if (concerned) wake_body(world, world.islands[i].bodies.front());
  }
}

}  // namespace
}  // namespace detail

Status PhysicsWorld::set_surface_velocity(ColliderId collider, const SurfaceVelocity& velocity) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(collider)) return detail::stale_collider();
  if (const Status status = detail::check_surface_velocity(velocity); !status) return status;
  detail::note_input(world, InputKind::SetSurfaceVelocity, collider.value(),
                     [&](auto& out) { detail::append(out, velocity); });
  detail::ColliderInfo& info = world.colliders.info[collider.index];
  detail::count_collider(world.counts, info.component, static_cast<std::uint32_t>(-1));
  info.component.surface_velocity = velocity;
  detail::count_collider(world.counts, info.component, 1);
  detail::wake_with_neighbours(world, info.body);
  detail::remake_pairs(
      world, [&](const detail::Pair& pair) { return detail::involves(pair, collider.index); });
  return {};
}

Status PhysicsWorld::set_filter(ColliderId collider, const Filter& filter) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(collider)) return detail::stale_collider();
  detail::note_input(world, InputKind::SetFilter, collider.value(),
                     [&](auto& out) { detail::append(out, filter); });
  detail::ColliderInfo& info = world.colliders.info[collider.index];
  detail::wake_with_neighbours(world, info.body);
  info.component.filter = filter;
  detail::refilter_pairs(
      world, [&](const detail::Pair& pair) { return detail::involves(pair, collider.index); });
  detail::seek_pairs(world, collider.index);
  return {};
}

Status PhysicsWorld::set_material_pair(std::uint32_t kind_a, std::uint32_t kind_b,
                                       const std::optional<MaterialPair>& values) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (kind_a == 0 || kind_b == 0)
    return {StatusCode::OutOfRange, "kind 0 is nothing in particular: give the material a kind"};
  if (values.has_value())
    if (const Status status = detail::check_material_pair(*values); !status) return status;
  detail::note_input(world, InputKind::SetMaterialPair, 0, [&](auto& out) {
    detail::append_all(out, {static_cast<double>(kind_a), static_cast<double>(kind_b)});
    detail::append(out, values);
  });
  const std::uint64_t kinds = detail::unordered_key(kind_a, kind_b);
  detail::wake_kinds(world, kinds);
  world.contact_data.materials.set(kind_a, kind_b, values);
  const auto& colliders = world.colliders.info;
  detail::remake_pairs(world, [&](const detail::Pair& pair) {
    return detail::unordered_key(colliders[pair.collider_a()].component.material.kind,
                                 colliders[pair.collider_b()].component.material.kind) == kinds;
  });
  return {};
}

std::optional<MaterialPair> PhysicsWorld::material_pair(std::uint32_t kind_a,
                                                        std::uint32_t kind_b) const {
  const MaterialPair* found = state_->contact_data.materials.find(kind_a, kind_b);
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

Status PhysicsWorld::exclude_pair(BodyId a, BodyId b, bool excluded) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(a) || !is_valid(b)) return detail::stale_body();
  if (a == b) return detail::same_one();
  detail::note_input(world, InputKind::ExcludeBodyPair, a.value(), [&](auto& out) {
    detail::append_long(out, b.value());
    out.push_back(excluded ? 1.0 : 0.0);
  });
  for (const BodyId body : {a, b}) detail::wake_body(world, body.index);
  world.contact_data.excluded_bodies.set(a.index, b.index, excluded);
  detail::refilter_pairs(world, [&](const detail::Pair& pair) {
    return detail::unordered_key(pair.body_a, pair.body_b) ==
           detail::unordered_key(a.index, b.index);
  });
  for (const BodyId body : {a, b})
    for (const std::uint32_t slot : world.bodies.info[body.index].colliders)
      detail::seek_pairs(world, slot);
  return {};
}

Status PhysicsWorld::exclude_pair(ColliderId a, ColliderId b, bool excluded) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(a) || !is_valid(b)) return detail::stale_collider();
  if (a == b) return detail::same_one();
  detail::note_input(world, InputKind::ExcludeColliderPair, a.value(), [&](auto& out) {
    detail::append_long(out, b.value());
    out.push_back(excluded ? 1.0 : 0.0);
  });
  for (const ColliderId collider : {a, b})
    detail::wake_body(world, world.colliders.info[collider.index].body);
  world.contact_data.excluded_colliders.set(a.index, b.index, excluded);
  detail::refilter_pairs(world, [&](const detail::Pair& pair) {
    return pair.key == detail::unordered_key(a.index, b.index);
  });
  for (const ColliderId collider : {a, b}) detail::seek_pairs(world, collider.index);
  return {};
}

bool PhysicsWorld::is_excluded(BodyId a, BodyId b) const {
  return is_valid(a) && is_valid(b) &&
         state_->contact_data.excluded_bodies.contains(a.index, b.index);
}
bool PhysicsWorld::is_excluded(ColliderId a, ColliderId b) const {
  return is_valid(a) && is_valid(b) &&
         state_->contact_data.excluded_colliders.contains(a.index, b.index);
}

}  // namespace plumb::inline PLUMB_ABI
