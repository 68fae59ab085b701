#include "solver/turned_rows.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "solver/body_substep.h"
#include "solver/contact_kernel.h"
#include "solver/newton/newton_solver.h"
#include "solver/plain_bodies.h"
#include "solver/row_end.h"
#include "world/forced.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// [rad] in a step, above which a body turns fast.
Real fast_turn(const WorldState& world) {
  return threshold(world.settings, PlanItem::FastTurns, tolerance::kFastTurn);
}

bool is_isotropic(const BodyMass& m) {
  return m.moments.x == m.moments.y && m.moments.y == m.moments.z;
}
// A ball shows the contact the same face whatever it turns.
bool matters(const WorldState& world, std::uint32_t body, Vec core, Vec arm) {
  return world.substep[body].turned &&
         (!is_isotropic(world.bodies.mass[body]) ||
          length_squared(core) > tolerance::kRoundCore * length_squared(arm));
}

bool has_turned(const BodyDelta& delta) {
  return length_squared(Vec{delta.dq.x, delta.dq.y, delta.dq.z}) > Real(0);
}
// The row has another inertia than when the step began.
void note_told(const WorldState& world, ContactRow<Real>& row) {
  row.told_anew =
      row.told_anew || has_turned(world.delta[row.body_a]) || has_turned(world.delta[row.body_b]);
}

BodyDelta since(const BodyDelta& now, const BodyDelta& then) {
  return {now.dp - then.dp, Real(0), normalized(now.dq * conjugate(then.dq))};
}

// Whether the row as the step began would begin to press now, visibly.
bool would_press(const WorldState& world, const ContactRow<Real>& row) {
  const BodyDelta &da = world.delta[row.body_a], &db = world.delta[row.body_b];
  const BodyVelocity& a = world.bodies.velocity[row.body_a];
  const BodyVelocity& b = world.bodies.velocity[row.body_b];
  RowVelocities<Real> u{a.v, a.w, b.v, b.w, {}, {}};
  place_arms(row, da.dp, db.dp, u);
  const SeparationChange<Real> change = separation_change(row, da, db);
  const Real u0 = dot(row.n, relative_velocity(u));
  const Vec w = u.wb - u.wa;
  const Real u1 = dot(row.t1, w), u2 = dot(row.t2, w);
  Real closing = 0;  // [m/s] beyond what closes the gap
  for (int i = 0; i < row.count; ++i) {
    const auto& point = row.points[i];
    const Real s = point.separation + change.D0 + point.a * change.E1 + point.b * change.E2;
    const Real gap = std::max(s, Real(0));
    closing = std::max(closing, -(u0 + point.b * u1 - point.a * u2 + gap / world.h));
  }
  const auto visibly = [&](std::uint32_t body) {
    return world.substep[body].constrained &&
           parts_visibly(world.bodies.mass[body], closing * row.n, {0, 0, 0}, world.dt);
  };
  return visibly(row.body_a) || visibly(row.body_b);
}

void renew(WorldState& world, TurnedRow& turned) {
  ContactRow<Real>& row = world.rows[turned.row];
  row.let_go = row.let_go || would_press(world, turned.as_begun);
  const BodyDelta da = delta_of_a(world, row), db = delta_of_b(world, row);
  const SeparationChange<Real> change = separation_change(row, da, db);
  const bool a_moves = world.substep[row.body_a].constrained;
  const bool b_moves = world.substep[row.body_b].constrained;
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    point.separation += change.D0 + point.a * change.E1 + point.b * change.E2;
    const Vec place = point.a * row.t1 + point.b * row.t2;
    const Vec by_a = rotate(da.dq, place), by_b = rotate(db.dq, place);
    const Vec now = row.both_dynamic ? Real(0.5) * (by_a + by_b) : (a_moves ? by_a : by_b);
    point.a = dot(row.t1, now);
    point.b = dot(row.t2, now);
  }
  row.core_a = rotate(da.dq, row.core_a);
  row.core_b = rotate(db.dq, row.core_b);
  const Vec from_a_to_b = row.between + world.delta[row.body_b].dp - world.delta[row.body_a].dp;
  const Vec on_a = row.core_a + row.surface_a * row.n;
  const Vec on_b = row.core_b - row.surface_b * row.n;
  if (row.both_dynamic) {
    row.arm_a = row.follow_b * on_a + row.follow_a * (from_a_to_b + on_b);
    row.arm_b = row.arm_a - from_a_to_b;
  } else if (a_moves) {
    row.arm_a = on_a;
    row.arm_b = on_a - from_a_to_b;
  } else {
    row.arm_b = on_b;
    row.arm_a = on_b + from_a_to_b;
  }
  row.advance = {0, 0, 0};
  if (a_moves) row.inverse_inertia_a = world.substep[row.body_a].I_inverse;
  if (b_moves) row.inverse_inertia_b = world.substep[row.body_b].I_inverse;
  fill_responses(row);
  note_told(world, row);
  turned.a = world.delta[row.body_a];
  turned.b = world.delta[row.body_b];
}

}  // namespace

