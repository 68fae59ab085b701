// Friction cones with facets (WorldSettings::friction_cone): a polygon about the circle, its facets
// across t1, t2 and, with eight, across what lies between them. For rows that stand alone.
#pragma once

#include <algorithm>
#include <cmath>

#include "plumb/settings.h"
#include "solver/contact_kernel.h"

namespace plumb::inline PLUMB_ABI::detail {

struct FacetCone : RoundCone {
  FrictionCone kind = FrictionCone::FourFacets;

  explicit FacetCone(FrictionCone cone) : kind(cone) {}

  [[nodiscard]] Real size_of(Real f1, Real f2) const {
    const Real straight = std::max(std::abs(f1), std::abs(f2));
    if (kind == FrictionCone::FourFacets) return straight;
    return std::max(straight, kHalfRoot * (std::abs(f1) + std::abs(f2)));
  }
  Real pull_in(Real& f1, Real& f2, Real limit) const {
    const Real size = size_of(f1, f2);
    if (!(size > limit)) return size;
    // By symmetry in the first octant: 0 <= y <= x.
    Real x = std::abs(f1), y = std::abs(f2);
    const bool swapped = y > x;
    if (swapped) std::swap(x, y);
    if (kind == FrictionCone::FourFacets) {
      x = std::min(x, limit);
      y = std::min(y, limit);
    } else {
      to_octagon(x, y, limit);
    }
    if (swapped) std::swap(x, y);
    f1 = std::copysign(x, f1);
    f2 = std::copysign(y, f2);
    return size;
  }

 private:
  static constexpr Real kHalfRoot = Real(0.70710678118654752440);  // sqrt(1/2)
  static constexpr Real kEdge = Real(0.41421356237309504880);      // tan(22.5 deg): where two meet

  // The nearest point on the facet across t1, on the corner, or on the facet at 45 degrees.
  static void to_octagon(Real& x, Real& y, Real limit) {
    const Real beyond = kHalfRoot * (x + y) - limit;  // the slanted facet
    const Real on_slant = x - kHalfRoot * beyond;
    if (y <= kEdge * limit) {
      x = std::min(x, limit);
    } else if (on_slant > limit) {
      x = limit;
      y = kEdge * limit;
    } else {
      x = on_slant;
      y -= kHalfRoot * beyond;
    }
  }
};

}  // namespace plumb::inline PLUMB_ABI::detail
