// What a step shows. A change that moves a body by less than some roundings of a place tens of its
// sizes from the origin cannot be told from what another order of the same sums would do.
#pragma once

#include <cmath>
#include <limits>

#include "world/body_store.h"

namespace plumb::inline PLUMB_ABI::detail {

inline constexpr Real kVisible = Real(64) * std::numeric_limits<Real>::epsilon();  // [-] sizes

// [m] Radius of gyration of the whole body; 0 where it does not turn.
inline Real gyration_of(const BodyMass& m) {
  const Real sum = m.moments.x + m.moments.y + m.moments.z;
  return m.mass > Real(0) ? std::sqrt(sum / (Real(2) * m.mass)) : Real(0);
}

// Whether velocities that differ by dv [m/s] and dw [rad/s] part two bodies visibly in a time [s].
inline bool parts_visibly(const BodyMass& m, Vec dv, Vec dw, Real time) {
  const Real size = gyration_of(m);
  return time * length(dv) > kVisible * (size > Real(0) ? size : Real(1)) ||
         time * length(dw) > kVisible;
}

}  // namespace plumb::inline PLUMB_ABI::detail