Real visible_turning(const BodyMass& m, Rotation q, Vec w) {
  const bool xy = m.moments.x == m.moments.y, yz = m.moments.y == m.moments.z;
  const bool xz = m.moments.x == m.moments.z;
  if (xy == yz && yz == xz) return length(w);
  Vec in_body = inverse_rotate(q, w);
  set_component(in_body, xy ? 2 : (yz ? 0 : 1), Real(0));
  return length(in_body);
}

// Marks the bodies that turn fast; whether there are any.
static bool mark_turned_bodies(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  const Real limit = fast_turn(world);
  std::atomic<bool> any = false;
  parallel_for(world, bodies.awake_end - bodies.awake_begin, tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 bool found = false;
                 for (std::uint32_t i = bodies.awake_begin + begin; i < bodies.awake_begin + end;
                      ++i) {
                   SubstepBody& s = world.substep[i];
                   const auto turning = [&] {
                     return visible_turning(bodies.mass[i], bodies.pose[i].q, bodies.velocity[i].w);
                   };
                   s.turned = s.constrained && !s.jointed && world.dt * turning() > limit;
                   found |= s.turned;
                 }
                 if (found) any.store(true, std::memory_order_relaxed);
               });
  return any;
}

void find_turned_rows(WorldState& world) {
  world.turned_rows.clear();
  if (world.rows.empty() || !mark_turned_bodies(world)) return;
  // Bounces keep time, arms and inertia of their own, and rows of fast pairs are those of the
  // moment of first touch.
  for (const ContactRow<Real>& row : world.rows)
    if (row.restitution > Real(0) || length_squared(row.advance) > Real(0))
      world.substep[row.body_a].turned = world.substep[row.body_b].turned = false;
  for (const ColorRange color : world.colors)
    for (std::uint32_t i = color.begin; i < color.end; ++i) {
      ContactRow<Real>& row = world.rows[i];
      if (!matters(world, row.body_a, row.core_a, row.arm_a) &&
          !matters(world, row.body_b, row.core_b, row.arm_b))
        continue;
      row.turned = static_cast<std::uint32_t>(world.turned_rows.size());
      row.watched = true;
      world.turned_rows.push_back({i, world.delta[row.body_a], world.delta[row.body_b], row});
    }
}

void renew_turned_rows(WorldState& world) {
  for (const TurnedRow& turned : world.turned_rows)
    for (const std::uint32_t body : {world.rows[turned.row].body_a, world.rows[turned.row].body_b})
      if (world.substep[body].turned && !is_isotropic(world.bodies.mass[body]))
        turn_inertia(world, body);
  for (TurnedRow& turned : world.turned_rows) renew(world, turned);
}

void renew_bouncing_rows(WorldState& world) {
  StepList<std::uint8_t> turns(&world.memory);  // per dense body
  const Real limit = fast_turn(world);
  const auto look_at = [&](std::uint32_t body) {
    const SubstepBody& s = world.substep[body];
    if (!s.constrained || s.jointed || is_isotropic(world.bodies.mass[body])) return;
    const Vec half_turn{world.delta[body].dq.x, world.delta[body].dq.y, world.delta[body].dq.z};
    const Real turn =
        std::max(Real(2) * length(half_turn), world.dt * length(world.bodies.velocity[body].w));
    if (!(turn > limit)) return;
    if (turns.empty()) turns.assign(world.bodies.awake_end, 0);
    turns[body] = 1;
  };
  for (const std::uint32_t k : world.bouncing_rows) {
    look_at(world.rows[k].body_a);
    look_at(world.rows[k].body_b);
  }
  if (turns.empty()) return;
  // All rows of a body see one inertia.
  for (const ContactRow<Real>& row : world.rows)
    if (!(row.restitution > Real(0))) turns[row.body_a] = turns[row.body_b] = 0;
  for (std::uint32_t i = 0; i < turns.size(); ++i)
    if (turns[i] != 0) turn_inertia(world, i);
  for (const std::uint32_t k : world.bouncing_rows) {
    ContactRow<Real>& row = world.rows[k];
    if (turns[row.body_a] == 0 && turns[row.body_b] == 0) continue;
    row.watched = true;
    if (turns[row.body_a] != 0) row.inverse_inertia_a = world.substep[row.body_a].I_inverse;
    if (turns[row.body_b] != 0) row.inverse_inertia_b = world.substep[row.body_b].I_inverse;
    fill_responses(row);
    note_told(world, row);
  }
}

