// Bounces at their own time inside the substep.
//
// Until something hits it, a body follows x(t) = x + v t + a t^2/2. An impulse at time t changes v
// by dv; shifting the start point by -t dv keeps the position at t continuous, so every trajectory
// keeps its own energy and an elastic impulse keeps the total exactly, whatever the time step.
//
//   repeat
//     for every bouncing row: T = when do its surfaces meet, on the present trajectories?
//     rows that are the earliest of both their bodies: reflect, shift, note the time
//   until nothing happens
//
// Rows that are no one's earliest wait: their turn comes in a later pass, on new trajectories. What
// is too slow to bounce, or overlaps at the end, is left to the contact solver.
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
// Sweeps over the points of one bounce [-]. It ends when nothing changes: 2 for one or two points,
// some 50 for a flat box.
constexpr int kBounceSweeps = 256;

struct Meeting {
  Real time = kNever;   // [s] within the substep
  Vec normal{0, 1, 0};  // A to B at that time
};

struct Impacts {
  WorldState& world;
  StepList<Meeting> meetings;    // per bouncing row
  StepList<Real> local_time;     // per dense body: its last event [s]
  StepList<std::uint32_t> best;  // per dense body: its earliest bouncing row
  StepList<std::uint8_t> stale;  // per dense body: hit in the last pass

  Vec acceleration(std::uint32_t body) const {
    return world.substep[body].constrained ? world.substep[body].acceleration : Vec{0, 0, 0};
  }
  Real cut(const ContactRow<Real>& row) const {
    return row.cut_unit * (row.at_rest ? tolerance::kBounceCutResting : tolerance::kBounceCutNew);
  }
};

// Smallest t in [t0, h] with s + v t + a t^2/2 = 0 while closing; t0 if already overlapping and
// closing.
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
  const Vec p_start = row.between + world.delta[row.body_b].dp - world.delta[row.body_a].dp;
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
  const Vec v = vb.v + cross(vb.w, row.core_b + place) - va.v - cross(va.w, row.core_a + place);
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

// One side of a bounce at its time t: where the body is and how it yields.
struct Side {
  Rotation q;   // principal axes to world
  Vec L, v, w;  // [kg m^2/s], [m/s], [rad/s]
  Symmetric3<Real> inverse_inertia;
  Vec inverse_mass;
  Vec core;                      // [m] arm that has turned with the body
  Vec place_axis1, place_axis2;  // the contact plane's axes as this body has carried them
  Vec surface;                   // [m] from the core to the surface, along the normal
};

Side side_at(const WorldState& world, const ContactRow<Real>& row, bool is_a, Vec normal, Real t) {
  const std::uint32_t body = is_a ? row.body_a : row.body_b;
  const BodyMass& m = world.bodies.mass[body];
  const BodyVelocity& velocity = world.bodies.velocity[body];
  const Rotation start = world.bodies.pose[body].q;
  Side s{world.delta[body].dq * start,
         world.bodies.momentum[body].L,
         velocity.v,
         velocity.w,
         {},
         {},
         {},
         {},
         {},
         {}};
  if (world.substep[body].constrained) {
    turn_freely(RotationMethod::Exact, m, s.q, s.L, t);
    s.v += t * world.substep[body].acceleration;
    s.w = angular_velocity_of(m, s.q, s.L);
    s.inverse_inertia = world_inverse_inertia(m, s.q);
    s.inverse_mass = m.inverse_mass;
  }
  const Rotation turned = s.q * conjugate(start);
  s.core = rotate(turned, is_a ? row.core_a : row.core_b);
  s.place_axis1 = rotate(turned, row.t1);
  s.place_axis2 = rotate(turned, row.t2);
  if (row.exact_spheres) s.core = {0, 0, 0};
  s.surface = is_a ? row.surface_a * normal : -row.surface_b * normal;
  return s;
}

// Gives a body its state after a bounce at time t: the velocity jumps, the path stays continuous.
// The rotation is carried to t and back by the exact flow, so that turning loses no energy either.
void deflect(Impacts& impacts, std::uint32_t body, const Side& after, Vec dv, Real t) {
  WorldState& world = impacts.world;
  SubstepBody& s = world.substep[body];
  if (!s.constrained) return;
  world.bodies.velocity[body].v += dv;
  world.delta[body].dp -= t * dv;
  Rotation q = after.q;
  Vec L = after.L;
  turn_freely(RotationMethod::Exact, world.bodies.mass[body], q, L, -t);
  world.bodies.momentum[body].L = L;
  world.delta[body].dq = normalized(q * conjugate(world.bodies.pose[body].q));
  world.bodies.velocity[body].w = angular_velocity_of(world.bodies.mass[body], q, L);
  s.bounced = true;
  impacts.local_time[body] = t;
  impacts.stale[body] = 1;
}

