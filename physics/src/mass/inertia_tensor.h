// The two steps to an inertia tensor that every formula here shares.
#pragma once

#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI::detail {

// Of a point mass at r from the point of reference: m (|r|^2 E - r r^T).
inline Eigen::Matrix3d point_inertia(double mass, const Eigen::Vector3d& r) {
  return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

// From the second moments C = integral r r^T dm: I = tr(C) E - C.
inline Eigen::Matrix3d inertia_from_second_moments(const Eigen::Matrix3d& C) {
  return C.trace() * Eigen::Matrix3d::Identity() - C;
}

}  // namespace plumb::inline PLUMB_ABI::detail
