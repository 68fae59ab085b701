// What has come apart is closed in positions alone: velocities, and with them energy, have no part
// in it [Cline 2003]. Only where an error is larger than closed_enough(): the solving pass has
// aimed at none.
//
// The step dx = M^-1 J^T l, (J M^-1 J^T + C) l = -error, is right to first order in how far it
// turns bodies. It goes no farther than where what it leaves out, size turn^2 / 2, reaches the part
// kLeftOut of the error. A chain drawn straight can close only sideways, and there a small error
// asks for a long way, again and again while a load draws it open: a step that would go too far is
// solved once more with damping in C, which bends it away from such ways [Levenberg 1944].
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/symmetric_inverse.h"
#include "solver/body_substep.h"
#include "solver/joints/coordinates.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// [m] or [rad] by which an error of row k is measured, and what may be closed in one substep.
Real size_of(const JointBlock& block, int k) {
  return is_linear(block.row[k].coordinate) ? block.size : Real(1);
}
Real most_of(const JointBlock& block, int k, Real h) {
  return h * (is_linear(block.row[k].coordinate) ? joint_tolerance::kPushSizesPerSecond * block.size
                                                 : joint_tolerance::kPushTurn);
}

// What a row can move without levers: a long lever makes much of a body turn easily, which is no
// reason to let a joint gape. [1/kg], or [1/(kg m^2)] where it only turns.
double mobility(const JointBlock& block, int k) {
  Real linear = 0, angular = 0;
  for (int i = 0; i < block.bodies; ++i) {
    if (!block.moves[i]) continue;
    const BodyJacobian& J = block.J[k * block.bodies + i];
    linear += dot(J.linear, multiply_each(block.inverse_mass[i], J.linear));
    angular += dot(J.angular, block.inverse_inertia[i] * J.angular);
  }
  return static_cast<double>(linear > Real(0) ? linear : angular);
}

// Calls task(body, path [m], turn [rad]) for what a block has its bodies do: M^-1 J^T l.
template <class Task>
void for_steps(const JointScratch& scratch, std::uint32_t place, Task&& task) {
  const JointBlock& block = scratch.blocks[place];
  const SystemRow* rows = &scratch.system.rows[std::size_t{kMaxJointRows} * place];
  for (int k = 0; k < block.bodies; ++k) {
    if (!block.moves[k]) continue;
    Vec linear{0, 0, 0}, angular{0, 0, 0};
    for (int i = 0; i < block.rows; ++i) {
      if (i >= block.held && !rows[i].acts) continue;
      const BodyJacobian& J = block.J[i * block.bodies + k];
      const Real l = static_cast<Real>(rows[i].value);
      linear += l * J.linear;
      angular += l * J.angular;
    }
    task(block.body[k], multiply_each(block.inverse_mass[k], linear),
         block.inverse_inertia[k] * angular);
  }
}

// The part of the step that may be gone [-]. error: the largest one, in sizes or radians.
Real share_of_step(const WorldState& world, const JointPiece& piece, Real error) {
  struct Step {
    Vec path, turn;
  };
  static thread_local std::vector<Step> steps;  // per body; kept for its storage only
  const JointScratch& scratch = *world.joints.scratch;
  steps.resize(world.bodies.awake_end);
  for_bodies(scratch, piece, [&](std::uint32_t i) { steps[i] = {{0, 0, 0}, {0, 0, 0}}; });
  Real sizes = 0;
  for (std::uint32_t p = piece.begin; p < piece.end; ++p) {
    sizes += scratch.blocks[p].size;
    for_steps(scratch, p, [&](std::uint32_t i, Vec path, Vec turn) {
      steps[i].path += path;
      steps[i].turn += turn;
    });
  }
  Real path = 0, turn = 0;  // squares
  for_bodies(scratch, piece, [&](std::uint32_t i) {
    path = std::max(path, length_squared(steps[i].path));
    turn = std::max(turn, length_squared(steps[i].turn));
  });
  // No body goes farther than what all joints of the group may close together.
  const Real farthest = std::abs(piece.h) * joint_tolerance::kPushSizesPerSecond * sizes;
  const Real closed = std::min(error, std::abs(piece.h) * joint_tolerance::kPushTurn);
  const Real allowed = Real(2) * joint_tolerance::kLeftOut * closed;  // [rad^2]
  Real share = 1;
  if (turn > allowed) share = std::sqrt(allowed / turn);
  if (path > farthest * farthest) share = std::min(share, farthest / std::sqrt(path));
  return share;
}

void displace(WorldState& world, std::uint32_t place, Real share) {
  for_steps(*world.joints.scratch, place, [&](std::uint32_t i, Vec path, Vec turn) {
    BodyDelta& delta = world.delta[i];
    delta.dp += share * path;
    delta.dq = normalized(from_rotation_vector(share * turn) * delta.dq);
  });
}

// The body's own angular momentum stays; what follows from it and the attitude does not.
void refresh(WorldState& world, std::uint32_t i) {
  SubstepBody& s = world.substep[i];
  world.bodies.velocity[i].w = angular_velocity_of(world.bodies.mass[i], orientation_now(world, i),
                                                   world.bodies.momentum[i].L);
  s.w_in = world.bodies.velocity[i].w;
  if (s.split) turn_inertia(world, i);
}

// [kg m^2/s] of the bodies' paths, about where the first of them was.
struct Orbit {
  Vec L{0, 0, 0};
  Vec moment{0, 0, 0};  // [kg m]
  Real mass = 0;
};
Vec place(const WorldState& world, std::uint32_t i, std::uint32_t origin) {
  return cast<Real>(world.bodies.pose[i].x - world.bodies.pose[origin].x) + world.delta[i].dp;
}
Orbit orbit_of(const WorldState& world, const JointPiece& piece, std::uint32_t origin) {
  Orbit orbit;
  for_bodies(*world.joints.scratch, piece, [&](std::uint32_t i) {
    const Real m = world.bodies.mass[i].mass;
    const Vec r = place(world, i, origin);
    orbit.L += m * cross(r, world.bodies.velocity[i].v);
    orbit.moment += m * r;
    orbit.mass += m;
  });
  return orbit;
}

