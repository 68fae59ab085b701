// Islands: bodies linked by contacts fall asleep together and wake together.
#include <algorithm>
#include <cmath>

#include "effects/effect_world.h"
#include "world/joint_world.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// A point has all of its friction used up if it is within this share of it [-].
constexpr Real kUsedUp = Real(0.99);
// What would take more than a hundred times the time to sleep to become faster than what rests
// counts as at rest [-].
constexpr Real kGathering = Real(0.01);

bool is_dynamic(const WorldState& world, std::uint32_t body) {
  return world.bodies.info[body].type == MotionType::Dynamic;
}

std::uint32_t find_root(std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) {
    parents[i] = parents[parents[i]];
    i = parents[i];
  }
  return i;
}

// The smaller slot becomes the root, so that roots do not depend on the order of the links.
void link(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
  a = find_root(parents, a);
  b = find_root(parents, b);
  if (a < b) {
    parents[b] = a;
  } else {
    parents[a] = b;
  }
}

void link_touching(WorldState& world) {
  world.parents.resize(world.bodies.info.size());
  for (std::uint32_t dense = world.bodies.awake_begin; dense < world.bodies.awake_end; ++dense)
    world.parents[world.bodies.slot_of[dense]] = world.bodies.slot_of[dense];
  for (const Pair& pair : world.pairs) {
    if (pair.contact_count == 0) continue;
    if (is_dynamic(world, pair.body_a) && is_dynamic(world, pair.body_b) &&
        world.bodies.is_awake(pair.body_a) && world.bodies.is_awake(pair.body_b))
      link(world.parents, pair.body_a, pair.body_b);
  }
  if (!world.joints.empty()) link_joined(world);
  if (world.has_effects) link_tied(world);
}

// A body must be this slow to count as resting [m/s].
Real rest_speed(const WorldState& world, std::uint32_t body, Real gravity_scale) {
  const Real size = world.bodies.extent[body].size;
  const Real g = static_cast<Real>(world.settings.gravity.norm()) * std::abs(gravity_scale);
  return std::max(tolerance::kRestSpeedFraction * std::sqrt(g * size),
                  tolerance::kRestSizesPerSecond * size);
}

void update_rest_time(WorldState& world, std::uint32_t dense) {
  const std::uint32_t body = world.bodies.slot_of[dense];
  BodyInfo& info = world.bodies.info[body];
  if (info.type != MotionType::Dynamic) return;
  const BodyVelocity& velocity = world.bodies.velocity[dense];
  // What is being pushed out of an overlap, or drawn back by a joint, moves without a velocity.
  const BodyDelta& path = world.delta[dense];
  const Real turned = Real(2) * length(Vec{path.dq.x, path.dq.y, path.dq.z});
  const Real moved = (length(path.dp) + turned * world.bodies.extent[body].radius) / world.dt;
  const Real speed =
      std::max(length(velocity.v) + length(velocity.w) * world.bodies.extent[body].radius, moved);
  // What nothing supports is not at rest, however slow it is at the moment: it floats or turns
  // back.
  const bool supported = world.substep[dense].constrained || world.substep[dense].balanced;
  const Real limit = rest_speed(world, body, world.bodies.mass[dense].gravity_scale);
  const bool still = length_squared(velocity.v) == Real(0) &&
                     length_squared(velocity.w) == Real(0) &&
                     length_squared(world.substep[dense].acceleration) == Real(0);
  const bool rests =
      info.can_sleep && !world.substep[dense].driven && (supported ? speed < limit : still);
  info.rest_time = rests ? info.rest_time + world.dt : Real(0);
}

// An island that has been slow for long enough to sleep, and what acts on it from outside in this
// step.
struct Rester {
  std::uint32_t root;
  Vec momentum{0, 0, 0};   // [N s]
  Vec gained{0, 0, 0};     // [N s] in the step
  Real rest_momentum = 0;  // [N s] of all its bodies at rest_speed()
  bool held = false;       // by a point with friction to spare, or by more than friction
};

bool slips(const Pair& pair, const Contact& contact, int i) {
  const Real limit = pair.friction * contact.step_normal_impulse[i];
  return length_squared(contact.step_friction_impulse[i]) >= kUsedUp * kUsedUp * limit * limit;
}

// What the ground gives to the body that lies on it.
void add_support(Rester& rester, const Pair& pair, const Contact& contact, bool of_b) {
  for (int i = 0; i < contact.manifold.count; ++i) {
    if (!(contact.step_normal_impulse[i] > Real(0))) continue;
    if (!slips(pair, contact, i)) rester.held = true;
    const Vec on_b =
        contact.step_normal_impulse[i] * contact.manifold.normal + contact.step_friction_impulse[i];
    rester.gained += of_b ? on_b : -on_b;
  }
}

