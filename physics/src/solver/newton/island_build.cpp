#include "solver/newton/island_build.h"

#include <algorithm>
#include <cmath>

#include "math/symmetric_inverse.h"
#include "motion/body_motion.h"
#include "solver/body_substep.h"
#include "solver/contact_kernel.h"
#include "solver/newton/island_laws.h"
#include "solver/newton/newton_method.h"
#include "solver/newton/tolerances.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

constexpr double kRegular = 1e-14;  // [-] smallest relative determinant of an inertia

Vec3d wide(Vec a) { return cast<double>(a); }
Sym3d wide(const Symmetric3<Real>& m) {
  return {static_cast<double>(m.xx), static_cast<double>(m.yy), static_cast<double>(m.zz),
          static_cast<double>(m.xy), static_cast<double>(m.xz), static_cast<double>(m.yz)};
}
double positive(Real a) { return a > Real(0) ? 1.0 : 0.0; }

// About axes that are locked, or about which nothing turns, the inertia is 1 and takes no momentum.
void fill_turning(const WorldState& world, IslandBody& body) {
  const BodyMass& mass = world.bodies.mass[body.dense];
  const SubstepBody& s = world.substep[body.dense];
  const bool whole = mass.angular_locks == 0 && mass.inverse_moments.x > Real(0) &&
                     mass.inverse_moments.y > Real(0) && mass.inverse_moments.z > Real(0);
  body.turns = kWhole;
  body.inverse_inertia = wide(s.I_inverse);
  if (whole && invert(body.inverse_inertia, kRegular, body.inertia)) return;
  body.restricted = true;
  if (mass.angular_locks != 0) {
    const auto free = [&](unsigned bit) { return (mass.angular_locks & bit) != 0 ? 0.0 : 1.0; };
    body.turns = {free(1), free(2), free(4), 0, 0, 0};
  } else {
    const Matrix3<Real> R = to_matrix(world.bodies.pose[body.dense].q);
    const Vec free{static_cast<Real>(positive(mass.inverse_moments.x)),
                   static_cast<Real>(positive(mass.inverse_moments.y)),
                   static_cast<Real>(positive(mass.inverse_moments.z))};
    body.turns = wide(rotate_diagonal(R, free));
  }
  const Sym3d I = wide(s.I), &P = body.turns;
  body.inertia = {I.xx + 1 - P.xx, I.yy + 1 - P.yy, I.zz + 1 - P.zz,
                  I.xy - P.xy,     I.xz - P.xz,     I.yz - P.yz};
  if (invert(body.inertia, kRegular, body.inverse_inertia)) return;
  body.turns = {};
  body.inertia = body.inverse_inertia = kWhole;
}

void fill_body(const WorldState& world, Island& island, std::size_t i) {
  IslandBody& body = island.bodies[i];
  const std::uint32_t dense = body.dense;
  const BodyMass& mass = world.bodies.mass[dense];
  const BodyVelocity& velocity = world.bodies.velocity[dense];
  const SubstepBody& s = world.substep[dense];
  const Real radius = world.bodies.extent[world.bodies.slot_of[dense]].radius;
  body.restricted = false;
  const Vec3d inverse = wide(mass.inverse_mass);
  body.moves = {positive(mass.inverse_mass.x), positive(mass.inverse_mass.y),
                positive(mass.inverse_mass.z)};
  if (body.moves.x * body.moves.y * body.moves.z == 0) body.restricted = true;
  const auto mass_of = [](double a) { return a > 0 ? 1 / a : 1.0; };
  body.mass = {mass_of(inverse.x), mass_of(inverse.y), mass_of(inverse.z)};
  fill_turning(world, body);
  body.m = static_cast<double>(mass.mass);
  body.size = radius > Real(0) && radius < kUnbounded ? static_cast<double>(radius) : 1.0;
  const double added = static_cast<double>(length(s.acceleration) * world.h);
  body.weight = body.m * added;
  const Twist now{wide(velocity.v), wide(velocity.w)};
  body.p = momentum_of(body, now);
  body.start = {wide(s.v_start), now.w};
  island.v[i] = world.settings.warm_starting ? body.start : now;
  island.slides = std::max(island.slides, tolerance::kSlides * added);
  island.speed = std::max(
      island.speed, tolerance::kVelocity * added +
                        tolerance::kRelativeVelocity * (length(now.v) + length(now.w) * body.size));
}

// [kg] that an impulse meets at the end of an arm, the mean over all directions.
double mass_at(const IslandBody& body, Vec3d arm) {
  const double linear =
      (body.moves.x / body.mass.x + body.moves.y / body.mass.y + body.moves.z / body.mass.z);
  const Sym3d& I = body.inverse_inertia;
  const double turning = length_squared(arm) * (I.xx + I.yy + I.zz) - detail::dot(arm, I * arm);
  const double response = (linear + turning) / 3;
  return response > 0 ? 1 / response : 0;
}

Twist outside_velocity(const WorldState& world, const IslandContact& c, std::uint32_t dense,
                       Vec3d arm) {
  const Vec3d v = wide(world.bodies.velocity[dense].v), w = wide(world.bodies.velocity[dense].w);
  return {to_frame(c, v + cross(w, arm)), to_frame(c, w)};
}

