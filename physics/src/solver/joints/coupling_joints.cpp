// Gear, and rack and pinion: a constant combination of the coordinates of two joints [Catto 2010].
//
//   gear           C = angle_1 + ratio angle_2 - constant
//   rack, pinion   C = angle - translation / radius - constant
//   J = J_1 + ratio J_2 over the four bodies of the two joints;  K = J M^-1 J^T, bodies that occur
//   twice (a common carrier) counted with the sum of their Jacobians
// The torques on the wheels are matched by opposite ones on what carries them: momentum is kept,
// and a planetary gear drags its carrier as it should.
#include "solver/joints/joint_rows.h"

namespace plumb::inline PLUMB_ABI::detail {

void make_rows(const GearJoint&, RowBuilder& rows) { rows.hold(Coordinate::Coupling); }

void make_rows(const RackPinionJoint&, RowBuilder& rows) { rows.hold(Coordinate::Coupling); }

}  // namespace plumb::inline PLUMB_ABI::detail
