// Short words for building worlds: numbers in double whatever Real is, and calls that must succeed.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>
#include <string>

#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

inline constexpr double kGravity = 9.81;  // [m/s^2] of every scene that does not say otherwise
inline constexpr double kPi = std::numbers::pi;

inline Real real(double value) { return static_cast<Real>(value); }
inline Vec3 vec(double x, double y, double z) { return Vec3(real(x), real(y), real(z)); }
inline Pos3 pos(double x, double y, double z) {
  return Pos3(static_cast<PosReal>(x), static_cast<PosReal>(y), static_cast<PosReal>(z));
}
inline Vec3 vec(const Eigen::Vector3d& v) { return v.cast<Real>(); }
inline Pos3 pos(const Eigen::Vector3d& p) { return p.cast<PosReal>(); }

// angle [rad] about an axis of any length > 0.
inline Quat turn(double angle, const Eigen::Vector3d& axis) {
  return Quat(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())).cast<Real>());
}
inline Pose at(double x, double y, double z) {
  Pose pose;
  pose.position = pos(x, y, z);
  return pose;
}
inline Pose at(const Eigen::Vector3d& p, const Quat& q) {
  Pose pose;
  pose.position = pos(p);
  pose.orientation = q;
  return pose;
}

// Scenes are built from numbers known to be good: a refusal is a mistake in the scene.
inline void must(const Status& status) {
  if (!status.ok()) throw std::runtime_error(std::string("refused: ") + status.message);
}
template <class IdType>
IdType must(const Created<IdType>& created) {
  must(created.status);
  return created.id;
}

inline BodyId add(PhysicsWorld& world, const RigidBody& body, const Collider& collider) {
  const BodyId id = must(world.create_body(body));
  must(world.create_collider(id, collider));
  return id;
}

inline RigidBody body_at(const Pose& pose, MotionType type = MotionType::Dynamic) {
  RigidBody body;
  body.pose = pose;
  body.type = type;
  return body;
}
inline RigidBody moving(const Pose& pose, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  RigidBody body = body_at(pose);
  body.linear_velocity = velocity;
  body.angular_velocity = spin;
  return body;
}

// The same coefficients on both colliders of a pair give those coefficients for the pair under
// every rule except Multiply.
inline Material material(double friction, double restitution = 0) {
  Material m;
  m.friction = real(friction);
  m.restitution = real(restitution);
  return m;
}
inline Collider with(const Shape& shape, const Material& surface = {}, double density = 1000) {
  Collider collider;
  collider.shape = shape;
  collider.material = surface;
  collider.density = density;
  return collider;
}
inline Sphere sphere(double radius) { return Sphere{real(radius)}; }
inline Box box(double hx, double hy, double hz) { return Box{vec(hx, hy, hz)}; }
inline Box cube(double half) { return box(half, half, half); }
inline Capsule capsule(double half_length, double radius) {
  return Capsule{real(half_length), real(radius)};
}
inline Cylinder cylinder(double half_length, double radius, double rounding = 0) {
  return Cylinder{real(half_length), real(radius), real(rounding)};
}
inline Cone cone(double half_length, double radius, double rounding = 0) {
  return Cone{real(half_length), real(radius), real(rounding)};
}
inline Box rounded_box(double hx, double hy, double hz, double rounding) {
  return Box{vec(hx, hy, hz), real(rounding)};
}

// A floor without end: solid where normal . x <= offset.
inline BodyId add_floor(PhysicsWorld& world, const Material& surface = {},
                        const Eigen::Vector3d& normal = Eigen::Vector3d::UnitY(),
                        double offset = 0) {
  return add(world, body_at(Pose{}, MotionType::Static),
             with(HalfSpace{vec(normal), real(offset)}, surface));
}

inline WorldSettings no_gravity() {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  return settings;
}
inline WorldSettings no_sleep() {
  WorldSettings settings;
  settings.sleeping = false;
  return settings;
}

// A body of given mass properties and no collider: free motion only.
inline RigidBody free_body(double mass, const Eigen::Vector3d& principal_moments) {
  RigidBody body;
  MassProperties properties;
  properties.mass = mass;
  properties.I_Bcm_B = principal_moments.asDiagonal();
  body.mass = properties;
  return body;
}

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
