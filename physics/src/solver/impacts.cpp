// Bounces at their own time inside the substep.
//
// Until something hits it, a body follows x(t) = x + v t + a t^2/2. An impulse at time t changes v by
// dv; shifting the start point by -t dv keeps the position at t continuous, so every trajectory keeps
// its own energy and an elastic impulse keeps the total exactly, whatever the time step.
//
//   repeat
//     for every bouncing row: T = when do its surfaces meet, on the present trajectories?
//     rows that are the earliest of both their bodies: reflect, shift, note the time
//   until nothing happens
//
// Rows that are no one's earliest wait: their turn comes in a later pass, on new trajectories. What is
// too slow to bounce, or overlaps at the end, is left to the contact solver.
#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/body_motion.h"
#include "solver/contact_kernel.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

void run_impacts(WorldState& world);

namespace {

constexpr Real kNever = std::numeric_limits<Real>::infinity();
// Points that meet within this share of the substep bounce together [-]: a box that lands flat.
constexpr Real kSimultaneous = Real(1e-4);
// Sweeps over the points of one bounce [-]. Two suffice for one or two points, a flat box needs 13.
constexpr int kBounceSweeps = 32;

struct Meeting {
  Real time = kNever;      // [s] within the substep
  Vec normal{0, 1, 0};     // A to B at that time
};

struct Impacts {
  WorldState& world;
  std::vector<Meeting> meetings;   // per bouncing row
  std::vector<Real> local_time;    // per dense body: its last event [s]
  std::vector<std::uint32_t> best; // per dense body: its earliest bouncing row
  std::vector<std::uint8_t> stale; // per dense body: hit in the last pass

  Vec acceleration(std::uint32_t body) const {
    return world.substep[body].constrained ? world.substep[body].acceleration : Vec{0, 0, 0};
  }
  Real cut(const ContactRow<Real>& row) const {
    return row.cut_unit * (row.at_rest ? tolerance::kBounceCutResting : tolerance::kBounceCutNew);
  }
};

// Smallest t in [t0, h] with s + v t + a t^2/2 = 0 while closing; t0 if already overlapping and closing.
Real meeting_time(Real s, Real v, Real a, Real t0, Real h) {
  const Real s0 = s + t0 * (v + Real(0.5) * a * t0), v0 = v + a * t0;
  if (s0 <= Real(0)) return v0 < Real(0) ? t0 : kNever;
  const Real discriminant = v0 * v0 - Real(2) * a * s0;
  if (discriminant < Real(0)) return kNever;
  const Real root = std::sqrt(discriminant);
  // The stable form of the smaller positive root of s0 + v0 t + a t^2/2.
  const Real denominator = -v0 + root;
  if (!(denominator > Real(0))) return kNever;
  const Real t = t0 + Real(2) * s0 / denominator;
  return t <= h ? t : kNever;
}

// Two spheres: |p + v t| = r on straight relative paths (they fall alike; where they do not, the
// relative acceleration is taken along the line of centres).
Meeting spheres_meet(const Impacts& impacts, const ContactRow<Real>& row, Real t0) {
  const WorldState& world = impacts.world;
  const BodyStore& bodies = world.bodies;
  const Real h = world.h, r = row.radius_a + row.radius_b;
  const Vec a = impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a);
  const Vec v_start = bodies.velocity[row.body_b].v - bodies.velocity[row.body_a].v;
  const Vec p_start = row.arm_a - row.arm_b + world.delta[row.body_b].dp - world.delta[row.body_a].dp;
  const Vec p = p_start + t0 * (v_start + (Real(0.5) * t0) * a);
  const Vec v = v_start + t0 * a;
  Meeting meeting;
  const Real c = length_squared(p) - r * r, b = dot(p, v);
  Real t = kNever;
  if (c <= Real(0)) {
    if (b < Real(0)) t = t0;
  } else if (length_squared(a) > Real(0)) {
    const Real distance = length(p);
    t = meeting_time(distance - r, b / distance, dot(a, p) / distance, Real(0), h - t0) + t0;
  } else {
    const Real discriminant = b * b - length_squared(v) * c;
    if (b < Real(0) && discriminant >= Real(0)) {
      t = t0 + c / (-b + std::sqrt(discriminant));
      if (t > h) t = kNever;
    }
  }
  if (t == kNever) return meeting;
  meeting.time = t;
  const Real s = t - t0;
  meeting.normal = normalized_or(p + s * (v + (Real(0.5) * s) * a), row.n);
  return meeting;
}

