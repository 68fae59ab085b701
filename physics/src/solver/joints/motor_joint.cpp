// Motor joint: moves frame B relative to frame A in all six coordinates with bounded force and
// torque.
//
//   velocity: x', y', z' of d . (x, y, z) and w . (x, y, z) brought to their targets
//   position: d . (x, y, z) to `linear`, 2 vec(R_A^-1 R_B) to that of the wanted attitude
//   The force is bounded as a vector, and so is the torque: no direction is favoured.
#include <cmath>

#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const MotorJoint& joint, RowBuilder& rows) {
  const bool position = joint.mode == JointMotor::Mode::Position;
  constexpr Coordinate kLinear[3] = {Coordinate::LinearX, Coordinate::LinearY, Coordinate::LinearZ};
  constexpr Coordinate kTurn[3] = {Coordinate::TurnX, Coordinate::TurnY, Coordinate::TurnZ};
  constexpr Coordinate kRate[3] = {Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ};
  const Vec turn{joint.angular.x(), joint.angular.y(), joint.angular.z()};
  const Rotation q = from_rotation_vector(turn);
  const Real sign = q.w < Real(0) ? Real(-2) : Real(2);
  const Real turned[3] = {sign * q.x, sign * q.y, sign * q.z};
  for (int i = 0; i < 3; ++i)
    rows.leave(kLinear[i],
               {.motor = JointMotor{joint.mode, joint.linear[i], joint.max_force, joint.softness}});
  for (int i = 0; i < 3; ++i)
    rows.leave(position ? kTurn[i] : kRate[i],
               {.motor = JointMotor{joint.mode, position ? turned[i] : joint.angular[i],
                                    joint.max_torque, joint.softness}});
  rows.bound_motors();
}

}  // namespace plumb::inline PLUMB_ABI::detail
