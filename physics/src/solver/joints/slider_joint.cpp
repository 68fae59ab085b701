// Slider (prismatic joint): attitudes coincide, origin B stays on the x axis of A [Catto 2009].
//
//   C = (y . d, z . d, 2 vec(R_A^-1 R_B), or the rotation vector where that is far off), five rows
//   free coordinate: x . d;  J: coordinates.h (Linear, Turn, Rotation);  K: 5x5, factored as a
//   whole Both bodies are acted on at origin B, however far it has moved: angular momentum is kept.
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const SliderJoint& joint, RowBuilder& rows) {
  rows.hold(Coordinate::LinearY);
  rows.hold(Coordinate::LinearZ);
  rows.hold_attitude();
  rows.leave(Coordinate::LinearX, joint.axis);
}

}  // namespace plumb::inline PLUMB_ABI::detail
