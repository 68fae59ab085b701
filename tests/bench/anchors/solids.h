// Bodies with the mass and principal inertia of their shape, filled evenly.
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "bench/anchors/scene.h"

namespace plumb::anchors {

inline Body box(const Vector3d& half, const Vector3d& position, double density = 1000) {
  Body body;
  body.shape = {.kind = ShapeKind::Box, .half = half};
  body.position = position;
  body.density = density;
  body.mass = density * 8 * half.prod();
  const Vector3d s = half.cwiseProduct(half);
  body.inertia = body.mass / 3 * Vector3d(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
  return body;
}

inline Body fixed_box(const Vector3d& half, const Vector3d& position) {
  Body body = box(half, position);
  body.mass = 0;
  return body;
}

// Solid below the plane through the origin with this normal.
inline Body fixed_plane(const Vector3d& normal) {
  Body body;
  body.shape = {.kind = ShapeKind::Plane, .half = {100, 1, 100}};
  body.orientation = Quaterniond::FromTwoVectors(Vector3d::UnitY(), normal);
  return body;
}

inline Body sphere(double radius, const Vector3d& position, double density = 1000) {
  Body body;
  body.shape = {.kind = ShapeKind::Sphere, .radius = radius};
  body.position = position;
  body.density = density;
  body.mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
  body.inertia = Vector3d::Constant(0.4 * body.mass * radius * radius);
  return body;
}

// Along y: a cylinder and two half balls.
inline Body capsule(double radius, double half_length, const Vector3d& position,
                    double density = 1000) {
  Body body;
  body.shape = {.kind = ShapeKind::Capsule, .radius = radius, .half_length = half_length};
  body.position = position;
  body.density = density;
  const double r2 = radius * radius, l = half_length;
  const double tube = density * std::numbers::pi * r2 * 2 * l;
  const double ball = density * 4 / 3 * std::numbers::pi * r2 * radius;
  body.mass = tube + ball;
  const double across = tube * (r2 / 4 + l * l / 3) + ball * (0.4 * r2 + l * l + 0.75 * l * radius);
  body.inertia = Vector3d(across, tube * r2 / 2 + ball * 0.4 * r2, across);
  return body;
}

// --- hulls ---------------------------------------------------------------------------------------

// The triangles that have every point behind them: the hull of points in general position.
inline Hull hull_of(const std::vector<Vector3d>& points) {
  Hull hull{points, {}};
  const auto n = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j)
      for (std::uint32_t k = i + 1; k < n; ++k) {
        if (k == j) continue;
        const Vector3d normal = (points[j] - points[i]).cross(points[k] - points[i]);
        bool outside = true;
        for (std::uint32_t m = 0; m < n && outside; ++m)
          outside = m == i || m == j || m == k || normal.dot(points[m] - points[i]) < 0;
        if (outside) hull.triangles.push_back({i, j, k});
      }
  return hull;
}

// Volume, first and second moments, summed over the tetrahedra between the origin and the faces.
struct HullMoments {
  double volume = 0;
  Vector3d center = Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, unit density
};
inline HullMoments moments_of(const Hull& hull) {
  HullMoments out;
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // integral of x x^T
  for (const auto& t : hull.triangles) {
    const Vector3d &a = hull.points[t[0]], &b = hull.points[t[1]], &c = hull.points[t[2]];
    const double volume = a.dot(b.cross(c)) / 6;
    const Vector3d sum = a + b + c;
    out.volume += volume;
    out.center += volume * sum / 4;
    second += volume / 20 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  out.center /= out.volume;
  second -= out.volume * out.center * out.center.transpose();
  out.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  return out;
}

// Moves the hull's centre of mass to the origin and turns its principal axes to x, y, z, moments
// ascending. Returns a body of it at the origin; Shape::hull is left to the caller.
inline Body centre(Hull& hull, double density = 1000) {
  const HullMoments moments = moments_of(hull);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments.inertia);
  Eigen::Matrix3d R = axes.eigenvectors();
  for (int k = 0; k < 2; ++k) {  // of the two signs, the one whose largest component is positive
    Eigen::Index largest = 0;
    R.col(k).cwiseAbs().maxCoeff(&largest);
    if (R(largest, k) < 0) R.col(k) = -R.col(k);
  }
  R.col(2) = R.col(0).cross(R.col(1));
  for (Vector3d& p : hull.points) p = R.transpose() * (p - moments.center);
  Body body;
  body.shape.kind = ShapeKind::Hull;
  body.density = density;
  body.mass = density * moments.volume;
  body.inertia = density * axes.eigenvalues();
  return body;
}

}  // namespace plumb::anchors
