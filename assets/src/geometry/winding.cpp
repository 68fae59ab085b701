#include "geometry/winding.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// A group of faces may stand as one dipole from this many of its radii away. The next term falls
// with the square of it; 3 keeps the error of a whole field below 0.02 where 0.25 would still do.
constexpr double kFarRadii = 3;

// A point counts as lying on a face when its distance is below this share of the lengths around it:
// well above the rounding of a centroid, far below any gap that a mesh means.
constexpr double kOnFace = 1e-10;

constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();
constexpr int kMaxDepth = 128;  // the tree halves its counts: 32 levels at most, two entries each

}  // namespace

WindingField::WindingField(const std::vector<Vector3d>& vertices,
                           const std::vector<Triangle>& triangles, std::vector<std::uint32_t> which)
    : vertices_(vertices), triangles_(triangles), bvh_(vertices, triangles, std::move(which)) {
  const auto& nodes = bvh_.nodes();
  clusters_.resize(nodes.size());
  // Children stand behind their parent, so walking backwards meets them first.
  std::vector<double> size_of(nodes.size(), 0);
  for (std::size_t n = nodes.size(); n-- > 0;) {
    Vector3d area = Vector3d::Zero(), moment = Vector3d::Zero();
    double size = 0;
    if (nodes[n].count > 0) {
      for (std::uint32_t i = nodes[n].first; i < nodes[n].first + nodes[n].count; ++i) {
        const Triangle& t = triangles_[bvh_.order()[i]];
        const Vector3d &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
        const Vector3d face = 0.5 * (b - a).cross(c - a);
        const double face_size = face.norm();
        area += face;
        size += face_size;
        moment += face_size * (a + (b - a) / 3 + (c - a) / 3);
      }
    } else {
      for (std::uint32_t child : {nodes[n].first, nodes[n].first + 1}) {
        area += clusters_[child].area;
        size += size_of[child];
        moment += size_of[child] * clusters_[child].center;
      }
    }
    const Vector3d center = size > 0 ? Vector3d(moment / size) : nodes[n].box.center();
    const Vector3d reach = (nodes[n].box.max() - center).cwiseMax(center - nodes[n].box.min());
    size_of[n] = size;
    clusters_[n] = {center, area, reach.norm()};
  }
}

double WindingField::sum(const Vector3d& point, std::uint32_t skip, const Vector3d& normal,
                         double& lie_on) const {
  const auto& nodes = bvh_.nodes();
  if (nodes.empty()) return 0;
  double angle = 0;  // [sr]
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t n = stack[--depth];
    const Cluster& cluster = clusters_[n];
    const Vector3d away = cluster.center - point;
    const double distance = away.norm();
    if (distance > kFarRadii * cluster.radius) {
      angle += cluster.area.dot(away) / (distance * distance * distance);
      continue;
    }
    if (nodes[n].count == 0) {
      stack[depth++] = nodes[n].first;
      stack[depth++] = nodes[n].first + 1;
      continue;
    }
    for (std::uint32_t i = nodes[n].first; i < nodes[n].first + nodes[n].count; ++i) {
      const std::uint32_t number = bvh_.order()[i];
      if (number == skip) continue;
      const Triangle& t = triangles_[number];
      const Vector3d a = vertices_[t[0]] - point, b = vertices_[t[1]] - point,
                     c = vertices_[t[2]] - point;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      const double volume = a.dot(b.cross(c));
      const double spread = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
      if (spread <= 0 && std::abs(volume) <= kOnFace * la * lb * lc) {
        const Vector3d other = (b - a).cross(c - a);
        lie_on += other.dot(normal) >= 0 ? 1 : -1;
        continue;  // seen half from either side: no net angle
      }
      angle += 2 * std::atan2(volume, spread);
    }
  }
  return angle / (4 * std::numbers::pi);
}

double WindingField::at(const Vector3d& point) const {
  double lie_on = 0;
  return sum(point, kNoTriangle, Vector3d::Zero(), lie_on);
}

WindingField::Sides WindingField::beside(std::uint32_t triangle, const Vector3d& point) const {
  const Triangle& t = triangles_[triangle];
  const Vector3d normal =
      (vertices_[t[1]] - vertices_[t[0]]).cross(vertices_[t[2]] - vertices_[t[0]]);
  double jump = 1;  // this face itself
  const double middle = sum(point, triangle, normal, jump);
  return {middle - 0.5 * jump, middle + 0.5 * jump};
}

WindingField::Sides WindingField::beside(std::uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  const Vector3d &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
  return beside(triangle, a + (b - a) / 3 + (c - a) / 3);
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
