// Volume and its moments of convex bodies grown by a ball, by pieces: the core, a slab on each
// face, a sector of a cylinder along each edge, a sector of the ball at each corner [Steiner 1840].
// Exact.
#pragma once

#include <span>

#include "plumb/mass_properties.h"

namespace plumb::inline PLUMB_ABI::detail {

struct VolumeMoments {
  double volume = 0;                                 // [m^3]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // [m^4] integral r dV from the reference
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // [m^5] integral r r^T dV from the reference
};

VolumeMoments moments_of_rounded_box(const Eigen::Vector3d& half, double rounding);

// Of a figure of revolution about y. `profile`: from the axis to the axis, upwards, convex: a
// rectangle for a cylinder, a triangle for a cone. About the origin.
struct ProfilePoint {
  double r, y;  // [m]
};
VolumeMoments moments_of_revolution(std::span<const ProfilePoint> profile, double rounding);

// What rounding adds to a hull, about the reference.
VolumeMoments moments_of_hull_rounding(const HullGeometry& hull, double rounding,
                                       const Eigen::Vector3d& reference);

}  // namespace plumb::inline PLUMB_ABI::detail
