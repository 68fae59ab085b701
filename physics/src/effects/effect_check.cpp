// What an effect may be. Everything must be finite, and no coefficient larger than what the
// arithmetic carries.
#include <cmath>

#include "effects/effect_numbers.h"
#include "effects/effect_world.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Whether every number of an effect is finite.
class FiniteCheck {
 public:
  void operator()(Real& v) { note(std::isfinite(v)); }
  void operator()(bool&) {}
  void operator()(std::uint32_t&) {}
  void operator()(BodyId&) {}
  void operator()(Vec3& v) { note(v.allFinite()); }
  void position(Pos3& p) { note(p.allFinite()); }
  void unit(Quat& q) { note(q.coeffs().allFinite()); }
  template <class Enum>
  void choice(Enum& v, std::uint32_t count) {
    choices_good = choices_good && static_cast<std::uint32_t>(v) < count;
  }
  void mesh(std::optional<SurfaceMesh>&) {}
  bool all_finite = true, choices_good = true;

 private:
  void note(bool good) { all_finite = all_finite && good; }
};

Status bad(const char* message) { return {StatusCode::OutOfRange, message}; }
bool in_range(Real v) {  // 0 .. the largest coefficient
  return v >= Real(0) && static_cast<double>(v) <= kLargestCoefficient;
}
bool moderate(Real v) { return std::abs(static_cast<double>(v)) <= kLargestCoefficient; }

struct Check {
  const WorldState& world;

  Status operator()(const PointGravity& e) const {
    if (!(std::abs(static_cast<double>(e.mu)) <= 1e30))
      return bad("mu of a point gravity must lie within +-1e30 [m^3/s^2]");
    if (e.softening < Real(0)) return bad("softening must not be negative [m]");
    return {};
  }
  Status operator()(const ForceField& e) const {
    if (world.effects == nullptr || world.effects->hook(e.field) == nullptr)
      return bad("no function is registered for this force field: call set_force_field() first");
    return {};
  }
  Status operator()(const Thrust& e) const {
    if (!(e.force.cwiseAbs().maxCoeff() <= Real(kLargestCoefficient)))
      return bad("thrust must lie within +-1e12 [N]");
    return {};
  }
  Status operator()(const Explosion& e) const {
    if (!in_range(e.impulse)) return bad("impulse of an explosion must lie in 0..1e12 [N s/m^2]");
    if (!(e.reference > Real(0)) || !(e.thickness > Real(0)) || !(e.range > Real(0)) ||
        !(e.chimney_radius > Real(0)) || !(e.chimney_height > Real(0)))
      return bad("reference, thickness, range and chimney of an explosion must be > 0 [m]");
    if (!(e.speed > Real(0))) return bad("the front of an explosion needs a speed > 0 [m/s]");
    if (!(e.falloff >= Real(0) && e.falloff <= Real(6)))
      return bad("falloff of an explosion must lie in 0..6");
    if (!in_range(e.area) || !in_range(e.updraft) || e.updraft_duration < Real(0))
      return bad("area [m^2], updraft [m/s^2] and its duration [s] must not be negative");
    return {};
  }
  Status operator()(const Drag& e) const {
    if (!in_range(e.linear) || !in_range(e.quadratic) || !in_range(e.angular_linear) ||
        !in_range(e.angular_quadratic))
      return bad("drag coefficients must lie in 0..1e12");
    return {};
  }
  Status operator()(const Magnus& e) const {
    if (!moderate(e.coefficient)) return bad("the Magnus coefficient must lie within +-1e12 [kg]");
    return {};
  }
  Status operator()(const Attractor& e) const {
    if (!moderate(e.strength)) return bad("strength of an attractor must lie within +-1e12");
    if (e.range < Real(0)) return bad("range of an attractor must not be negative [m]");
    if (!(e.softening > Real(0))) return bad("softening of an attractor must be > 0 [m]");
    return {};
  }
  Status operator()(const Wind& e) const {
    if (!(e.density > Real(0)) || !in_range(e.density))
      return bad("density of the air must be > 0 [kg/m^3]");
    if (!in_range(e.pressure) || !in_range(e.friction))
      return bad("pressure and friction coefficients must lie in 0..1e12 [-]");
    return {};
  }
  Status operator()(const AeroSurface& e) const {
    for (const Mat3* m : {&e.tensor, &e.minimum, &e.maximum})
      if (!(m->cwiseAbs().maxCoeff() <= Real(kLargestCoefficient)))
        return bad("entries of an aerodynamic tensor must lie within +-1e12 [N s/m]");
    if (!(e.control >= Real(-1) && e.control <= Real(1))) return bad("control must lie in -1..1");
    return check_orientation(e.orientation);
  }
  Status operator()(const Buoyancy& e) const {
    if (!(e.density > Real(0)) || !in_range(e.density))
      return bad("density of a fluid must be > 0 and <= 1e12 [kg/m^3]");
    if (!(e.normal.stableNorm() > Real(1e-6)) || !moderate(e.normal.stableNorm()))
      return bad("normal of a fluid's surface must have a length in 1e-6..1e12");
    if (!in_range(e.linear_drag) || !in_range(e.quadratic_drag) || !in_range(e.angular_drag))
      return bad("drag of a fluid must lie in 0..1e12");
    if (!e.hull.has_value()) return {};
    if (e.hull->geometry == nullptr || !check_shape(*e.hull).ok())
      return {StatusCode::BadShape, "the mesh that displaces the fluid is no valid mesh"};
    if (e.hull->geometry->open_edges() > 0 || e.hull->geometry->odd_edges() > 0)
      return {StatusCode::BadShape,
              "the mesh that displaces the fluid must be closed: weld it, or fill its holes"};
    return {};
  }
  Status operator()(const Spring& e) const {
    if (!(e.rest_length > Real(0)) || !in_range(e.rest_length))
      return bad("rest length of a spring must be > 0 [m]; an Attractor pulls to a point");
    if (!(e.stiffness > Real(0)) || !in_range(e.stiffness))
      return bad("stiffness of a spring must be > 0 and <= 1e12 [N/m]");
    if (!in_range(e.damping)) return bad("damping of a spring must lie in 0..1e12 [N s/m]");
    return {};
  }
};

