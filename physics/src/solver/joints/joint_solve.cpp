// Warm start and passes over one joint (joint_solver.h has the equations).
#include <cmath>

#include "solver/joints/joint_poses.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

BlockVelocities read(const WorldState& world, const JointBlock& block) {
  BlockVelocities u;
  for (int k = 0; k < block.bodies; ++k) {
    const BodyVelocity& velocity = world.bodies.velocity[block.body[k]];
    u.v[k] = velocity.v;
    u.w[k] = velocity.w;
  }
  return u;
}
// Bodies that are not dynamic may stand in many joints of a colour; they are never written.
void write(WorldState& world, const JointBlock& block, const BlockVelocities& u) {
  for (int k = 0; k < block.bodies; ++k) {
    if (!block.moves[k]) continue;
    BodyVelocity& velocity = world.bodies.velocity[block.body[k]];
    velocity.v = u.v[k];
    velocity.w = u.w[k];
  }
}
Real rate(const JointBlock& block, int row, const BlockVelocities& u) {
  Real sum = 0;
  for (int k = 0; k < block.bodies; ++k) {
    const BodyJacobian& J = block.J[row * block.bodies + k];
    sum += dot(J.linear, u.v[k]) + dot(J.angular, u.w[k]);
  }
  return sum;
}
void apply(const JointBlock& block, const Real* impulse, BlockVelocities& u) {
  for (int k = 0; k < block.bodies; ++k) {
    if (!block.moves[k]) continue;
    Vec linear{0, 0, 0}, angular{0, 0, 0};
    for (int i = 0; i < block.rows; ++i) {
      const BodyJacobian& J = block.J[i * block.bodies + k];
      linear += impulse[i] * J.linear;
      angular += impulse[i] * J.angular;
    }
    u.v[k] += multiply_each(block.inverse_mass[k], linear);
    u.w[k] += block.inverse_inertia[k] * angular;
  }
}

Real clamp(Real a, Real size) { return std::min(std::max(a, -size), size); }

// The free rows of a joint while they are being solved, in the space in which the held ones hold.
struct FreeSpace {
  JointBlock& block;
  JointPass pass;
  Real T, h;              // [s] time for which the pass acts; substep
  Real u[kMaxJointRows];  // rates now
  Real u_begin[kMaxJointRows];
  Real end_begin[kMaxJointRows];  // coordinates predicted with u_begin
  Real l[kMaxJointRows] = {};     // impulses added

  [[nodiscard]] int count() const { return block.rows - block.held; }
  [[nodiscard]] JointRow& row(int f) const { return block.row[block.held + f]; }
  Real& part(int f, RowPart p) const {
    RowImpulses& impulses = row(f).impulses;
    return block.split && pass == JointPass::Relax ? impulses.second[p] : impulses.first[p];
  }
  [[nodiscard]] Real end(int f) const { return end_begin[f] + h * (u[f] - u_begin[f]); }
  void add(int f, Real impulse) {
    l[f] += impulse;
    for (int g = 0; g < count(); ++g) u[g] += block.S[g][f] * impulse;
  }
  // Brings part p to `wanted`.
  void set(int f, RowPart p, Real wanted) {
    Real& now = part(f, p);
    const Real step = wanted - now;
    now = wanted;
    add(f, step);
  }
};

// One step of a spring's equation l = -T (k x + c u), x the displacement half-way (or at the end).
Real spring_step(const FreeSpace& s, int f, Real rest, Real k, Real c, Real impulse) {
  const Real value = s.row(f).value, end = s.end(f);
  const Real x = (s.block.split ? Real(0.5) * (value + end) : end) - rest;
  const Real wanted = -s.T * (k * x + c * s.u[f]);
  return (wanted - impulse) / (Real(1) + s.T * (k * s.T + c) * s.block.S[f][f]);
}

