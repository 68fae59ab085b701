// Short words for building the lab's scenes: numbers in double whatever Real is.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "accuracy/cells/case.h"

namespace plumb::inline PLUMB_ABI::cells {

inline constexpr double kGravity = 9.81;  // [m/s^2]
inline constexpr double kPi = std::numbers::pi;

inline Real real(double v) { return static_cast<Real>(v); }
inline Vec3 vec(const Eigen::Vector3d& v) { return v.cast<Real>(); }
inline Eigen::Vector3d wide(const Vec3& v) { return v.cast<double>(); }
inline Eigen::Quaterniond wide(const Quat& q) { return q.cast<double>(); }
inline Quat quat(const Eigen::Quaterniond& q) { return Quat(q.cast<Real>()).normalized(); }
inline Eigen::Quaterniond turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}
inline Pose at(const Eigen::Vector3d& p,
               const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  Pose pose;
  pose.position = p.cast<PosReal>();
  pose.orientation = quat(q);
  return pose;
}
inline Eigen::Vector3d place(const PhysicsWorld& world, BodyId body) {
  return world.center_of_mass(body).cast<double>();
}

// Scenes are built from numbers known to be good: a refusal is a mistake in the case.
inline void must(const Status& status) {
  if (!status.ok()) throw std::logic_error(std::string("the lab's scene: ") + status.message);
}
template <class Id>
Id must(const Created<Id>& created) {
  must(created.status);
  return created.id;
}

inline RigidBody body_at(const Pose& pose, MotionType type = MotionType::Dynamic) {
  RigidBody body;
  body.pose = pose;
  body.type = type;
  return body;
}
inline MassProperties mass_of(double mass, const Eigen::Vector3d& moments) {
  MassProperties properties;
  properties.mass = mass;
  properties.I_Bcm_B = moments.asDiagonal();
  return properties;
}
inline Material material(double friction, double restitution = 0) {
  Material m;
  m.friction = real(friction);
  m.restitution = real(restitution);
  return m;
}
inline BodyId add(PhysicsWorld& world, const RigidBody& body, const Shape& shape,
                  const Material& surface, double density = 1000) {
  Collider collider;
  collider.shape = shape;
  collider.material = surface;
  collider.density = density;
  const BodyId id = must(world.create_body(body));
  must(world.create_collider(id, collider));
  return id;
}
// Solid below y = 0, without end; or below another plane through the origin.
inline BodyId add_floor(PhysicsWorld& world, const Material& surface,
                        const Eigen::Vector3d& normal = Eigen::Vector3d::UnitY()) {
  return add(world, body_at(Pose{}, MotionType::Static), HalfSpace{vec(normal), Real(0)}, surface);
}
inline Box box(double hx, double hy, double hz) { return Box{vec({hx, hy, hz})}; }

inline void append_place(std::vector<double>& out, const Eigen::Vector3d& p) {
  out.insert(out.end(), p.data(), p.data() + 3);
}

template <class Kind>
std::unique_ptr<Case> make(const Making& making) {
  return std::make_unique<Kind>(making);
}

}  // namespace plumb::inline PLUMB_ABI::cells