void add_member(const WorldState& world, Rester& rester, std::uint32_t body) {
  const BodyInfo& info = world.bodies.info[body];
  const BodyMass& mass = world.bodies.mass[info.dense];
  const SubstepBody& s = world.substep[info.dense];
  rester.momentum += mass.mass * world.bodies.velocity[info.dense].v;
  rester.gained += (world.dt * mass.mass) * s.acceleration;
  rester.rest_momentum += mass.mass * rest_speed(world, body, mass.gravity_scale);
  if (s.jointed || s.affected) rester.held = true;
}

// Whether it gathers speed, at the rate of this step, and has what that brings in the time for
// which it was slow, give or take: a single push from its neighbours is none of it.
bool gathers_speed(const WorldState& world, const Rester& rester) {
  const Real size = length(rester.momentum);
  if (rester.held || !(size > Real(0))) return false;
  const Real steps = world.settings.time_to_sleep / world.dt;
  const Real brought = steps * dot(rester.gained, rester.momentum) / size;
  return brought > kGathering * rester.rest_momentum && size > Real(0.5) * brought;
}

// Of the islands that have been slow for long enough, those that slide off slowly: friction holds
// them at no point, and what is left over drives them on.
StepList<std::uint32_t> find_sliding(
    WorldState& world, std::span<const std::pair<std::uint32_t, std::uint32_t>> resting) {
  StepList<Rester> resters(&world.memory);
  for (const auto& [root, body] : resting) {
    if (resters.empty() || resters.back().root != root) resters.push_back({root});
    add_member(world, resters.back(), body);
  }
  const auto rester_of = [&](std::uint32_t body) -> Rester* {
    if (!is_dynamic(world, body) || !world.bodies.is_awake(body)) return nullptr;
    const std::uint32_t root = find_root(world.parents, body);
    const auto at = std::lower_bound(resters.begin(), resters.end(), root,
                                     [](const Rester& r, std::uint32_t k) { return r.root < k; });
    return at != resters.end() && at->root == root ? &*at : nullptr;
  };
  for (const Pair& pair : world.pairs) {
    if (pair.contact_count == 0) continue;
    Rester* const a = rester_of(pair.body_a);
    Rester* const b = rester_of(pair.body_b);
    if (a == b) continue;  // within one island, or none
    Rester& rester = a != nullptr ? *a : *b;
    if (pair.adhesion > Real(0) || pair.grained) rester.held = true;
    for (const Contact& contact : contacts_of(pair, world.contacts))
      add_support(rester, pair, contact, b != nullptr);
  }
  StepList<std::uint32_t> sliding(&world.memory);
  for (const Rester& rester : resters)
    if (gathers_speed(world, rester)) sliding.push_back(rester.root);
  return sliding;
}

void store_island(WorldState& world, std::vector<std::uint32_t> bodies) {
  std::uint32_t index;
  if (world.free_islands.empty()) {
    index = static_cast<std::uint32_t>(world.islands.size());
    world.islands.emplace_back();
  } else {
    index = world.free_islands.back();
    world.free_islands.pop_back();
  }
  SleepingIsland& island = world.islands[index];
  island = {};
  island.used = true;
  island.bodies = std::move(bodies);
  for (const std::uint32_t body : island.bodies) {
    BodyInfo& info = world.bodies.info[body];
    const std::uint32_t dense = info.dense;
    world.bodies.velocity[dense] = {};
    world.bodies.momentum[dense] = {};
    world.bodies.force[dense].force = world.bodies.force[dense].torque = {0, 0, 0};
    info.island = index;
    world.bodies.acceleration[body] = {0, 0, 0};
    world.bodies.rest(body);
    for (const std::uint32_t slot : info.colliders) {
      world.trees.set_asleep(world.colliders.info[slot], slot, true);
      update_reach(world, slot);  // it goes nowhere now
    }
    world.bodies.travel[body].old_reach = false;
    world.gathering.sleep.push_back({{body, info.generation}, true});
  }
}

// Takes the touching pairs of all bodies that just fell asleep out of the awake ones. A pair that
// only has overlapping bounds is forgotten; waking seeks it again.
void move_pairs_to_islands(WorldState& world) {
  world.sleeping_contacts.forget();
  world.pairs.remove_if([&](Pair& pair) {
    const std::uint32_t in_a = world.bodies.info[pair.body_a].island;
    const std::uint32_t in_b = world.bodies.info[pair.body_b].island;
    if (in_a == kNone && in_b == kNone) return false;
    if (world.bodies.is_awake(pair.body_a) || world.bodies.is_awake(pair.body_b)) return false;
    if (pair.was_touching || pair.touching || pair.passage == Passage::Passing) {
      SleepingIsland& island = world.islands[in_a != kNone ? in_a : in_b];
      move_contacts(pair, world.contacts, island.contacts);
      island.pairs.push_back(pair);
    }
    return true;
  });
}

}  // namespace

void link_bodies(WorldState& world, std::uint32_t body_a, std::uint32_t body_b) {
  link(world.parents, body_a, body_b);
}

