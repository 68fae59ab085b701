#include "mass/rounded_moments.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr double kPi = std::numbers::pi;

using Eigen::Matrix3d;
using Eigen::Vector3d;

// ---- figures of revolution: integrals of r^(i + 1) y^j over areas of the (r, y) half-plane ----

struct AreaMoments {
  double r = 0, r_y = 0, r_yy = 0, rrr = 0;  // integral r, r y, r y^2, r^3 dA
};

// Three points, weight 1/3 each, are exact to the second degree; these seven to the fifth [Radon
// 1948]. The integrands have degree three.
void add_triangle(ProfilePoint a, ProfilePoint b, ProfilePoint c, AreaMoments& sum) {
  const double area = 0.5 * ((b.r - a.r) * (c.y - a.y) - (c.r - a.r) * (b.y - a.y));
  const double root = std::sqrt(15.0);
  const double near = (6 - root) / 21, far = (6 + root) / 21;
  const double weight_near = (155 - root) / 1200, weight_far = (155 + root) / 1200;
  const auto point = [&](double u, double v, double weight) {
    const double w = 1 - u - v;
    const double r = u * a.r + v * b.r + w * c.r, y = u * a.y + v * b.y + w * c.y;
    const double f = weight * area * r;
    sum.r += f, sum.r_y += f * y, sum.r_yy += f * y * y, sum.rrr += f * r * r;
  };
  point(1.0 / 3, 1.0 / 3, 9.0 / 40);
  for (const auto& [u, weight] : {std::pair{near, weight_near}, std::pair{far, weight_far}}) {
    point(u, u, weight);
    point(u, 1 - 2 * u, weight);
    point(1 - 2 * u, u, weight);
  }
}

// The sector of radius q about a point between two angles (from the r axis towards y): with r = r0
// + s cos, y = y0 + s sin, the integrals of cos^i sin^j over the angle and s^(i + j + 1) over s.
void add_sector(ProfilePoint at, double q, double from, double to, AreaMoments& sum) {
  const double c0 = std::cos(from), s0 = std::sin(from), c1 = std::cos(to), s1 = std::sin(to);
  const double angle = to - from;
  const double c = s1 - s0, s = c0 - c1;  // integrals of cos, sin
  const double cc = angle / 2 + (s1 * c1 - s0 * c0) / 2, ss = angle - cc;
  const double cs = (s1 * s1 - s0 * s0) / 2;
  const double ccc = (s1 - s0) - (s1 * s1 * s1 - s0 * s0 * s0) / 3;
  const double css = (s1 * s1 * s1 - s0 * s0 * s0) / 3;
  const double q2 = q * q / 2, q3 = q * q * q / 3, q4 = q * q * q * q / 4;
  const double q5 = q * q * q * q * q / 5;
  const double r = at.r, y = at.y;
  sum.r += q2 * r * angle + q3 * c;
  sum.r_y += q2 * r * y * angle + q3 * (y * c + r * s) + q4 * cs;
  sum.r_yy += q2 * r * y * y * angle + q3 * (y * y * c + 2 * r * y * s) +
              q4 * (r * ss + 2 * y * cs) + q5 * css;
  sum.rrr += q2 * r * r * r * angle + q3 * 3 * r * r * c + q4 * 3 * r * cc + q5 * ccc;
}

// ---- hulls ----

void add_slab(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& n, double q,
              VolumeMoments& sum) {
  // Area moments of a triangle, swept along n by 0 ... q.
  const double area = (b - a).cross(c - a).norm() / 2;
  const Vector3d s = a + b + c, g = area / 3 * s;
  const Matrix3d G =
      area / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  sum.volume += area * q;
  sum.first += q * g + area * q * q / 2 * n;
  sum.second += q * G + q * q / 2 * (g * n.transpose() + n * g.transpose()) +
                area * q * q * q / 3 * n * n.transpose();
}

// A section with moments (area, f, S) about its corner, moved along an edge from a to b.
void add_edge_sector(const Vector3d& a, const Vector3d& b, const Vector3d& n1, const Vector3d& n2,
                     double q, VolumeMoments& sum) {
  const double sine = n1.cross(n2).norm(), angle = std::atan2(sine, n1.dot(n2));
  const Vector3d middle = (n1 + n2).normalized(), d = b - a;
  const Vector3d across = d.cross(middle).normalized();
  const double area = angle * q * q / 2, length = d.norm();
  const Vector3d f = q * q * q / 3 * 2 * std::sin(angle / 2) * middle;
  const Matrix3d S = q * q * q * q / 4 *
                     ((angle + sine) / 2 * middle * middle.transpose() +
                      (angle - sine) / 2 * across * across.transpose());
  const Vector3d c = (a + b) / 2;
  sum.volume += length * area;
  sum.first += length * (area * c + f);
  sum.second += length * (area * c * c.transpose() + c * f.transpose() + f * c.transpose() + S) +
                length * area / 12 * d * d.transpose();
}

// Moments over the directions in which a corner is the farthest point: a polygon on the unit sphere
// bounded by arcs between face normals. With u the direction, W the solid angle, and on each arc
// the outward unit vector e tangent to the sphere (constant: the direction of the edge):
//   integral u dW     = -1/2 sum angle e
//   integral u u^T dW = W/3 E - 1/6 sum (s e^T + e s^T),  s = integral u along the arc
// by the divergence theorem, since u and u u^T - E/3 are surface harmonics of degree 1 and 2.
struct CornerMoments {
  double solid_angle = 2 * kPi;  // less the face angles at the corner: the angle defect
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();  // without W/3 E
};

}  // namespace

