// Ball joint: origin B coincides with origin A [Catto 2009].
//
//   C = R_A^T d (three rows), d = (x_B + r_B) - (x_A + r_A)
//   J: see coordinates.h (Linear);  K = (1/m_A + 1/m_B) 1 - [r]_x I_A^-1 [r]_x - [r_B]_x I_B^-1
//   [r_B]_x, r = r_A + d
//   friction: w_B - w_A = 0 by a torque vector of bounded length
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const BallJoint& joint, RowBuilder& rows) {
  rows.hold(Coordinate::LinearX);
  rows.hold(Coordinate::LinearY);
  rows.hold(Coordinate::LinearZ);
  rows.turn_friction(joint.friction);
}

}  // namespace plumb::inline PLUMB_ABI::detail
