// Narrowphase: a manifold for every awake pair, warm-start impulses carried over, sleepers woken.
#include <algorithm>
#include <limits>

#include "collision/collide.h"
#include "world/body_sweep.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Points that lost their feature name are matched to an old point within this share of the contact
// thickness [-]; farther off it is another place of the surface.
constexpr Real kMatchFraction = Real(0.02);

// The shape of a collider placed relative to a reference point near the contact.
Transform placed_from(const WorldState& world, const ColliderInfo& collider, PosVec reference) {
  const BodyPose& pose = world.bodies.pose[world.bodies.info[collider.body].dense];
  const Vec offset = rotate(pose.q, collider.in_body.p);
  const Rotation q = pose.q * collider.in_body.q;
  const PosVec p = pose.x - reference + cast<PosReal>(offset);
  if (collider.shape.type != ShapeType::HalfSpace) return {cast<Real>(p), q};
  // A plane may be described from any of its points: the nearest to the reference loses no digits.
  const PosVec n = cast<PosReal>(rotate(q, collider.shape.normal));
  return {cast<Real>(dot(n, p) * n), q};
}

void carry_impulses(Pair& pair, const Manifold& old, Real thickness) {
  Real normal[Manifold::kMaxPoints]{};
  Vec friction[Manifold::kMaxPoints]{};
  bool taken[Manifold::kMaxPoints]{}, matched[Manifold::kMaxPoints]{};
  const auto take = [&](int i, int j) {
    normal[i] = pair.normal_impulse[j];
    friction[i] = pair.friction_impulse[j];
    taken[j] = matched[i] = true;
  };
  for (int i = 0; i < pair.manifold.count; ++i)
    for (int j = 0; j < old.count && !matched[i]; ++j)
      if (!taken[j] && old.points[j].feature == pair.manifold.points[i].feature) take(i, j);
  const Real reach = kMatchFraction * thickness;
  for (int i = 0; i < pair.manifold.count; ++i) {
    if (matched[i]) continue;
    int nearest = -1;
    Real best = reach * reach;
    for (int j = 0; j < old.count; ++j) {
      const Real d = length_squared(old.points[j].position - pair.manifold.points[i].position);
      if (!taken[j] && d < best) {
        best = d;
        nearest = j;
      }
    }
    if (nearest >= 0) take(i, nearest);
  }
  for (int i = 0; i < Manifold::kMaxPoints; ++i) {
    pair.normal_impulse[i] = normal[i];
    pair.friction_impulse[i] = friction[i];
  }
}

// How far the surfaces of a slow pair may approach within one step [m]. What may come nearer than
// that is swept, or else stopped after the step (continuous.cpp): a contact made across a wide gap
// has long arms and a normal of the wrong moment, and throws bodies about.
Real reach_of(const WorldState& world, const Pair& pair) {
  const BodyInfo& a = world.bodies.info[pair.body_a];
  const BodyInfo& b = world.bodies.info[pair.body_b];
  const BodyVelocity& va = world.bodies.velocity[a.dense];
  const BodyVelocity& vb = world.bodies.velocity[b.dense];
  const Real speed = length(vb.v - va.v) + length(va.w) * a.radius + length(vb.w) * b.radius;
  const Real thickness = pair.slop / tolerance::kSlopFraction;
  const Real g = static_cast<Real>(world.settings.gravity.norm());
  return std::min(world.dt * speed, tolerance::kSweptFraction * thickness) +
         world.dt * world.dt * g;
}

// Fast pairs: the manifold is that of the first touch along the relative path of the step (without
// rotation), so that they meet, and bounce, within the step. Returns false when the pair is slow,
// touches already, or does not meet; the ordinary manifold serves then.
bool collide_swept(const WorldState& world, Pair& pair, const ColliderInfo& a, const Transform& xa,
                   const ColliderInfo& b, const Transform& xb, Real margin) {
  const BodyInfo& info_a = world.bodies.info[pair.body_a];
  const BodyInfo& info_b = world.bodies.info[pair.body_b];
  const Vec v = world.bodies.velocity[info_b.dense].v - world.bodies.velocity[info_a.dense].v;
  const Real thickness = pair.slop / tolerance::kSlopFraction;
  const Vec path = world.dt * v;
  if (length(path) <= tolerance::kSweptFraction * thickness) return false;
  const Sweep still = resting_at(to_num(xa.p), {0, 0, 0, 1});
  Sweep moving = resting_at(to_num(xb.p), {0, 0, 0, 1});
  moving.travel = to_num(path);
  const SweptShape in_a{a.shape, {0, 0, 0}, normalized(to_num(xa.q)), still};
  const SweptShape in_b{b.shape, {0, 0, 0}, normalized(to_num(xb.q)), moving};
  // What only brushes past (the next of two flush tiles, under a body that slides) does not count.
  const Num slop = static_cast<Num>(pair.slop);
  ImpactSearch search;
  search.separation = -static_cast<Num>(tolerance::kContinuousOverlapSlops) * slop;
  search.tolerance = slop;
  Impact meeting = time_of_impact(in_a, in_b, search);
  if (meeting.status == ImpactStatus::Apart || !(meeting.time > Num(0))) return false;
  search.separation = 0;
  search.tolerance = static_cast<Num>(tolerance::kSweepTolerance) * slop;
  search.end = meeting.time;
  const Impact touch = time_of_impact(in_a, in_b, search);
  if (touch.status != ImpactStatus::Apart) meeting = touch;
  if (!(meeting.time > Num(0)) || !(dot(meeting.normal, moving.travel) < Num(0))) return false;
  const Real t = static_cast<Real>(meeting.time);
  Transform moved = xb;
  moved.p = xb.p + t * path;
  Manifold manifold;
  if (!collide(a.shape, xa, b.shape, moved, margin, manifold)) return false;
  pair.manifold = manifold;
  pair.advance = t * path;
  pair.advanced_gap = -dot(manifold.normal, pair.advance);
  for (int i = 0; i < manifold.count; ++i) {
    ManifoldPoint& point = pair.manifold.points[i];
    point.separation += pair.advanced_gap;
    if (pair.relative_to_b) point.position -= pair.advance;
  }
  return true;
}

