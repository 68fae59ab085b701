// Hinge: origins coincide, and so do the x axes; the angle about x is free [Catto 2009].
//
//   C = (R_A^T d, the turn from x to x'), five rows;  free coordinate: the twist, turns counted
//   J: coordinates.h (Linear, Axis, Twist);  K: 5x5, factored as a whole (joint_block.h)
//   effective inertia about the axis, for motor, spring, friction and limits: 1/S, with the pivot
//   holding: I + m l^2 for a body whose centre of mass is l from a fixed axis
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const HingeJoint& joint, RowBuilder& rows) {
  for (const Coordinate c : {Coordinate::LinearX, Coordinate::LinearY, Coordinate::LinearZ,
                             Coordinate::AxisXAboutY, Coordinate::AxisXAboutZ})
    rows.hold(c);
  rows.leave(Coordinate::Twist, joint.axis);
}

}  // namespace plumb::inline PLUMB_ABI::detail
