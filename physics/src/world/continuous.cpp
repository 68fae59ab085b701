// Continuous: bodies that moved far in the step are followed along their path and stopped where
// they meet something that they would pass.
//
//   which     dynamic bodies that moved by more than a fraction of their thickness, and those that
//             such a kinematic body may have run over; all others cost one comparison
//   against   static and kinematic colliders; dynamic ones for bodies with the `continuous` flag
//   stop      at a static body (or a slower dynamic one): it rests there for the rest of the step.
//             At a kinematic one: it is carried along with it. Two flagged fast bodies: both rest.
//   after     velocities stay, so that momentum does; the next step's contact solver finds the pair
//             just touching, with its approach, and stops or bounces it. What gravity did on the
//             part of the path that was not travelled is taken back: no energy is gained.
//
// What is lost is the rest of the step for the stopped body: it arrives later by that much. The
// look-ahead of the narrowphase loses nothing and bounces within the step, so it stays for pairs
// that meet on the paths they have when the step begins; here is what it cannot see: turning, paths
// that contacts have bent, and second meetings.
//
// Contacts that exist when the step begins are the contact solver's business: such a pair is only
// stopped if it gets deeper by a fraction of its thickness, so that nothing that rolls or slides
// fast is held up by its own floor. And shapes are stopped at a slight overlap, which is the same
// as following a slightly smaller core, so that the flush seam of two floor tiles stops nothing.
#include <algorithm>
#include <cmath>

#include "motion/body_motion.h"
#include "world/body_sweep.h"
#include "world/far_movers.h"
#include "world/one_way.h"
#include "world/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Num kNever = 2;  // beyond the end of the step, which is 1
constexpr NumRotation kNoTurn{0, 0, 0, 1};

// Where a body is from some time on: placed in something that sweeps (itself, at first).
struct Path {
  Sweep sweep;
  NumVec p{0, 0, 0};
  NumRotation q = kNoTurn;

  [[nodiscard]] NumVec position_at(Num t) const {
    return sweep.centre_at(t) + rotate(sweep.rotation_at(t), p);
  }
  [[nodiscard]] NumRotation rotation_at(Num t) const {
    return normalized(sweep.rotation_at(t) * q);
  }
};

struct FastPair {
  std::uint64_t key;               // of the colliders
  std::uint32_t mover_a, mover_b;  // of collider_a, collider_b
  std::uint32_t collider_a, collider_b;
  Num time = kNever;
};

// A body that is followed. Lengths are relative to where it was when the step began.
struct Mover {
  std::uint32_t body = 0, dense = 0;
  PosVec start{0, 0, 0};
  Path first;  // until `stop`; without the turn, until that is asked for
  bool knows_turn = false;
  Num stop = kNever;
  bool carried = false;
  Path then;  // from `stop` to `end`, if carried
  Num end = 1;
  NumVec lift{0, 0, 0};  // [m] out of what it sank into, for the part of the step that it waits
};

void learn_turn(const WorldState& world, Mover& mover) {
  if (mover.knows_turn) return;
  add_turn_of_step(world, mover.dense, mover.first.sweep);
  mover.knows_turn = true;
}

struct Hit {
  Num time = kNever;
  std::uint32_t body = kNone;
  NumVec lift{0, 0, 0};  // [m]
};

Num thickness_of(const ColliderInfo& a, const ColliderInfo& b) {
  return static_cast<Num>(std::min(a.thickness, b.thickness));
}

ImpactSearch search_for(const ColliderInfo& a, const ColliderInfo& b, Num begin, Num end) {
  const Num thickness = thickness_of(a, b);
  const Num slop = static_cast<Num>(tolerance::kSlopFraction) * thickness;
  ImpactSearch search;
  search.begin = begin;
  search.end = end;
  search.separation = -static_cast<Num>(tolerance::kContinuousOverlapSlops) * slop;
  search.tolerance = slop;
  search.touching = static_cast<Num>(tolerance::kContinuousTouchSlops) * slop;
  search.allowance = static_cast<Num>(tolerance::kContinuousAllowance) * thickness;
  return search;
}

// What gets deeper each time it is stopped is worked off while it waits, as fast as contacts do.
NumVec lift_from(const Impact& impact, const ImpactSearch& search, Num thickness, Real dt) {
  if (impact.status != ImpactStatus::Deepens) return {0, 0, 0};
  const Num rate = static_cast<Num>(tolerance::kPushRate) * thickness * static_cast<Num>(dt);
  const Num most = std::max(search.separation - impact.distance, Num(0));
  return std::min(most, (Num(1) - impact.time) * rate) * impact.normal;
}

