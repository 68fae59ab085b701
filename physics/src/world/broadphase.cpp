// Broadphase: from boxes that grew to pairs of colliders that may touch.
#include <algorithm>
#include <cmath>

#include "math/eigen_bridge.h"
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

WorldAabb grown(const WorldAabb& box, PosReal by) {
  const PosVec m{by, by, by};
  return {box.lower - m, box.upper + m};
}

// Bounds that hold the collider throughout the next step, whatever its contacts do to it but stop
// it.
WorldAabb bounds_for_next_step(const WorldState& world, const ColliderInfo& collider) {
  const BodyStore& bodies = world.bodies;
  const std::uint32_t dense = bodies.info[collider.body].dense;
  const BodyPose& pose = bodies.pose[dense];
  const Transform placed{rotate(pose.q, collider.in_body.p), pose.q * collider.in_body.q};
  const Aabb tight = bounds_of(collider.shape, placed);
  return {pose.x + cast<PosReal>(tight.lower), pose.x + cast<PosReal>(tight.upper)};
}

Real reach_per_second(const WorldState& world, const ColliderInfo& collider) {
  const BodyInfo& info = world.bodies.info[collider.body];
  const BodyVelocity& velocity = world.bodies.velocity[info.dense];
  return length(velocity.v) + length(velocity.w) * info.radius;
}

}  // namespace

bool may_meet(const WorldState& world, std::uint32_t collider_a, std::uint32_t collider_b) {
  const ColliderInfo& a = world.colliders.info[collider_a];
  const ColliderInfo& b = world.colliders.info[collider_b];
  if (a.body == b.body) return false;
  const MotionType type_a = world.bodies.info[a.body].type, type_b = world.bodies.info[b.body].type;
  if (type_a != MotionType::Dynamic && type_b != MotionType::Dynamic) return false;
  if (a.component.is_sensor && b.component.is_sensor) return false;
  if (!world.joints.empty() && !a.component.is_sensor && !b.component.is_sensor &&
      joined_without_contact(world, a.body, b.body))
    return false;
  return (a.component.filter.layers & b.component.filter.collides_with) != 0 &&
         (b.component.filter.layers & a.component.filter.collides_with) != 0;
}

Pair make_pair(const WorldState& world, std::uint64_t key) {
  Pair pair;
  pair.key = key;
  const ColliderInfo& a = world.colliders.info[pair.collider_a()];
  const ColliderInfo& b = world.colliders.info[pair.collider_b()];
  pair.body_a = a.body;
  pair.body_b = b.body;
  pair.sensor = a.component.is_sensor || b.component.is_sensor;
  const Material& ma = a.component.material;
  const Material& mb = b.component.material;
  pair.friction = combine(std::max(ma.friction_rule, mb.friction_rule), ma.friction, mb.friction);
  pair.restitution =
      combine(std::max(ma.restitution_rule, mb.restitution_rule), ma.restitution, mb.restitution);
  pair.slop = tolerance::kSlopFraction * std::min(a.thickness, b.thickness);
  pair.relative_to_b = world.bodies.info[a.body].type != MotionType::Dynamic;
  return pair;
}

void update_proxy(WorldState& world, std::uint32_t slot, bool force) {
  ColliderInfo& collider = world.colliders.info[slot];
  AabbTree& tree = collider.is_static ? world.static_tree : world.moving_tree;
  const WorldAabb tight = bounds_for_next_step(world, collider);
  const Real thickness = std::min(collider.thickness, kUnbounded);
  const Real speed = collider.is_static ? Real(0) : reach_per_second(world, collider);
  const std::uint32_t dense = world.bodies.info[collider.body].dense;
  const Real pulled =
      length(multiply_each(world.bodies.mass[dense].inverse_mass, world.bodies.force[dense].force));
  const Real fall =
      collider.is_static
          ? Real(0)
          : world.dt * world.dt * (static_cast<Real>(world.settings.gravity.norm()) + pulled);
  const Real slops = tolerance::kMarginSlops * tolerance::kSlopFraction * thickness;
  const WorldAabb needed = grown(tight, static_cast<PosReal>(slops + world.dt * speed + fall));
  if (!force && contains(tree.box(collider.proxy), needed)) return;
  const Real ahead =
      tolerance::kFatBoxFraction * thickness + tolerance::kFatBoxSteps * (world.dt * speed + fall);
  const WorldAabb fat = collider.is_static ? needed : grown(needed, static_cast<PosReal>(ahead));
  if (collider.proxy == AabbTree::kNull) {
    collider.proxy = tree.insert(fat, slot);
  } else {
    tree.move(collider.proxy, fat);
  }
  if (!collider.query_pairs) {
    collider.query_pairs = true;
    world.query_list.push_back(slot);
  }
}

