#include "world/clearance.h"

#include <algorithm>
#include <limits>

#include "world/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Real kFar = std::numeric_limits<Real>::infinity();
// Paths are told longer by this much [-], a hundred times what their sums may round ...
constexpr Real kLonger = Real(1.001);
// ... and by so many roundings of the lengths that poses and shapes are placed with [-].
constexpr Real kRoundings = Real(16);

}  // namespace

void note_travel(WorldState& world, std::uint32_t dense, const BodyPose& before, Rotation turn) {
  BodyStore& bodies = world.bodies;
  const std::uint32_t slot = bodies.slot_of[dense];
  const BodyInfo& info = bodies.info[slot];
  const BodyVelocity& velocity = bodies.velocity[dense];
  const Vec path = cast<Real>(bodies.pose[dense].x - before.x);
  // A turn by an angle moves a point by 2 sin(angle / 2) of its distance from the axis.
  const Real turned = Real(2) * length(Vec{turn.x, turn.y, turn.z}) * info.turning_radius;
  constexpr Real kRounding = kRoundings * std::numeric_limits<Real>::epsilon();
  bodies.travel[slot] = {
      kLonger * (length(path) + turned) + kRounding * info.radius,
      kLonger * world.dt * (length(velocity.v) + length(velocity.w) * info.radius)};
}

void forget_travel(WorldState& world, std::uint32_t body) {
  world.bodies.travel[body] = {kFar, kFar};
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

Real gap_of(const WorldAabb& a, const WorldAabb& b) {
  const PosVec d = max_each(b.lower - a.upper, a.lower - b.upper);
  return static_cast<Real>(std::max({d.x, d.y, d.z}));
}

}  // namespace plumb::inline PLUMB_ABI::detail
