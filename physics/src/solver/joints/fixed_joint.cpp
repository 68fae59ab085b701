// Fixed joint: the frames coincide.
//
//   C = (R_A^T d, 2 vec(R_A^-1 R_B), or the rotation vector where that is far off), six rows
//   J: coordinates.h (Linear, Turn, Rotation);  K: 6x6, factored as a whole, so that a force at the
//   end of a long arm is borne in one pass
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const FixedJoint&, RowBuilder& rows) {
  for (const Coordinate c : {Coordinate::LinearX, Coordinate::LinearY, Coordinate::LinearZ})
    rows.hold(c);
  rows.hold_attitude();
}

}  // namespace plumb::inline PLUMB_ABI::detail
