// Spring and damper between the origins [Hooke 1678].
//
//   force along n = d/|d|:  f = -k (|d| - rest) - c |d|'
//   implicit midpoint rule (joint_solver.h): energy of an undamped spring kept at any step,
//   frequency right to (w h)^2 / 12
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const SpringJoint& joint, RowBuilder& rows) {
  FreeRow& row =
      rows.leave(Coordinate::Distance,
                 {.spring = JointSpring{joint.rest_length, joint.stiffness, joint.damping}});
  row.pulls_only = joint.pulls_only;
}

}  // namespace plumb::inline PLUMB_ABI::detail
