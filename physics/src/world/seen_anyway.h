// Whether a contact that was found by looking ahead is the one that is seen from here.
#pragma once

#include "collision/manifold.h"
#include "world/visible.h"

namespace plumb::inline PLUMB_ABI::detail {

// The manifold of the moment of first touch, told as of the step's start, and the ordinary one.
// `carried` [m]: by which the point of contact moves on until then, seen from a body that gives way
// and from which positions are not told. `size` [m]: of the smaller body.
inline bool is_seen_anyway(const Manifold& ahead, const Manifold& here, Vec carried, Real size) {
  if (ahead.count != here.count) return false;
  const Vec n = here.normal;
  if (length(ahead.normal - n) > kVisible) return false;
  const auto along = [n](Vec x) { return x - dot(n, x) * n; };
  for (int i = 0; i < here.count; ++i) {
    const ManifoldPoint &a = ahead.points[i], &b = here.points[i];
    const Vec apart = along(a.position - b.position + carried);
    if (std::abs(a.separation - b.separation) > kVisible * size || length(apart) > kVisible * size)
      return false;
  }
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