void wake_body(WorldState& world, std::uint32_t body) {
  BodyInfo& info = world.bodies.info[body];
  if (info.disabled || info.type == MotionType::Static) return;
  info.rest_time = 0;
  world.touched.push_back(body);
  if (info.island == kNone) {
    world.bodies.wake(body);
    if (!world.joints.empty()) wake_joined(world, body);
    if (world.has_effects) wake_tied(world, body);
    return;
  }
  world.sleeping_contacts.forget();
  const std::uint32_t index = info.island;
  SleepingIsland island = std::move(world.islands[index]);
  world.islands[index] = {};
  world.free_islands.push_back(index);
  for (const std::uint32_t member : island.bodies) {
    BodyInfo& sleeper = world.bodies.info[member];
    sleeper.island = kNone;
    sleeper.rest_time = 0;
    world.bodies.wake(member);
    world.gathering.sleep.push_back({{member, sleeper.generation}, false});
    for (const std::uint32_t collider : sleeper.colliders) {
      ColliderInfo& c = world.colliders.info[collider];
      world.trees.set_asleep(c, collider, false);
      note_new_box(world, collider);  // it may have been moved while it slept
      if (!c.query_pairs) {
        c.query_pairs = true;
        world.query_list.push_back(collider);
      }
    }
  }
  std::erase_if(island.pairs, [&](const Pair& pair) { return world.pairs.contains(pair.key); });
  for (Pair& pair : island.pairs) move_contacts(pair, island.contacts, world.contacts);
  world.pairs.insert_sorted(island.pairs);
}

void wake_around(WorldState& world, std::uint32_t body) {
  std::vector<std::uint32_t> sleepers;
  for (const std::uint32_t slot : world.bodies.info[body].colliders) {
    const ColliderInfo& collider = world.colliders.info[slot];
    if (collider.proxy == AabbTree::kNull) continue;
    const WorldAabb& box = world.trees.of(collider).box(collider.proxy);
    world.trees.query_movable(box, [&](std::uint32_t other) {
      const ColliderInfo& met = world.colliders.info[other];
      if (met.body == body) return;
      // A kinematic body at rest is in no island: only a sensor has to find it again.
      const bool sensed = collider.component.is_sensor || met.component.is_sensor;
      if (world.bodies.info[met.body].island != kNone ||
          (sensed && !world.bodies.is_awake(met.body)))
        sleepers.push_back(met.body);
    });
  }
  std::sort(sleepers.begin(), sleepers.end());
  for (const std::uint32_t sleeper : sleepers) wake_body(world, sleeper);
}

void sleep_islands(WorldState& world) {
  world.report.islands = 0;
  if (!world.flags.sleeping) return;
  BodyStore& bodies = world.bodies;
  link_touching(world);
  for (std::uint32_t dense = bodies.awake_begin; dense < bodies.awake_end; ++dense)
    update_rest_time(world, dense);
  // The shortest rest of any member decides for the island.
  StepList<std::uint32_t> awake(bodies.slot_of.begin() + bodies.awake_begin,
                                bodies.slot_of.begin() + bodies.awake_end, &world.memory);
  std::erase_if(awake, [&](std::uint32_t body) { return !is_dynamic(world, body); });
  std::sort(awake.begin(), awake.end());
  for (const std::uint32_t body : awake) {
    const std::uint32_t root = find_root(world.parents, body);
    bodies.info[root].rest_time =
        std::min(bodies.info[root].rest_time, bodies.info[body].rest_time);
    if (root == body) ++world.report.islands;
  }
  StepList<std::pair<std::uint32_t, std::uint32_t>> resting(&world.memory);  // root, body
  for (const std::uint32_t body : awake) {
    const std::uint32_t root = find_root(world.parents, body);
    if (bodies.info[root].rest_time >= world.settings.time_to_sleep)
      resting.emplace_back(root, body);
  }
  if (resting.empty()) return;
  std::sort(resting.begin(), resting.end());
  const StepList<std::uint32_t> sliding = find_sliding(world, resting);
  for (std::size_t i = 0; i < resting.size();) {
    std::vector<std::uint32_t> members;
    const std::uint32_t root = resting[i].first;
    for (; i < resting.size() && resting[i].first == root; ++i)
      members.push_back(resting[i].second);
    if (std::binary_search(sliding.begin(), sliding.end(), root)) continue;
    store_island(world, std::move(members));
  }
  move_pairs_to_islands(world);
}

void put_to_sleep(WorldState& world, std::uint32_t body) {
  if (!is_dynamic(world, body) || !world.bodies.is_awake(body)) return;
  link_touching(world);
  std::vector<std::uint32_t> members;
  const std::uint32_t root = find_root(world.parents, body);
  for (std::uint32_t dense = world.bodies.awake_begin; dense < world.bodies.awake_end; ++dense) {
    const std::uint32_t other = world.bodies.slot_of[dense];
    if (is_dynamic(world, other) && find_root(world.parents, other) == root)
      members.push_back(other);
  }
  std::sort(members.begin(), members.end());
  store_island(world, std::move(members));
  move_pairs_to_islands(world);
}

}  // namespace plumb::inline PLUMB_ABI::detail