void solve_springs(FreeSpace& s, int f) {
  const FreeRow& row = s.block.free[f];
  if (row.spring) {
    Real wanted = s.part(f, kSpring);
    wanted += spring_step(s, f, row.rest, row.stiffness, row.damping, wanted);
    s.set(f, kSpring, row.pulls_only ? std::min(wanted, Real(0)) : wanted);
  }
  if (row.servo && row.servo_frequency > Real(0)) {
    Real wanted = s.part(f, kMotor);
    wanted += spring_step(s, f, row.servo_target, row.servo_stiffness, row.servo_damping, wanted);
    s.set(f, kMotor, clamp(wanted, s.T * row.max_effort));
  }
}

void solve_motor(FreeSpace& s, int f) {
  const FreeRow& row = s.block.free[f];
  const Real inverse_S = Real(1) / s.block.S[f][f];
  Real lack = 0;
  if (row.motor) {
    lack = s.u[f] - row.speed;
  } else if (row.servo && !(row.servo_frequency > Real(0))) {
    lack = s.pass == JointPass::Solve ? (s.end(f) - row.servo_target) / s.h : s.u[f];
  } else {
    return;
  }
  s.set(f, kMotor, clamp(s.part(f, kMotor) - inverse_S * lack, s.T * row.max_effort));
}

void solve_row_friction(FreeSpace& s, int f) {
  const FreeRow& row = s.block.free[f];
  if (!(row.friction > Real(0))) return;
  s.set(f, kFriction, clamp(s.part(f, kFriction) - s.u[f] / s.block.S[f][f], s.T * row.friction));
}

// One side of a limit: sign +1 keeps the coordinate above, -1 below `bound`. Impulses are counted
// positive away from the limit.
void solve_limit_side(FreeSpace& s, int f, RowPart p, Real sign, Real bound) {
  if (!std::isfinite(bound)) return;
  const FreeRow& row = s.block.free[f];
  const Real gap = sign * (s.row(f).value - bound);
  const Real S = s.block.S[f][f];
  Real& now = s.part(f, p);
  if (row.limit_frequency > Real(0)) {
    if (s.pass == JointPass::Relax) return;
    const Real wanted =
        sign * now + spring_step(s, f, bound, row.limit_stiffness, row.limit_damping, sign * now);
    const Real kept = std::max(sign * wanted, Real(0));
    const Real step = kept - now;
    now = kept;
    s.add(f, sign * step);
    return;
  }
  Real lack, least = 0;
  if (s.pass == JointPass::Solve) {
    const Real push = is_linear(s.row(f).coordinate) ? s.block.push_linear : s.block.push_angular;
    lack = sign * (s.end(f) - s.row(f).value) / s.h;
    lack += gap < Real(0) ? std::max(gap / s.h, -push) : gap / s.h;
  } else {
    const Real before = s.row(f).impulses.first[p];
    if (s.block.split) least = -before;  // what was pushed too much before is taken back
    lack = sign * s.u[f] + std::max(gap, Real(0)) / s.h;
    const Real approach = sign * s.row(f).approach;
    if (row.restitution > Real(0) && s.row(f).may_bounce && before > Real(0) && approach < Real(0))
      lack = sign * s.u[f] + row.restitution * approach;
  }
  const Real kept = std::max(now - lack / S, least);
  const Real step = kept - now;
  now = kept;
  s.add(f, sign * step);
}

// A motor without bound must not work against a limit without end.
void settle_unlimited_motor(FreeSpace& s, int f, RowPart p, Real sign) {
  if (std::isfinite(s.block.free[f].max_effort)) return;
  Real& limit = s.part(f, p);
  Real& motor = s.part(f, kMotor);
  const Real both = std::min(limit, -sign * motor);
  if (!(both > Real(0))) return;
  limit -= both;
  motor += sign * both;
}

// Scales the impulses of three rows so that they form a vector no longer than `size`.
void bound_group(FreeSpace& s, int first, RowPart p, Real size) {
  Real square = 0;
  for (int f = first; f < first + 3; ++f) square += s.part(f, p) * s.part(f, p);
  if (!(square > size * size)) return;
  const Real scale = size / std::sqrt(square);
  for (int f = first; f < first + 3; ++f) s.set(f, p, scale * s.part(f, p));
}