struct PointMotion {
  Real s, v;  // [m], [m/s] at the start of the substep's trajectories
};
PointMotion point_motion(const WorldState& world, const ContactRow<Real>& row, int i,
                         const SeparationChange<Real>& change) {
  const auto& point = row.points[i];
  const BodyVelocity& va = world.bodies.velocity[row.body_a];
  const BodyVelocity& vb = world.bodies.velocity[row.body_b];
  const Vec place = point.a * row.t1 + point.b * row.t2;
  const Vec v = vb.v + cross(vb.w, row.arm_b + place) - va.v - cross(va.w, row.arm_a + place);
  return {point.separation + change.D0 + point.a * change.E1 + point.b * change.E2, dot(row.n, v)};
}

Meeting find_meeting(const Impacts& impacts, const ContactRow<Real>& row) {
  if (row.bounces >= tolerance::kMaxBouncesPerSubstep) return {};
  const WorldState& world = impacts.world;
  const Real t0 = std::max(impacts.local_time[row.body_a], impacts.local_time[row.body_b]);
  const Vec a_rel = impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a);
  Meeting meeting;
  Real closing;
  if (row.exact_spheres) {
    meeting = spheres_meet(impacts, row, t0);
    if (meeting.time == kNever) return meeting;
    const Vec v = world.bodies.velocity[row.body_b].v - world.bodies.velocity[row.body_a].v +
                  meeting.time * a_rel;
    closing = -dot(meeting.normal, v);
  } else {
    const Real a = dot(row.n, a_rel);
    const auto change = separation_change(row, world.delta[row.body_a], world.delta[row.body_b]);
    meeting.normal = row.n;
    closing = Real(0);
    for (int i = 0; i < row.count; ++i) {
      const PointMotion motion = point_motion(world, row, i, change);
      const Real t = meeting_time(motion.s, motion.v, a, t0, world.h);
      if (t < meeting.time) {
        meeting.time = t;
        closing = -(motion.v + a * t);
      }
    }
  }
  if (meeting.time != kNever && closing <= impacts.cut(row)) meeting.time = kNever;
  return meeting;
}

// Changes a body's trajectory by an impulse at time t: the velocity jumps, the path stays continuous.
void deflect(Impacts& impacts, std::uint32_t body, Vec dv, Vec dw, Vec dL, Real t) {
  WorldState& world = impacts.world;
  SubstepBody& s = world.substep[body];
  if (!s.constrained) return;
  world.bodies.velocity[body].v += dv;
  world.bodies.velocity[body].w += dw;
  world.bodies.momentum[body].L += dL;
  world.delta[body].dp -= t * dv;
  if (length_squared(dw) > Real(0))
    world.delta[body].dq = normalized(from_rotation_vector(-t * dw) * world.delta[body].dq);
  s.bounced = true;
  impacts.local_time[body] = t;
  impacts.stale[body] = 1;
}