bool is_alive(const WorldState& world, BodyId body) {
  return body.index < world.bodies.info.size() && world.bodies.info[body.index].alive &&
         world.bodies.info[body.index].generation == body.generation;
}

Status check_bodies(const WorldState& world, const Effect& effect) {
  const auto* spring = std::get_if<Spring>(&effect.kind);
  if (effect.body.is_null()) {
    if (spring != nullptr || std::holds_alternative<Thrust>(effect.kind) ||
        std::holds_alternative<AeroSurface>(effect.kind))
      return {StatusCode::StaleHandle, "springs, thrusts and aero surfaces need a body"};
    if (const auto* fluid = std::get_if<Buoyancy>(&effect.kind); fluid && fluid->hull)
      return {StatusCode::StaleHandle, "a mesh that displaces belongs to one body: name it"};
    return {};
  }
  if (!is_alive(world, effect.body)) return stale_body();
  if (spring != nullptr && !spring->other.is_null()) {
    if (!is_alive(world, spring->other)) return stale_body();
    if (spring->other == effect.body) return bad("a spring ties two bodies, not one to itself");
  }
  return {};
}

}  // namespace

Status check_effect(const WorldState& world, const Effect& effect) {
  if (const Status status = check_bodies(world, effect); !status) return status;
  Effect copy = effect;  // visitors serve reading too
  FiniteCheck finite;
  std::visit(EffectVisitor<FiniteCheck>{finite}, copy.kind);
  if (!finite.all_finite)
    return {StatusCode::NotFinite, "a number of the effect is NaN or infinite"};
  if (!finite.choices_good) return bad("a choice of the effect is none of its enum");
  return std::visit(Check{world}, effect.kind);
}

}  // namespace plumb::inline PLUMB_ABI::detail