// Bodies that were shifted while they fly keep their linear momentum, but not the angular momentum
// of their paths. What a free group has gained it gives back turning as a whole, which no joint
// resists.
void keep_angular_momentum(WorldState& world, const JointPiece& piece, std::uint32_t origin,
                           const Orbit& before) {
  const Orbit after = orbit_of(world, piece, origin);
  const Vec center = (Real(1) / after.mass) * after.moment;
  Symmetric3<Real> I{}, I_inverse{};
  for_bodies(*world.joints.scratch, piece, [&](std::uint32_t i) {
    const Vec r = place(world, i, origin) - center;
    const Real m = world.bodies.mass[i].mass, r2 = length_squared(r);
    const Symmetric3<Real>& own = world.substep[i].I;
    I.xx += own.xx + m * (r2 - r.x * r.x);
    I.yy += own.yy + m * (r2 - r.y * r.y);
    I.zz += own.zz + m * (r2 - r.z * r.z);
    I.xy += own.xy - m * r.x * r.y;
    I.xz += own.xz - m * r.x * r.z;
    I.yz += own.yz - m * r.y * r.z;
  });
  if (!invert(I, joint_tolerance::kRegular, I_inverse)) return;
  const Vec turn = I_inverse * (before.L - after.L);
  for_bodies(*world.joints.scratch, piece, [&](std::uint32_t i) {
    BodyVelocity& velocity = world.bodies.velocity[i];
    velocity.v += cross(turn, place(world, i, origin) - center);
    velocity.w += turn;  // to angular momentum with all that the rows will do (collect_momentum)
  });
}

// [m] or [rad] by which row k is off: a held one either way, a rigid limit beyond its end.
Real error_of(const JointBlock& block, int k) {
  const JointRow& row = block.row[k];
  if (k < block.held) return row.value - row.target;
  const FreeRow& free = block.free[k - block.held];
  if (!free.limited || free.limit_frequency > Real(0)) return Real(0);
  return std::min(row.value - free.lower, Real(0)) + std::max(row.value - free.upper, Real(0));
}

// Sets up the rows, C with so much damping [-]. Limits only push: `again` leaves out those that
// have been let go. Returns the largest error, in sizes or radians.
Real ask_for_closing(JointScratch& scratch, const JointPiece& piece, double damping, bool again) {
  Real largest = 0;
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
    const JointBlock& block = scratch.blocks[i];
    SystemRow* rows = &scratch.system.rows[std::size_t{kMaxJointRows} * i];
    for (int k = 0; k < block.rows; ++k) {
      const bool open = k < block.held || !again || rows[k].acts;
      rows[k] = {};
      const Real error = open ? error_of(block, k) : Real(0);
      if (k >= block.held && error == Real(0)) continue;
      largest = std::max(largest, std::abs(error) / size_of(block, k));
      const Real most = most_of(block, k, std::abs(piece.h));
      rows[k].acts = true;
      if (damping > 0) rows[k].give = damping * mobility(block, k);
      rows[k].value =
          -static_cast<double>(std::min(std::max(block.correction * error, -most), most));
    }
  }
  return largest;
}

// Lets go of limits that would pull. Returns whether there were any.
bool let_go(JointScratch& scratch, const JointPiece& piece) {
  bool any = false;
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
    const JointBlock& block = scratch.blocks[i];
    SystemRow* rows = &scratch.system.rows[std::size_t{kMaxJointRows} * i];
    for (int k = block.held; k < block.rows; ++k) {
      if (!rows[k].acts || !(rows[k].value * static_cast<double>(error_of(block, k)) > 0)) continue;
      rows[k].acts = false;
      any = true;
    }
  }
  return any;
}

// Solves for the step. Returns the part of it that may be gone.
Real find_step(WorldState& world, const JointPiece& piece, double damping, Real& error) {
  JointScratch& scratch = *world.joints.scratch;
  bool again = false;
  do {
    const Real largest = ask_for_closing(scratch, piece, damping, again);
    if (!again) error = largest;
    if (!(error > closed_enough(world))) return Real(0);
    factor_piece(scratch.system, scratch.blocks, piece);
    solve_factored(scratch.system, scratch.blocks, piece);
    again = let_go(scratch, piece);
  } while (again);
  return share_of_step(world, piece, error);
}

}  // namespace

Real closed_enough(const WorldState& world) {
  return world.settings.joint_order == 4 ? joint_tolerance::kClosedTight : joint_tolerance::kClosed;
}

void close_joints_of(WorldState& world, const JointPiece& piece) {
  JointScratch& scratch = *world.joints.scratch;
  Real error = 0;
  Real share = find_step(world, piece, 0, error);
  if (!(error > closed_enough(world))) return;
  if (share < Real(1)) share = find_step(world, piece, joint_tolerance::kClosingDamping, error);
  const std::uint32_t origin = scratch.members[scratch.order[piece.begin]].body[0];
  Orbit before;
  if (!piece.anchored) before = orbit_of(world, piece, origin);
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) displace(world, i, share);
  for_bodies(scratch, piece, [&](std::uint32_t i) { refresh(world, i); });
  if (!piece.anchored) keep_angular_momentum(world, piece, origin, before);
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) prepare_joint(world, scratch.blocks[i]);
}

}  // namespace plumb::inline PLUMB_ABI::detail