namespace {

// Bodies that were acted on between steps may be faster than their boxes reach; all of them when
// the time step is another.
void refresh_proxies(WorldState& world) {
  BodyStore& bodies = world.bodies;
  std::vector<std::uint32_t>& stale = world.touched;
  if (world.dt != world.proxy_dt) {
    stale.assign(bodies.slot_of.begin() + bodies.awake_begin,
                 bodies.slot_of.begin() + bodies.awake_end);
    world.proxy_dt = world.dt;
  }
  std::sort(stale.begin(), stale.end());
  stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
  for (const std::uint32_t body : stale) {
    if (body >= bodies.info.size() || !bodies.info[body].alive) continue;
    for (const std::uint32_t collider : bodies.info[body].colliders)
      update_proxy(world, collider, false);
  }
  stale.clear();
}

}  // namespace

void find_pairs(WorldState& world) {
  refresh_proxies(world);
  std::vector<std::uint32_t>& seekers = world.query_list;
  std::sort(seekers.begin(), seekers.end());
  const std::uint32_t count = static_cast<std::uint32_t>(seekers.size());
  const std::uint32_t chunks = (count + tolerance::kPairGrain - 1) / tolerance::kPairGrain;
  if (world.new_keys_by_chunk.size() < chunks) world.new_keys_by_chunk.resize(chunks);
  for (std::uint32_t c = 0; c < chunks; ++c) world.new_keys_by_chunk[c].clear();
  parallel_for(world, count, tolerance::kPairGrain, [&](std::uint32_t begin, std::uint32_t end) {
    std::vector<std::uint64_t>& keys = world.new_keys_by_chunk[begin / tolerance::kPairGrain];
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t slot = seekers[i];
      const ColliderInfo& collider = world.colliders.info[slot];
      if (!collider.alive) continue;
      const auto meet = [&](std::uint32_t other) {
        if (!may_meet(world, slot, other)) return;
        const std::uint64_t key = pair_key(slot, other);
        if (!world.pairs.contains(key)) keys.push_back(key);
      };
      const WorldAabb& box =
          (collider.is_static ? world.static_tree : world.moving_tree).box(collider.proxy);
      world.moving_tree.query(box, meet);
      if (!collider.is_static) world.static_tree.query(box, meet);
    }
  });
  world.new_keys.clear();
  for (std::uint32_t c = 0; c < chunks; ++c)
    world.new_keys.insert(world.new_keys.end(), world.new_keys_by_chunk[c].begin(),
                          world.new_keys_by_chunk[c].end());
  std::sort(world.new_keys.begin(), world.new_keys.end());
  world.new_keys.erase(std::unique(world.new_keys.begin(), world.new_keys.end()),
                       world.new_keys.end());
  world.new_pairs.clear();
  for (const std::uint64_t key : world.new_keys) world.new_pairs.push_back(make_pair(world, key));
  world.pairs.insert_sorted(world.new_pairs);
  for (const std::uint32_t slot : seekers)
    if (slot < world.colliders.info.size()) world.colliders.info[slot].query_pairs = false;
  seekers.clear();
}

}  // namespace plumb::inline PLUMB_ABI::detail