void note_bounce(WorldState& world, const ContactRow<Real>& row, Vec normal, PosVec point,
                 Real approach, Real impulse) {
  const Pair& pair = world.pairs[world.contacts[row.contact].pair];
  HitEvent hit;
  hit.a = world.colliders.id(pair.collider_a());
  hit.b = world.colliders.id(pair.collider_b());
  hit.body_a = {pair.body_a, world.bodies.info[pair.body_a].generation};
  hit.body_b = {pair.body_b, world.bodies.info[pair.body_b].generation};
  hit.point = to_public_position(point);
  hit.normal = to_public(normal);
  hit.approach_speed = approach;
  hit.impulse = impulse;
  world.gathering.hits.push_back(hit);
}

// Newton's restitution at all points that meet now, together: sequential impulses until every
// approaching point leaves at -e times its approach. Friction of the bounce stays on the cone.
void bounce(Impacts& impacts, ContactRow<Real>& row, const Meeting& meeting) {
  WorldState& world = impacts.world;
  const Real t = meeting.time;
  const Vec n = meeting.normal;
  Vec t1, t2;
  tangent_frame(n, t1, t2);
  if (row.along != Real(1)) {  // in axes in which the cone is round (contact_kernel.h)
    const Vec across = cross(n, row.t1);
    t2 = (Real(1) / length(across)) * across;
    t1 = row.along * cross(t2, n);
  }
  Side A = side_at(world, row, true, n, t), B = side_at(world, row, false, n, t);
  const Vec va_before = A.v, vb_before = B.v;

  struct Point {
    Vec ra, rb;
    Vec drive;                       // [m/s] of B's surface over A's
    Real wanted = 0, k_n = 0;        // [m/s], [1/kg]
    Real k11 = 0, k12 = 0, k22 = 0;  // [1/kg] tangential response
    Real l_n = 0, l_1 = 0, l_2 = 0;  // [N s]
    int index = 0;
  };
  Point points[ContactRow<Real>::kMaxPoints];
  int count = 0;
  const auto relative = [&](const Point& p) {
    return B.v + cross(B.w, p.rb) - A.v - cross(A.w, p.ra);
  };
  const auto response = [&](Vec d1, Vec d2, const Point& p) {
    return dot(d1, multiply_each(A.inverse_mass, d2) + multiply_each(B.inverse_mass, d2)) +
           dot(cross(p.ra, d1), A.inverse_inertia * cross(p.ra, d2)) +
           dot(cross(p.rb, d1), B.inverse_inertia * cross(p.rb, d2));
  };
  const auto change = separation_change(row, world.delta[row.body_a], world.delta[row.body_b]);
  const Real a_n = dot(n, impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a));
  Real approach = 0;
  for (int i = 0; i < row.count; ++i) {
    const PointMotion motion = point_motion(world, row, i, change);
    const Real gap = motion.s + t * (motion.v + Real(0.5) * a_n * t);
    if (!row.exact_spheres && gap > kSimultaneous * world.h * std::abs(motion.v + a_n * t))
      continue;
    const auto arm = [&](const Side& side) {
      return side.core + row.points[i].a * side.place_axis1 + row.points[i].b * side.place_axis2 +
             side.surface;
    };
    Point& p = points[count++];
    p.ra = arm(A);
    p.rb = arm(B);
    p.drive = (row.drive.x - row.points[i].b * row.drive.z) * row.t1 +
              (row.drive.y + row.points[i].a * row.drive.z) * row.t2;
    p.index = i;
    if (row.both_dynamic) {  // one common point keeps the angular momentum
      const Vec apart = row.between + world.delta[row.body_b].dp - world.delta[row.body_a].dp +
                        t * (B.v - A.v) -
                        (Real(0.5) * t * t) *
                            (impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a)) +
                        p.rb - p.ra;
      p.ra += Real(0.5) * apart;
      p.rb -= Real(0.5) * apart;
    }
    const Real vn = dot(n, relative(p));
    p.wanted = -row.restitution * std::min(vn, Real(0));
    p.k_n = response(n, n, p);
    p.k11 = response(t1, t1, p);
    p.k12 = response(t1, t2, p);
    p.k22 = response(t2, t2, p);
    approach = std::max(approach, -vn);
  }
  const auto push = [&](Vec impulse, const Point& p) {
    A.v -= multiply_each(A.inverse_mass, impulse);
    B.v += multiply_each(B.inverse_mass, impulse);
    const Vec on_a = cross(p.ra, impulse), on_b = cross(p.rb, impulse);
    A.w -= A.inverse_inertia * on_a;
    B.w += B.inverse_inertia * on_b;
    A.L -= on_a;
    B.L += on_b;
  };
  for (int sweep = 0; sweep < kBounceSweeps; ++sweep) {
    Real largest = 0, largest_change = 0;
    for (int i = 0; i < count; ++i) {
      Point& p = points[i];
      const Real total = std::max(p.l_n + (p.wanted - dot(n, relative(p))) / p.k_n, Real(0));
      const Real d_n = total - p.l_n;
      p.l_n = total;
      push(d_n * n, p);
      largest_change = std::max(largest_change, std::abs(d_n));
      largest = std::max(largest, total);
      if (!(row.friction > Real(0))) continue;
      const Vec v = relative(p) + p.drive;
      const Real determinant = p.k11 * p.k22 - p.k12 * p.k12, trace = p.k11 + p.k22;
      if (!(trace > Real(0))) continue;
      const Real v1 = dot(t1, v), v2 = dot(t2, v);
      const bool regular = determinant > kSingular * trace * trace;
      Real f1 = p.l_1 - (regular ? (p.k22 * v1 - p.k12 * v2) / determinant : v1 / trace);
      Real f2 = p.l_2 - (regular ? (p.k11 * v2 - p.k12 * v1) / determinant : v2 / trace);
      const Real limit = row.friction * p.l_n, size = std::sqrt(f1 * f1 + f2 * f2);
      if (size > limit) {
        f1 *= limit / size;
        f2 *= limit / size;
      }
      push((f1 - p.l_1) * t1 + (f2 - p.l_2) * t2, p);
      p.l_1 = f1;
      p.l_2 = f2;
    }
    if (largest_change <= std::numeric_limits<Real>::epsilon() * largest) break;
  }
  Real impulse = 0;
  Vec middle{0, 0, 0};
  for (int i = 0; i < count; ++i) {
    const Point& p = points[i];
    impulse += p.l_n;
    middle += (Real(1) / static_cast<Real>(count)) * (row.body_a != 0 ? p.ra : p.rb);
    // Two spheres meet along a normal of their own; what is reported is in the row's axes.
    const Vec given = p.l_n * n + p.l_1 * t1 + p.l_2 * t2;
    row.points[p.index].impulse_sum += dot(row.n, given);
    row.points[p.index].friction1_sum += dot(row.t1, given);
    row.points[p.index].friction2_sum += dot(row.t2, given);
  }
  if (approach > Real(0)) {  // points that part already, or rest, are no hit
    const std::uint32_t seen_from = row.body_a != 0 ? row.body_a : row.body_b;
    const Vec moved =
        world.delta[seen_from].dp + t * (world.bodies.velocity[seen_from].v +
                                         (Real(0.5) * t) * impacts.acceleration(seen_from));
    note_bounce(world, row, n, world.bodies.pose[seen_from].x + cast<PosReal>(moved + middle),
                approach, impulse);
    ++world.report.impacts;
  }
  deflect(impacts, row.body_a, A, A.v - va_before, t);
  deflect(impacts, row.body_b, B, B.v - vb_before, t);
  ++row.bounces;
  row.bounced = true;
}

