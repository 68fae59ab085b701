// Moving air: on the panels of real surfaces, and on surfaces told as tensors.
#include <cmath>
#include <numbers>

#include "effects/body_surface.h"
#include "effects/effect_stage.h"
#include "math/eigen_bridge.h"
#include "world/body_sweep.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct Air {
  double pressure, friction;  // 1/2 density times the coefficient [kg/m^3]
  NumVec velocity;            // [m/s]
};

// F = -area (p |u| (u . n) n [u . n > 0] + f |u| (u - (u . n) n)) at one panel, with -dF/du.
void add_panel(StiffShare& share, const Air& air, NumVec arm, NumVec n, double area, NumVec u) {
  const double speed = length(u), into = dot(u, n);
  if (!(speed > 0)) return;
  NumVec force{0, 0, 0};
  if (into > 0) {
    const double p = area * air.pressure;
    force -= (p * speed * into) * n;
    const NumVec slope = (into / speed) * u + speed * n;  // of |u| (u . n)
    share.D.add_outer(p, {n, cross(arm, n)}, {slope, cross(arm, slope)});
  }
  const double f = area * air.friction;
  if (f > 0) {
    const NumVec along = u - into * n;
    force -= (f * speed) * along;
    const auto row = [&](int i, NumVec e) {
      return (f * speed) * (e - component(n, i) * n) + (f * component(along, i) / speed) * u;
    };
    share.D.add_at(arm, {row(0, {1, 0, 0}), row(1, {0, 1, 0}), row(2, {0, 0, 1})});
  }
  share.f0 = share.f0 + Wrench{force, cross(arm, force)};
}

// The same law, summed over a sphere: pressure gives -p pi r^2/2 |u| u, friction -f (8/3) pi r^2.
void add_ball(StiffShare& share, const Air& air, const SurfaceBall& ball, NumVec arm, NumVec u) {
  const double speed = length(u);
  if (!(speed > 0)) return;
  const double c =
      std::numbers::pi * ball.radius * ball.radius * (0.5 * air.pressure + 8.0 / 3 * air.friction);
  const NumVec force = (-c * speed) * u;
  const auto row = [&](int i, NumVec e) {
    return (c * speed) * e + (c * component(u, i) / speed) * u;
  };
  share.D.add_at(arm, {row(0, {1, 0, 0}), row(1, {0, 1, 0}), row(2, {0, 0, 1})});
  share.f0 = share.f0 + Wrench{force, cross(arm, force)};
}

Matrix3<double> rows_of(const Eigen::Matrix3d& m) {
  return {{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
}

}  // namespace

void act_wind(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<Wind>(*world.effects, [&](const Wind& wind, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const BodySurface& surface = surface_of(world, body.slot);
    const StiffView at = stiff_view(scratch, body);
    const double half = 0.5 * static_cast<double>(wind.density);
    const Air air{half * static_cast<double>(wind.pressure),
                  half * static_cast<double>(wind.friction), cast<Num>(to_inner(wind.velocity))};
    StiffShare& share = stiff_share(scratch, link);
    const Matrix3<double> R = to_matrix(body.q);
    const NumVec through = at.v - air.velocity;
    for (const SurfacePanel& panel : surface.panels) {
      const NumVec arm = R * panel.center;
      add_panel(share, air, arm, R * panel.normal, panel.area, through + cross(at.w, arm));
    }
    for (const SurfaceBall& ball : surface.balls) {
      const NumVec arm = R * ball.center;
      add_ball(share, air, ball, arm, through + cross(at.w, arm));
    }
    add_stiff(scratch, link);
  });
}

void act_aero_surfaces(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<AeroSurface>(*world.effects, [&](const AeroSurface& wing, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const StiffView at = stiff_view(scratch, body);
    Eigen::Matrix3d T = wing.tensor.cast<double>();
    if (wing.is_controlled) {
      const double c = static_cast<double>(wing.control);
      T += std::abs(c) * ((c < 0 ? wing.minimum : wing.maximum).cast<double>() - T);
    }
    const NumRotation R_WS = body_axes(world, body) * to_num(to_inner(wing.orientation));
    const Matrix3<double> tensor = rows_of(T);
    const NumVec arm = arm_of(world, body, wing.point);
    const NumVec u = at.v + cross(at.w, arm) - cast<Num>(to_inner(wing.wind));
    const auto answer = [&](NumVec flow) {
      return rotate(R_WS, tensor * inverse_rotate(R_WS, flow));
    };
    StiffShare& share = stiff_share(scratch, link);
    const NumVec force = answer(u);
    share.f0 = {force, cross(arm, force)};
    const NumVec x = -answer({1, 0, 0}), y = -answer({0, 1, 0}), z = -answer({0, 0, 1});
    share.D.add_at(arm, {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}});
    add_stiff(scratch, link);
  });
}

}  // namespace plumb::inline PLUMB_ABI::detail
