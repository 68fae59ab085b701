// The sign of two determinants without rounding: on which side of a line or a plane a point lies.
//
// A floating-point filter answers when the rounding cannot reach zero; the rest is summed exactly
// in expansions of doubles [Shewchuk 1997]. A face test built on these signs cannot contradict
// itself, which is what makes shared edges and flat regions harmless.
#pragma once

#include <Eigen/Core>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if they are on one line.
int orientation_2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

// The sign of (b - a) x (c - a) . (d - a): +1 if d lies on the side of the plane a, b, c from which
// these appear counter-clockwise, 0 if it lies in the plane.
int orientation_3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Eigen::Vector3d& d);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
