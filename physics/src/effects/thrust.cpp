// Thrust, and explosions: forces that do not ask how the body moves.
#include <algorithm>
#include <cmath>

#include "effects/body_surface.h"
#include "effects/effect_stage.h"
#include "effects/explosion.h"
#include "math/eigen_bridge.h"
#include "world/body_sweep.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

void act_thrust(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<Thrust>(*world.effects, [&](const Thrust& thrust, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    NumVec force = cast<Num>(to_inner(thrust.force));
    if (!thrust.in_world_axes) force = rotate(body_axes(world, body), force);
    add_soft(body, link, {force, cross(arm_of(world, body, thrust.point), force)});
  });
}

namespace {

NumVec away_from(const Explosion& blast, NumVec x) {
  return x - NumVec{static_cast<Num>(blast.center.x()), static_cast<Num>(blast.center.y()),
                    static_cast<Num>(blast.center.z())};
}

// x^n for x > 0 and 0 <= n <= 6 from multiplications and square roots alone, exact to 1e-12 in n:
// the same bits on every system, which the C library's does not promise.
double power(double x, double n) {
  double out = 1;
  for (; n >= 1; n -= 1) out *= x;
  double root = x;
  for (int bit = 0; bit < 40 && n > 0; ++bit) {
    root = std::sqrt(root);
    n *= 2;
    if (n >= 1) {
      out *= root;
      n -= 1;
    }
  }
  return out;
}

}  // namespace

double share_of_front(const Explosion& blast, double r, double from, double to) {
  const double speed = static_cast<double>(blast.speed);
  const double arrives = r / speed, passes = static_cast<double>(blast.thickness) / speed;
  const double inside = std::min(to, arrives + passes) - std::max(from, arrives);
  return inside > 0 ? inside / passes : 0;
}

double impulse_at(const Explosion& blast, double r) {
  if (r > static_cast<double>(blast.range)) return 0;
  const double reference = static_cast<double>(blast.reference);
  return static_cast<double>(blast.impulse) *
         power(reference / std::max(r, reference), static_cast<double>(blast.falloff));
}

double updraft_at(const Explosion& blast, NumVec from_center, NumVec up) {
  const double height = dot(from_center, up);
  const double d = length(from_center - height * up) / static_cast<double>(blast.chimney_radius);
  const double z = height / static_cast<double>(blast.chimney_height);
  if (d >= 1 || z < 0 || z >= 1) return 0;
  return static_cast<double>(blast.updraft) * (1 - d) * (1 - z);
}

NumVec up_of(const WorldState& world) {
  const NumVec g = cast<Num>(to_inner(world.settings.gravity));
  return normalized_or(-g, NumVec{0, 1, 0});
}

// The front's share of each substep is in closed form: what a body gets does not depend on how the
// steps fall.
void act_explosions(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  const NumVec up = up_of(world);
  for_links<Explosion>(*world.effects, [&](const Explosion& blast, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const double age = world.effects->info[link.effect].memory.age;
    const NumVec r = away_from(blast, body.x);
    const double distance = length(r);
    NumVec force{0, 0, 0};
    const double share = share_of_front(blast, distance, age, age + scratch.h);
    if (share > 0) {
      const NumVec away = normalized_or(r, up);
      const double area = blast.area > Real(0)
                              ? static_cast<double>(blast.area)
                              : shown_area(surface_of(world, body.slot), body.q, away);
      force += (share * impulse_at(blast, distance) * area / scratch.h) * away;
    }
    const double blowing =
        std::min(age + scratch.h, static_cast<double>(blast.updraft_duration)) - age;
    if (blowing > 0) force += (blowing / scratch.h * body.mass * updraft_at(blast, r, up)) * up;
    add_soft(body, link, {force, {0, 0, 0}});
  });
}

}  // namespace plumb::inline PLUMB_ABI::detail
