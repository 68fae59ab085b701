// Drag and the Magnus force: what depends on how a body moves through a medium.
//
// Linear drag is handed over as a rate, with which the substeps move the body in closed form
// (damped_motion()). Quadratic drag is a rate too, that of the mean speed over the substep:
//   v' = a - (c + k |v|)/m v,  |v| by Simpson's rule over the substep.
// At the terminal speed the mean is that speed, so that it is kept exactly; the motion never turns
// back by drag, whatever the step.
#include <cmath>

#include "effects/effect_stage.h"
#include "math/eigen_bridge.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// v after a time t of v' = a - rate v.
NumVec dragged(NumVec v, NumVec a, double rate, double t) {
  const double decay = decay_of(rate * t);
  const double gain = rate * t > 1e-8 ? (1 - decay) / rate : t;
  return decay * v + gain * a;
}

double mean_speed(NumVec v, NumVec a, double linear, double quadratic, double h) {
  const double start = length(v);
  const double rough = length(dragged(v, a, linear + quadratic * start, 0.5 * h));
  const double middle = length(dragged(v, a, linear + quadratic * 0.5 * (start + rough), 0.5 * h));
  const double end = length(dragged(v, a, linear + quadratic * middle, h));
  return (start + 4 * middle + end) / 6;
}

void resist_turning(EffectScratch& scratch, const Drag& drag, EffectLink& link) {
  const AffectedBody& body = scratch.bodies[link.body];
  const NumVec w = stiff_view(scratch, body).w;
  const double speed = length(w), k = static_cast<double>(drag.angular_quadratic);
  const double c = static_cast<double>(drag.angular_linear) + k * speed;
  StiffShare& share = stiff_share(scratch, link);
  share.f0.torque = -c * w;
  for (int i = 3; i < 6; ++i) share.D.m[i][i] = c;
  if (speed > 0 && k > 0) share.D.add_outer(k / speed, {{0, 0, 0}, w}, {{0, 0, 0}, w});
  add_stiff(scratch, link);
}

}  // namespace

void act_drag(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<Drag>(*world.effects, [&](const Drag& drag, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const double c = static_cast<double>(drag.linear) / body.mass;
    const double k = static_cast<double>(drag.quadratic) / body.mass;
    link.medium = cast<Num>(to_inner(drag.medium));
    link.rate = c;
    if (k > 0) {
      const NumVec a = body.inverse.times(body.soft).force;
      link.rate += k * mean_speed(body.v - link.medium, a, c, k, scratch.h);
    }
    body.rate += link.rate;
    body.drawn += link.rate * link.medium;
    if (drag.angular_linear > Real(0) || drag.angular_quadratic > Real(0))
      resist_turning(scratch, drag, link);
  });
}

// v' = (S/m) w x v turns v about w and keeps its length: half of what else acts, the turn, the
// other half [Boris 1970].
void act_magnus(WorldState& world) {
  EffectScratch& scratch = *world.effects->scratch;
  for_links<Magnus>(*world.effects, [&](const Magnus& magnus, EffectLink& link) {
    AffectedBody& body = scratch.bodies[link.body];
    const StiffView at = stiff_view(scratch, body);
    const NumVec u = at.v - cast<Num>(to_inner(magnus.medium));
    const double s = static_cast<double>(magnus.coefficient) * scratch.h / body.mass;
    const NumVec turned = rotate(from_rotation_vector(s * at.w), u);
    add_soft(body, link, {(body.mass / scratch.h) * (turned - u), {0, 0, 0}});
  });
}

}  // namespace plumb::inline PLUMB_ABI::detail