void fill_contact(const WorldState& world, const Solver& solver, Island& island, IslandContact& c,
                  std::uint32_t index) {
  const ContactRow<Real>& row = world.rows[index];
  c = {};
  c.row = index;
  if (row.skip) return;
  c.count = row.count;
  c.a = row.body_a == 0 ? kFixed : solver.place[row.body_a].body;
  c.b = row.body_b == 0 ? kFixed : solver.place[row.body_b].body;
  c.n = wide(row.n);
  c.t1 = wide(row.t1);
  c.t2 = wide(row.t2);
  RowVelocities<Real> arms{};
  place_arms(row, world.delta[row.body_a].dp, world.delta[row.body_b].dp, arms);
  c.arm_a = wide(arms.arm_a);
  c.arm_b = wide(arms.arm_b);
  c.mu = static_cast<double>(row.friction);
  if (c.a == kFixed) c.fixed = c.fixed - outside_velocity(world, c, row.body_a, c.arm_a);
  if (c.b == kFixed) c.fixed = c.fixed + outside_velocity(world, c, row.body_b, c.arm_b);
  for (const auto& [body, arm] : {std::pair{c.a, c.arm_a}, std::pair{c.b, c.arm_b}}) {
    if (body == kFixed) continue;
    const IslandBody& of = island.bodies[static_cast<std::size_t>(body)];
    const double m = mass_at(of, arm);
    if (m > 0) c.response += 1 / m;
    island.mass = std::max(island.mass, m);
    c.lever2 = std::max(c.lever2, of.size * of.size);
  }
  const auto change = separation_change(row, world.delta[row.body_a], world.delta[row.body_b]);
  const double inverse_h = 1 / static_cast<double>(world.h);
  const double slop = static_cast<double>(world.pairs[world.contacts[row.contact].pair].slop);
  for (int i = 0; i < row.count; ++i) {
    const auto& from = row.points[i];
    IslandPoint& p = c.points[i];
    p.a = static_cast<double>(from.a);
    p.b = static_cast<double>(from.b);
    const double gap =
        static_cast<double>(from.separation + change.D0 + from.a * change.E1 + from.b * change.E2);
    if (gap > tolerance::kTouching * slop) p.gap = gap * inverse_h;
    if (gap < -tolerance::kTouching * slop)
      p.push =
          std::max(tolerance::kPush * gap * inverse_h, -static_cast<double>(row.push_speed_now));
    p.drive1 = static_cast<double>(row.drive.x) - p.b * static_cast<double>(row.drive.z);
    p.drive2 = static_cast<double>(row.drive.y) + p.a * static_cast<double>(row.drive.z);
    p.warm = {static_cast<double>(from.impulse), static_cast<double>(from.friction1),
              static_cast<double>(from.friction2)};
  }
  if (row.turning != ContactRow<Real>::kNoTurning) {
    const TurningRow<Real>& turning = world.turning_rows[row.turning];
    c.resists_turning = true;
    c.rolling = static_cast<double>(turning.rolling);
    c.torsional = static_cast<double>(turning.torsional);
    c.spin_drive = static_cast<double>(row.drive.z);
    c.turn_warm = {static_cast<double>(turning.impulse3), static_cast<double>(turning.impulse1),
                   static_cast<double>(turning.impulse2)};
  }
  // What slid before the step slides in it, it is guessed.
  const Twist u = relative(c, island.v) + c.fixed;
  c.rests = true;
  for (int i = 0; i < c.count; ++i) {
    IslandPoint& p = c.points[i];
    const Vec3d v = at_point(p, u);
    const double s1 = v.y + p.drive1, s2 = v.z + p.drive2;
    const double slip = std::sqrt(s1 * s1 + s2 * s2);
    p.slid = slip > island.slides && p.warm.x > 0;
    c.rests = c.rests && p.gap == 0 && std::abs(v.x) <= island.slides;
  }
}

}  // namespace

void fill_island(const WorldState& world, const Solver& solver, Island& island) {
  island.mass = island.speed = island.slides = 0;
  island.solves_positions = false;
  island.v.resize(island.bodies.size());
  for (std::size_t i = 0; i < island.bodies.size(); ++i) fill_body(world, island, i);
  island.contacts.resize(island.rows.size());
  for (std::size_t i = 0; i < island.rows.size(); ++i)
    fill_contact(world, solver, island, island.contacts[i], island.rows[i]);
  fill_joints(world, solver, island);
  if (!(island.mass > 0)) island.mass = 1;
  if (!(island.speed > 0)) island.speed = tolerance::kRelativeVelocity;
}

void store_island(WorldState& world, Island& island) {
  for (IslandContact& c : island.contacts) {
    ContactRow<Real>& row = world.rows[c.row];
    for (int i = 0; i < c.count; ++i) {
      const IslandPoint& p = c.points[i];
      auto& to = row.points[i];
      to.impulse = static_cast<Real>(p.center.x);
      to.friction1 = static_cast<Real>(p.center.y);
      to.friction2 = static_cast<Real>(p.center.z);
      const double limit = c.mu * p.center.x;
      const double friction = std::sqrt(p.center.y * p.center.y + p.center.z * p.center.z);
      const double share =
          !(limit > 0) || p.shift > island.slides ? 1 : std::min(1.0, friction / limit);
      c.load += p.center.x;
      c.sliding += share * p.center.x;
    }
    if (row.turning != ContactRow<Real>::kNoTurning && c.count > 0) {
      TurningRow<Real>& turning = world.turning_rows[row.turning];
      turning.impulse3 = static_cast<Real>(c.turn_center.x);
      turning.impulse1 = static_cast<Real>(c.turn_center.y);
      turning.impulse2 = static_cast<Real>(c.turn_center.z);
      if (length(c.now.w) * std::sqrt(c.lever2) > island.slides) c.sliding = c.load;
    }
  }
  store_joints(world, island);
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
