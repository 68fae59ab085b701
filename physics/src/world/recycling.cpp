#include "world/recycling.h"

#include <algorithm>

#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

const BodyPose& pose_of(const WorldState& world, std::uint32_t body) {
  return world.bodies.pose[world.bodies.dense_of[body]];
}

// What a body has done since a moment: x - x0, and the rotation.
struct Motion {
  Vec shift;  // [m]
  Rotation turn;

  // (Q - 1) r
  [[nodiscard]] Vec of_direction(Vec r) const {
    const Vec u{turn.x, turn.y, turn.z};
    return Real(2) * (turn.w * cross(u, r) + cross(u, cross(u, r)));
  }
  // By how much it has carried a point whose arm from the centre of mass was r [m].
  [[nodiscard]] Vec of(Vec r) const { return shift + of_direction(r); }
};
Motion motion_since(const KeptPose& then, const BodyPose& now) {
  if (now.x.x == then.x.x && now.x.y == then.x.y && now.x.z == then.x.z && now.q.x == then.q.x &&
      now.q.y == then.q.y && now.q.z == then.q.z && now.q.w == then.q.w)
    return {{0, 0, 0}, {0, 0, 0, 1}};
  return {cast<Real>(now.x - then.x), now.q * conjugate(then.q)};
}

// What the two bodies of a pair have done since its manifolds were found.
struct PairMotion {
  Motion a, b;
  Vec from_a_to_b;  // [m] between the centres of mass then
};
PairMotion motion_of(const WorldState& world, const Pair& pair, const KeptManifold& kept) {
  return {motion_since(kept.a, pose_of(world, pair.body_a)),
          motion_since(kept.b, pose_of(world, pair.body_b)), cast<Real>(kept.b.x - kept.a.x)};
}

// No point of the smaller body has moved farther, seen from the other one [m].
Real relative_path(const WorldState& world, const Pair& pair, const PairMotion& m) {
  const Real radius_a = world.bodies.extent[pair.body_a].radius;
  const Real radius_b = world.bodies.extent[pair.body_b].radius;
  const Rotation turn = m.b.turn * conjugate(m.a.turn);
  const Vec of_centre =
      radius_a < radius_b ? m.a.shift - m.b.of(-m.from_a_to_b) : m.b.shift - m.a.of(m.from_a_to_b);
  return length(of_centre) +
         Real(2) * length(Vec{turn.x, turn.y, turn.z}) * std::min(radius_a, radius_b);
}

// The normal goes with the body that does not yield, or half with either.
Vec carried(const WorldState& world, const Pair& pair, const PairMotion& m, Vec normal) {
  const BodyStore& bodies = world.bodies;
  const bool a_yields = bodies.mass[bodies.dense_of[pair.body_a]].mass > Real(0);
  const bool b_yields = bodies.mass[bodies.dense_of[pair.body_b]].mass > Real(0);
  const Real by_a = !a_yields ? Real(1) : !b_yields ? Real(0) : Real(0.5);
  const Vec turned = by_a * m.a.of_direction(normal) + (Real(1) - by_a) * m.b.of_direction(normal);
  return length_squared(turned) > Real(0) ? normalized_or(normal + turned, normal) : normal;
}

// Tells a contact as of now; false where one of its points has left the margin [m].
bool tell(Contact& contact, const Pair& pair, const PairMotion& m, Vec normal, Real margin) {
  contact.manifold.normal = normal;
  for (int i = 0; i < contact.manifold.count; ++i) {
    const Vec p = contact.kept.position[i];
    const Vec by_a = m.a.of(pair.relative_to_b ? p + m.from_a_to_b : p);
    const Vec by_b = m.b.of(pair.relative_to_b ? p : p - m.from_a_to_b);
    ManifoldPoint& point = contact.manifold.points[i];
    point.separation = contact.kept.separation[i] + dot(normal, by_b - by_a);
    if (point.separation > margin) return false;
    point.position = p + Real(0.5) * (by_a + by_b) - (pair.relative_to_b ? m.b.shift : m.a.shift);
    contact.step_normal_impulse[i] = Real(0);
    contact.step_friction_impulse[i] = {0, 0, 0};
  }
  return true;
}

}  // namespace

void keep(const WorldState& world, const Pair& pair, Real margin, std::span<Contact> contacts) {
  const BodyPose &a = pose_of(world, pair.body_a), &b = pose_of(world, pair.body_b);
  for (Contact& contact : contacts) {
    KeptManifold& kept = contact.kept;
    kept.margin = length_squared(contact.advance) > Real(0) ? Real(-1) : margin;
    kept.a = {a.x, a.q};
    kept.b = {b.x, b.q};
    kept.normal = contact.manifold.normal;
    for (int i = 0; i < contact.manifold.count; ++i) {
      kept.position[i] = contact.manifold.points[i].position;
      kept.separation[i] = contact.manifold.points[i].separation;
    }
  }
}

bool recycle(WorldState& world, const Pair& pair, Real margin, Real reach) {
  if (pair.contact_count == 0 || pair.one_way) return false;
  if (world.settings.forced.off(PlanItem::KeptManifolds)) return false;
  const std::span<Contact> contacts = contacts_of(pair, world.contacts);
  const KeptManifold& first = contacts.front().kept;
  const Real tolerance = tolerance::kRecycleSlops * pair.slop;
  // What was not seen then is not reached in this step either.
  if (!(reach + tolerance <= first.margin)) return false;
  const PairMotion m = motion_of(world, pair, first);
  if (!(relative_path(world, pair, m) <= tolerance)) return false;
  for (Contact& contact : contacts)
    if (!tell(contact, pair, m, carried(world, pair, m, contact.kept.normal), margin)) return false;
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
