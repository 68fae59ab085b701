#include "world/far_movers.h"

#include <algorithm>
#include <cmath>

#include "world/forced.h"
#include "world/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// [m] Where every body is to be followed: what is this still has gone nowhere.
constexpr Real kNoWay = std::numeric_limits<Real>::min();

bool moved_far(const WorldState& world, std::uint32_t dense) {
  const std::uint32_t slot = world.bodies.slot_of[dense];
  const BodyExtent& extent = world.bodies.extent[slot];
  const Real path = length_squared(world.delta[dense].dp);
  const Real spin = world.dt * world.dt * length_squared(world.bodies.velocity[dense].w);
  const Real limit = threshold(world.settings, PlanItem::Continuous,
                               tolerance::kContinuousFraction * extent.size, kNoWay);
  // (a + b)^2 <= 2 (a^2 + b^2): nothing far is missed.
  if (!(Real(2) * (path + spin * extent.radius * extent.radius) > limit * limit)) return false;
  return limit > Real(0) && std::sqrt(path) + std::sqrt(spin) * extent.turning_radius > limit &&
         !world.bodies.info[slot].disabled;
}

}  // namespace

Real path_ahead(const WorldState& world, std::uint32_t body, Real time) {
  const BodyVelocity& u = world.bodies.velocity[world.bodies.dense_of[body]];
  const Real spin = length(u.w);
  return time * (length(u.v) +
                 (spin > Real(0) ? spin * world.bodies.extent[body].turning_radius : Real(0)));
}

StepList<std::uint32_t> bodies_that_moved_far(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  const std::uint32_t count = bodies.awake_end - bodies.awake_begin;
  const std::uint32_t chunks = (count + tolerance::kBodyGrain - 1) / tolerance::kBodyGrain;
  std::vector<std::vector<std::uint32_t>>& found = world.fast_by_chunk;
  if (found.size() < chunks) found.resize(chunks);
  parallel_for(world, count, tolerance::kBodyGrain, [&](std::uint32_t begin, std::uint32_t end) {
    std::vector<std::uint32_t>& list = found[begin / tolerance::kBodyGrain];
    list.clear();
    for (std::uint32_t i = bodies.awake_begin + begin; i < bodies.awake_begin + end; ++i)
      if (moved_far(world, i)) list.push_back(bodies.slot_of[i]);
  });
  StepList<std::uint32_t> all(&world.memory);
  for (std::uint32_t c = 0; c < chunks; ++c)
    all.insert(all.end(), found[c].begin(), found[c].end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace plumb::inline PLUMB_ABI::detail
