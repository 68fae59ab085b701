#include "collision/sweep.h"

#include "motion/rotation_flow.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Num kFullTurn = 6.28318530717958647693;  // [rad]
constexpr Num kRightAngle = kFullTurn / 4;         // [rad]

// The angle in [0, pi/2] of a given sine and cosine. That of the C library differs in the last bit
// between systems. a += sin(angle - a) cubes the error: 0.08, 9e-5, 1e-13, 0.
Num angle_of(Num sine, Num cosine) {
  Num a = sine < cosine ? sine : kRightAngle - cosine;
  for (int i = 0; i < 3; ++i) {
    Num s, c;
    sin_cos(a, s, c);
    a += sine * c - cosine * s;
  }
  return a;
}

}  // namespace

NumRotation Sweep::rotation_at(Num t) const {
  if (tumbles) {
    NumRotation q = start;
    advance_rotation(q, momentum, inverse_moments, t);
    return q;
  }
  if (length_squared(turn) == Num(0)) return start;
  return normalized(from_rotation_vector(t * turn) * start);
}

NumVec Sweep::spin_at(NumRotation q) const {
  if (!tumbles) return turn;
  return rotate(q, multiply_each(inverse_moments, inverse_rotate(q, momentum)));
}

Num Sweep::fastest_spin() const {
  if (!tumbles) return length(turn);
  const Num largest = std::max(inverse_moments.x, std::max(inverse_moments.y, inverse_moments.z));
  return largest * length(momentum);
}

NumVec turn_between(NumRotation q0, NumRotation q1, NumVec expected) {
  NumRotation d = normalized(q1 * conjugate(q0));
  if (d.w < Num(0)) d = {-d.x, -d.y, -d.z, -d.w};
  const NumVec v{d.x, d.y, d.z};
  const Num sine = length(v);
  if (!(sine > Num(0))) {
    // No turn, or whole ones.
    const Num turns = std::nearbyint(length(expected) / kFullTurn);
    return turns > Num(0) ? (turns * kFullTurn / length(expected)) * expected : NumVec{0, 0, 0};
  }
  const NumVec axis = (Num(1) / sine) * v;
  const Num angle = Num(2) * angle_of(sine, d.w);
  const Num turns = std::nearbyint((dot(axis, expected) - angle) / kFullTurn);
  return (angle + turns * kFullTurn) * axis;
}

}  // namespace plumb::inline PLUMB_ABI::detail
