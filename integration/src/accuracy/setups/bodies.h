// Bodies of even density.
#pragma once

#include "accuracy/setups/setup.h"

namespace plumb::accuracy {

inline constexpr double kGravity = 9.81;  // [m/s^2]

inline SetupBody ball(double mass, double radius, const Eigen::Vector3d& position) {
  SetupBody body;
  body.shape = SetupBody::Shape::Sphere;
  body.radius = radius;
  body.mass = mass;
  body.moments = Eigen::Vector3d::Constant(0.4 * mass * radius * radius);
  body.position = position;
  return body;
}

inline SetupBody box(double mass, const Eigen::Vector3d& half, const Eigen::Vector3d& position) {
  SetupBody body;
  body.shape = SetupBody::Shape::Box;
  body.half = half;
  body.mass = mass;
  const Eigen::Vector3d h = half.cwiseProduct(half);
  body.moments = mass / 3 * Eigen::Vector3d(h.y() + h.z(), h.z() + h.x(), h.x() + h.y());
  body.position = position;
  return body;
}

}  // namespace plumb::accuracy
