// Adhesion: what holds on to what it touches.
//
// In every substep the bodies of an adhesive contact are pressed together by a force as large as
// the pull a that they withstand. The contact answers with its own, N' >= 0, so that what acts
// between the bodies,
//
//   N = N' - a >= -a,   |F_t| <= mu N' = mu (N + a)
//
// is the law of Coulomb with adhesion [Raous, Cangemi, Cocou 1999, without damage], and the kernel
// of the rows need not know. The force acts where the row does, so that it keeps what the row
// keeps.
#pragma once

#include <cstdint>

#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

struct AdhesiveRow {
  std::uint32_t row = 0;
  // Along n [N], about t1 and t2 [N m], on B in manifold space (contact_row.h).
  Real force = 0, moment1 = 0, moment2 = 0;
};
// The rows of adhesive pairs whose points are near enough to hold on.
void find_adhesive_rows(WorldState& world);
// The pull of the coming substep.
void pull_together(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
