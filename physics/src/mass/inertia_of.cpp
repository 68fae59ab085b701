// Closed forms. Each is the integral I = integral (|r|^2 E - r r^T) dm of a uniform body; where a
// body is a sum of simpler ones the sum is left visible.
#include <algorithm>

#include "mass/inertia_tensor.h"
#include "plumb/mass_properties.h"

namespace plumb::inline PLUMB_ABI {
namespace inertia_of {
namespace {

MassProperties centred(double mass, double I_xx, double I_yy, double I_zz) {
  MassProperties body;
  body.mass = mass;
  body.I_Bcm_B.diagonal() << I_xx, I_yy, I_zz;
  return body;
}
// With the axis of revolution along y.
MassProperties round(double mass, double I_across, double I_axis) {
  return centred(mass, I_across, I_axis, I_across);
}

}  // namespace

MassProperties point(double mass, const Eigen::Vector3d& at) {
  MassProperties body;
  body.mass = mass;
  body.center = at;
  return body;
}

MassProperties particles(std::span<const double> masses,
                         std::span<const Eigen::Vector3d> positions) {
  const std::size_t count = std::min(masses.size(), positions.size());
  MassProperties body;
  if (count == 0) return body;
  // Places relative to the first one, then to the centre: nothing cancels far from the origin.
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    body.mass += masses[i];
    first_moment += masses[i] * (positions[i] - positions[0]);
  }
  if (body.mass == 0) return body;
  body.center = positions[0] + first_moment / body.mass;
  for (std::size_t i = 0; i < count; ++i) {
    body.I_Bcm_B += detail::point_inertia(masses[i], positions[i] - body.center);
  }
  return body;
}

MassProperties solid_sphere(double mass, double radius) {
  const double I = 2.0 / 5 * mass * radius * radius;
  return centred(mass, I, I, I);
}

MassProperties hollow_sphere(double mass, double radius) {
  const double I = 2.0 / 3 * mass * radius * radius;
  return centred(mass, I, I, I);
}

MassProperties ellipsoid(double mass, const Eigen::Vector3d& semi_axes) {
  const Eigen::Vector3d s = semi_axes.cwiseAbs2();
  const double f = mass / 5;
  return centred(mass, f * (s.y() + s.z()), f * (s.x() + s.z()), f * (s.x() + s.y()));
}

MassProperties box(double mass, const Eigen::Vector3d& half_extents) {
  const Eigen::Vector3d s = half_extents.cwiseAbs2();  // 1/3 on half sides, 1/12 on whole ones
  const double f = mass / 3;
  return centred(mass, f * (s.y() + s.z()), f * (s.x() + s.z()), f * (s.x() + s.y()));
}

MassProperties rod(double mass, double length) {
  return round(mass, mass * length * length / 12, 0);
}

MassProperties disc(double mass, double radius) {
  const double m_r2 = mass * radius * radius;
  return round(mass, m_r2 / 4, m_r2 / 2);
}

MassProperties plate(double mass, double width_x, double width_z) {
  const double along_x = mass * width_x * width_x / 12;  // integral x^2 dm
  const double along_z = mass * width_z * width_z / 12;
  return centred(mass, along_z, along_x + along_z, along_x);
}

MassProperties cylinder(double mass, double radius, double height) {
  return tube(mass, 0, radius, height);
}

MassProperties tube(double mass, double inner_radius, double outer_radius, double height) {
  const double squares = inner_radius * inner_radius + outer_radius * outer_radius;
  return round(mass, mass * (squares / 4 + height * height / 12), mass * squares / 2);
}

MassProperties cone(double mass, double radius, double height) {
  const double r2 = radius * radius, h2 = height * height;
  MassProperties body = round(mass, 3.0 / 80 * mass * (4 * r2 + h2), 3.0 / 10 * mass * r2);
  body.center = {0, height / 4, 0};
  return body;
}

MassProperties capsule(double mass, double radius, double half_length) {
  // A cylinder and two half balls, masses as their volumes (over pi r^2).
  const double r2 = radius * radius, cylinder_share = 2 * half_length,
               balls_share = 4.0 / 3 * radius;
  const double m_cylinder = mass * cylinder_share / (cylinder_share + balls_share);
  const double m_balls = mass * balls_share / (cylinder_share + balls_share);
  const double axis = m_cylinder * r2 / 2 + m_balls * 2 / 5 * r2;
  // A half ball has 83/320 m r^2 across about its own centre, which lies 3/8 r beyond its flat
  // side: 83/320 r^2 + (L + 3/8 r)^2 = 2/5 r^2 + L^2 + 3/4 r L.
  const double across =
      m_cylinder * (r2 / 4 + half_length * half_length / 3) +
      m_balls * (2.0 / 5 * r2 + half_length * half_length + 3.0 / 4 * radius * half_length);
  return round(mass, across, axis);
}

MassProperties torus(double mass, double ring_radius, double tube_radius) {
  const double R2 = ring_radius * ring_radius, r2 = tube_radius * tube_radius;
  return round(mass, mass * (R2 / 2 + 5.0 / 8 * r2), mass * (R2 + 3.0 / 4 * r2));
}

MassProperties tetrahedron(double mass, const std::array<Eigen::Vector3d, 4>& corners) {
  // Second moments about the centroid: m/20 times the sum over the corners of d d^T [Tonon 2005].
  const Eigen::Vector3d edges_sum =
      (corners[1] - corners[0]) + (corners[2] - corners[0]) + (corners[3] - corners[0]);
  MassProperties body;
  body.mass = mass;
  body.center = corners[0] + edges_sum / 4;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d d = (corner - corners[0]) - edges_sum / 4;
    second += d * d.transpose();
  }
  body.I_Bcm_B = detail::inertia_from_second_moments(mass / 20 * second);
  return body;
}

MassProperties octahedron(double mass, double edge) {
  const double I = mass * edge * edge / 10;
  return centred(mass, I, I, I);
}

}  // namespace inertia_of
}  // namespace plumb::inline PLUMB_ABI
