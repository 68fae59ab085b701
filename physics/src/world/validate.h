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

inline Status check_local_pose(const LocalPose& pose) {
  if (!all_finite(pose.position))
    return {StatusCode::NotFinite, "collider position is not finite [m]"};
  return check_orientation(pose.orientation);
}

Status check_motion_type(MotionType type);
Status check_damping(Real linear, Real angular);
Status check_gravity_scale(Real scale);
Status check_body(const RigidBody& body);
Status check_surface_velocity(const SurfaceVelocity& velocity);
Status check_material_pair(const MaterialPair& values);
Status check_material(const Material& material);
Status check_one_way(const Vec3& direction);
Status check_density(double density);
// Whether a body of that type may have the shape.
Status check_shape_fits(const Shape& shape, MotionType type);
Status check_collider(const Collider& collider, MotionType type);
// Whether what the collider adds to its body's mass is the mass of a body, and fits the numbers.
Status check_added_mass(const Collider& collider);

}  // namespace plumb::inline PLUMB_ABI::detail
