// Finalize: poses, bounds, events, and the quarantine of bodies whose state is not finite.
#include <algorithm>
#include <limits>
#include <utility>

#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "world/clearance.h"
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
  const BodyDelta& delta = world.delta[i];
  BodyPose next = bodies.pose[i];
  next.x += cast<PosReal>(delta.dp);
  const bool dynamic = bodies.mass[i].mass > Real(0);
  const bool turned_here = world.substep[i].constrained || world.substep[i].affected ||
                           !dynamic;  // free bodies have turned already
  if (turned_here) next.q = normalized(delta.dq * next.q);
  if (turned_here && dynamic)
    bodies.velocity[i].w = angular_velocity_of(bodies.mass[i], next.q, bodies.momentum[i].L);
  const Vec a = world.substep[i].acceleration;
  Vec& last = bodies.acceleration[bodies.slot_of[i]];
  if (length_squared(last - a) != Real(0)) last = a;  // mostly gravity's
  bodies.force[i].force = bodies.force[i].torque = {0, 0, 0};
  if (!is_sound(bodies.velocity[i], next, bodies.momentum[i].L)) return false;
  const BodyPose before = bodies.pose[i];
  bodies.pose[i] = next;
  note_travel(world, i, before, turned_here ? next.q * conjugate(before.q) : delta.dq);
  return true;
}

// Takes an awake body out of the awake ones. Another one gets its place, with what the step still
// has to know of it.
void rest_in_step(WorldState& world, std::uint32_t body) {
  const std::uint32_t place = world.bodies.dense_of[body];
  world.bodies.rest(body);
  const std::uint32_t last = world.bodies.awake_end;
  std::swap(world.delta[place], world.delta[last]);
  std::swap(world.substep[place], world.substep[last]);
  for (const std::uint32_t collider : world.bodies.info[body].colliders)
    update_reach(world, collider);  // it goes nowhere now
  world.bodies.travel[body].old_reach = false;
}

void quarantine(WorldState& world, std::uint32_t body) {
  BodyInfo& info = world.bodies.info[body];
  const std::uint32_t dense = info.dense;
  world.bodies.velocity[dense] = {};
  world.bodies.momentum[dense] = {};
  world.bodies.mass[dense] = {};
  info.disabled = true;
  world.facts.forget();
  world.gathering.quarantined.push_back({{body, info.generation}});
  ++world.report.quarantined;
  rest_in_step(world, body);
}

// Boxes of the colliders of the bodies that moved. Who leaves its box is found by all threads; the
// tree is changed by one, in the order of the bodies.
void renew_boxes(WorldState& world, const std::vector<std::uint32_t>& moved) {
  const std::uint32_t count = static_cast<std::uint32_t>(moved.size());
  std::vector<std::uint8_t>& leaves = world.leaves_box;
  leaves.assign(count, 0);
  parallel_for(world, count, tolerance::kBodyGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i)
      leaves[i] = may_leave_boxes(world, moved[i]) ? 1 : 0;
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    if (leaves[i] == 0) continue;
    for (const std::uint32_t collider : world.bodies.info[moved[i]].colliders)
      update_proxy(world, collider, false);
  }
}

// A kinematic body that has been told to stand still costs nothing.
void rest_standing_kinematic_bodies(WorldState& world) {
  BodyStore& bodies = world.bodies;
  for (const std::uint32_t body : world.moved) {
    const BodyVelocity& velocity = bodies.velocity[bodies.dense_of[body]];
    if (bodies.info[body].type == MotionType::Kinematic && length_squared(velocity.v) == Real(0) &&
        length_squared(velocity.w) == Real(0))
      rest_in_step(world, body);
  }
}

}  // namespace

void finalize_bodies(WorldState& world) {
  BodyStore& bodies = world.bodies;
  note_hits(world);
  StepList<std::uint8_t> unsound(bodies.awake_end, 0, &world.memory);
  parallel_for(world, bodies.awake_end - bodies.awake_begin, tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = bodies.awake_begin + begin; i < bodies.awake_begin + end;
                      ++i)
                   unsound[i] = move_body(world, i) ? 0 : 1;
               });
  StepList<std::uint32_t> to_quarantine(&world.memory);
  std::vector<std::uint32_t>& moved = world.moved;
  moved.clear();
  for (std::uint32_t i = bodies.awake_begin; i < bodies.awake_end; ++i)
    if (unsound[i] != 0)
      to_quarantine.push_back(bodies.slot_of[i]);
    else
      moved.push_back(bodies.slot_of[i]);
  std::sort(to_quarantine.begin(), to_quarantine.end());
  if (!std::is_sorted(moved.begin(), moved.end())) std::sort(moved.begin(), moved.end());
  for (const std::uint32_t body : to_quarantine) quarantine(world, body);
  renew_boxes(world, moved);
  if (world.counts.kinematic > 0) rest_standing_kinematic_bodies(world);
  note_contact_events(world);
  if (!world.gathering.sensors.empty()) update_overlaps(world);
  world.time += static_cast<double>(world.report.dt);
  world.report.time = world.time;
  world.report.awake_bodies = static_cast<std::uint32_t>(moved.size());
}

}  // namespace plumb::inline PLUMB_ABI::detail
