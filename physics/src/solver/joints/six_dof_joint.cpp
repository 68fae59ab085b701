// Six-degree-of-freedom joint: each coordinate locked, limited or free, with motor, spring and
// friction.
//
//   coordinates: x . d, y . d, z . d, twist about x, swing about y, swing about z
//   J: coordinates.h (Linear, Twist, Swing). The swings are the angles of B's x axis in two planes
//   of A, so that each can be limited by itself; they are good up to a right angle.
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Coordinate kCoordinates[6] = {Coordinate::LinearX, Coordinate::LinearY,
                                        Coordinate::LinearZ, Coordinate::Twist,
                                        Coordinate::SwingY,  Coordinate::SwingZ};

bool acts(const JointAxis& axis) {
  return axis.limit.has_value() || axis.motor.has_value() || axis.spring.has_value() ||
         axis.friction > Real(0);
}

}  // namespace

void make_rows(const SixDofJoint& joint, RowBuilder& rows) {
  using Freedom = SixDofJoint::Freedom;
  for (int i = 0; i < 6; ++i)
    if (joint.coordinates[static_cast<std::size_t>(i)].freedom == Freedom::Locked)
      rows.hold(kCoordinates[i]);
  for (int i = 0; i < 6; ++i) {
    const SixDofJoint::Coordinate& c = joint.coordinates[static_cast<std::size_t>(i)];
    if (c.freedom == Freedom::Locked) continue;
    JointAxis axis = c.axis;
    if (c.freedom == Freedom::Free) axis.limit.reset();
    if (acts(axis)) rows.leave(kCoordinates[i], axis);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
