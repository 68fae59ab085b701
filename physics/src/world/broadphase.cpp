// Broadphase: from boxes that grew to pairs of colliders that may touch.
#include <algorithm>
#include <cmath>

#include "math/eigen_bridge.h"
#include "world/clearance.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

WorldAabb grown(const WorldAabb& box, PosReal by) {
  const PosVec m{by, by, by};
  return {box.lower - m, box.upper + m};
}
WorldAabb swept(const WorldAabb& box, PosVec path) {
  const PosVec zero{0, 0, 0};
  return {box.lower + min_each(path, zero), box.upper + max_each(path, zero)};
}

// The thickness that boxes are grown by. A surface leaves it to what it meets: margins follow the
// thinner of two.
Real skin_of(const ColliderInfo& collider) {
  return is_surface(collider.shape.type) ? Real(0) : std::min(collider.thickness, kUnbounded);
}

// As the step's rows take it: a locked axis feels none.
Vec gravity_on(const WorldState& world, std::uint32_t dense) {
  const BodyMass& m = world.bodies.mass[dense];
  const Vec g = m.gravity_scale * to_inner(world.settings.gravity);
  return {m.inverse_mass.x > Real(0) ? g.x : Real(0), m.inverse_mass.y > Real(0) ? g.y : Real(0),
          m.inverse_mass.z > Real(0) ? g.z : Real(0)};
}

struct Reach {
  WorldAabb box;   // all places of the collider in the next step, unless something hits the body
  PosVec path;     // [m] of its centre of mass in it
  WorldAabb ball;  // all places with the body turned in any way
  Real turn = 0;   // [m] by which turning may move a point
};

Reach reach_in_next_step(const WorldState& world, const ColliderInfo& collider) {
  const BodyStore& bodies = world.bodies;
  const Real dt = coming_step(world);
  const BodyInfo& body = bodies.info[collider.body];
  const BodyPose& pose = bodies.pose[body.dense];
  const Transform placed{rotate(pose.q, collider.in_body.p), pose.q * collider.in_body.q};
  const Aabb tight = bounds_of(collider.shape, placed);
  const Real slops = tolerance::kMarginSlops * tolerance::kSlopFraction * skin_of(collider);
  Aabb box = tight;
  Vec path{0, 0, 0};
  Real around = slops, turn = 0;
  Vec ball{0, 0, 0};
  if (bodies.is_awake(collider.body) && !collider.is_static) {
    const BodyVelocity& velocity = bodies.velocity[body.dense];
    // Turning moves a point by at most |w| times its distance from the centre of mass, and never
    // out of the ball around it.
    const Real far = collider.farthest;
    turn = std::min(dt * length(velocity.w) * far, Real(2) * far);
    const Vec t{turn, turn, turn};
    ball = {far, far, far};
    box = {max_each(tight.lower - t, min_each(-ball, tight.lower)),
           min_each(tight.upper + t, max_each(ball, tight.upper))};
    const Real pulled =
        length(multiply_each(bodies.mass[body.dense].inverse_mass, bodies.force[body.dense].force));
    around += dt * dt * (static_cast<Real>(world.settings.gravity.norm()) + pulled);
    const Vec acceleration = bodies.acceleration[collider.body];
    const bool pushed = world.has_effects && length_squared(acceleration) > Real(0);
    if (pushed) around += dt * dt * length(acceleration - gravity_on(world, body.dense));
    path = dt * velocity.v;
  }
  const WorldAabb here{pose.x + cast<PosReal>(box.lower), pose.x + cast<PosReal>(box.upper)};
  const PosVec way = cast<PosReal>(path);
  const PosVec b = cast<PosReal>(ball);
  const PosReal more = static_cast<PosReal>(around);
  return {grown(swept(here, way), more), way, grown(swept({pose.x - b, pose.x + b}, way), more),
          turn};
}

// A ball of all attitudes of a collider that holds all its places in the next step, if only gravity
// acts on it then. Cheaper than its reach.
WorldAabb ball_of_reach(const WorldState& world, const ColliderInfo& collider) {
  const std::uint32_t dense = world.bodies.dense_of[collider.body];
  const Real dt = coming_step(world);
  const PosVec x = world.bodies.pose[dense].x;
  const PosVec way = cast<PosReal>(dt * world.bodies.velocity[dense].v);
  const Real slops = tolerance::kMarginSlops * tolerance::kSlopFraction * skin_of(collider);
  const Real falls = dt * dt * static_cast<Real>(world.settings.gravity.norm());
  const auto room = static_cast<PosReal>(collider.farthest + slops + falls);
  const PosVec r{room, room, room};
  return swept({x - r, x + r}, way);
}

void set_reach(WorldState& world, std::uint32_t slot, const WorldAabb& box) {
  if (world.reach.size() <= slot) {
    world.reach.resize(slot + 1);
    world.box_notes.resize(slot + 1);
  }
  world.reach[slot] = box;
  world.box_notes[slot].old_reach = false;
}

}  // namespace

