// Where the bodies of a joint are, and where they will be at the end of the substep.
#pragma once

#include "solver/joints/coordinates.h"
#include "solver/joints/joint_block.h"

namespace plumb::inline PLUMB_ABI::detail {

struct BlockVelocities {
  Vec v[kMaxJointBodies], w[kMaxJointBodies];
};

// The turn by the rotation vector r. tan(|r|/2) = |r|/2 (1 + |r|^2/12 + ...): good to |r|^5/720, a
// rotation whatever |r|.
inline Rotation small_turn(Vec r) {
  const Vec u = (Real(0.5) + length_squared(r) / Real(24)) * r;
  const Real c = Real(1) / std::sqrt(Real(1) + length_squared(u));
  return {c * u.x, c * u.y, c * u.z, c};
}

// After a time h of free drift: w' = I^-1 (I w x w), the turn by h w + h^2/2 w' [Goldstein 2002].
inline Moved drifted(const Moved& now, Vec v, Vec w, const Symmetric3<Real>& inertia,
                     const Symmetric3<Real>& inverse_inertia, Real h) {
  const Vec w_rate = inverse_inertia * cross(inertia * w, w);
  return {now.dp + h * v, small_turn(h * (w + (Real(0.5) * h) * w_rate)) * now.dq};
}

// The two ends of a pulley's rope: directions from where it leaves to the bodies, and lengths.
struct PulleyRopes {
  Vec n_a, n_b, arm_a, arm_b;
  Real length_a, length_b;
};
inline PulleyRopes pulley_ropes(const JointBlock& block, const Moved* moved) {
  const FramePair& pair = block.pair[0];
  const Moved& a = moved[block.place[0]];
  const Moved& b = moved[block.place[1]];
  PulleyRopes ropes;
  ropes.arm_a = rotate(a.dq, pair.arm_a);
  ropes.arm_b = rotate(b.dq, pair.arm_b);
  const Vec d_a = a.dp + (ropes.arm_a - block.over_a), d_b = b.dp + (ropes.arm_b - block.over_b);
  ropes.length_a = length(d_a);
  ropes.length_b = length(d_b);
  ropes.n_a = normalized_or(d_a, Vec{0, -1, 0});
  ropes.n_b = normalized_or(d_b, Vec{0, -1, 0});
  return ropes;
}

inline bool is_pulley(Coordinate coordinate) {
  return coordinate >= Coordinate::Pulley && coordinate <= Coordinate::PulleyB;
}

// The coordinates that have a value, at given poses.
inline void coordinates_at(const JointBlock& block, const Moved* moved, Real* values) {
  PlacedPair at[2];
  for (int p = 0; p < block.pairs; ++p)
    at[p] = place_pair(block.pair[p], moved[block.place[2 * p]], moved[block.place[2 * p + 1]]);
  for (int i = 0; i < block.rows; ++i) {
    values[i] = Real(0);
    if (!block.row[i].needs_value) continue;
    const Coordinate coordinate = block.row[i].coordinate;
    if (is_pulley(coordinate)) {
      const PulleyRopes ropes = pulley_ropes(block, moved);
      const Real a = ropes.length_a, b = block.ratio * ropes.length_b;
      if (coordinate == Coordinate::Pulley) values[i] = a + b - block.zero;
      if (coordinate == Coordinate::PulleyA) values[i] = a - block.zero;
      if (coordinate == Coordinate::PulleyB) values[i] = b - block.zero;
    } else if (coordinate == Coordinate::Coupling) {
      values[i] = coordinate_of(block.pair[0].measured, at[0], block.pair[0].angle) +
                  block.ratio * coordinate_of(block.pair[1].measured, at[1], block.pair[1].angle) -
                  block.zero;
    } else {
      values[i] = coordinate_of(coordinate, at[0], block.pair[0].angle);
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
