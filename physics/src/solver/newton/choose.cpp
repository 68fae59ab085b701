#include "solver/newton/choose.h"

#include <algorithm>

#include "math/eigen_bridge.h"
#include "solver/newton/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

// Of one contact.
Call call_of(const WorldState& world, const Contact& contact, Vec down, Real g) {
  const Pair& pair = world.pairs[contact.pair];
  const std::uint32_t a = world.bodies.info[pair.body_a].dense;
  const std::uint32_t b = world.bodies.info[pair.body_b].dense;
  const Real m_a = world.bodies.mass[a].mass, m_b = world.bodies.mass[b].mass;
  Real pressed = 0, gap = 0;
  for (int i = 0; i < contact.manifold.count; ++i) {
    pressed += contact.normal_impulse[i];
    gap = std::min(gap, contact.manifold.points[i].separation);
  }
  const bool loaded = pressed > Real(0);
  if (m_a > Real(0) && m_b > Real(0)) {
    const bool b_above = dot(contact.manifold.normal, down) < Real(0);
    const Real above = b_above ? m_b : m_a, below = b_above ? m_a : m_b;
    if (above > tolerance::kLightest * below && (loaded || world.last_h == Real(0)))
      return Call::Mass;
  }
  // What has only just met strikes; whether it carries will be seen.
  const auto touching = static_cast<std::uint32_t>(world.step_count) - pair.began;
  if (touching < tolerance::kStepsToBeLoad) return Call::None;
  const Real lightest = m_a > Real(0) && m_b > Real(0) ? std::min(m_a, m_b) : std::max(m_a, m_b);
  if (pressed > tolerance::kMostLoad * lightest * g * world.last_h) return Call::Load;
  if (loaded && gap < -tolerance::kMostOverlap * pair.slop) return Call::Overlap;
  return Call::None;
}

// Looks at every contact; on_call(slot) is told the bodies concerned.
template <class OnCall>
Calls look_for_calls(const WorldState& world, OnCall&& on_call) {
  Calls calls;
  const Vec gravity = to_inner(world.settings.gravity);
  const Real g = length(gravity);
  if (!(g > Real(0))) return calls;  // what is thrown has no weight to be carried
  for (const Contact& contact : world.contacts) {
    const Call call = call_of(world, contact, gravity, g);
    if (call == Call::None) continue;
    ++(call == Call::Mass ? calls.mass : call == Call::Load ? calls.load : calls.overlap);
    const Pair& pair = world.pairs[contact.pair];
    on_call(pair.body_a);
    on_call(pair.body_b);
  }
  return calls;
}

}  // namespace

Calls look_for_calls(const WorldState& world) {
  return look_for_calls(world, [](std::uint32_t) {});
}

bool choose_bodies(WorldState& world) {
  BodyStore& bodies = world.bodies;
  bool any = false;
  for (std::uint32_t i = bodies.awake_begin; i < bodies.awake_end; ++i) {
    std::uint8_t& left = bodies.info[bodies.slot_of[i]].newton_steps;
    if (left == 0) continue;
    --left;
    any = any || left > 0;
  }
  const Calls calls = look_for_calls(
      world, [&](std::uint32_t slot) { bodies.info[slot].newton_steps = tolerance::kStepsToStay; });
  return any || calls.any();
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
