// Buoyancy of real shapes, with the drag of the fluid.
//
// A body that moves by (dx, turn) changes what it displaces by -(n . dx + (r x n) . turn) dA at
// every point r of its waterline: K = density g sum j j^T dA, j = (n, r x n). Solved implicitly, a
// cork bobs at any step.
#include <cmath>

#include "effects/displacement.h"
#include "effects/effect_stage.h"
#include "math/eigen_bridge.h"
#include "world/body_sweep.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct Water {
  NumVec up;     // unit, world
  double level;  // [m] of the body's centre of mass below the surface
};
Water water_at(const Buoyancy& fluid, NumVec x) {
  const NumVec n = cast<Num>(to_inner(fluid.normal));
  const double size = length(n);
  return {(1 / size) * n, static_cast<double>(fluid.level) - dot(n, x) / size};
}

// Newton's steps from above, the same bits on every system.
double cube_root(double a) {
  if (!(a > 0)) return 0;
  int exponent = 0;
  std::frexp(a, &exponent);
  const int third = (exponent + (exponent >= 0 ? 2 : 0)) / 3;  // 2^third >= the root
  double x = std::ldexp(1.0, third);
  for (int i = 0; i < 12; ++i) x -= (x - a / (x * x)) / 3;
  return x;
}

// K = strength sum j j^T dA with everything turned into world axes.
void add_waterline(Matrix6& K, const Displacement& d, NumRotation q, NumVec up, double strength) {
  if (!(d.area > 0)) return;
  const NumVec r = rotate(q, d.line);
  const Matrix3<double> R = to_matrix(q);
  const NumVec cols[3] = {d.line_second * R.row0, d.line_second * R.row1, d.line_second * R.row2};
  const auto second = [&](int i, int j) {
    const NumVec row = j == 0 ? R.row0 : (j == 1 ? R.row1 : R.row2);
    return dot(row, cols[i]);
  };
  const NumVec arm = cross(r, up);  // integral r x n dA
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      K.m[i][j] += strength * d.area * component(up, i) * component(up, j);
      K.m[i][3 + j] += strength * component(up, i) * component(arm, j);
      K.m[3 + j][i] += strength * component(up, i) * component(arm, j);
    }
  }
  // (r x n)(r x n)^T = N S N^T with N v = v x n.
  const NumVec unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const NumVec a = cross(up, unit[i]), b = cross(up, unit[j]);  // rows of N
      double sum = 0;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum += component(a, k) * second(k, l) * component(b, l);
      K.m[3 + i][3 + j] += strength * sum;
    }
  }
}

}  // namespace

void act_buoyancy(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<Buoyancy>(*world.effects, [&](const Buoyancy& fluid, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const StiffView at = stiff_view(scratch, body);
    const Water water = water_at(fluid, at.x);
    const BodySurface& surface = fluid.hull.has_value()
                                     ? hull_of(world, link.effect, *fluid.hull, body.slot)
                                     : surface_of(world, body.slot);
    const Displacement d = displaced_below(surface, inverse_rotate(body.q, water.up), water.level);
    if (!(d.volume > 0)) return;
    const double density = static_cast<double>(fluid.density), M = density * d.volume;
    const NumVec lift = -M * scratch.gravity;
    const NumVec arm = rotate(body.q, (1 / d.volume) * d.first);
    StiffShare& share = stiff_share(scratch, link);
    share.f0 = {lift, cross(arm, lift)};
    add_waterline(share.K, d, body.q, water.up, density * length(scratch.gravity));

    const NumVec u = at.v + cross(at.w, arm) - cast<Num>(to_inner(fluid.current));
    const double speed = length(u), side = cube_root(d.volume);
    const double k = 0.5 * static_cast<double>(fluid.quadratic_drag) * density * side * side;
    const double c = static_cast<double>(fluid.linear_drag) * M + k * speed;
    const NumVec drag = -c * u;
    share.f0 = share.f0 + Wrench{drag, cross(arm, drag)};
    const auto row = [&](int i, NumVec e) {
      return c * e + (speed > 0 ? k * component(u, i) / speed : 0.0) * u;
    };
    share.D.add_at(arm, {row(0, {1, 0, 0}), row(1, {0, 1, 0}), row(2, {0, 0, 1})});
    const double turning = static_cast<double>(fluid.angular_drag) * M * side * side;
    share.f0.torque += -turning * at.w;
    for (int i = 3; i < 6; ++i) share.D.m[i][i] += turning;
    // A heave or roll that is too fast for the substep is damped, as a splash would: damping
    // tau K, tau rising to h/2 where (w h)^2 is above 1 and of no effect where it is below.
    const double h = scratch.h, fast = h * h * fastest_rate(share.K, body.inverse);
    const double tau = 0.5 * h * fast * fast / (1 + fast * fast);
    const Wrench flow = {at.v - cast<Num>(to_inner(fluid.current)), at.w};
    const Wrench splash = share.K.times(flow);
    share.f0 = share.f0 - Wrench{tau * splash.force, tau * splash.torque};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) share.D.m[i][j] += tau * share.K.m[i][j];
    body.held += length(lift);
    add_stiff(scratch, link);
  });
}

// The work of pushing what is displaced up to the surface: density g V times the depth of its
// centre.
double potential_of_buoyancy(const WorldState& world, const EffectInfo& effect,
                             std::uint32_t slot) {
  const Buoyancy& fluid = std::get<Buoyancy>(effect.component.kind);
  const BodyPose& pose = world.bodies.pose[world.bodies.info[slot].dense];
  const Water water = water_at(fluid, cast<Num>(pose.x));
  const NumRotation q = to_num(pose.q);
  const BodyInfo& info = world.bodies.info[slot];
  BodySurface surface;  // not the step's: several threads may ask
  if (fluid.hull.has_value()) {
    make_surface(*fluid.hull, cast<Num>(info.center_B), to_num(info.R_BP), surface);
  } else {
    make_surface(world, slot, surface);
  }
  const Displacement d = displaced_below(surface, inverse_rotate(q, water.up), water.level);
  const double depth = water.level * d.volume - dot(inverse_rotate(q, water.up), d.first);
  const NumVec g = cast<Num>(to_inner(world.settings.gravity));
  return -static_cast<double>(fluid.density) * dot(g, water.up) * depth;
}

}  // namespace plumb::inline PLUMB_ABI::detail