void solve_free(FreeSpace& s) {
  const JointBlock& block = s.block;
  const int sweeps = s.count() == 1 && block.simple ? 1 : joint_tolerance::kFreeSweeps;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int f = 0; f < s.count(); ++f) {
      const FreeRow& row = block.free[f];
      if (!(block.S[f][f] > Real(0))) continue;
      // Springs have said in the solving pass what they do until the end of the substep.
      if (s.pass == JointPass::Solve) solve_springs(s, f);
      solve_motor(s, f);
      solve_row_friction(s, f);
      if (!row.limited) continue;
      solve_limit_side(s, f, kLower, Real(1), row.lower);
      settle_unlimited_motor(s, f, kLower, Real(1));
      solve_limit_side(s, f, kUpper, Real(-1), row.upper);
      settle_unlimited_motor(s, f, kUpper, Real(-1));
    }
    if (block.friction_group >= 0)
      bound_group(s, block.friction_group, kFriction,
                  s.T * block.free[block.friction_group].friction);
    for (int g = 0; g < block.motor_groups; ++g)
      if (std::isfinite(block.free[3 * g].max_effort))
        bound_group(s, 3 * g, kMotor, s.T * block.free[3 * g].max_effort);
  }
}

// Both sides of a limit push along the row with opposite signs.
Real total(const RowImpulses& impulses, bool second) {
  const Real* part = second ? impulses.second : impulses.first;
  return part[kHold] + part[kSpring] + part[kMotor] + part[kFriction] + part[kLower] - part[kUpper];
}

// Whether a limit that is hit in this substep bounces, and how fast it is hit: the slower of the
// speeds before and after the forces, so that no bounce gains energy.
void note_approach(JointRow& row, const FreeRow& free, Real now) {
  const Real before = row.rate;
  row.approach = std::abs(before) < std::abs(now) ? before : now;
  Real pushed = 0;
  for (const RowPart side : {kLower, kUpper})
    pushed = std::max(pushed, row.impulses.first[side] + row.impulses.second[side]);
  row.may_bounce = free.restitution > Real(0) && !(pushed > Real(0)) &&
                   std::abs(row.approach) > joint_tolerance::kBounceCut * std::abs(now - before);
}

}  // namespace

void warm_start_joint(WorldState& world, JointBlock& block, JointPass pass) {
  const bool second = pass == JointPass::Relax;
  if (second && !block.split) return;  // one impulse for both passes: it is there already
  BlockVelocities u = read(world, block);
  Real impulse[kMaxJointRows] = {};
  for (int i = 0; i < block.rows; ++i) {
    RowImpulses& impulses = block.row[i].impulses;
    if (i >= block.held) {
      const FreeRow& row = block.free[i - block.held];
      if (!second) {
        note_approach(block.row[i], row, rate(block, i, u));
      } else {
        // The second half of what springs do is the same as the first.
        impulses.second[kSpring] = impulses.first[kSpring];
        if (row.servo && row.servo_frequency > Real(0))
          impulses.second[kMotor] = impulses.first[kMotor];
        if (row.limit_frequency > Real(0)) {
          impulses.second[kLower] = impulses.first[kLower];
          impulses.second[kUpper] = impulses.first[kUpper];
        } else {
          for (const RowPart side : {kLower, kUpper})
            impulses.second[side] = std::max(impulses.second[side], -impulses.first[side]);
        }
      }
    }
    impulse[i] = total(impulses, second);
  }
  apply(block, impulse, u);
  write(world, block, u);
}

