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

bool recycle(const WorldState& world, const Pair& pair, std::uint32_t index, Real margin,
             std::vector<Contact>& out) {
  if (!may_recycle(world, pair, margin)) return false;
  const std::size_t first_out = out.size();
  const std::span<const Contact> before = contacts_of(pair, world.contacts);
  const KeptManifold& first = before.front().kept;
  const BodyPose &a = pose_of(world, pair.body_a), &b = pose_of(world, pair.body_b);
  const Motion of_a = motion_since(first.a, a), of_b = motion_since(first.b, b);
  const Vec from_a_to_b = cast<Real>(first.b.x - first.a.x);
  for (const Contact& old : before) {
    Contact& contact = out.emplace_back(old);
    contact.pair = index;
    const KeptManifold& kept = contact.kept;
    for (int i = 0; i < contact.manifold.count; ++i) {
      const Vec p = kept.position[i];
      const Vec d_a = of_a.of(pair.relative_to_b ? p + from_a_to_b : p);
      const Vec d_b = of_b.of(pair.relative_to_b ? p : p - from_a_to_b);
      ManifoldPoint& point = contact.manifold.points[i];
      point.separation = kept.separation[i] + dot(contact.manifold.normal, d_b - d_a);
      if (point.separation > margin) {
        out.resize(first_out);
        return false;
      }
      point.position = p + Real(0.5) * (d_a + d_b) - (pair.relative_to_b ? of_b.shift : of_a.shift);
      contact.step_normal_impulse[i] = Real(0);
      contact.step_friction_impulse[i] = {0, 0, 0};
    }
  }
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
