// Finalize: poses, bounds, events, and the quarantine of bodies whose state is not finite.
#include <algorithm>
#include <limits>

#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

bool is_sound(const BodyVelocity& velocity, const BodyPose& pose, Vec L) {
  return is_finite(velocity.v) && is_finite(velocity.w) && is_finite(pose.x) && is_finite(pose.q) &&
         is_finite(L);
}

// Moves one body to where the step has brought it. Returns false, and leaves the old pose, when
// that is no place.
bool move_body(WorldState& world, std::uint32_t i) {
  BodyStore& bodies = world.bodies;
  BodyInfo& info = bodies.info[bodies.slot_of[i]];
  const BodyDelta& delta = world.delta[i];
  BodyPose next = bodies.pose[i];
  next.x += cast<PosReal>(delta.dp);
  const bool dynamic = bodies.mass[i].mass > Real(0);
  const bool turned_here =
      world.substep[i].constrained || !dynamic;  // free bodies have turned already
  if (turned_here) next.q = normalized(delta.dq * next.q);
  if (turned_here && dynamic)
    bodies.velocity[i].w = angular_velocity_of(bodies.mass[i], next.q, bodies.momentum[i].L);
  info.acceleration = world.substep[i].acceleration;
  bodies.force[i].force = bodies.force[i].torque = {0, 0, 0};
  if (!is_sound(bodies.velocity[i], next, bodies.momentum[i].L)) return false;
  bodies.pose[i] = next;
  return true;
}

void quarantine(WorldState& world, std::uint32_t body) {
  BodyInfo& info = world.bodies.info[body];
  const std::uint32_t dense = info.dense;
  world.bodies.velocity[dense] = {};
  world.bodies.momentum[dense] = {};
  world.bodies.mass[dense] = {};
  info.disabled = true;
  world.gathering.quarantined.push_back({{body, info.generation}});
  ++world.report.quarantined;
  world.bodies.rest(body);
}

// Begin when surfaces are within a slop or push; end when no point is left within the margin.
void note_contact_events(WorldState& world) {
  for (std::size_t i = 0; i < world.pairs.size(); ++i) {
    Pair& pair = world.pairs[i];
    bool now = pair.was_touching && pair.touching;
    if (pair.sensor) {
      now = pair.touching;
    } else if (pair.touching) {
      Real nearest = std::numeric_limits<Real>::max(), impulse = 0;
      for (int k = 0; k < pair.manifold.count; ++k) {
        nearest = std::min(nearest, pair.manifold.points[k].separation);
        impulse = std::max(impulse, pair.step_normal_impulse[k]);
      }
      now = impulse > Real(0) || nearest <= pair.slop ||
            (pair.was_touching && nearest <= tolerance::kMarginSlops * pair.slop);
    }
    if (now == pair.was_touching) continue;
    pair.was_touching = now;
    const ColliderId a = world.colliders.id(pair.collider_a()),
                     b = world.colliders.id(pair.collider_b());
    if (pair.sensor) {
      const bool a_senses = world.colliders.info[a.index].component.is_sensor;
      world.gathering.sensors.push_back({now ? SensorEvent::Kind::Enter : SensorEvent::Kind::Exit,
                                         a_senses ? a : b, a_senses ? b : a});
    } else {
      world.gathering.contacts.push_back(
          {now ? ContactEvent::Kind::Begin : ContactEvent::Kind::End,
           a,
           b,
           {pair.body_a, world.bodies.info[pair.body_a].generation},
           {pair.body_b, world.bodies.info[pair.body_b].generation}});
    }
  }
}

// Contacts that began with an approach above the bounce threshold and were stopped without a
// bounce.
void note_hits(WorldState& world) {
  for (const ContactRow<Real>& row : world.rows) {
    if (row.bounced) continue;
    const Pair& pair = world.pairs[row.pair];
    if (pair.was_touching || row.approach_speed <= tolerance::kBounceCutResting * row.cut_unit)
      continue;
    HitEvent hit;
    // The manifold lies midway in the gap; they met on the side that did not move to the other.
    const bool b_yields = world.bodies.info[pair.body_b].type == MotionType::Dynamic;
    const Real side = pair.relative_to_b ? Real(-0.5) : (b_yields ? Real(0) : Real(0.5));
    Vec place{0, 0, 0};
    Real impulse = 0;
    for (int i = 0; i < row.count; ++i) {
      const ManifoldPoint& point = pair.manifold.points[i];
      const Real gap = point.separation - pair.advanced_gap;
      impulse += row.points[i].impulse_sum;
      place += row.points[i].impulse_sum * (point.position + (side * gap) * row.n);
    }
    if (!(impulse > Real(0))) continue;
    place = (Real(1) / impulse) * place;
    if (pair.relative_to_b) place += pair.advance;  // B has gone so far until it met A
    const std::uint32_t reference =
        world.bodies.info[pair.relative_to_b ? pair.body_b : pair.body_a].dense;
    hit.a = world.colliders.id(pair.collider_a());
    hit.b = world.colliders.id(pair.collider_b());
    hit.body_a = {pair.body_a, world.bodies.info[pair.body_a].generation};
    hit.body_b = {pair.body_b, world.bodies.info[pair.body_b].generation};
    hit.point = to_public_position(world.bodies.pose[reference].x + cast<PosReal>(place));
    hit.normal = to_public(row.n);
    hit.approach_speed = row.approach_speed;
    hit.impulse = impulse;
    world.gathering.hits.push_back(hit);
  }
}

}  // namespace

void finalize_bodies(WorldState& world) {
  BodyStore& bodies = world.bodies;
  note_hits(world);
  std::vector<std::uint8_t> unsound(bodies.awake_end, 0);
  parallel_for(world, bodies.awake_end - bodies.awake_begin, tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = bodies.awake_begin + begin; i < bodies.awake_begin + end;
                      ++i)
                   unsound[i] = move_body(world, i) ? 0 : 1;
               });
  std::vector<std::uint32_t> to_quarantine;
  std::vector<std::uint32_t>& moved = world.moved;
  moved.clear();
  for (std::uint32_t i = bodies.awake_begin; i < bodies.awake_end; ++i)
    (unsound[i] != 0 ? to_quarantine : moved).push_back(bodies.slot_of[i]);
  std::sort(to_quarantine.begin(), to_quarantine.end());
  std::sort(moved.begin(), moved.end());
  for (const std::uint32_t body : to_quarantine) quarantine(world, body);
  for (const std::uint32_t body : moved) {
    for (const std::uint32_t collider : bodies.info[body].colliders)
      update_proxy(world, collider, false);
    // A kinematic body that has been told to stand still costs nothing.
    const std::uint32_t dense = bodies.info[body].dense;
    if (bodies.info[body].type == MotionType::Kinematic &&
        length_squared(bodies.velocity[dense].v) == Real(0) &&
        length_squared(bodies.velocity[dense].w) == Real(0))
      bodies.rest(body);
  }
  note_contact_events(world);
  world.time += static_cast<double>(world.report.dt);
  world.report.time = world.time;
  world.report.awake_bodies = static_cast<std::uint32_t>(moved.size());
}

}  // namespace plumb::inline PLUMB_ABI::detail
