// Springs, anchored springs and bungees.
//
// With e the way from A's point to B's, l its length and d = e/l, the mean force on B over the
// substep is f d,
//   f = -(k (l - rest) + c dl/dt) - (h^2/4 k + theta h c) (d . W d) f,
// l and dl/dt where everything else brings both points by the middle of the substep, W what a unit
// of force does to their acceleration: implicit midpoint for the stiffness, fitted for the damping
// (stiff_solve.h). d is that of the middle of the substep too, found by looking again from the
// direction in which the substep began: a spring too stiff for the step does not turn over. Springs
// are solved together, beginning with what they did last. Momentum stays to round-off, angular
// momentum where the tied bodies turn to second order of the step.
#include <algorithm>
#include <cmath>

#include "effects/effect_stage.h"
#include "math/eigen_bridge.h"
#include "world/body_sweep.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Looks for the directions, and for which one-sided springs act [-].
constexpr int kLooks = 4;
// Rounds of conjugate gradients [-]; n springs in a row need n at most. Done when the error is this
// small beside the whole (squared, [-]).
constexpr int kMostRounds = 64;
constexpr double kSolved = 1e-22;

// A point of a body that effects do not move: static, kinematic, or the world.
SpringEnd fixed_end(const WorldState& world, const EffectScratch& scratch, std::uint32_t slot,
                    NumVec p) {
  SpringEnd end;
  end.point = p;
  if (slot == kEveryBody) return end;
  const BodyInfo& info = world.bodies.info[slot];
  const BodyPose& pose = world.bodies.pose[info.dense];
  const bool moves = world.bodies.is_awake(slot);
  const BodyVelocity still{};
  const BodyVelocity& u = moves ? world.bodies.velocity[info.dense] : still;
  const BodyDelta rest{};
  const BodyDelta& delta = moves ? world.delta[info.dense] : rest;
  const NumVec v = cast<Num>(u.v), w = cast<Num>(u.w);
  const double half = 0.5 * scratch.h;
  const NumRotation q =
      from_rotation_vector(half * w) * to_num(delta.dq * pose.q) * conjugate(to_num(info.R_BP));
  end.arm = rotate(q, p - cast<Num>(info.center_B));
  end.point = cast<Num>(pose.x) + cast<Num>(delta.dp) + half * v + end.arm;
  end.velocity = v + cross(w, end.arm);
  return end;
}

SpringEnd end_of(WorldState& world, EffectScratch& scratch, std::uint32_t affected,
                 std::uint32_t slot, NumVec p) {
  if (affected == kNone) return fixed_end(world, scratch, slot, p);
  SpringEnd end;
  end.body = &scratch.bodies[affected];
  end.arm = rotate(body_axes(world, *end.body), p - cast<Num>(world.bodies.info[slot].center_B));
  end.point = end.body->x + end.arm;
  end.velocity = end.body->v + cross(end.body->w, end.arm);
  return end;
}

// The acceleration of the point by springs,
NumVec given_way(const SpringEnd& end) {
  if (end.body == nullptr) return {0, 0, 0};
  const Wrench a = end.body->inverse.times({end.body->springs, end.body->spring_torque});
  return a.force + cross(a.torque, end.arm);
}
// and by all else.
NumVec acceleration_of(const SpringEnd& end) {
  if (end.body == nullptr) return {0, 0, 0};
  const AffectedBody& body = *end.body;
  const Wrench a = body.inverse.times(body.soft);
  return a.force + body.drawn - body.rate * body.v + cross(a.torque, end.arm);
}
double response(const SpringEnd& end, NumVec d) {
  if (end.body == nullptr) return 0;
  const Wrench a = end.body->inverse.times({d, cross(end.arm, d)});
  return dot(d, a.force + cross(a.torque, end.arm));
}
void push(const SpringEnd& end, NumVec force) {
  if (end.body == nullptr) return;
  end.body->springs += force;
  end.body->spring_torque += cross(end.arm, force);
}