void collide_pair(WorldState& world, std::size_t index) {
  Pair& pair = world.pairs[index];
  const ColliderInfo& a = world.colliders.info[pair.collider_a()];
  const ColliderInfo& b = world.colliders.info[pair.collider_b()];
  const BodyStore& bodies = world.bodies;
  const WorldAabb& box_a = (a.is_static ? world.static_tree : world.moving_tree).box(a.proxy);
  const WorldAabb& box_b = (b.is_static ? world.static_tree : world.moving_tree).box(b.proxy);
  const bool some_awake = bodies.is_awake(pair.body_a) || bodies.is_awake(pair.body_b);
  world.pair_gone[index] = !some_awake || !overlaps(box_a, box_b);
  if (world.pair_gone[index] != 0) {
    pair.manifold.count = 0;
    return;
  }
  const PosVec reference =
      bodies.pose[bodies.info[pair.relative_to_b ? pair.body_b : pair.body_a].dense].x;
  const Transform xa = placed_from(world, a, reference), xb = placed_from(world, b, reference);
  const Real margin =
      pair.sensor ? Real(0) : tolerance::kMarginSlops * pair.slop + reach_of(world, pair);
  const Manifold old = pair.manifold;
  pair.manifold.count = 0;
  pair.advance = {0, 0, 0};
  pair.advanced_gap = 0;
  if (pair.sensor || !collide_swept(world, pair, a, xa, b, xb, margin))
    collide(a.shape, xa, b.shape, xb, margin, pair.manifold);
  if (!pair.sensor) carry_impulses(pair, old, pair.slop / tolerance::kSlopFraction);
  for (int i = 0; i < Manifold::kMaxPoints; ++i) {
    pair.step_normal_impulse[i] = 0;
    pair.step_friction_impulse[i] = {0, 0, 0};
  }
}

void collide_range(WorldState& world, const std::vector<std::uint32_t>& which) {
  parallel_for(world, static_cast<std::uint32_t>(which.size()), tolerance::kPairGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) collide_pair(world, which[i]);
               });
}

// Sleeping dynamic bodies that something awake has reached.
bool wake_what_is_touched(WorldState& world) {
  world.bodies_to_wake.clear();
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    const Pair& pair = world.pairs[i];
    if (pair.manifold.count == 0 || pair.sensor) continue;
    for (const std::uint32_t body : {pair.body_a, pair.body_b})
      if (world.bodies.info[body].island != kNone) world.bodies_to_wake.push_back(body);
  }
  for (const std::uint32_t body : world.bodies_to_wake) wake_body(world, body);
  return !world.bodies_to_wake.empty();
}

}  // namespace

void collide_pairs(WorldState& world) {
  std::vector<std::uint32_t>& all = world.touching;
  const auto list_all = [&] {
    all.resize(world.pairs.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    world.pair_gone.assign(all.size(), 0);
  };
  list_all();
  collide_range(world, all);
  // A woken island brings its own contacts; they are computed once more together with all others,
  // which happens only in steps in which something wakes.
  while (world.flags.sleeping && wake_what_is_touched(world)) {
    find_pairs(world);
    list_all();
    collide_range(world, all);
  }
  world.deep_overlap = false;
  std::size_t index = 0;
  world.pairs.remove_if([&](const Pair& pair) {
    const bool gone = world.pair_gone[index++] != 0;
    if (gone && pair.was_touching) {
      const ColliderId a = world.colliders.id(pair.collider_a()),
                       b = world.colliders.id(pair.collider_b());
      if (pair.sensor) {
        const bool a_senses = world.colliders.info[a.index].component.is_sensor;
        world.gathering.sensors.push_back(
            {SensorEvent::Kind::Exit, a_senses ? a : b, a_senses ? b : a});
      } else {
        world.gathering.contacts.push_back(
            {ContactEvent::Kind::End,
             a,
             b,
             {pair.body_a, world.bodies.info[pair.body_a].generation},
             {pair.body_b, world.bodies.info[pair.body_b].generation}});
      }
    }
    return gone;
  });
  world.touching.clear();
  world.report.candidate_pairs = static_cast<std::uint32_t>(world.pairs.size());
  for (std::uint32_t i = 0; i < world.pairs.size(); ++i) {
    Pair& pair = world.pairs[i];
    pair.touching = pair.manifold.count > 0;
    if (!pair.touching || pair.sensor) continue;
    world.touching.push_back(i);
    ++world.report.touching_pairs;
    world.report.contact_points += static_cast<std::uint32_t>(pair.manifold.count);
    if (length_squared(pair.advance) > Real(0)) ++world.report.looked_ahead;
    for (int k = 0; k < pair.manifold.count; ++k) {
      const Real depth = -pair.manifold.points[k].separation;
      world.report.largest_penetration =
          std::max(world.report.largest_penetration, static_cast<double>(depth));
      world.deep_overlap = world.deep_overlap || depth > tolerance::kDeepSlops * pair.slop;
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