SweptShape on_path(const ColliderInfo& collider, const Path& path) {
  return {collider.shape, path.p + rotate(path.q, to_num(collider.in_body.p)),
          normalized(path.q * to_num(collider.in_body.q)), path.sweep};
}

// ---- which bodies -------------------------------------------------------------------------------

WorldAabb ball_at(PosVec centre, Num radius) {
  const auto r = static_cast<PosReal>(radius);
  return {centre - PosVec{r, r, r}, centre + PosVec{r, r, r}};
}

// Calls visit(slot) for the colliders of a tree whose boxes the collider may meet on its path.
template <class Visit>
void along_path(const AabbTree& tree, const ColliderInfo& collider, const Path& path, PosVec start,
                Num begin, Visit&& visit) {
  const NumVec from = path.sweep.centre_at(begin), to = path.sweep.centre_at(Num(1));
  const Num arch = Num(0.25) * length(path.sweep.bend);
  const Num radius = length(path.p) + length(to_num(collider.in_body.p)) +
                     static_cast<Num>(bounding_radius(collider.shape)) + arch;
  tree.cast_box(ball_at(start + cast<PosReal>(from), radius), cast<PosReal>(to - from), PosReal(1),
                [&](std::uint32_t slot, PosReal max_fraction) {
                  visit(slot);
                  return max_fraction;
                });
}

bool is_kinematic(const WorldState& world, std::uint32_t body) {
  return world.bodies.info[body].type == MotionType::Kinematic;
}
bool is_dynamic(const WorldState& world, std::uint32_t body) {
  return world.bodies.info[body].type == MotionType::Dynamic;
}

// Whether a kinematic body has moved far as seen from a dynamic one, over the latter's thickness.
bool runs_into(const WorldState& world, std::uint32_t kinematic, std::uint32_t dynamic) {
  const BodyInfo& info = world.bodies.info[dynamic];
  const PosVec start = world.bodies.pose[info.dense].x;
  const Sweep k = sweep_of_step(world, world.bodies.info[kinematic].dense, start);
  const NumVec own =
      world.bodies.is_awake(dynamic) ? to_num(world.delta[info.dense].dp) : NumVec{0, 0, 0};
  // Where the kinematic body would have taken the dynamic one's centre.
  const NumVec arm = inverse_rotate(k.rotation_at(Num(0)), -k.centre);
  const NumVec taken = k.centre_at(Num(1)) + rotate(k.rotation_at(Num(1)), arm);
  const Num reach = length(k.turn) * static_cast<Num>(world.bodies.extent[dynamic].radius);
  return length(taken - own) + reach >
         static_cast<Num>(tolerance::kContinuousFraction * world.bodies.extent[dynamic].size);
}

// Dynamic bodies on the paths of fast kinematic ones join those that moved far themselves. Sleepers
// among them are woken by the contact that the next step finds.
StepList<Mover> movers_of(WorldState& world) {
  StepList<std::uint32_t> dynamic(&world.memory);
  for (const std::uint32_t body : bodies_that_moved_far(world)) {
    if (is_dynamic(world, body)) {
      dynamic.push_back(body);
      continue;
    }
    const std::uint32_t dense = world.bodies.info[body].dense;
    const PosVec start = world.bodies.pose[dense].x;
    Path path;
    path.sweep = sweep_of_step(world, dense, start);
    for (const std::uint32_t slot : world.bodies.info[body].colliders) {
      const ColliderInfo& own = world.colliders.info[slot];
      if (own.component.is_sensor) continue;
      along_path(world.trees.of_moving, own, path, start, 0, [&](std::uint32_t other) {
        const ColliderInfo& collider = world.colliders.info[other];
        if (collider.component.is_sensor || !is_dynamic(world, collider.body) ||
            !world.bodies.is_awake(collider.body) || !may_meet(world, slot, other))
          return;
        if (runs_into(world, body, collider.body)) dynamic.push_back(collider.body);
      });
    }
  }
  std::sort(dynamic.begin(), dynamic.end());
  dynamic.erase(std::unique(dynamic.begin(), dynamic.end()), dynamic.end());
  StepList<Mover> movers(dynamic.size(), &world.memory);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    movers[i].body = dynamic[i];
    movers[i].dense = world.bodies.info[dynamic[i]].dense;
    movers[i].start = world.bodies.pose[movers[i].dense].x;
  }
  return movers;
}

