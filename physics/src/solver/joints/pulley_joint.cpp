// Pulley: a rope from body A over two fixed points to body B [Catto 2010].
//
//   C = |d_A| + ratio |d_B| - length (<= 0 for a rope, = 0 when stiff), d from where the rope
//   leaves to the origins;  J = (n_A, r_A x n_A | ratio n_B, ratio r_B x n_B)
//   |d_A| <= length, ratio |d_B| <= length, which C says as well; but where an end has reached its
//   point n is any direction there, and what hangs on the other end could run out against it
//   K = 1/m_A + ratio^2 / m_B + turning terms. The wheels stand on the world, which takes the rest
//   of the momentum.
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const PulleyJoint& joint, RowBuilder& rows) {
  const JointLimit rope{-kUnlimited, Real(0)};
  if (joint.stiff) rows.hold(Coordinate::Pulley);
  for (const Coordinate c : {Coordinate::Pulley, Coordinate::PulleyA, Coordinate::PulleyB}) {
    if (c == Coordinate::Pulley && joint.stiff) continue;
    FreeRow& row = rows.leave(c, {.limit = rope});
    if (rows.is_soft()) rows.soften_limit(row);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
