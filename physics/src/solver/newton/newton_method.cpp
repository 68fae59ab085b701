#include "solver/newton/newton_method.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/newton/island_laws.h"
#include "solver/newton/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

// Rounding of one evaluation, in units in the last place of its largest terms [-].
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

bool same(const Sym3d& a, const Sym3d& b) {
  return a.xx == b.xx && a.yy == b.yy && a.zz == b.zz && a.xy == b.xy && a.xz == b.xz &&
         a.yz == b.yz;
}

// What acts on a body, and how much of it may be round-off.
void note_load(Island& island, int body, double impulse, double rounded) {
  if (body == kFixed) return;
  IslandBody& of = island.bodies[static_cast<std::size_t>(body)];
  of.carried += impulse;
  of.floor += rounded;
}
double speed_of(const Island& island, int body) {
  return body == kFixed ? 0 : length(island.v[static_cast<std::size_t>(body)].v);
}

void evaluate_contact(Island& island, IslandContact& c, double rho) {
  c.now = relative(c, island.v) + c.fixed;
  Twist wrench;
  double load = 0;
  for (int i = 0; i < c.count; ++i) {
    IslandPoint& p = c.points[i];
    const Projected law = law_of(island, c, p, rho, at_point(p, c.now));
    p.g = law.g;
    p.D = law.D;
    load += length(p.g);
    add_at_point(p, p.g, wrench);
  }
  if (c.resists_turning) {
    const Projected law = turning_law(c, rho, c.now.w);
    c.turn_g = law.g;
    c.turn_D = law.D;
    wrench.w += law.g;
  }
  if (!(load > 0)) return;
  add_wrench(island, c, wrench, -1, island.gradient);
  const double rounded = c.count * rho * (speed_of(island, c.a) + speed_of(island, c.b));
  note_load(island, c.a, load, rounded);
  note_load(island, c.b, load, rounded);
}

void evaluate_joint(Island& island, IslandJoint& joint, double rho) {
  double impulse[kMaxJointRows] = {};
  for (int i = 0; i < joint.rows; ++i) joint.now[i] = rate_of(joint, i, island.v) + joint.fixed[i];
  const std::uint32_t balls = static_cast<std::uint32_t>(3 * joint.balls);
  for (std::uint32_t k = joint.first_law; k < joint.first_law + joint.laws - balls; ++k) {
    ScalarLaw& law = island.laws[k];
    const ScalarResult result = law_of(island, law, rho, joint.unit2[law.row], joint.now[law.row]);
    law.g = result.g;
    law.D = result.D;
    impulse[law.row] += law.g;
  }
  for (int b = 0; b < joint.balls; ++b) {
    double scale;
    const Projected p = law_of_ball(island, joint, joint.ball[b], rho, joint.now, scale);
    const double diagonal[3] = {p.D.xx, p.D.yy, p.D.zz};
    for (int k = 0; k < 3; ++k) {
      ScalarLaw& law = island.laws[static_cast<std::size_t>(joint.ball[b].first + k)];
      law.g = component(p.g, k);
      law.D = scale * diagonal[k];
      impulse[law.row] += law.g;
    }
    joint.ball_D[b][0] = scale * p.D.xy;
    joint.ball_D[b][1] = scale * p.D.xz;
    joint.ball_D[b][2] = scale * p.D.yz;
  }
  add_impulses(island, joint, impulse, -1, island.gradient);
  double load = 0, speeds = 0;
  for (int i = 0; i < joint.rows; ++i) load += std::abs(impulse[i]) / std::sqrt(joint.unit2[i]);
  for (int k = 0; k < joint.bodies; ++k) speeds += speed_of(island, joint.body[k]);
  for (int k = 0; k < joint.bodies; ++k)
    note_load(island, joint.body[k], load, joint.rows * rho * speeds);
}

// Whether some law acts otherwise than in the factored matrix.
bool laws_changed(const Island& island) {
  for (const IslandContact& c : island.contacts) {
    for (int i = 0; i < c.count; ++i)
      if (!same(c.points[i].D, c.points[i].factored_D)) return true;
    if (c.resists_turning && !same(c.turn_D, c.factored_turn_D)) return true;
  }
  for (const ScalarLaw& law : island.laws)
    if (law.D != law.factored_D) return true;
  for (const IslandJoint& joint : island.joints)
    for (int b = 0; b < joint.balls; ++b)
      for (int e = 0; e < 3; ++e)
        if (joint.ball_D[b][e] != joint.factored_ball_D[b][e]) return true;
  return false;
}

}  // namespace

double evaluate(Island& island) {
  const double rho = island.step_length * island.mass;
  island.gradient.resize(island.bodies.size());
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    IslandBody& body = island.bodies[i];
    const Twist momentum = momentum_of(body, island.v[i]);
    island.gradient[i] = momentum - body.p;
    body.carried = 0;
    body.floor = length(momentum.v) + length(momentum.w) / body.size;
  }
  for (IslandContact& contact : island.contacts)
    if (contact.count > 0) evaluate_contact(island, contact, rho);
  for (IslandJoint& joint : island.joints) evaluate_joint(island, joint, rho);
  double error = 0;
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const IslandBody& body = island.bodies[i];
    const double scale =
        body.weight + body.carried + (kRounding / tolerance::kMomentum) * body.floor;
    const double missing =
        std::max(length(island.gradient[i].v), length(island.gradient[i].w) / body.size);
    if (missing > 0) error = std::max(error, missing / scale);
  }
  return error;
}

void factor(Island& island) {
  assemble(island);
  island.matrix.factor();
  ++island.factorizations;
  island.has_factor = true;
  for (IslandContact& c : island.contacts) {
    for (int i = 0; i < c.count; ++i) c.points[i].factored_D = c.points[i].D;
    c.factored_turn_D = c.turn_D;
  }
  for (ScalarLaw& law : island.laws) law.factored_D = law.D;
  for (IslandJoint& joint : island.joints)
    for (int b = 0; b < joint.balls; ++b)
      for (int e = 0; e < 3; ++e) joint.factored_ball_D[b][e] = joint.ball_D[b][e];
}

bool minimize(Island& island, int iterations) {
  for (int k = 0; k < iterations; ++k) {
    if (evaluate(island) < tolerance::kMomentum) return true;
    if (!island.has_factor || laws_changed(island)) factor(island);
    island.step.resize(island.bodies.size());
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
      island.step[i] = -1.0 * island.gradient[i];
    island.matrix.solve(&island.step[0].v.x);
    const double length = length_of_step(island);
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
      island.v[i] = island.v[i] + length * island.step[i];
  }
  return evaluate(island) < tolerance::kMomentum;
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
