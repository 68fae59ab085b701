// Distance joint (a rigid rod without mass), and the rope that only pulls.
//
//   C = |d| - length (rod: = 0, rope: <= 0);  J: coordinates.h (Distance)
//   effective mass 1/K, K = 1/m_A + 1/m_B + (r_A x n) . I_A^-1 (r_A x n) + the same of B, n = d/|d|
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const DistanceJoint& joint, RowBuilder& rows) {
  rows.hold(Coordinate::Distance, joint.length);
}

void make_rows(const RopeJoint& joint, RowBuilder& rows) {
  FreeRow& row =
      rows.leave(Coordinate::Distance, {.limit = JointLimit{-kUnlimited, joint.max_length}});
  if (rows.is_soft()) rows.soften_limit(row);
}

}  // namespace plumb::inline PLUMB_ABI::detail
