#include "decompose/part_hull.h"

#include <algorithm>
#include <limits>

#include "hull/qhull.h"
#include "hull/simplify.h"
#include "plumb/assets/hull.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// Less than the coplanar points of a float mesh need costs a few faces more, not a wrong volume.
constexpr double kMergeWidth = 1e-9;
// Sizes below this are flat: solids of the search are of size 1.
constexpr double kFlat = 1e-9;

}  // namespace

double PartHull::height(const Vector3d& p) const {
  double highest = -std::numeric_limits<double>::infinity();
  for (const CutPlane& plane : planes) highest = std::max(highest, plane.height(p));
  return highest;
}

std::optional<PartHull> part_hull(const std::vector<Vector3d>& points) {
  if (points.size() < 4) return std::nullopt;
  PartHull hull;
  for (const Vector3d& p : points) hull.box.extend(p);
  const double size = hull.box.sizes().maxCoeff();
  if (!(hull.box.sizes().minCoeff() > kFlat)) return std::nullopt;
  const Vector3d middle = hull.box.center();
  std::vector<Vector3d> unit;
  unit.reserve(points.size());
  for (const Vector3d& p : points) unit.emplace_back((p - middle) / size);
  const Result<QhullRun> run = run_qhull(unit, kMergeWidth);
  if (!run) return std::nullopt;

  std::vector<bool> is_corner(points.size(), false);
  for (const auto& face : run->polygons) {
    const Vector3d area = polygon_area_vector(points, face);
    hull.volume += (points[face[0]] - middle).dot(area) / 3;
    for (const std::uint32_t p : face) is_corner[p] = true;
    if (!(area.norm() > 0)) continue;
    CutPlane plane{area.normalized(), -std::numeric_limits<double>::infinity()};
    for (const std::uint32_t p : face)
      plane.offset = std::max(plane.offset, plane.normal.dot(points[p]));
    hull.planes.push_back(plane);
  }
  for (std::size_t p = 0; p < points.size(); ++p)
    if (is_corner[p]) hull.corners.push_back(points[p]);
  if (!(hull.volume > 0)) return std::nullopt;
  return hull;
}

std::optional<PartHull> joined(const PartHull& a, const PartHull& b) {
  std::vector<Vector3d> points = a.corners;
  points.insert(points.end(), b.corners.begin(), b.corners.end());
  return part_hull(points);
}

double shared_volume(const PartHull& a, const PartHull& b) {
  if (!a.box.intersects(b.box)) return 0;
  const Result<QhullRun> run = run_qhull(a.corners, kMergeWidth);
  if (!run) return 0;
  Piece piece;
  piece.points = a.corners;
  for (const auto& face : run->polygons) {
    for (std::size_t k = 0; k < face.size(); ++k)
      piece.edges.push_back({face[k], face[(k + 1) % face.size()]});
    piece.face_ends.push_back(static_cast<std::uint32_t>(piece.edges.size()));
  }
  for (const CutPlane& plane : b.planes) {
    piece = in_front(piece, plane.flipped(), kFlat);
    if (piece.face_ends.empty()) return 0;
  }
  return std::max(piece.volume, 0.0);
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