// A damped spring that is too fast for the substep loses its ringing as well as its motion: up to
// h k / 2 more, by its damping ratio, where h^2 k W is above 1, and nothing where it is below.
double damping_of(const Spring& spring, double k, double W, double h) {
  const double c = static_cast<double>(spring.damping);
  if (!(c > 0) || !(W > 0)) return c;
  const double ratio = std::min(1.0, 0.5 * c * std::sqrt(W / k)), fast = h * h * k * W;
  return c + ratio * 0.5 * h * k * (fast * fast / (1 + fast * fast));
}

// What the springs' forces (`of` each row) do to the length of each spring: W l.
template <class Of>
void respond(std::vector<SpringRow>& rows, std::vector<AffectedBody>& bodies, Of&& of) {
  for (AffectedBody& body : bodies) body.springs = body.spring_torque = {0, 0, 0};
  for (const SpringRow& row : rows) {
    if (!row.acts) continue;
    push(row.a, -of(row) * row.d);
    push(row.b, of(row) * row.d);
  }
  for (SpringRow& row : rows) row.response = dot(row.d, given_way(row.b) - given_way(row.a));
}

// (1/give + W) f = known/give: symmetric and positive, by conjugate gradients with the diagonal as
// preconditioner [Hestenes 1952]; springs that share no body are done after one round.
void solve_together(std::vector<SpringRow>& rows, std::vector<AffectedBody>& bodies) {
  const auto scale = [](const SpringRow& row) {
    return 1 / (1 / row.give + response(row.a, row.d) + response(row.b, row.d));
  };
  respond(rows, bodies, [](const SpringRow& row) { return row.force; });
  double size = 0, rr = 0;
  for (SpringRow& row : rows) {
    if (!row.acts) row.force = 0;
    row.rest = row.acts ? (row.known - row.force) / row.give - row.response : 0;
    row.search = scale(row) * row.rest;
    rr += row.rest * row.search;
    const double whole = row.acts ? row.known / row.give : 0;
    size += whole * whole * scale(row);
  }
  const int rounds = std::min(static_cast<int>(rows.size()), kMostRounds);
  for (int round = 0; round < rounds && rr > kSolved * size; ++round) {
    respond(rows, bodies, [](const SpringRow& row) { return row.search; });
    double curve = 0;
    for (const SpringRow& row : rows)
      if (row.acts) curve += row.search * (row.search / row.give + row.response);
    if (!(curve > 0)) break;
    const double step = rr / curve;
    double next = 0;
    for (SpringRow& row : rows) {
      if (!row.acts) continue;
      row.force += step * row.search;
      row.rest -= step * (row.search / row.give + row.response);
      next += row.rest * row.rest * scale(row);
    }
    for (SpringRow& row : rows)
      if (row.acts) row.search = scale(row) * row.rest + (next / rr) * row.search;
    rr = next;
  }
  respond(rows, bodies, [](const SpringRow& row) { return row.force; });
}

// The row as everything but springs leaves it, along the present direction.
void look_at(SpringRow& row, double h) {
  const Spring& spring = *row.spring;
  const NumVec a = acceleration_of(row.b) - acceleration_of(row.a);
  const NumVec e = row.b.point - row.a.point + (0.25 * h * h) * a;
  const NumVec rate = row.b.velocity - row.a.velocity + (0.5 * h) * a;
  const double k = static_cast<double>(spring.stiffness);
  const double W = response(row.a, row.d) + response(row.b, row.d);
  const double c = damping_of(spring, k, W, h), theta = fitted_theta(h * c * W);
  const double stretch = dot(e, row.d) - static_cast<double>(spring.rest_length);
  row.known = -(k * stretch + c * (dot(rate, row.d) + (theta - 0.5) * h * dot(a, row.d)));
  row.give = 0.25 * h * h * k + theta * h * c;
  // One-sided: by the length that it would have in the middle, all springs counted.
  const double length_now = stretch + 0.25 * h * h * row.response;
  if (spring.acts == Spring::Acts::WhenStretched) row.acts = length_now > 0 && row.force <= 0;
  if (spring.acts == Spring::Acts::WhenCompressed) row.acts = length_now < 0 && row.force >= 0;
}

}  // namespace