// Newton's restitution at all points that meet now, together: sequential impulses until every
// approaching point leaves at -e times its approach. Friction of the bounce stays on the cone.
void bounce(Impacts& impacts, ContactRow<Real>& row, const Meeting& meeting) {
  WorldState& world = impacts.world;
  const Real t = meeting.time;
  const Vec a_rel = impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a);
  ContactRow<Real> now = row;  // the row with the geometry of the moment of impact
  if (row.exact_spheres) {
    now.n = meeting.normal;
    tangent_frame(now.n, now.t1, now.t2);
    now.arm_a = row.radius_a * now.n;
    now.arm_b = -row.radius_b * now.n;
    now.points[0].a = now.points[0].b = Real(0);
  }
  const auto change = separation_change(row, world.delta[row.body_a], world.delta[row.body_b]);
  const Real a_n = dot(now.n, a_rel);
  bool meets[ContactRow<Real>::kMaxPoints]{};
  for (int i = 0; i < row.count; ++i) {
    const PointMotion motion = point_motion(world, row, i, change);
    const Real gap = motion.s + t * (motion.v + Real(0.5) * a_n * t);
    meets[i] = row.exact_spheres ||
               gap <= kSimultaneous * world.h * std::abs(motion.v + a_n * t);
  }

  RowVelocities<Real> u{world.bodies.velocity[row.body_a].v, world.bodies.velocity[row.body_a].w,
                        world.bodies.velocity[row.body_b].v, world.bodies.velocity[row.body_b].w};
  const RowVelocities<Real> before = u;
  Real wanted[ContactRow<Real>::kMaxPoints]{}, l_n[ContactRow<Real>::kMaxPoints]{},
      l_1[ContactRow<Real>::kMaxPoints]{}, l_2[ContactRow<Real>::kMaxPoints]{};
  const auto arms = [&](int i, Vec& ra, Vec& rb) {
    const Vec place = now.points[i].a * now.t1 + now.points[i].b * now.t2;
    ra = now.arm_a + place;
    rb = now.arm_b + place;
  };
  const auto relative = [&](Vec ra, Vec rb) {
    return u.vb + cross(u.wb, rb) - u.va - cross(u.wa, ra) + t * a_rel;
  };
  Real approach = 0;
  for (int i = 0; i < row.count; ++i) {
    if (!meets[i]) continue;
    Vec ra, rb;
    arms(i, ra, rb);
    const Real vn = dot(now.n, relative(ra, rb));
    wanted[i] = -row.restitution * std::min(vn, Real(0));
    approach = std::max(approach, -vn);
  }
  // Angular momentum received, summed as r x P so that it is exactly opposite on both bodies.
  Vec P{0, 0, 0}, torque_a{0, 0, 0}, torque_b{0, 0, 0};
  const auto push = [&](Vec impulse, Vec ra, Vec rb) {
    u.va -= multiply_each(now.inverse_mass_a, impulse);
    u.wa -= now.inverse_inertia_a * cross(ra, impulse);
    u.vb += multiply_each(now.inverse_mass_b, impulse);
    u.wb += now.inverse_inertia_b * cross(rb, impulse);
    P += impulse;
    torque_a += cross(ra, impulse);
    torque_b += cross(rb, impulse);
  };
  const auto response = [&](Vec d1, Vec d2, Vec ra, Vec rb) {
    return dot(d1, multiply_each(now.inverse_mass_a, d2) + multiply_each(now.inverse_mass_b, d2)) +
           dot(cross(ra, d1), now.inverse_inertia_a * cross(ra, d2)) +
           dot(cross(rb, d1), now.inverse_inertia_b * cross(rb, d2));
  };
  for (int sweep = 0; sweep < kBounceSweeps; ++sweep) {
    Real largest = 0, change_of = 0;
    for (int i = 0; i < row.count; ++i) {
      if (!meets[i]) continue;
      Vec ra, rb;
      arms(i, ra, rb);
      const Real k_n = response(now.n, now.n, ra, rb);
      const Real total = std::max(l_n[i] + (wanted[i] - dot(now.n, relative(ra, rb))) / k_n, Real(0));
      const Real d_n = total - l_n[i];
      l_n[i] = total;
      push(d_n * now.n, ra, rb);
      change_of = std::max(change_of, std::abs(d_n));
      largest = std::max(largest, total);
      if (!(row.friction > Real(0))) continue;
      const Vec v = relative(ra, rb);
      const Real k11 = response(now.t1, now.t1, ra, rb), k12 = response(now.t1, now.t2, ra, rb),
                 k22 = response(now.t2, now.t2, ra, rb);
      const Real determinant = k11 * k22 - k12 * k12;
      if (!(determinant > Real(0))) continue;
      const Real v1 = dot(now.t1, v), v2 = dot(now.t2, v);
      Real f1 = l_1[i] - (k22 * v1 - k12 * v2) / determinant;
      Real f2 = l_2[i] - (k11 * v2 - k12 * v1) / determinant;
      const Real limit = row.friction * l_n[i], size = std::sqrt(f1 * f1 + f2 * f2);
      if (size > limit) {
        f1 *= limit / size;
        f2 *= limit / size;
      }
      push((f1 - l_1[i]) * now.t1 + (f2 - l_2[i]) * now.t2, ra, rb);
      l_1[i] = f1;
      l_2[i] = f2;
    }
    if (change_of <= std::numeric_limits<Real>::epsilon() * largest) break;
  }
  deflect(impacts, row.body_a, u.va - before.va, u.wa - before.wa, -torque_a, t);
  deflect(impacts, row.body_b, u.vb - before.vb, u.wb - before.wb, torque_b, t);
  ++row.bounces;
  ++world.report.impacts;
  for (int i = 0; i < row.count; ++i) {
    row.points[i].impulse_sum += l_n[i];
    row.points[i].friction1_sum += l_1[i];
    row.points[i].friction2_sum += l_2[i];
  }
  const Pair& pair = world.pairs[row.pair];
  HitEvent hit;
  hit.a = world.colliders.id(pair.collider_a());
  hit.b = world.colliders.id(pair.collider_b());
  hit.body_a = {pair.body_a, world.bodies.info[pair.body_a].generation};
  hit.body_b = {pair.body_b, world.bodies.info[pair.body_b].generation};
  const std::uint32_t dense_a = world.bodies.info[pair.body_a].dense;
  hit.point = to_public_position(world.bodies.pose[dense_a].x +
                                 cast<PosReal>(now.arm_a + world.delta[row.body_a].dp));
  hit.normal = to_public(now.n);
  hit.approach_speed = approach;
  hit.impulse = length(P);
  world.gathering.hits.push_back(hit);
}

