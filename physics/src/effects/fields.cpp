// Fields: what depends on where a body is.
#include <cmath>

#include "effects/effect_stage.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

NumVec place(const Pos3& p) {
  return {static_cast<Num>(p.x()), static_cast<Num>(p.y()), static_cast<Num>(p.z())};
}

Eigen::Vector3d wide(NumVec v) { return {v.x, v.y, v.z}; }

// F = g d, d from the body to the centre, and dg/d(d^2).
struct Pull {
  double g = 0, slope = 0, potential = 0;
};
Pull pull_of(const Attractor& a, double d2) {
  const double s = static_cast<double>(a.strength), e = static_cast<double>(a.softening);
  const double r = std::sqrt(d2 + e * e);
  switch (a.law) {
    case Attractor::Law::Constant:
      return {s / r, -0.5 * s / (r * r * r), s * r};
    case Attractor::Law::Linear:
      return {s, 0, 0.5 * s * d2};
    case Attractor::Law::InverseSquare:
      return {s / (r * r * r), -1.5 * s / (r * r * r * r * r), -s / r};
  }
  return {};
}

FieldForce ask(const WorldState& world, const EffectInfo& effect, std::uint32_t slot, NumVec x,
               NumVec v, NumVec w, double mass, double time) {
  const auto& field = std::get<ForceField>(effect.component.kind);
  const FieldHook* hook = world.effects->hook(field.field);
  if (hook == nullptr) return {};
  FieldSample at;
  at.body = {slot, world.bodies.info[slot].generation};
  at.time = time;
  at.mass = mass;
  at.position = wide(x);
  at.velocity = wide(v);
  at.angular_velocity = wide(w);
  at.parameters = field.parameters;
  const FieldForce answer = hook->function(at, hook->context);
  const bool sound =
      answer.force.allFinite() && answer.torque.allFinite() && std::isfinite(answer.potential);
  return sound ? answer : FieldForce{};
}

}  // namespace

void act_point_gravity(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<PointGravity>(*world.effects, [&](const PointGravity& field, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const NumVec r = body.x - place(field.center);
    const double s = static_cast<double>(field.softening);
    const double d2 = length_squared(r) + s * s;
    if (!(d2 > 0)) return;  // at the centre it pulls nowhere
    const double strength = -body.mass * static_cast<double>(field.mu) / (d2 * std::sqrt(d2));
    add_soft(body, link, {strength * r, {0, 0, 0}});
  });
}

void act_force_fields(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<ForceField>(*world.effects, [&](const ForceField& field, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    if (field.keeps_awake) world.substep[body.dense].driven = true;
    const FieldForce f = ask(world, world.effects->info[link.effect], body.slot, body.x, body.v,
                             body.w, body.mass, scratch.time);
    add_soft(body, link,
             {{f.force.x(), f.force.y(), f.force.z()}, {f.torque.x(), f.torque.y(), f.torque.z()}});
  });
}

// F = g d; K = -dF/dx has g across d and g + 2 slope d^2 along it. What would drive the body away
// needs no damping and is left out.
void act_attractors(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<Attractor>(*world.effects, [&](const Attractor& a, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const NumVec d = place(a.center) - stiff_view(scratch, body).x;
    const double d2 = length_squared(d), range = static_cast<double>(a.range);
    if (range > 0 && d2 > range * range) return;
    const Pull pull = pull_of(a, d2);
    StiffShare& share = stiff_share(scratch, link);
    share.f0.force = pull.g * d;
    const double across = std::max(0.0, pull.g);
    const double along = std::max(0.0, pull.g + 2 * pull.slope * d2);
    for (int i = 0; i < 3; ++i) share.K.m[i][i] = across;
    if (d2 > 0) share.K.add_outer((along - across) / d2, {d, {0, 0, 0}}, {d, {0, 0, 0}});
    add_stiff(scratch, link);
  });
}

double potential_of_field(const WorldState& world, const EffectInfo& effect, std::uint32_t slot) {
  const BodyInfo& info = world.bodies.info[slot];
  const BodyVelocity& u = world.bodies.velocity[info.dense];
  const double mass = static_cast<double>(world.bodies.mass[info.dense].mass);
  const NumVec x = cast<Num>(world.bodies.pose[info.dense].x);
  if (const auto* field = std::get_if<PointGravity>(&effect.component.kind)) {
    const double s = static_cast<double>(field->softening);
    const double r = std::sqrt(length_squared(x - place(field->center)) + s * s);
    return r > 0 ? -mass * static_cast<double>(field->mu) / r : 0;
  }
  if (const auto* attractor = std::get_if<Attractor>(&effect.component.kind)) {
    const double d2 = length_squared(place(attractor->center) - x);
    const double range = static_cast<double>(attractor->range);
    return pull_of(*attractor, range > 0 && d2 > range * range ? range * range : d2).potential;
  }
  return ask(world, effect, slot, x, cast<Num>(u.v), cast<Num>(u.w), mass, world.time).potential;
}

}  // namespace plumb::inline PLUMB_ABI::detail