VolumeMoments moments_of_rounded_box(const Vector3d& half, double q) {
  VolumeMoments sum;
  const double a[3] = {half.x(), half.y(), half.z()};
  const double q2 = q * q, q3 = q2 * q, q4 = q3 * q, q5 = q4 * q;
  for (int i = 0; i < 3; ++i) {
    const double x = a[i], u = a[(i + 1) % 3], v = a[(i + 2) % 3];
    // Faces across i, faces along i, edges along i (a disc in all), edges across i, corners (a ball
    // in all); integrals of (x + t)^2 with t >= 0 outward.
    double s = 8 * x * u * v * x * x / 3;
    s += 2 * 4 * u * v * ((x + q) * (x + q) * (x + q) - x * x * x) / 3;
    s += 8 * x * (u + v) * q * x * x / 3;
    s += 2 * x * kPi * q2 * x * x / 3;
    s += 2 * (u + v) * (kPi * q2 * x * x + 2 * x * 4 * q3 / 3 + kPi * q4 / 4);
    s += 4 * kPi / 3 * q3 * x * x + 2 * x * kPi * q4 / 2 + 4 * kPi * q5 / 15;
    sum.second(i, i) = s;
  }
  sum.volume = 8 * a[0] * a[1] * a[2] + 8 * q * (a[0] * a[1] + a[1] * a[2] + a[2] * a[0]) +
               2 * kPi * q2 * (a[0] + a[1] + a[2]) + 4 * kPi / 3 * q3;
  return sum;
}

VolumeMoments moments_of_revolution(std::span<const ProfilePoint> profile, double q) {
  AreaMoments area;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i)
    add_triangle(profile[0], profile[i], profile[i + 1], area);
  if (q > 0) {
    double last = -kPi / 2;  // outward direction of the side before: the profile starts on the axis
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const ProfilePoint a = profile[i], b = profile[i + 1];
      const double dr = b.r - a.r, dy = b.y - a.y, size = std::hypot(dr, dy);
      const double nr = dy / size, ny = -dr / size, angle = std::atan2(ny, nr);
      add_sector(a, q, last, angle, area);
      const ProfilePoint c{b.r + q * nr, b.y + q * ny}, d{a.r + q * nr, a.y + q * ny};
      add_triangle(a, d, c, area);
      add_triangle(a, c, b, area);
      last = angle;
    }
    add_sector(profile.back(), q, last, kPi / 2, area);
  }
  VolumeMoments sum;
  sum.volume = 2 * kPi * area.r;
  sum.first.y() = 2 * kPi * area.r_y;
  sum.second(0, 0) = sum.second(2, 2) = kPi * area.rrr;
  sum.second(1, 1) = 2 * kPi * area.r_yy;
  return sum;
}

VolumeMoments moments_of_hull_rounding(const HullGeometry& hull, double q,
                                       const Vector3d& reference) {
  VolumeMoments sum;
  std::vector<CornerMoments> corners(hull.vertices().size());
  const auto at = [&](std::uint32_t i) -> Vector3d {
    return hull.vertices()[i].cast<double>() - reference;
  };
  const auto normal = [&](std::size_t k) -> Vector3d {
    return hull.face_normals()[k].cast<double>().normalized();
  };
  for (std::size_t k = 0; k < hull.face_count(); ++k) {
    const std::span<const std::uint32_t> face = hull.face(k);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vector3d here = at(face[i]), next = at(face[(i + 1) % face.size()]) - here;
      const Vector3d before = at(face[(i + face.size() - 1) % face.size()]) - here;
      corners[face[i]].solid_angle -= std::atan2(next.cross(before).norm(), next.dot(before));
      if (i >= 2) add_slab(at(face[0]), at(face[i - 1]), here, normal(k), q, sum);
    }
  }
  for (const HullGeometry::Edge& edge : hull.edges()) {
    const Vector3d a = at(edge.v0), b = at(edge.v1), e = (b - a).normalized();
    const Vector3d n1 = normal(edge.face_a), n2 = normal(edge.face_b);
    add_edge_sector(a, b, n1, n2, q, sum);
    const double angle = std::atan2(n1.cross(n2).norm(), n1.dot(n2));
    const Vector3d along = 2 * std::sin(angle / 2) * (n1 + n2).normalized();
    const Matrix3d both = along * e.transpose() + e * along.transpose();
    corners[edge.v0].first -= angle / 2 * e;
    corners[edge.v1].first += angle / 2 * e;
    corners[edge.v0].second -= both / 6;
    corners[edge.v1].second += both / 6;
  }
  const double q3 = q * q * q / 3, q4 = q * q * q * q / 4, q5 = q * q * q * q * q / 5;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const CornerMoments& c = corners[i];
    const Vector3d p = at(i), f = q4 * c.first;
    const Matrix3d S = q5 * (c.second + c.solid_angle / 3 * Matrix3d::Identity());
    const double volume = q3 * c.solid_angle;
    sum.volume += volume;
    sum.first += volume * p + f;
    sum.second += volume * p * p.transpose() + p * f.transpose() + f * p.transpose() + S;
  }
  return sum;
}

}  // namespace plumb::inline PLUMB_ABI::detail