std::uint32_t mover_of(const StepList<Mover>& movers, std::uint32_t body) {
  const auto at =
      std::lower_bound(movers.begin(), movers.end(), body,
                       [](const Mover& m, std::uint32_t wanted) { return m.body < wanted; });
  return at != movers.end() && at->body == body ? static_cast<std::uint32_t>(at - movers.begin())
                                                : kNone;
}

// ---- one body against what it cannot move -------------------------------------------------------

struct Follower {
  const WorldState& world;
  const StepList<Mover>& movers;
  FastOthers& fast_others;

  // The first collider met on a path from `begin` on. `passed` is a body that does not count.
  Hit first_hit(Mover& mover, const Path& path, Num begin, std::uint32_t passed) {
    const BodyInfo& info = world.bodies.info[mover.body];
    Hit first;
    for (const std::uint32_t slot : info.colliders) {
      const ColliderInfo& own = world.colliders.info[slot];
      if (own.component.is_sensor) continue;
      static thread_local std::vector<std::uint32_t> obstacles;  // kept for its storage only
      obstacles.clear();
      const auto consider = [&](std::uint32_t other) {
        const ColliderInfo& collider = world.colliders.info[other];
        // Flagged bodies find the others; on a second path only what cannot yield counts.
        const bool dynamic = is_dynamic(world, collider.body);
        if (dynamic && (passed != kNone || !info.continuous)) return;
        if (collider.body == passed || collider.component.is_sensor ||
            !may_meet(world, slot, other))
          return;
        if (dynamic && mover_of(movers, collider.body) != kNone) {
          fast_others.emplace_back(static_cast<std::uint32_t>(&mover - movers.data()), other);
          return;
        }
        obstacles.push_back(other);
      };
      along_path(world.trees.of_static, own, path, mover.start, begin, consider);
      if (world.counts.kinematic > 0 || info.continuous)
        along_path(world.trees.of_moving, own, path, mover.start, begin, consider);
      if (info.continuous)
        along_path(world.trees.of_sleeping, own, path, mover.start, begin, consider);
      if (!obstacles.empty()) learn_turn(world, mover);
      std::sort(obstacles.begin(), obstacles.end());  // not in the order of the tree
      for (const std::uint32_t other : obstacles) {
        const ColliderInfo& collider = world.colliders.info[other];
        const Num until = std::min(first.time, Num(1));
        if (!(until > begin)) break;
        const Sweep sweep =
            sweep_of_step(world, world.bodies.info[collider.body].dense, mover.start);
        const ImpactSearch search = search_for(own, collider, begin, until);
        const Impact impact =
            time_of_impact(swept_shape(collider, sweep), on_path(own, path), search);
        if (impact.status == ImpactStatus::Apart ||
            passes_one_way(world, other, slot, impact.normal))
          continue;
        first = {impact.time, collider.body,
                 lift_from(impact, search, thickness_of(own, collider), world.dt)};
      }
    }
    return first;
  }

  void follow(Mover& mover) {
    mover.first.sweep = path_of_step(world, mover.dense, mover.start);
    const Hit hit = first_hit(mover, mover.first, 0, kNone);
    if (hit.body == kNone) return;
    mover.stop = hit.time;
    if (!is_kinematic(world, hit.body)) {
      // What is lifted alone would be torn from what a joint ties it to.
      if (!world.substep[mover.dense].jointed) mover.lift = hit.lift;
      return;
    }
    const Sweep carrier = sweep_of_step(world, world.bodies.info[hit.body].dense, mover.start);
    const NumRotation q_K = carrier.rotation_at(hit.time);
    mover.carried = true;
    mover.then.sweep = carrier;
    mover.then.p =
        inverse_rotate(q_K, mover.first.position_at(hit.time) - carrier.centre_at(hit.time));
    mover.then.q = normalized(conjugate(q_K) * mover.first.rotation_at(hit.time));
    const Hit squeezed = first_hit(mover, mover.then, hit.time, hit.body);
    if (squeezed.body != kNone) mover.end = squeezed.time;
  }
};

// ---- fast bodies among one another --------------------------------------------------------------

