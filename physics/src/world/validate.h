// Checks of what users hand in, shared by the calls that build and act.
#pragma once

#include <cmath>

#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::detail {

inline Status stale_body() {
  return {StatusCode::StaleHandle, "no such body: the handle is null or the body was destroyed"};
}
inline Status stale_collider() {
  return {StatusCode::StaleHandle,
          "no such collider: the handle is null or the collider was destroyed"};
}
inline Status inside_step() {
  return {StatusCode::InsideStep,
          "the world is stepping: change it before or after step(), not from an observer"};
}

// Quaternions farther than this from unit length are refused [-]; nearer ones are normalised. Wide
// enough for four-digit text files, far too narrow for a forgotten quaternion.
inline constexpr Real kUnitTolerance = Real(1e-3);

template <class Derived>
bool all_finite(const Eigen::MatrixBase<Derived>& m) {
  return m.allFinite();
}
inline Status check_orientation(const Quat& q) {
  if (!q.coeffs().allFinite()) return {StatusCode::NotFinite, "orientation is not finite"};
  if (std::abs(q.norm() - Real(1)) > kUnitTolerance)
    return {StatusCode::OutOfRange, "orientation must be a unit quaternion (length 1 within 1e-3)"};
  return {};
}
inline Status check_pose(const Pose& pose) {
  if (!all_finite(pose.position)) return {StatusCode::NotFinite, "position is not finite [m]"};
  return check_orientation(pose.orientation);
}

Status check_body(const RigidBody& body);
Status check_surface_velocity(const SurfaceVelocity& velocity);
Status check_material_pair(const MaterialPair& values);
Status check_collider(const Collider& collider, MotionType type);

}  // namespace plumb::inline PLUMB_ABI::detail
