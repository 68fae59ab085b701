// Surfaces that run over their bodies, as friction sees them: three numbers a row that are added to
// its relative velocity (contact_row.h). Straight belts keep theirs through the step. Where a
// surface turns they depend on the place, which moves: those rows are listed, and looked at again
// in every substep for the place of its middle, so that a turntable carries in a circle.
#pragma once

#include <cstdint>

#include "solver/contact_row.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;
struct Pair;

struct SurfaceDrive {
  Vec velocity{0, 0, 0};  // [m/s, m/s, rad/s] along t1, t2 and about n, of B's surface over A's
  Real turn = 0;          // [rad/s] sum of both surfaces' spins about n
};
// At the place of the contact when the step begins.
SurfaceDrive drive_of(const WorldState& world, const Pair& pair, const ContactRow<Real>& row);

// A row whose drive depends on the place.
struct SpinningRow {
  std::uint32_t row = 0;
  SurfaceDrive start;
};
void find_spinning_rows(WorldState& world);
// The drives of the coming substep.
void carry_drives(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
