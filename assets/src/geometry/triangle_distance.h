// The distance from a point to a triangle.
#pragma once

#include <Eigen/Core>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// [m], to the nearest point of the triangle, rim and corners included.
double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
