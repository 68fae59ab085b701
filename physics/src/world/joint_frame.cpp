// Frames from an axis. Not in the header: Eigen's own shortest turn rests on a singular value
// decomposition, which every file that sees it would have to compile.
#include <cmath>

#include "plumb/joint.h"

namespace plumb::inline PLUMB_ABI {

// With n the unit axis, the turn is (1 + n_x, x cross n), made unit. Near the opposite direction
// 1 + n_x = (n_y^2 + n_z^2) / (1 - n_x), which loses no digits.
Quat turn_from_x(const Vec3& axis) {
  const Eigen::Vector3d wide = axis.cast<double>();
  const double length = wide.norm();
  if (!(length > 0)) return Quat::Identity();
  const double x = wide.x() / length, y = wide.y() / length, z = wide.z() / length;
  const double across = y * y + z * z;
  const double w = x >= 0 ? 1 + x : across / (1 - x);
  const double norm = std::sqrt(w * w + across);
  if (!(norm > 0)) return Quat(0, 0, 0, 1);
  return Quat(static_cast<Real>(w / norm), 0, static_cast<Real>(-z / norm),
              static_cast<Real>(y / norm));
}

LocalPose joint_frame(const Vec3& point, const Vec3& axis) {
  LocalPose frame;
  frame.position = point;
  frame.orientation = turn_from_x(axis);
  return frame;
}

}  // namespace plumb::inline PLUMB_ABI