void act_springs(WorldState& world) {
  EffectStore& store = *world.effects;
  EffectScratch& scratch = *store.scratch;
  const double h = scratch.h;
  std::vector<SpringRow>& rows = scratch.spring_rows;
  rows.clear();
  for_links<Spring>(store, [&](const Spring& spring, EffectLink& link) {
    const EffectInfo& info = store.info[link.effect];
    SpringRow& row = rows.emplace_back();
    row.spring = &spring;
    row.link = &link;
    row.a = end_of(world, scratch, link.body, info.body, cast<Num>(to_inner(spring.point)));
    row.b =
        end_of(world, scratch, link.other, info.other,
               {static_cast<Num>(spring.other_point.x()), static_cast<Num>(spring.other_point.y()),
                static_cast<Num>(spring.other_point.z())});
    const NumVec way = (0.5 * h) * (row.b.velocity - row.a.velocity);
    row.d = normalized_or(row.b.point - row.a.point - way, NumVec{0, 1, 0});
    row.force = info.memory.pull;
  });
  for (int look = 0; look < kLooks; ++look) {
    for (SpringRow& row : rows) {
      if (look > 0) {
        const NumVec a =
            acceleration_of(row.b) - acceleration_of(row.a) + given_way(row.b) - given_way(row.a);
        row.d = normalized_or(row.b.point - row.a.point + (0.25 * h * h) * a, row.d);
      }
      look_at(row, h);
    }
    solve_together(rows, scratch.bodies);
  }
  // A one-sided spring whose damper would do what it must not does nothing.
  for (SpringRow& row : rows)
    if ((row.spring->acts == Spring::Acts::WhenStretched && row.force > 0) ||
        (row.spring->acts == Spring::Acts::WhenCompressed && row.force < 0))
      row.force = 0;
  respond(rows, scratch.bodies, [](const SpringRow& row) { return row.force; });
  for (SpringRow& row : rows) {
    const NumVec on_b = row.force * row.d;
    store.info[row.link->effect].memory.pull = row.force;
    row.link->wrench = {-on_b, -cross(row.a.arm, on_b)};
    row.link->wrench_on_other = {on_b, cross(row.b.arm, on_b)};
    for (const SpringEnd* end : {&row.a, &row.b})
      if (end->body != nullptr) end->body->held += std::abs(row.force);
  }
}

double potential_of_spring(const WorldState& world, const EffectInfo& effect) {
  const Spring& spring = std::get<Spring>(effect.component.kind);
  const auto place = [&](std::uint32_t slot, NumVec p) {
    if (slot == kEveryBody) return p;
    const BodyInfo& info = world.bodies.info[slot];
    const BodyPose& pose = world.bodies.pose[info.dense];
    return cast<Num>(pose.x) +
           rotate(to_num(pose.q) * conjugate(to_num(info.R_BP)), p - cast<Num>(info.center_B));
  };
  const NumVec a = place(effect.body, cast<Num>(to_inner(spring.point)));
  const NumVec b = place(effect.other, {static_cast<Num>(spring.other_point.x()),
                                        static_cast<Num>(spring.other_point.y()),
                                        static_cast<Num>(spring.other_point.z())});
  const double stretch = length(b - a) - static_cast<double>(spring.rest_length);
  if (spring.acts == Spring::Acts::WhenStretched && stretch <= 0) return 0;
  if (spring.acts == Spring::Acts::WhenCompressed && stretch >= 0) return 0;
  return 0.5 * static_cast<double>(spring.stiffness) * stretch * stretch;
}

}  // namespace plumb::inline PLUMB_ABI::detail