NumVec position_of(const Mover& m, Num t) {
  if (t < m.stop) return m.first.position_at(t);
  return m.carried ? m.then.position_at(std::min(t, m.end)) : m.first.position_at(m.stop);
}
NumRotation rotation_of(const Mover& m, Num t) {
  if (t < m.stop) return m.first.rotation_at(t);
  return m.carried ? m.then.rotation_at(std::min(t, m.end)) : m.first.rotation_at(m.stop);
}

// The path of a mover on a stretch of time that begins at t and holds none of its turning points.
Path path_from(const Mover& m, Num t, PosVec reference) {
  Path path;
  if (t < m.stop) {
    path = m.first;
  } else if (m.carried && t < m.end) {
    path = m.then;
  } else {
    path.sweep = resting_at(position_of(m, t), rotation_of(m, t));
  }
  path.sweep.centre += cast<Num>(m.start - reference);
  return path;
}

Num meeting_time(const WorldState& world, const StepList<Mover>& movers, const FastPair& pair,
                 Num from) {
  const Mover& a = movers[pair.mover_a];
  const Mover& b = movers[pair.mover_b];
  const ColliderInfo& collider_a = world.colliders.info[pair.collider_a];
  const ColliderInfo& collider_b = world.colliders.info[pair.collider_b];
  Num marks[6] = {from, a.stop, a.end, b.stop, b.end, 1};
  std::sort(marks + 1, marks + 6);
  Num t = from;
  for (const Num mark : marks) {
    const Num until = std::min(mark, Num(1));
    if (!(until > t)) continue;
    const Path path_a = path_from(a, t, a.start), path_b = path_from(b, t, a.start);
    const Impact impact = time_of_impact(on_path(collider_a, path_a), on_path(collider_b, path_b),
                                         search_for(collider_a, collider_b, t, until));
    if (impact.status != ImpactStatus::Apart)
      return passes_one_way(world, pair.collider_a, pair.collider_b, impact.normal) ? kNever
                                                                                    : impact.time;
    t = until;
  }
  return kNever;
}

StepList<FastPair> fast_pairs(WorldState& world, StepList<Mover>& movers) {
  StepList<FastPair> pairs(&world.memory);
  for (const FastOthers& chunk : world.fast_others_by_chunk) {
    for (const auto& [m, other] : chunk) {
      const std::uint32_t n = mover_of(movers, world.colliders.info[other].body);
      learn_turn(world, movers[m]);
      learn_turn(world, movers[n]);
      for (const std::uint32_t own : world.bodies.info[movers[m].body].colliders) {
        if (world.colliders.info[own].component.is_sensor || !may_meet(world, own, other)) continue;
        if (own < other) {
          pairs.push_back({pair_key(own, other), m, n, own, other});
        } else {
          pairs.push_back({pair_key(own, other), n, m, other, own});
        }
      }
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const FastPair& a, const FastPair& b) { return a.key < b.key; });
  pairs.erase(std::unique(pairs.begin(), pairs.end(),
                          [](const FastPair& a, const FastPair& b) { return a.key == b.key; }),
              pairs.end());
  return pairs;
}

// Meetings in the order of time. Each stops at least one body earlier than before, so they end.
void meet_one_another(WorldState& world, StepList<Mover>& movers) {
  StepList<FastPair> pairs = fast_pairs(world, movers);
  for (FastPair& pair : pairs) pair.time = meeting_time(world, movers, pair, 0);
  for (;;) {
    FastPair* earliest = nullptr;
    for (FastPair& pair : pairs)
      if (pair.time <= Num(1) && (earliest == nullptr || pair.time < earliest->time))
        earliest = &pair;
    if (earliest == nullptr) return;
    const Num t = earliest->time;
    earliest->time = kNever;
    const std::uint32_t met[2] = {earliest->mover_a, earliest->mover_b};
    bool changed[2] = {false, false};
    for (int i = 0; i < 2; ++i) {
      Mover& mover = movers[met[i]];
      if (!(t < mover.stop)) continue;
      mover.stop = t;
      mover.carried = false;
      mover.lift = {0, 0, 0};
      mover.end = 1;
      changed[i] = true;
    }
    for (FastPair& pair : pairs) {
      const bool stale = (changed[0] && (pair.mover_a == met[0] || pair.mover_b == met[0])) ||
                         (changed[1] && (pair.mover_a == met[1] || pair.mover_b == met[1]));
      if (stale && &pair != earliest) pair.time = meeting_time(world, movers, pair, t);
    }
  }
}

