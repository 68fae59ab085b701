// Which bodies an effect may act on, and the potential that it has there.
#include <cmath>

#include "effects/body_surface.h"
#include "effects/effect_stage.h"
#include "effects/effect_world.h"
#include "effects/explosion.h"
#include "math/eigen_bridge.h"

namespace plumb::inline PLUMB_ABI::detail {

double potential_of_field(const WorldState& world, const EffectInfo& effect, std::uint32_t slot);
double potential_of_buoyancy(const WorldState& world, const EffectInfo& effect, std::uint32_t slot);
double potential_of_spring(const WorldState& world, const EffectInfo& effect);

namespace {

// Where a body may be during the next step: around its centre, with all that belongs to it.
struct Place {
  NumVec x;
  double around;  // [m]
  double size;    // [m] of the body itself
};
Place place_of(const WorldState& world, std::uint32_t body, bool ever) {
  const BodyInfo& info = world.bodies.info[body];
  const BodyVelocity& u = world.bodies.velocity[info.dense];
  const double dt = static_cast<double>(coming_step(world));
  const double g = static_cast<double>(world.settings.gravity.norm());
  const double a = static_cast<double>(length(world.bodies.acceleration[body])) + g;
  const double way = ever ? 0 : static_cast<double>(length(u.v)) * dt + a * dt * dt;
  const double radius = static_cast<double>(world.bodies.extent[body].radius);
  return {cast<Num>(world.bodies.pose[info.dense].x), 2 * way, radius};
}

struct Reach {
  const WorldState& world;
  const EffectInfo& effect;
  std::uint32_t body;
  bool ever;

  bool operator()(const PointGravity& field) const { return field.mu != Real(0); }
  bool operator()(const ForceField& field) const {
    return world.effects->hook(field.field) != nullptr;
  }
  bool operator()(const Thrust& thrust) const { return thrust.force.squaredNorm() > Real(0); }
  bool operator()(const Drag& d) const {
    return d.linear > Real(0) || d.quadratic > Real(0) || d.angular_linear > Real(0) ||
           d.angular_quadratic > Real(0);
  }
  bool operator()(const Magnus& m) const { return m.coefficient != Real(0); }
  bool operator()(const Attractor& a) const {
    if (a.strength == Real(0)) return false;
    if (!(a.range > Real(0))) return true;
    const Place at = place_of(world, body, ever);
    const NumVec d = at.x - cast<Num>(to_inner_position(a.center));
    return length(d) <= static_cast<double>(a.range) + at.around;
  }
  bool operator()(const Wind&) const { return !world.bodies.info[body].colliders.empty(); }
  bool operator()(const AeroSurface&) const { return true; }
  bool operator()(const Spring&) const { return true; }
  bool operator()(const Buoyancy& fluid) const {
    if (fluid.hull.has_value()) return true;
    const Place at = place_of(world, body, ever);
    const NumVec n = normalized_or(cast<Num>(to_inner(fluid.normal)), NumVec{0, 1, 0});
    const double size = static_cast<double>(fluid.normal.norm());
    return dot(n, at.x) - at.size - at.around <= static_cast<double>(fluid.level) && size > 0 &&
           !world.bodies.info[body].colliders.empty();
  }
  bool operator()(const Explosion& blast) const {
    const Place at = place_of(world, body, ever);
    const NumVec r = at.x - cast<Num>(to_inner_position(blast.center));
    const double age = effect.memory.age, speed = static_cast<double>(blast.speed);
    const double d = length(r), range = static_cast<double>(blast.range);
    const double until = ever ? (range + static_cast<double>(blast.thickness)) / speed
                              : age + static_cast<double>(coming_step(world));
    const double first = (d - at.around) / speed;
    const double last = (d + at.around + static_cast<double>(blast.thickness)) / speed;
    if (blast.impulse > Real(0) && d - at.around <= range && first <= until && last >= age)
      return true;
    if (!(blast.updraft > Real(0)) || age >= static_cast<double>(blast.updraft_duration))
      return false;
    const NumVec up = up_of(world);
    const double height = dot(r, up);
    return length(r - height * up) <= static_cast<double>(blast.chimney_radius) + at.around &&
           height >= -at.around && height <= static_cast<double>(blast.chimney_height) + at.around;
  }
};

}  // namespace

bool may_act(const WorldState& world, const EffectInfo& effect, std::uint32_t body, bool ever) {
  return std::visit(Reach{world, effect, body, ever}, effect.component.kind);
}

bool is_awaited(const WorldState& world, const EffectInfo& effect, std::uint32_t body) {
  return std::holds_alternative<Explosion>(effect.component.kind) &&
         may_act(world, effect, body, true);
}

double potential_of(const WorldState& world, const EffectInfo& effect, std::uint32_t body) {
  const EffectKind& kind = effect.component.kind;
  const BodyInfo& info = world.bodies.info[body];
  if (std::holds_alternative<Spring>(kind)) return potential_of_spring(world, effect);
  if (!(world.bodies.mass[info.dense].mass > Real(0))) return 0;
  if (std::holds_alternative<PointGravity>(kind) || std::holds_alternative<ForceField>(kind) ||
      std::holds_alternative<Attractor>(kind))
    return potential_of_field(world, effect, body);
  if (std::holds_alternative<Buoyancy>(kind)) return potential_of_buoyancy(world, effect, body);
  return 0;
}

}  // namespace plumb::inline PLUMB_ABI::detail
