#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hull/qhull.h"
#include "hull/simplify.h"
#include "mesh/topology.h"
#include "plumb/assets/hull.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace detail {
namespace {

using Eigen::Vector3d;

// The least extent over the largest below which points are said to be flat. Under it the merging of
// nearly coplanar faces would merge the whole body.
constexpr double kFlatExtent = 1e-8;

const char* kDimensionText[] = {"all stand in one place", "all lie on one line",
                                "all lie in one plane"};

// 0 one point, 1 a line, 2 a plane, 3 a body; of points of size about 1. Extents along the axes of
// the points themselves, found one after the other: farthest pair, farthest from the line, from the
// plane.
int dimension_of(const std::vector<Vector3d>& points) {
  const auto farthest = [&](auto&& distance) {
    return *std::max_element(
        points.begin(), points.end(),
        [&](const Vector3d& a, const Vector3d& b) { return distance(a) < distance(b); });
  };
  const Vector3d origin = points.front();
  const Vector3d a = farthest([&](const Vector3d& p) { return (p - origin).norm(); });
  if ((a - origin).norm() <= std::numeric_limits<double>::epsilon()) return 0;
  const Vector3d along = (a - origin).normalized();
  const auto off_line = [&](const Vector3d& p) { return (p - origin).cross(along).norm(); };
  const Vector3d b = farthest(off_line);
  if (off_line(b) <= kFlatExtent) return 1;
  const Vector3d normal = along.cross(b - origin).normalized();
  const auto off_plane = [&](const Vector3d& p) { return std::abs((p - origin).dot(normal)); };
  return off_plane(farthest(off_plane)) <= kFlatExtent ? 2 : 3;
}

// Points times faces up to which every pair is measured; beyond, Qhull's own bound is reported.
constexpr std::size_t kMaxMeasured = 20'000'000;

double measured_outside(const HullMesh& hull, const std::vector<Vector3d>& points) {
  double outside = 0;
  for (const auto& face : hull.faces) {
    const Vector3d normal = polygon_area_vector(hull.vertices, face).normalized();
    Vector3d on_plane = Vector3d::Zero();
    for (const std::uint32_t v : face)
      on_plane += hull.vertices[v] / static_cast<double>(face.size());
    for (const Vector3d& p : points) outside = std::max(outside, normal.dot(p - on_plane));
  }
  return outside;
}

}  // namespace

Vector3d polygon_area_vector(const std::vector<Vector3d>& vertices,
                             const std::vector<std::uint32_t>& face) {
  Vector3d area = Vector3d::Zero();
  const Vector3d& first = vertices[face[0]];
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    area += 0.5 * (vertices[face[i]] - first).cross(vertices[face[i + 1]] - first);
  }
  return area;
}

HullMesh compact_hull(const std::vector<Vector3d>& points, const Polygons& polygons) {
  constexpr std::uint32_t kAbsent = ~0u;
  std::vector<std::uint32_t> number(points.size(), kAbsent);
  HullMesh hull;
  for (const auto& polygon : polygons) {
    for (const std::uint32_t p : polygon) number[p] = 0;
  }
  for (std::size_t p = 0; p < points.size(); ++p) {  // kept in the order of the input
    if (number[p] == kAbsent) continue;
    number[p] = static_cast<std::uint32_t>(hull.vertices.size());
    hull.vertices.push_back(points[p]);
  }
  for (const auto& polygon : polygons) {
    auto& face = hull.faces.emplace_back();
    for (const std::uint32_t p : polygon) face.push_back(number[p]);
  }
  return hull;
}

}  // namespace detail

using Eigen::Vector3d;

Result<HullMesh> convex_hull(std::span<const Vector3d> points, const HullOptions& options) {
  if (points.size() < 4) {
    return Error{"convex hull: " + std::to_string(points.size()) +
                 " points do not make a body; 4 at least do"};
  }
  if (!(options.coplanar_tolerance >= 0 && options.coplanar_tolerance <= 1e-2)) {
    return Error{"convex hull: coplanar_tolerance must be 0 to 0.01"};
  }
  if (options.max_vertices != 0 && options.max_vertices < 4) {
    return Error{"convex hull: max_vertices must be 0 (all) or at least 4"};
  }
  Vector3d lower = points[0], upper = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      return Error{"convex hull: point " + std::to_string(i) + " is not finite"};
    lower = lower.cwiseMin(points[i]);
    upper = upper.cwiseMax(points[i]);
  }

  // Qhull's tolerances follow the size of the coordinates: near the origin and of size 1 they fit
  // bodies of any size anywhere.
  const Vector3d middle = 0.5 * lower + 0.5 * upper;
  const double size = (upper - lower).maxCoeff();
  const std::vector<Vector3d> all(points.begin(), points.end());
  const detail::Places places = detail::gather_places(all, 0);
  std::vector<Vector3d> unit = places.positions;
  if (!(size > 0)) return Error{"convex hull: the points all stand in one place"};
  for (Vector3d& p : unit) p = (p - middle) / size;
  const int dimension = detail::dimension_of(unit);
  if (dimension < 3) {
    return Error{std::string("convex hull: the points ") + detail::kDimensionText[dimension] +
                 "; a hull needs a body"};
  }
  const Result<detail::QhullRun> run = detail::run_qhull(unit, options.coplanar_tolerance);
  if (!run) return Error{run.error()};

  HullMesh full = detail::compact_hull(unit, run->polygons);
  full.full_vertex_count = full.vertices.size();
  if (options.max_vertices != 0 && full.vertices.size() > options.max_vertices) {
    Result<HullMesh> simple =
        detail::simplified(full, options.max_vertices, options.coplanar_tolerance);
    if (!simple) return Error{simple.error()};
    full = std::move(simple).value();
  } else {
    full.max_outside = unit.size() * full.faces.size() <= detail::kMaxMeasured
                           ? detail::measured_outside(full, unit)
                           : run->outer;
  }
  for (Vector3d& p : full.vertices) p = middle + size * p;
  full.max_outside *= size;
  full.simplification_distance *= size;
  return full;
}

TriangleMesh triangulated(const HullMesh& hull) {
  TriangleMesh mesh;
  mesh.name = "hull";
  mesh.vertices = hull.vertices;
  for (const auto& face : hull.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      mesh.triangles.push_back({face[0], face[i], face[i + 1]});
  }
  return mesh;
}

}  // namespace plumb::inline PLUMB_ABI::assets
