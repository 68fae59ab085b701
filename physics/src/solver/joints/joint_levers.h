// What a pull through a joint does to the bodies that turn about it: a taut line is stiff sideways.
#pragma once

#include <cmath>

#include "solver/joints/coordinates.h"
#include "solver/joints/joint_block.h"
#include "solver/joints/joint_laws.h"

namespace plumb::inline PLUMB_ABI::detail {

// How easily a body gives way at the end of an arm r across a pull along it.
struct Lever {
  Real turn = 0;   // [1/(kg m^2)] about an axis across the arm: the larger of the two
  Real along = 0;  // [1/kg] of the end of the arm, sideways
  Real r = 0;      // [m]
};
inline Lever lever_of(const JointBlock& block, int k, Vec arm) {
  Lever lever;
  if (!block.moves[k]) return lever;
  lever.r = length(arm);
  const Vec& m = block.inverse_mass[k];
  lever.along = std::max(m.x, std::max(m.y, m.z));
  if (!(lever.r > Real(0))) return lever;
  Vec t1, t2;
  tangent_frame((Real(1) / lever.r) * arm, t1, t2);
  lever.turn =
      std::max(dot(t1, block.inverse_inertia[k] * t1), dot(t2, block.inverse_inertia[k] * t2));
  lever.along += lever.r * lever.r * lever.turn;
  return lever;
}

// [rad^2/s^2] that a joint adds to the square of a body's frequency when it is pulled by a force f
// at the end of an arm, while the body at the other side gives way.
inline Real stiffness(Real f, const Lever& body, const Lever& other) {
  if (!(body.turn > Real(0)) || !(other.along > Real(0))) return Real(0);
  return f * body.r / (Real(1) / body.turn + body.r * body.r / other.along);
}

// [N] with which a joint pulled in the last substep of length h: what it holds, springs and ropes.
inline Real pull_of(const JointBlock& block, Real h) {
  Real square = 0;
  for (int k = 0; k < block.rows; ++k) {
    if (!is_linear(block.row[k].coordinate)) continue;
    const RowImpulses& l = block.row[k].impulses;
    const Real both = total_impulse(l, false) + (block.split ? total_impulse(l, true) : Real(0));
    square += both * both;
  }
  return std::sqrt(square) / h;
}

}  // namespace plumb::inline PLUMB_ABI::detail
