// Where a joint stands: coordinates, Jacobians, and the factored effective masses.
#include <cmath>

#include "solver/joints/joint_motion.h"
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
    if (is_pulley(block.row[i].coordinate)) {
      const PulleyRopes ropes = pulley_ropes(block, moved);
      if (block.row[i].coordinate != Coordinate::PulleyB)
        add(jacobian(block, i, block.place[0]), Real(1),
            {ropes.n_a, cross(ropes.arm_a, ropes.n_a)});
      if (block.row[i].coordinate != Coordinate::PulleyA)
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

// S = K_ff - K_fh K_hh^-1 K_hf of each free row by itself: its inverse mass while the held ones
// hold.
void make_inverse_masses(JointBlock& block) {
  const auto response = [&](int i, int j) {
    double K = 0;
    for (int k = 0; k < block.bodies; ++k) {
      if (!block.moves[k]) continue;
      const BodyJacobian& a = block.J[i * block.bodies + k];
      const BodyJacobian& b = block.J[j * block.bodies + k];
      K += static_cast<double>(dot(multiply_each(block.inverse_mass[k], a.linear), b.linear) +
                               dot(block.inverse_inertia[k] * a.angular, b.angular));
    }
    return K;
  };
  // Rows orthogonalized one after the other: L of L D L^T, the free row last.
  double L[kMaxHeld + 1][kMaxHeld], D[kMaxHeld];
  const auto eliminate = [&](int row, int place) {
    double d = response(row, row);
    const double size = d;
    for (int j = 0; j < std::min(place, block.held); ++j) {
      double entry = response(row, j);
      for (int k = 0; k < j; ++k) entry -= L[place][k] * L[j][k] * D[k];
      L[place][j] = D[j] > 0 ? entry / D[j] : 0;
      d -= L[place][j] * L[place][j] * D[j];
    }
    return d > joint_tolerance::kUnmoved * size ? d : 0;
  };
  for (int i = 0; i < block.held; ++i) D[i] = eliminate(i, i);
  for (int f = 0; f < block.rows - block.held; ++f)
    block.free_inverse_mass[f] = static_cast<Real>(eliminate(block.held + f, block.held));
}

// The part before the drift of a spring that is as stiff as this [rad^2/s^2].
Real share_of(const JointBlock& block, Real square) {
  const Real turn = std::abs(block.h) * std::sqrt(square);
  return std::max(Real(0.5), Real(1) - Real(0.5) * joint_tolerance::kVibrationPerCycle / turn);
}

// k = m w^2, c = 2 z m w with the mass m = 1/S that the spring really sees.
Real spring_from_frequency(const JointBlock& block, Real frequency, Real damping_ratio, Real S,
                           Real& stiffness, Real& damping) {
  const Real w = kTwoPi * frequency;
  if (S > Real(0)) {
    stiffness = w * w / S;
    damping = Real(2) * damping_ratio * w / S;
  }
  return share_of(block, w * w);
}

void make_springs(JointBlock& block) {
  for (int f = 0; f < block.rows - block.held; ++f) {
    FreeRow& row = block.free[f];
    const Real S = block.free_inverse_mass[f];
    if (row.hold_frequency > Real(0)) {
      row.spring_share = spring_from_frequency(block, row.hold_frequency, row.hold_damping_ratio, S,
                                               row.stiffness, row.damping);
    } else if (row.spring) {
      row.spring_share = share_of(block, row.stiffness * S);
    }
    if (row.servo_frequency > Real(0))
      row.servo_share = spring_from_frequency(block, row.servo_frequency, row.servo_damping_ratio,
                                              S, row.servo_stiffness, row.servo_damping);
    if (row.limit_frequency > Real(0))
      row.limit_share = spring_from_frequency(block, row.limit_frequency, row.limit_damping_ratio,
                                              S, row.limit_stiffness, row.limit_damping);
  }
}

}  // namespace

void prepare_joint(const WorldState& world, JointBlock& block) {
  Moved moved[kMaxJointBodies];
  for (int k = 0; k < block.bodies; ++k) {
    moved[k] = moved_now(world, block, k);
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
  if (!block.needs_inverse_mass) return;
  make_inverse_masses(block);
  make_springs(block);
}

}  // namespace plumb::inline PLUMB_ABI::detail