// After the bounces: which rows does the contact solver leave alone in this substep?
void share_with_contact_solver(Impacts& impacts) {
  WorldState& world = impacts.world;
  for (const std::uint32_t k : world.bouncing_rows) {
    ContactRow<Real>& row = world.rows[k];
    const auto change = separation_change(row, world.delta[row.body_a], world.delta[row.body_b]);
    const Real a = dot(row.n, impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a));
    const Real h = world.h;
    Real closing_now = -kNever, closing_at_end = -kNever;
    for (int i = 0; i < row.count; ++i) {
      const PointMotion motion = point_motion(world, row, i, change);
      closing_now = std::max(closing_now, -motion.v);
      closing_at_end = std::max(closing_at_end, -(motion.v + a * h));
    }
    const bool left_by_bounce = row.bounces > 0 && closing_now < Real(0);
    // Too fast to be stopped: it bounces in this substep or in a later one. (The contact solver ends a
    // substep at v h + a h^2, half an a h^2 too deep, and would stop it just before it touches.)
    const bool will_bounce = !row.at_rest && closing_at_end > impacts.cut(row) + row.cut_unit &&
                             row.bounces < tolerance::kMaxBouncesPerSubstep;
    row.skip = left_by_bounce || will_bounce;
    if (row.skip) {
      row.at_rest = false;
      for (int i = 0; i < row.count; ++i) {
        row.points[i].impulse = row.points[i].friction1 = row.points[i].friction2 = Real(0);
      }
    }
  }
  // Where a bounce shifted a start point, overlap is an artefact of the shift: push gently.
  for (ContactRow<Real>& row : world.rows) {
    const bool shifted = world.substep[row.body_a].bounced || world.substep[row.body_b].bounced;
    row.push_speed_now = shifted ? std::min(row.push_speed, row.cut_unit) : row.push_speed;
  }
}

}  // namespace

void run_impacts(WorldState& world) {
  const std::size_t count = world.bouncing_rows.size();
  Impacts impacts{world, std::vector<Meeting>(count),
                  std::vector<Real>(world.bodies.awake_end, Real(0)),
                  std::vector<std::uint32_t>(world.bodies.awake_end, kNone),
                  std::vector<std::uint8_t>(world.bodies.awake_end, 1)};
  for (const std::uint32_t k : world.bouncing_rows) world.rows[k].bounces = 0;
  for (int pass = 0; pass < tolerance::kMaxImpactPasses; ++pass) {
    std::fill(impacts.best.begin(), impacts.best.end(), kNone);
    const auto offer = [&](std::uint32_t body, std::uint32_t i) {
      if (!world.substep[body].constrained) return;
      std::uint32_t& best = impacts.best[body];
      if (best == kNone || impacts.meetings[i].time < impacts.meetings[best].time) best = i;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      const ContactRow<Real>& row = world.rows[world.bouncing_rows[i]];
      if (impacts.stale[row.body_a] != 0 || impacts.stale[row.body_b] != 0)
        impacts.meetings[i] = find_meeting(impacts, row);
      if (impacts.meetings[i].time == kNever) continue;
      offer(row.body_a, i);
      offer(row.body_b, i);
    }
    std::fill(impacts.stale.begin(), impacts.stale.end(), std::uint8_t{0});
    bool any = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      ContactRow<Real>& row = world.rows[world.bouncing_rows[i]];
      if (impacts.meetings[i].time == kNever) continue;
      const auto earliest = [&](std::uint32_t body) {
        return !world.substep[body].constrained || impacts.best[body] == i;
      };
      if (!earliest(row.body_a) || !earliest(row.body_b)) continue;
      bounce(impacts, row, impacts.meetings[i]);
      any = true;
    }
    if (!any) break;
  }
  share_with_contact_solver(impacts);
}

}  // namespace plumb::inline PLUMB_ABI::detail
