#include "decompose/concave_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/topology.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// Faces that bend inwards by less than this are flat: single-precision coordinates bend large flat
// regions by 1e-6, and no round surface has so many faces.
constexpr double kFlatAngle = 1e-3;  // [rad]
// Two planes this near to each other cut alike; of a solid of size 1.
constexpr double kSamePlane = 1e-3;

Vector3d normal_of(const std::vector<Vector3d>& places, const Triangle& t) {
  return (places[t[1]] - places[t[0]]).cross(places[t[2]] - places[t[0]]).normalized();
}

bool nearly_same(const CutPlane& p, const CutPlane& q) {
  const double sign = p.normal.dot(q.normal) < 0 ? -1 : 1;
  return (p.normal - sign * q.normal).norm() < kSamePlane &&
         std::abs(p.offset - sign * q.offset) < kSamePlane;
}

}  // namespace

std::vector<ConcaveEdge> concave_edges(const std::vector<Vector3d>& places,
                                       const std::vector<Triangle>& faces) {
  std::vector<ConcaveEdge> edges;
  const std::vector<EdgeUse> uses = sorted_edge_uses(faces);
  for_each_edge(uses, [&](std::size_t begin, std::size_t end) {
    if (end - begin != 2) return;
    const EdgeUse& use = uses[begin].forward ? uses[begin] : uses[begin + 1];
    const EdgeUse& other = uses[begin].forward ? uses[begin + 1] : uses[begin];
    if (other.forward) return;
    ConcaveEdge edge{places[use.low], places[use.high], normal_of(places, faces[use.face]),
                     normal_of(places, faces[other.face])};
    // Around the edge as the first face runs along it, a hollow turns the normals backwards.
    const Vector3d along = (edge.b - edge.a).normalized();
    edge.angle = -std::atan2(edge.normal_1.cross(edge.normal_2).dot(along),
                             edge.normal_1.dot(edge.normal_2));
    if (edge.angle > kFlatAngle) edges.push_back(edge);
  });
  return edges;
}

std::vector<ConcaveEdge> in_front(const std::vector<ConcaveEdge>& edges, const CutPlane& plane,
                                  double on_plane) {
  std::vector<ConcaveEdge> front;
  for (ConcaveEdge edge : edges) {
    const double ha = plane.height(edge.a), hb = plane.height(edge.b);
    if (ha <= on_plane && hb <= on_plane) continue;
    if (ha < 0 || hb < 0) {
      const Vector3d at_plane = edge.a + ha / (ha - hb) * (edge.b - edge.a);
      (ha < 0 ? edge.a : edge.b) = at_plane;
    }
    front.push_back(edge);
  }
  return front;
}

std::vector<CutPlane> planes_through(const std::vector<ConcaveEdge>& edges, std::size_t count) {
  std::vector<std::pair<double, std::size_t>> deepest;
  for (std::size_t k = 0; k < edges.size(); ++k)
    deepest.emplace_back(-(edges[k].b - edges[k].a).norm() * edges[k].angle, k);
  std::sort(deepest.begin(), deepest.end());
  std::vector<CutPlane> planes;
  for (const auto& [depth, k] : deepest) {
    const ConcaveEdge& edge = edges[k];
    // Midway between the faces lies the plane that holds the sum of their normals.
    const Vector3d along = (edge.b - edge.a).normalized();
    const Vector3d across = along.cross(edge.normal_1 + edge.normal_2);
    for (const Vector3d& normal : {edge.normal_1, edge.normal_2, across}) {
      if (planes.size() >= count) return planes;
      if (!(normal.norm() > 1e-6)) continue;  // a slit: both faces lie in the plane of the cut
      CutPlane plane{normal.normalized(), 0};
      plane.offset = plane.normal.dot(0.5 * (edge.a + edge.b));
      if (std::none_of(planes.begin(), planes.end(),
                       [&](const CutPlane& other) { return nearly_same(plane, other); }))
        planes.push_back(plane);
    }
  }
  return planes;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