// After the bounces: which rows does the contact solver leave alone in this substep?
void share_with_contact_solver(Impacts& impacts) {
  WorldState& world = impacts.world;
  for (const std::uint32_t k : world.bouncing_rows) {
    ContactRow<Real>& row = world.rows[k];
    const auto change = separation_change(row, world.delta[row.body_a], world.delta[row.body_b]);
    const Real a = dot(row.n, impacts.acceleration(row.body_b) - impacts.acceleration(row.body_a));
    const Real h = world.h;
    Real closing_now = -kNever, closing_at_end = -kNever, gap_at_end = kNever;
    for (int i = 0; i < row.count; ++i) {
      const PointMotion motion = point_motion(world, row, i, change);
      closing_now = std::max(closing_now, -motion.v);
      closing_at_end = std::max(closing_at_end, -(motion.v + a * h));
      gap_at_end = std::min(gap_at_end, motion.s + h * (motion.v + Real(0.5) * a * h));
    }
    const bool bounced_away = row.bounces > 0 && closing_now < Real(0);
    // Apart at the end although it turns back: the contact solver knows only where the shifted path
    // starts, and would stop it there.
    const bool turns_back = bounced_away && closing_at_end >= Real(0) && gap_at_end > Real(0);
    // Not yet there, or too fast to be stopped: it bounces in a later substep. (The contact solver
    // ends a substep at v h + a h^2, half an a h^2 too deep, and would stop it just before it
    // touches.)
    const bool will_bounce =
        !row.at_rest && row.bounces < tolerance::kMaxBouncesPerSubstep &&
        (gap_at_end > Real(0) || closing_at_end > impacts.cut(row) + row.cut_unit);
    row.skip = turns_back || will_bounce;
    row.keeps_apart = bounced_away && !row.skip;
    if (row.skip || row.keeps_apart) {
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
    // Of what has just bounced off nothing is left to do, unless others press it back.
    if (row.keeps_apart) row.push_speed_now = Real(0);
    row.keeps_apart = false;
  }
}

}  // namespace

void run_impacts(WorldState& world) {
  const std::size_t count = world.bouncing_rows.size();
  StepMemory* const memory = &world.memory;
  const std::uint32_t bodies = world.bodies.awake_end;
  Impacts impacts{world, StepList<Meeting>(count, memory), StepList<Real>(bodies, Real(0), memory),
                  StepList<std::uint32_t>(bodies, kNone, memory),
                  StepList<std::uint8_t>(bodies, 1, memory)};
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
