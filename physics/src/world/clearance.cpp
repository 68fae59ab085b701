#include "world/clearance.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "world/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Real kFar = std::numeric_limits<Real>::infinity();
// Paths are told longer by this much [-], a hundred times what their sums may round ...
constexpr Real kLonger = Real(1.001);
// ... and by so many roundings of the lengths that poses and shapes are placed with [-].
constexpr Real kRoundings = Real(16);
constexpr Real kMostRoom = Real(8);  // [-] of the body's radius

}  // namespace

void note_travel(WorldState& world, std::uint32_t dense, const BodyPose& before, Rotation turn) {
  BodyStore& bodies = world.bodies;
  const std::uint32_t slot = bodies.slot_of[dense];
  const BodyExtent& extent = bodies.extent[slot];
  const BodyVelocity& velocity = bodies.velocity[dense];
  const Vec path = cast<Real>(bodies.pose[dense].x - before.x);
  // A turn by an angle moves a point by 2 sin(angle / 2) of its distance from the axis.
  const Real turned = Real(2) * length(Vec{turn.x, turn.y, turn.z}) * extent.turning_radius;
  constexpr Real kRounding = kRoundings * std::numeric_limits<Real>::epsilon();
  BodyTravel& travel = bodies.travel[slot];
  const Real rounding = kRounding * extent.radius;
  const Real came = length(path), comes = world.dt * length(velocity.v);
  travel.moved = kLonger * (came + turned) + rounding;
  travel.coming = kLonger * (comes + world.dt * length(velocity.w) * extent.radius);
  travel.room -= travel.room_to_turn ? kLonger * came + rounding : travel.moved;
  travel.needed = travel.room_to_turn ? kLonger * comes : travel.coming;
}

void forget_travel(WorldState& world, std::uint32_t body) {
  BodyTravel& travel = world.bodies.travel[body];
  travel.moved = travel.coming = kFar;
  travel.room = 0;
  world.bodies.standing.push_back(body);
}

void end_travels(WorldState& world) {
  BodyStore& bodies = world.bodies;
  for (const std::uint32_t body : bodies.standing)
    if (!bodies.info[body].alive || !bodies.is_awake(body)) bodies.travel[body] = {};
  bodies.standing.clear();
}

bool stays_clear(const WorldState& world, Pair& pair) {
  const BodyTravel& a = world.bodies.travel[pair.body_a];
  const BodyTravel& b = world.bodies.travel[pair.body_b];
  pair.memory.gap -= a.moved + b.moved;
  const Real near = tolerance::kMarginSlops * pair.slop + world.falls_in_a_step;
  return pair.memory.gap > kLonger * near + a.coming + b.coming;
}

bool stays_in_boxes(WorldState& world, std::uint32_t body) {
  if (world.has_effects) return false;
  BodyTravel& travel = world.bodies.travel[body];
  // What pairs ask for again and again is better renewed once.
  const bool asked = std::exchange(travel.asked, false);
  if (asked || !(travel.room > travel.needed)) return false;
  travel.old_reach = true;
  return true;
}

void note_room(WorldState& world, std::uint32_t body, PosReal room, bool to_turn) {
  BodyTravel& travel = world.bodies.travel[body];
  // Subtractions from more would lose what is told longer.
  travel.room =
      std::min(static_cast<Real>(room) / kLonger, kMostRoom * world.bodies.extent[body].radius);
  travel.room_to_turn = to_turn;
  travel.old_reach = false;
}

PosReal room_in(const WorldAabb& outer, const WorldAabb& inner) {
  const PosVec d = min_each(inner.lower - outer.lower, outer.upper - inner.upper);
  const PosVec size = max_each(absolute(outer.lower), absolute(outer.upper));
  constexpr PosReal kRounding = kRoundings * std::numeric_limits<PosReal>::epsilon();
  return std::min({d.x, d.y, d.z}) - kRounding * std::max({size.x, size.y, size.z});
}

Real gap_of(const WorldAabb& a, const WorldAabb& b) {
  const PosVec d = max_each(b.lower - a.upper, a.lower - b.upper);
  return static_cast<Real>(std::max({d.x, d.y, d.z}));
}

}  // namespace plumb::inline PLUMB_ABI::detail