void note_new_box(WorldState& world, std::uint32_t slot) {
  if (world.box_notes[slot].is_new) return;
  world.box_notes[slot].is_new = true;
  world.new_boxes.push_back(slot);
}

PosVec update_reach(WorldState& world, std::uint32_t slot) {
  const Reach reach = reach_in_next_step(world, world.colliders.info[slot]);
  set_reach(world, slot, reach.box);
  return reach.path;
}

bool may_leave_boxes(WorldState& world, std::uint32_t body) {
  if (stays_in_boxes(world, body)) return false;
  bool leaves = false, to_turn = true;
  PosReal room = std::numeric_limits<PosReal>::max();
  for (const std::uint32_t slot : world.bodies.info[body].colliders) {
    const ColliderInfo& collider = world.colliders.info[slot];
    const WorldAabb& box = world.trees.of(collider).box(collider.proxy);
    BoxNotes& notes = world.box_notes[slot];
    if (!notes.paired && !world.has_effects) {
      const WorldAabb ball = ball_of_reach(world, collider);
      if (contains(box, ball)) {
        notes.old_reach = true;
        room = std::min(room, room_in(box, ball));
        continue;
      }
    }
    to_turn = false;
    leaves |= leaves_proxy(world, slot);
    room = std::min(room, room_in(box, world.reach[slot]));
  }
  note_room(world, body, leaves ? PosReal(0) : room, to_turn);
  return leaves;
}

WorldAabb reach_now(const WorldState& world, std::uint32_t slot) {
  const ColliderInfo& collider = world.colliders.info[slot];
  const bool old = world.bodies.travel[collider.body].old_reach || world.box_notes[slot].old_reach;
  return old ? reach_in_next_step(world, collider).box : world.reach[slot];
}

bool leaves_proxy(WorldState& world, std::uint32_t slot) {
  const ColliderInfo& collider = world.colliders.info[slot];
  update_reach(world, slot);
  return !contains(world.trees.of(collider).box(collider.proxy), world.reach[slot]);
}

void update_proxy(WorldState& world, std::uint32_t slot, bool force) {
  if (force) forget_travel(world, world.colliders.info[slot].body);
  if (force || leaves_proxy(world, slot)) give_proxy(world, slot);
}

void give_proxy(WorldState& world, std::uint32_t slot) {
  ColliderInfo& collider = world.colliders.info[slot];
  AabbTree& tree = world.trees.of(collider);
  const Reach reach = reach_in_next_step(world, collider);
  set_reach(world, slot, reach.box);
  const BoxNotes& notes = world.box_notes[slot];
  note_new_box(world, slot);
  WorldAabb fat = reach.box;
  if (!collider.is_static) {
    const Real skin = skin_of(collider);
    Real spare = tolerance::kFatBoxFraction * skin;
    auto steps = static_cast<PosReal>(tolerance::kFatBoxSteps);
    const PosReal path = length(reach.path);
    if (!notes.paired && path > PosReal(0)) {
      steps =
          std::clamp(static_cast<PosReal>(tolerance::kFreeBoxFraction * collider.farthest) / path,
                     steps, static_cast<PosReal>(tolerance::kFreeBoxSteps));
      // Its room is to last as long on all sides.
      spare = std::clamp(static_cast<Real>(steps * path), spare, tolerance::kFreeBoxSpare * skin);
    }
    // What spins would soon turn out of a close box: it gets one that it cannot turn out of.
    if (static_cast<Real>(steps) * reach.turn > tolerance::kFatBoxFraction * skin)
      fat = union_of(fat, reach.ball);
    fat = grown(swept(fat, steps * reach.path), static_cast<PosReal>(spare));
  }
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
    forget_travel(world, body);
    for (const std::uint32_t collider : bodies.info[body].colliders)
      update_proxy(world, collider, false);
  }
  stale.clear();
}

}  // namespace

void note_paired(WorldState& world) {
  for (const std::uint32_t slot : world.new_boxes) world.box_notes[slot].is_new = false;
  world.new_boxes.clear();
  for (BoxNotes& notes : world.box_notes) notes.paired = false;
  for (const Pair& pair : world.pairs)
    world.box_notes[pair.collider_a()].paired = world.box_notes[pair.collider_b()].paired = true;
}

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
      const WorldAabb& box = world.trees.of(collider).box(collider.proxy);
      world.trees.query_movable(box, meet);
      if (!collider.is_static) world.trees.of_static.query(box, meet);
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
  for (const Pair& pair : world.new_pairs)
    for (const std::uint32_t slot : {pair.collider_a(), pair.collider_b()})
      if (world.box_notes[slot].old_reach) update_reach(world, slot);
  world.pairs.insert_sorted(world.new_pairs);
  for (const std::uint32_t slot : seekers)
    if (slot < world.colliders.info.size()) world.colliders.info[slot].query_pairs = false;
  seekers.clear();
}

}  // namespace plumb::inline PLUMB_ABI::detail
