#include "geometry/triangle_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/exact_predicates.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;
using FlatCorners = std::array<Vector2d, 3>;

// The axis along which a triangle shows the largest shadow: dropping it keeps the triangle's area.
int axis_to_drop(const Corners& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis);
}

Vector2d drop(const Vector3d& p, int axis) {
  return axis == 0   ? Vector2d(p.y(), p.z())
         : axis == 1 ? Vector2d(p.z(), p.x())
                     : Vector2d(p.x(), p.y());
}

// Counter-clockwise.
FlatCorners flat(const Corners& t, int axis) {
  FlatCorners f{drop(t[0], axis), drop(t[1], axis), drop(t[2], axis)};
  if (orientation_2d(f[0], f[1], f[2]) < 0) std::swap(f[1], f[2]);
  return f;
}

// p in the plane of t: inside or on the rim?
bool holds_coplanar_point(const Corners& t, const Vector3d& p) {
  const int axis = axis_to_drop(t);
  const FlatCorners f = flat(t, axis);
  const Vector2d q = drop(p, axis);
  return orientation_2d(f[0], f[1], q) >= 0 && orientation_2d(f[1], f[2], q) >= 0 &&
         orientation_2d(f[2], f[0], q) >= 0;
}

// The segment from p to q against the closed triangle t.
PairRelation segment_against(const Vector3d& p, const Vector3d& q, const Corners& t,
                             std::optional<Vector3d>& contact) {
  const int side_p = orientation_3d(t[0], t[1], t[2], p);
  const int side_q = orientation_3d(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return PairRelation::Apart;
  if (side_p == 0 || side_q == 0) {
    const bool p_hits = side_p == 0 && holds_coplanar_point(t, p);
    const bool q_hits = side_q == 0 && holds_coplanar_point(t, q);
    if (!p_hits && !q_hits) return PairRelation::Apart;
    contact = p_hits ? p : q;
    return PairRelation::Touching;
  }
  // The line p q passes the three edges on the same side exactly if it goes through the triangle.
  const int a = orientation_3d(p, q, t[0], t[1]);
  const int b = orientation_3d(p, q, t[1], t[2]);
  const int c = orientation_3d(p, q, t[2], t[0]);
  const int lowest = std::min({a, b, c}), highest = std::max({a, b, c});
  if (lowest < 0 && highest > 0) return PairRelation::Apart;
  if (a != 0 && b != 0 && c != 0) return PairRelation::Crossing;
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double height_p = normal.dot(p - t[0]), height_q = normal.dot(q - t[0]);
  contact = p + height_p / (height_p - height_q) * (q - p);
  return PairRelation::Touching;
}

// Do the insides of two triangles in one plane overlap? They do not if an edge of one has all of
// the other on its outer side.
bool coplanar_overlap(const Corners& first, const Corners& second) {
  const int axis = axis_to_drop(first);
  const FlatCorners f = flat(first, axis), g = flat(second, axis);
  const auto separated_by = [](const FlatCorners& edges, const FlatCorners& points) {
    for (std::size_t i = 0; i < 3; ++i) {
      const bool outside = std::all_of(points.begin(), points.end(), [&](const Vector2d& point) {
        return orientation_2d(edges[i], edges[(i + 1) % 3], point) <= 0;
      });
      if (outside) return true;
    }
    return false;
  };
  return !separated_by(f, g) && !separated_by(g, f);
}

PairRelation worse(PairRelation a, PairRelation b) { return std::max(a, b); }

}  // namespace

PairRelation relation_of(const std::vector<Vector3d>& places, const Triangle& first,
                         const Triangle& second, std::optional<Vector3d>& contact) {
  const Corners a{places[first[0]], places[first[1]], places[first[2]]};
  const Corners b{places[second[0]], places[second[1]], places[second[2]]};
  std::array<bool, 3> a_shared{}, b_shared{};
  int shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (first[i] != second[j]) continue;
      a_shared[i] = b_shared[j] = true;
      ++shared;
    }
  }
  // All of b on one side of a's plane, or the other way round: the usual case.
  std::array<int, 3> b_sides{};
  for (std::size_t j = 0; j < 3; ++j)
    b_sides[j] = b_shared[j] ? 0 : orientation_3d(a[0], a[1], a[2], b[j]);
  const auto [lowest, highest] = std::minmax_element(b_sides.begin(), b_sides.end());
  const bool coplanar = *lowest == 0 && *highest == 0;
  if (coplanar) return coplanar_overlap(a, b) ? PairRelation::Touching : PairRelation::Apart;
  if (shared == 2) return PairRelation::Apart;  // two planes meet in the shared edge only
  if (shared == 0 && (*lowest > 0 || *highest < 0)) return PairRelation::Apart;

  // With one shared vertex only the opposite edges can meet the other triangle anywhere else.
  PairRelation relation = PairRelation::Apart;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (!a_shared[i] && !a_shared[next])
      relation = worse(relation, segment_against(a[i], a[next], b, contact));
    if (!b_shared[i] && !b_shared[next])
      relation = worse(relation, segment_against(b[i], b[next], a, contact));
    if (relation == PairRelation::Crossing) return relation;
  }
  return relation;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