namespace {

bool find_spun_bodies(WorldState& world, const StepGroup& group) {
  const bool newton = world.newton != nullptr && world.newton->count > 0;
  const Real limit = fast_turn(world);
  if (group.rows.empty()) return false;
  std::atomic<bool> any = false;
  for_bodies_at_once(group, [&](std::uint32_t i) {
    const Vec w = world.bodies.velocity[i].w;
    if (!(world.dt * length(w) > limit)) return;
    SubstepBody& s = world.substep[i];
    const BodyMass& mass = world.bodies.mass[i];
    if (!s.constrained || s.split || s.turned || s.spun || is_isotropic(mass)) return;
    if (newton && in_newton_island(world, i)) return;
    s.spun = world.dt * visible_turning(mass, orientation_now(world, i), w) > limit;
    if (s.spun) any.store(true, std::memory_order_relaxed);
  });
  return any;
}

void list_spun_rows(WorldState& world, StepGroup& group) {
  group.spun_rows.clear();
  const std::uint32_t colored = world.colors.empty() ? 0 : world.colors.back().end;
  for (const std::uint32_t k : group.rows) {
    if (k >= colored) break;
    ContactRow<Real>& row = world.rows[k];
    row.spun = world.substep[row.body_a].spun || world.substep[row.body_b].spun;
    row.in_block = false;
    if (row.spun) group.spun_rows.push_back(k);
  }
}

}  // namespace

bool renew_spun_rows(WorldState& world, StepGroup& group) {
  const bool found = find_spun_bodies(world, group);
  if (found) {
    empty_blocks(world, group);
    list_spun_rows(world, group);
    fill_blocks(world, group);
  }
  if (group.spun_rows.empty()) return found;
  for_bodies_of(group, [&](std::uint32_t i) {
    if (world.substep[i].spun) turn_inertia(world, i);
  });
  for (const std::uint32_t k : group.spun_rows) {
    ContactRow<Real>& row = world.rows[k];
    row.watched = true;
    if (world.substep[row.body_a].spun) row.inverse_inertia_a = world.substep[row.body_a].I_inverse;
    if (world.substep[row.body_b].spun) row.inverse_inertia_b = world.substep[row.body_b].I_inverse;
    fill_responses(row);
    note_told(world, row);
  }
  return found;
}

bool telling_showed(const WorldState& world, const ContactRow<Real>& row) {
  if (row.let_go) return true;
  if (!(row.pressed_anew > Real(0))) return false;
  if (row.turned != ContactRow<Real>::kNotTurned) return shows(world, row, row.pressed_anew);
  // Arms stayed, and an impulse gives the same momentum whatever inertia rows see: that decides how
  // large it must be for a velocity.
  const auto begun = [&](std::uint32_t body, const Symmetric3<Real>& now) {
    return world.substep[body].constrained
               ? world_inverse_inertia(world.bodies.mass[body], world.bodies.pose[body].q)
               : now;
  };
  const Symmetric3<Real> then_a = begun(row.body_a, row.inverse_inertia_a);
  const Symmetric3<Real> then_b = begun(row.body_b, row.inverse_inertia_b);
  const auto changes = [&](Vec place, Vec d, Real impulse) {
    const Vec a = cross(row.arm_a + place, d), b = cross(row.arm_b + place, d);
    const Real turning = dot(a, row.inverse_inertia_a * a) + dot(b, row.inverse_inertia_b * b);
    const Real before = dot(a, then_a * a) + dot(b, then_b * b);
    const Vec moving = multiply_each(row.inverse_mass_a + row.inverse_mass_b, d);
    const Real share = std::abs(turning - before) / (dot(d, moving) + turning);
    return shows(world, row, share * impulse);
  };
  const Real rubs = row.friction * row.pressed_anew;
  for (int i = 0; i < row.count; ++i) {
    const Vec place = row.points[i].a * row.t1 + row.points[i].b * row.t2;
    if (changes(place, row.n, row.pressed_anew) || changes(place, row.t1, rubs) ||
        changes(place, row.t2, rubs))
      return true;
  }
  return false;
}

BodyDelta delta_of_a(const WorldState& world, const ContactRow<Real>& row) {
  const BodyDelta& now = world.delta[row.body_a];
  return row.turned == ContactRow<Real>::kNotTurned ? now
                                                    : since(now, world.turned_rows[row.turned].a);
}
BodyDelta delta_of_b(const WorldState& world, const ContactRow<Real>& row) {
  const BodyDelta& now = world.delta[row.body_b];
  return row.turned == ContactRow<Real>::kNotTurned ? now
                                                    : since(now, world.turned_rows[row.turned].b);
}

}  // namespace plumb::inline PLUMB_ABI::detail
