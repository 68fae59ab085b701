// Six-degree-of-freedom joint: each coordinate locked, limited or free, with motor, spring and
// friction.
//
//   coordinates: x . d, y . d, z . d, twist about x, swing about y, swing about z
//   J: coordinates.h (Linear, Twist, Axis, Align, Turn). The swings are the rotation vector of the
//   turn without twist that takes A's x axis to B's: good up to half a turn, and the angle in one
//   plane where the other is none.
//
// What several locks hold together is held by the coordinates that are good farthest:
//   all three            the attitude, as a fixed joint
//   both swings          the x axes, as a hinge
//   twist and one swing  a hinge about the axis that is left, whose angle takes the swing's place
//   one swing            B's x axis lies across A's y or z axis
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Freedom = SixDofJoint::Freedom;
constexpr std::size_t kTwist = 3, kSwingY = 4, kSwingZ = 5;

void choose_angles(const SixDofJoint& joint, Coordinate* angle) {
  const auto locked = [&](std::size_t i) {
    return joint.coordinates[i].freedom == Freedom::Locked;
  };
  const bool twist = locked(kTwist), y = locked(kSwingY), z = locked(kSwingZ);
  if (twist && y && z) {
    angle[0] = Coordinate::TurnX;
    angle[1] = Coordinate::TurnY;
    angle[2] = Coordinate::TurnZ;
  } else if (twist && y) {
    angle[0] = Coordinate::AxisZAboutX;
    angle[1] = Coordinate::AxisZAboutY;
    angle[2] = Coordinate::TwistZ;
  } else if (twist && z) {
    angle[0] = Coordinate::AxisYAboutX;
    angle[1] = Coordinate::TwistY;
    angle[2] = Coordinate::AxisYAboutZ;
  } else if (y != z) {
    angle[y ? 1 : 2] = y ? Coordinate::AlignZ : Coordinate::AlignY;
  }
}

bool acts(const JointAxis& axis) {
  return axis.limit.has_value() || axis.motor.has_value() || axis.spring.has_value() ||
         axis.friction > Real(0);
}

}  // namespace

void make_rows(const SixDofJoint& joint, RowBuilder& rows) {
  Coordinate coordinate[6] = {Coordinate::LinearX,     Coordinate::LinearY,
                              Coordinate::LinearZ,     Coordinate::Twist,
                              Coordinate::AxisXAboutY, Coordinate::AxisXAboutZ};
  choose_angles(joint, coordinate + kTwist);
  const bool attitude = coordinate[kTwist] == Coordinate::TurnX;  // all three angles are locked
  for (std::size_t i = 0; i < (attitude ? kTwist : std::size_t{6}); ++i)
    if (joint.coordinates[i].freedom == Freedom::Locked) rows.hold(coordinate[i]);
  if (attitude) rows.hold_attitude();
  for (int i = 0; i < 6; ++i) {
    const SixDofJoint::Coordinate& c = joint.coordinates[static_cast<std::size_t>(i)];
    if (c.freedom == Freedom::Locked) continue;
    JointAxis axis = c.axis;
    if (c.freedom == Freedom::Free) axis.limit.reset();
    if (acts(axis)) rows.leave(coordinate[i], axis);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
