// The area of a triangle, or exactly zero where rounding would only pretend to one.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// A face this flat (height over longest side) has no area that doubles could tell from rounding.
inline constexpr double kDegenerateHeight = 1e-13;

inline double area_or_zero(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  const double doubled = (b - a).cross(c - a).norm();
  return doubled <= kDegenerateHeight * longest ? 0 : 0.5 * doubled;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
