#include "world/recycling.h"

#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

const BodyPose& pose_of(const WorldState& world, std::uint32_t body) {
  return world.bodies.pose[world.bodies.info[body].dense];
}

// What a body has done since a moment: x - x0, and the rotation.
struct Motion {
  Vec shift;  // [m]
  Rotation turn;

  // By how much it has carried a point whose arm from the centre of mass was r [m].
  [[nodiscard]] Vec of(Vec r) const {
    const Vec u{turn.x, turn.y, turn.z};
    return shift + Real(2) * (turn.w * cross(u, r) + cross(u, cross(u, r)));
  }
  // No point of the body has moved farther [m].
  [[nodiscard]] Real at_most(Real radius) const {
    return length(shift) + Real(2) * length(Vec{turn.x, turn.y, turn.z}) * radius;
  }
};
Motion motion_since(const KeptPose& then, const BodyPose& now) {
  if (now.x.x == then.x.x && now.x.y == then.x.y && now.x.z == then.x.z && now.q.x == then.q.x &&
      now.q.y == then.q.y && now.q.z == then.q.z && now.q.w == then.q.w)
    return {{0, 0, 0}, {0, 0, 0, 1}};
  return {cast<Real>(now.x - then.x), now.q * conjugate(then.q)};
}

// Whether the last step's contacts of the pair are still good, for a search with `margin`.
bool may_recycle(const WorldState& world, const Pair& pair, Real margin) {
  if (pair.contact_count == 0 || pair.one_way) return false;
  const KeptManifold& kept = world.contacts[pair.first_contact].kept;
  const Real tolerance = tolerance::kRecycleSlops * pair.slop;
  if (!(kept.margin > Real(0)) || margin > kept.margin + tolerance) return false;
  const BodyInfo& a = world.bodies.info[pair.body_a];
  const BodyInfo& b = world.bodies.info[pair.body_b];
  return motion_since(kept.b, world.bodies.pose[b.dense]).at_most(b.radius) <= tolerance &&
         motion_since(kept.a, world.bodies.pose[a.dense]).at_most(a.radius) <= tolerance;
}

}  // namespace

void keep(const WorldState& world, const Pair& pair, Real margin, std::span<Contact> contacts) {
  const BodyPose &a = pose_of(world, pair.body_a), &b = pose_of(world, pair.body_b);
  for (Contact& contact : contacts) {
    KeptManifold& kept = contact.kept;
    kept.margin = length_squared(contact.advance) > Real(0) ? Real(-1) : margin;
    kept.a = {a.x, a.q};
    kept.b = {b.x, b.q};
    for (int i = 0; i < contact.manifold.count; ++i) {
      kept.position[i] = contact.manifold.points[i].position;
      kept.separation[i] = contact.manifold.points[i].separation;
    }
  }
}

bool recycle(WorldState& world, const Pair& pair, Real margin) {
  if (!may_recycle(world, pair, margin)) return false;
  const std::span<Contact> contacts = contacts_of(pair, world.contacts);
  const KeptManifold& first = contacts.front().kept;
  const BodyPose &a = pose_of(world, pair.body_a), &b = pose_of(world, pair.body_b);
  const Motion of_a = motion_since(first.a, a), of_b = motion_since(first.b, b);
  const Vec from_a_to_b = cast<Real>(first.b.x - first.a.x);
  struct Carried {
    Vec by_a, by_b;   // [m]
    Real separation;  // [m]
  };
  const auto carried = [&](const Contact& contact, int i) {
    const Vec p = contact.kept.position[i];
    const Vec d_a = of_a.of(pair.relative_to_b ? p + from_a_to_b : p);
    const Vec d_b = of_b.of(pair.relative_to_b ? p : p - from_a_to_b);
    return Carried{d_a, d_b, contact.kept.separation[i] + dot(contact.manifold.normal, d_b - d_a)};
  };
  for (const Contact& contact : contacts)
    for (int i = 0; i < contact.manifold.count; ++i)
      if (carried(contact, i).separation > margin) return false;
  for (Contact& contact : contacts) {
    for (int i = 0; i < contact.manifold.count; ++i) {
      const Carried c = carried(contact, i);
      ManifoldPoint& point = contact.manifold.points[i];
      point.separation = c.separation;
      point.position = contact.kept.position[i] + Real(0.5) * (c.by_a + c.by_b) -
                       (pair.relative_to_b ? of_b.shift : of_a.shift);
      contact.step_normal_impulse[i] = Real(0);
      contact.step_friction_impulse[i] = {0, 0, 0};
    }
  }
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
