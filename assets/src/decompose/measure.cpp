#include "decompose/measure.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "decompose/hollow.h"
#include "geometry/triangle_distance.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// Of the distance asked for: how near the largest distance from parts to mesh is known.
constexpr double kResolution = 0.25;

// A part as it will collide.
struct FinalPart {
  PartHull hull;
  TriangleMesh surface;

  [[nodiscard]] double distance(const Vector3d& p) const {
    if (hull.height(p) <= 0) return 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : surface.triangles)
      nearest =
          std::min(nearest, distance_to_triangle(p, surface.vertices[t[0]], surface.vertices[t[1]],
                                                 surface.vertices[t[2]]));
    return nearest;
  }
};

double distance_to(const std::vector<FinalPart>& parts, const Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const FinalPart& part : parts) {
    if (part.hull.box.exteriorDistance(p) >= nearest) continue;
    nearest = std::min(nearest, part.distance(p));
    if (nearest == 0) break;
  }
  return nearest;
}

}  // namespace

void measure(const std::vector<Vector3d>& places, const std::vector<Triangle>& faces,
             const SolidField& solid, const std::vector<PartHull>& parts, Decomposition& out) {
  DecompositionReport& report = out.report;
  report.parts = out.parts.size();
  std::vector<FinalPart> finals;
  bool all_within = true;
  for (std::size_t k = 0; k < out.parts.size(); ++k) {
    const HullMesh& mesh = out.parts[k];
    report.vertices += mesh.vertices.size();
    report.most_vertices = std::max(report.most_vertices, mesh.vertices.size());
    const std::optional<PartHull> simple = part_hull(mesh.vertices);
    finals.push_back({simple ? *simple : parts[k], triangulated(mesh)});
    const PartHull& hull = finals.back().hull;
    report.parts_volume += hull.volume;
    if (parts[k].reach > 0)
      report.parts_beyond_mesh = std::max(
          report.parts_beyond_mesh, reach_beyond(hull, solid, kResolution * report.max_distance));
    all_within = all_within && parts[k].reach <= report.max_distance;
  }
  for (std::size_t i = 0; i < finals.size(); ++i) {
    for (std::size_t j = i + 1; j < finals.size(); ++j) {
      const double shared = shared_volume(finals[i].hull, finals[j].hull);
      report.overlap_volume += shared;
      report.largest_overlap = std::max(report.largest_overlap, shared);
    }
  }
  const auto sample = [&](const Vector3d& p) {
    ++report.samples;
    report.mesh_beyond_parts = std::max(report.mesh_beyond_parts, distance_to(finals, p));
  };
  for (const Vector3d& place : places) sample(place);
  for (const Triangle& t : faces) {
    const Vector3d &a = places[t[0]], &b = places[t[1]], &c = places[t[2]];
    sample((a + b + c) / 3);
    for (const Vector3d& middle : {Vector3d(a + b), Vector3d(b + c), Vector3d(c + a)})
      sample(0.5 * middle);
  }
  report.within_distance = all_within && report.mesh_beyond_parts <= report.max_distance;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
