#include "world/one_way.h"

#include "world/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

bool has_direction(const ColliderInfo& collider) {
  return collider.component.one_way.squaredNorm() > 0;
}

// Whether a one-way collider lets through what lies from it along `outward`, a unit vector.
bool lets_through(const WorldState& world, const ColliderInfo& collider, Vec outward) {
  if (!has_direction(collider)) return false;
  const BodyPose& pose = world.bodies.pose[world.bodies.info[collider.body].dense];
  const Vec solid = rotate(pose.q * collider.in_body.q, to_inner(collider.component.one_way));
  return dot(solid, outward) < tolerance::kOneWayCosine;
}

bool lets_through(const WorldState& world, std::uint32_t a, std::uint32_t b, Vec normal) {
  return lets_through(world, world.colliders.info[a], normal) ||
         lets_through(world, world.colliders.info[b], -normal);
}

}  // namespace

Passage passage_of(const WorldState& world, const Pair& pair, std::span<const Contact> contacts) {
  const Contact* nearest = nullptr;
  Real separation = 0;
  for (const Contact& contact : contacts) {
    for (int i = 0; i < contact.manifold.count; ++i) {
      const Real s = contact.manifold.points[i].separation;
      if (nearest != nullptr && !(s < separation)) continue;
      nearest = &contact;
      separation = s;
    }
  }
  if (nearest == nullptr) return Passage::Apart;
  if (pair.passage == Passage::Held) return Passage::Held;
  if (pair.passage == Passage::Passing && separation < Real(0)) return Passage::Passing;
  if (separation < -tolerance::kOneWayInsideSlops * pair.slop) return Passage::Passing;
  return lets_through(world, pair.collider_a(), pair.collider_b(), nearest->manifold.normal)
             ? Passage::Passing
             : Passage::Held;
}

bool passes_one_way(const WorldState& world, std::uint32_t a, std::uint32_t b, NumVec normal) {
  if (!has_direction(world.colliders.info[a]) && !has_direction(world.colliders.info[b]))
    return false;
  const Pair* pair = world.pairs.find(pair_key(a, b));
  if (pair != nullptr && pair->passage != Passage::Apart) return pair->passage == Passage::Passing;
  return lets_through(world, a, b, cast<Real>(normal));
}

}  // namespace plumb::inline PLUMB_ABI::detail