// ---- the outcome --------------------------------------------------------------------------------

// What gravity and forces did to the speed on the part of the path that was not travelled.
void take_back_work(WorldState& world, const Mover& mover) {
  BodyVelocity& velocity = world.bodies.velocity[mover.dense];
  const Vec a = world.substep[mover.dense].acceleration;
  if (flies_a_parabola(world, mover.dense)) {
    velocity.v -= (static_cast<Real>(Num(1) - mover.stop) * world.dt) * a;
    return;
  }
  const Vec missing = world.delta[mover.dense].dp - cast<Real>(mover.first.position_at(mover.stop));
  const Real gained = Real(2) * dot(a, missing), squared = length_squared(velocity.v);
  if (!(gained > Real(0)) || !(squared > Real(0))) return;
  velocity.v = std::sqrt(std::max(Real(1) - gained / squared, Real(0))) * velocity.v;
}

// A body that has been turned back between the step's ends keeps its angular momentum; where that
// would mean more energy than it had, some of it goes.
void limit_spin(BodyStore& bodies, std::uint32_t dense, Rotation before, Rotation after) {
  const BodyMass& mass = bodies.mass[dense];
  Vec& L = bodies.momentum[dense].L;
  const Real had = dot(L, angular_velocity_of(mass, before, L));
  const Real has = dot(L, angular_velocity_of(mass, after, L));
  if (has > had && has > Real(0)) L = std::sqrt(std::max(had, Real(0)) / has) * L;
}

// What the lift costs against gravity is taken from the motion.
void pay_for_lift(WorldState& world, const Mover& mover, Rotation q) {
  BodyStore& bodies = world.bodies;
  const BodyMass& mass = bodies.mass[mover.dense];
  Vec& v = bodies.velocity[mover.dense].v;
  Vec& L = bodies.momentum[mover.dense].L;
  const Real cost =
      -mass.mass * dot(world.substep[mover.dense].acceleration, cast<Real>(mover.lift));
  if (!(cost > Real(0))) return;
  const Real twice = mass.mass * length_squared(v) + dot(L, angular_velocity_of(mass, q, L));
  const Real kept = std::sqrt(std::max(Real(1) - Real(2) * cost / twice, Real(0)));
  if (!(twice > Real(0))) return;
  v = kept * v;
  L = kept * L;
}

void stop_body(WorldState& world, const Mover& mover) {
  BodyStore& bodies = world.bodies;
  BodyDelta& delta = world.delta[mover.dense];
  BodyPose& pose = bodies.pose[mover.dense];
  const Rotation q = to_real(rotation_of(mover, 1));
  const Vec dp = cast<Real>(position_of(mover, 1) + mover.lift);
  if (!is_finite(q) || !is_finite(dp)) return;
  take_back_work(world, mover);
  delta.dp = dp;
  pay_for_lift(world, mover, q);
  const bool exact = mover.first.sweep.tumbles && !mover.carried;
  if (flies_free(world, mover.dense)) {
    if (!exact) limit_spin(bodies, mover.dense, pose.q, q);
    pose.q = q;
    bodies.velocity[mover.dense].w =
        angular_velocity_of(bodies.mass[mover.dense], q, bodies.momentum[mover.dense].L);
  } else {
    limit_spin(bodies, mover.dense, normalized(delta.dq * pose.q), q);
    delta.dq = normalized(q * conjugate(pose.q));
  }
  ++world.report.continuous;
}

}  // namespace

void stop_fast_bodies(WorldState& world) {
  StepList<Mover> movers = movers_of(world);
  if (movers.empty()) return;
  const auto count = static_cast<std::uint32_t>(movers.size());
  std::vector<FastOthers>& found = world.fast_others_by_chunk;
  found.resize(std::max<std::size_t>(found.size(), count / tolerance::kSweepGrain + 1));
  for (FastOthers& chunk : found) chunk.clear();
  parallel_for(world, count, tolerance::kSweepGrain, [&](std::uint32_t begin, std::uint32_t end) {
    Follower follower{world, movers, found[begin / tolerance::kSweepGrain]};
    for (std::uint32_t i = begin; i < end; ++i) follower.follow(movers[i]);
  });
  meet_one_another(world, movers);
  for (const Mover& mover : movers)
    if (mover.stop <= Num(1)) stop_body(world, mover);
}

}  // namespace plumb::inline PLUMB_ABI::detail
