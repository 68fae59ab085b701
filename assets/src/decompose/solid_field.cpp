#include "decompose/solid_field.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/triangle_distance.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

constexpr int kMaxDepth = 128;  // the tree halves its counts: 32 levels at most, two entries each
// The projection of a point must lie this far inside a face, as a share of its height.
constexpr double kMargin = 1e-6;

std::vector<std::uint32_t> all_of(const std::vector<Triangle>& faces) {
  std::vector<std::uint32_t> which(faces.size());
  std::iota(which.begin(), which.end(), 0u);
  return which;
}

}  // namespace

SolidField::SolidField(const std::vector<Vector3d>& places, const std::vector<Triangle>& faces,
                       bool faces_apart)
    : places_(places),
      faces_(faces),
      faces_apart_(faces_apart),
      bvh_(places, faces, all_of(faces)),
      winding_(places, faces, all_of(faces)) {}

double SolidField::distance_to(std::uint32_t face, const Vector3d& point) const {
  const Triangle& t = faces_[face];
  return distance_to_triangle(point, places_[t[0]], places_[t[1]], places_[t[2]]);
}

SolidField::Nearest SolidField::nearest(const Vector3d& point, std::uint32_t guess) const {
  const auto& nodes = bvh_.nodes();
  Nearest best{distance_to(guess, point), guess};
  struct Entry {
    std::uint32_t node;
    double squared;  // distance of its box
  };
  std::array<Entry, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, nodes[0].box.squaredExteriorDistance(point)};
  while (depth > 0) {
    const Entry entry = stack[--depth];
    if (entry.squared >= best.distance * best.distance) continue;
    const TriangleBvh::Node& node = nodes[entry.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::uint32_t face = bvh_.order()[i];
        const double distance = distance_to(face, point);
        if (distance < best.distance) best = {distance, face};
      }
      continue;
    }
    Entry near{node.first, nodes[node.first].box.squaredExteriorDistance(point)};
    Entry far{node.first + 1, nodes[node.first + 1].box.squaredExteriorDistance(point)};
    if (far.squared < near.squared) std::swap(near, far);
    stack[depth++] = far;
    stack[depth++] = near;
  }
  return best;
}

bool SolidField::is_inside(const Vector3d& point, std::uint32_t nearest_face) const {
  // In front of or behind the middle of a face the face itself tells the side; past its rim a
  // neighbour might have the last word.
  if (faces_apart_) {
    const Triangle& t = faces_[nearest_face];
    const Vector3d &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
    const Vector3d normal = (b - a).cross(c - a);
    const double margin = kMargin * normal.squaredNorm();
    const auto within = [&](const Vector3d& from, const Vector3d& to) {
      return normal.dot((to - from).cross(point - from)) > margin;
    };
    if (within(a, b) && within(b, c) && within(c, a)) return normal.dot(point - a) < 0;
  }
  return winding_.at(point) > 0.5;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
