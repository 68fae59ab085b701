#include "hull/simplify.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/triangle_distance.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

struct Plane {
  Vector3d normal, point;
};

std::vector<Plane> planes_of(const HullMesh& hull) {
  std::vector<Plane> planes;
  for (const auto& face : hull.faces) {
    planes.push_back(
        {polygon_area_vector(hull.vertices, face).normalized(), hull.vertices[face[0]]});
  }
  return planes;
}

double height_outside(const std::vector<Plane>& planes, const Vector3d& p) {
  double height = 0;
  for (const Plane& plane : planes) height = std::max(height, plane.normal.dot(p - plane.point));
  return height;
}

double volume_of(const HullMesh& hull) {
  double volume = 0;
  for (const auto& face : hull.faces) {
    volume += hull.vertices[face[0]].dot(polygon_area_vector(hull.vertices, face)) / 3;
  }
  return volume;
}

// A tetrahedron to start from: a lowest vertex, the farthest from it, the farthest from their line,
// the farthest from their plane.
std::vector<std::size_t> first_four(const std::vector<Vector3d>& points) {
  const auto farthest = [&](auto&& distance) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (distance(points[i]) > distance(points[best])) best = i;
    }
    return best;
  };
  const std::size_t a = farthest([](const Vector3d& p) { return -p.x(); });
  const std::size_t b = farthest([&](const Vector3d& p) { return (p - points[a]).norm(); });
  const Vector3d along = (points[b] - points[a]).normalized();
  const std::size_t c =
      farthest([&](const Vector3d& p) { return (p - points[a]).cross(along).norm(); });
  const Vector3d normal = along.cross(points[c] - points[a]).normalized();
  const std::size_t d =
      farthest([&](const Vector3d& p) { return std::abs((p - points[a]).dot(normal)); });
  return {a, b, c, d};
}

}  // namespace

Result<HullMesh> simplified(const HullMesh& full, std::size_t max_vertices,
                            double coplanar_tolerance) {
  std::vector<std::size_t> chosen = first_four(full.vertices);
  HullMesh hull;
  for (;;) {
    std::vector<Vector3d> points;
    for (const std::size_t i : chosen) points.push_back(full.vertices[i]);
    const Result<QhullRun> run = run_qhull(points, coplanar_tolerance);
    if (!run) return Error{run.error()};
    hull = compact_hull(points, run->polygons);
    if (chosen.size() >= max_vertices) break;
    const std::vector<Plane> planes = planes_of(hull);
    std::size_t best = 0;
    double highest = 0;
    for (std::size_t i = 0; i < full.vertices.size(); ++i) {
      const double height = height_outside(planes, full.vertices[i]);
      if (height <= highest) continue;
      highest = height;
      best = i;
    }
    if (highest <= coplanar_tolerance) break;  // the rest lies in the faces
    chosen.push_back(best);
  }

  hull.full_vertex_count = full.vertices.size();
  const TriangleMesh triangles = triangulated(hull);
  const std::vector<Plane> planes = planes_of(hull);
  for (const Vector3d& p : full.vertices) {
    if (height_outside(planes, p) <= 0) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles.triangles) {
      nearest = std::min(nearest, distance_to_triangle(p, hull.vertices[t[0]], hull.vertices[t[1]],
                                                       hull.vertices[t[2]]));
    }
    hull.simplification_distance = std::max(hull.simplification_distance, nearest);
  }
  hull.max_outside = hull.simplification_distance;
  hull.simplification_volume_loss = 1 - volume_of(hull) / volume_of(full);
  return hull;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