namespace {

// Coordinates at the end of the substep. How arms turn on the way is seen with velocities that the
// joint allows: those between passes may be far off, above all the spin of a light body that was
// warm started with last substep's directions.
void predict(const WorldState& world, const JointBlock& block, const BlockVelocities& u,
             const Real* now, Real* end) {
  Real l[kMaxJointRows] = {};
  for (int i = 0; i < block.held; ++i) l[i] = -now[i];
  solve_held(block, l);
  BlockVelocities allowed = u;
  apply(block, l, allowed);
  Moved moved[kMaxJointBodies];
  for (int k = 0; k < block.bodies; ++k) {
    if (block.body[k] == 0) continue;
    const BodyDelta& delta = world.delta[block.body[k]];
    const SubstepBody& s = world.substep[block.body[k]];
    moved[k] = drifted({delta.dp, delta.dq}, allowed.v[k], allowed.w[k], s.I, s.I_inverse, world.h);
  }
  coordinates_at(block, moved, end);
  // Back to the velocities as they are, to first order.
  for (int i = 0; i < block.rows; ++i) {
    Real taken = 0;
    if (i < block.held) {
      taken = now[i];
    } else {
      for (int k = 0; k < block.held; ++k) taken -= block.KW[k][i - block.held] * l[k];
    }
    end[i] += world.h * taken;
  }
}

}  // namespace

void solve_joint(WorldState& world, JointBlock& block, JointPass pass) {
  BlockVelocities u = read(world, block);
  const bool solving = pass == JointPass::Solve;
  const Real h = world.h, inverse_h = Real(1) / h;
  Real now[kMaxJointRows] = {}, end[kMaxJointRows] = {};
  for (int i = 0; i < block.rows; ++i) now[i] = rate(block, i, u);
  Real x[kMaxJointRows] = {}, l[kMaxJointRows] = {};
  for (int i = 0; i < block.held; ++i) x[i] = now[i];
  if (solving) {
    predict(world, block, u, now, end);
    for (int i = 0; i < block.held; ++i) {
      const JointRow& row = block.row[i];
      const Real push = is_linear(row.coordinate) ? block.push_linear : block.push_angular;
      x[i] = inverse_h * (end[i] - row.value) +
             clamp(block.correction * inverse_h * (row.value - row.target), push);
    }
  }
  solve_held(block, x);
  if (solving)
    for (int i = 0; i < block.held; ++i)
      x[i] += joint_tolerance::kHoldLeak * (block.row[i].impulses.first[kHold] - x[i]);

  FreeSpace s{block, pass, block.split ? Real(0.5) * h : h, h, {}, {}, {}, {}};
  for (int f = 0; f < s.count(); ++f) {
    const int i = block.held + f;
    Real answer = 0;  // what the held rows are about to change
    for (int k = 0; k < block.held; ++k) answer += block.KW[k][f] * x[k];
    s.u[f] = s.u_begin[f] = now[i] - answer;
    s.end_begin[f] = end[i] - h * answer;
  }
  solve_free(s);

  for (int f = 0; f < s.count(); ++f) l[block.held + f] = s.l[f];
  for (int i = 0; i < block.held; ++i) {
    l[i] = -x[i];
    for (int f = 0; f < s.count(); ++f) l[i] -= block.W[i][f] * s.l[f];
    RowImpulses& impulses = block.row[i].impulses;
    (solving || !block.split ? impulses.first : impulses.second)[kHold] += l[i];
  }
  apply(block, l, u);
  write(world, block, u);
}

void note_rates(JointBlock& block, const WorldState& world) {
  const BlockVelocities u = read(world, block);
  for (int i = block.held; i < block.rows; ++i) block.row[i].rate = rate(block, i, u);
}

void sum_joint(JointBlock& block, const WorldState& world, JointPass pass) {
  if (!block.split && pass == JointPass::Solve) return;  // the relaxing pass changes it yet
  const bool second = block.split && pass == JointPass::Relax;
  const int b = block.place[1];
  const Vec arm = rotate(world.delta[block.body[b]].dq, block.pair[0].arm_b);
  for (int i = 0; i < block.rows; ++i) {
    JointRow& row = block.row[i];
    const Real* part = second ? row.impulses.second : row.impulses.first;
    for (int p = 0; p < kRowParts; ++p) row.sum[p] += part[p];
    const BodyJacobian& J = block.J[i * block.bodies + b];
    const Real l = total(row.impulses, second);
    block.force_sum += l * J.linear;
    block.torque_sum += l * (J.angular - cross(arm, J.linear));
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
