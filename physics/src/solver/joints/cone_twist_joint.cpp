// Cone-twist joint (shoulders, necks): origins coincide; B's x axis stays within a cone about A's,
// and the twist about it within a range.
//
//   C = R_A^T d = 0;  angle between the x axes <= cone;  lower <= twist <= upper
//   J: coordinates.h (Linear, Cone, Twist). Swing and twist are the two factors of the relative
//   attitude q = swing twist, so that neither limit depends on the other.
#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const ConeTwistJoint& joint, RowBuilder& rows) {
  for (const Coordinate c : {Coordinate::LinearX, Coordinate::LinearY, Coordinate::LinearZ})
    rows.hold(c);
  const bool narrow = joint.cone < joint_tolerance::kNarrowCone;
  if (narrow) {
    rows.hold(Coordinate::AxisXAboutY);
    rows.hold(Coordinate::AxisXAboutZ);
    rows.leave(Coordinate::Twist,
               {.limit = JointLimit{joint.twist_lower, joint.twist_upper, joint.softness},
                .friction = joint.friction});
    return;
  }
  rows.leave(Coordinate::Cone, {.limit = JointLimit{-kUnlimited, joint.cone, joint.softness}});
  rows.leave(Coordinate::Twist,
             {.limit = JointLimit{joint.twist_lower, joint.twist_upper, joint.softness}});
  rows.turn_friction(joint.friction);
}

}  // namespace plumb::inline PLUMB_ABI::detail
