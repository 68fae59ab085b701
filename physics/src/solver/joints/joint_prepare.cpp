// Where a joint stands: coordinates, Jacobians, and the factored effective masses.
#include <cmath>

#include "solver/joints/joint_poses.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Real kTwoPi = Real(6.283185307179586476925);

BodyJacobian& jacobian(JointBlock& block, int row, int body) {
  return block.J[row * block.bodies + body];
}
void add(BodyJacobian& to, Real scale, const BodyJacobian& from) {
  to.linear += scale * from.linear;
  to.angular += scale * from.angular;
}

void make_jacobians(JointBlock& block, const Moved* moved) {
  PlacedPair at[2];
  for (int p = 0; p < block.pairs; ++p)
    at[p] = place_pair(block.pair[p], moved[block.place[2 * p]], moved[block.place[2 * p + 1]]);
  for (int k = 0; k < block.rows * block.bodies; ++k) block.J[k] = {{0, 0, 0}, {0, 0, 0}};
  for (int i = 0; i < block.rows; ++i) {
    if (block.row[i].coordinate == Coordinate::Pulley) {
      const PulleyRopes ropes = pulley_ropes(block, moved);
      add(jacobian(block, i, block.place[0]), Real(1), {ropes.n_a, cross(ropes.arm_a, ropes.n_a)});
      add(jacobian(block, i, block.place[1]), block.ratio,
          {ropes.n_b, cross(ropes.arm_b, ropes.n_b)});
      continue;
    }
    const bool coupling = block.row[i].coordinate == Coordinate::Coupling;
    for (int p = 0; p < block.pairs; ++p) {
      BodyJacobian a, b;
      gradient_of(coupling ? block.pair[p].measured : block.row[i].coordinate, at[p], a, b);
      const Real scale = p == 0 ? Real(1) : block.ratio;
      add(jacobian(block, i, block.place[2 * p]), scale, a);
      add(jacobian(block, i, block.place[2 * p + 1]), scale, b);
    }
  }
}

// K = J M^-1 J^T, upper triangle.
void make_response(const JointBlock& block, Real K[kMaxJointRows][kMaxJointRows]) {
  for (int i = 0; i < block.rows; ++i) {
    for (int j = i; j < block.rows; ++j) K[i][j] = Real(0);
    for (int k = 0; k < block.bodies; ++k) {
      if (!block.moves[k]) continue;
      const BodyJacobian& from = block.J[i * block.bodies + k];
      const Vec linear = multiply_each(block.inverse_mass[k], from.linear);
      const Vec angular = block.inverse_inertia[k] * from.angular;
      for (int j = i; j < block.rows; ++j) {
        const BodyJacobian& to = block.J[j * block.bodies + k];
        K[i][j] += dot(linear, to.linear) + dot(angular, to.angular);
      }
    }
  }
}

// L D L^T of the held rows, then W and S (joint_block.h). A row that moves nothing, because every
// axis along it is locked, gets no impulse.
void make_factors(JointBlock& block, const Real K[kMaxJointRows][kMaxJointRows]) {
  const int held = block.held, free = block.rows - held;
  auto& L = block.factor;
  for (int i = 0; i < held; ++i) {
    Real d = K[i][i] + joint_tolerance::kRegular * K[i][i];
    for (int k = 0; k < i; ++k) d -= L[i][k] * L[i][k] * block.D[k];
    const bool acts = d > Real(0);
    block.D[i] = acts ? d : Real(0);
    block.D_inverse[i] = acts ? Real(1) / d : Real(0);
    for (int j = i + 1; j < held; ++j) {
      Real entry = K[i][j];
      for (int k = 0; k < i; ++k) entry -= L[i][k] * L[j][k] * block.D[k];
      L[j][i] = block.D_inverse[i] * entry;
    }
  }
  for (int f = 0; f < free; ++f) {
    Real column[kMaxJointRows];
    for (int i = 0; i < held; ++i) column[i] = block.KW[i][f] = K[i][held + f];
    solve_held(block, column);
    for (int i = 0; i < held; ++i) block.W[i][f] = column[i];
  }
  for (int f = 0; f < free; ++f) {
    for (int g = f; g < free; ++g) {
      Real s = K[held + f][held + g];
      for (int i = 0; i < held; ++i) s -= K[i][held + f] * block.W[i][g];
      // What the held rows leave unmoved (round-off apart) cannot be moved.
      if (f == g && !(s > joint_tolerance::kUnmoved * K[held + f][held + f])) s = Real(0);
      block.S[f][g] = block.S[g][f] = s;
    }
  }
}

// k = m w^2, c = 2 z m w with the mass m = 1/S that the spring really sees.
void spring_from_frequency(Real frequency, Real damping_ratio, Real S, Real& stiffness,
                           Real& damping) {
  if (!(S > Real(0))) return;
  const Real w = kTwoPi * frequency;
  stiffness = w * w / S;
  damping = Real(2) * damping_ratio * w / S;
}

void make_springs(JointBlock& block) {
  for (int f = 0; f < block.rows - block.held; ++f) {
    FreeRow& row = block.free[f];
    const Real S = block.S[f][f];
    if (row.hold_frequency > Real(0))
      spring_from_frequency(row.hold_frequency, row.hold_damping_ratio, S, row.stiffness,
                            row.damping);
    if (row.servo_frequency > Real(0))
      spring_from_frequency(row.servo_frequency, row.servo_damping_ratio, S, row.servo_stiffness,
                            row.servo_damping);
    if (row.limit_frequency > Real(0))
      spring_from_frequency(row.limit_frequency, row.limit_damping_ratio, S, row.limit_stiffness,
                            row.limit_damping);
  }
}

}  // namespace

void prepare_joint(const WorldState& world, JointBlock& block) {
  Moved moved[kMaxJointBodies];
  for (int k = 0; k < block.bodies; ++k) {
    const BodyDelta& delta = world.delta[block.body[k]];
    moved[k] = {delta.dp, delta.dq};
    block.inverse_inertia[k] = world.substep[block.body[k]].I_inverse;
  }
  Real values[kMaxJointRows];
  coordinates_at(block, moved, values);
  for (int i = 0; i < block.rows; ++i) block.row[i].value = values[i];
  for (int p = 0; p < block.pairs; ++p) {
    if (!block.pair[p].counts_turns) continue;
    const PlacedPair at =
        place_pair(block.pair[p], moved[block.place[2 * p]], moved[block.place[2 * p + 1]]);
    block.pair[p].angle = coordinate_of(Coordinate::Twist, at, block.pair[p].angle);
  }
  make_jacobians(block, moved);
  Real K[kMaxJointRows][kMaxJointRows];
  make_response(block, K);
  make_factors(block, K);
  make_springs(block);
}

}  // namespace plumb::inline PLUMB_ABI::detail
