#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mass/compensated_sum.h"
#include "mass/integrals.h"
#include "mesh/topology.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double angle_at(const Vector3d& apex, const Vector3d& p, const Vector3d& q) {
  const Vector3d a = p - apex, b = q - apex;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The total absolute curvature [sr]: what the corner angles around each inner place miss of a full
// turn. 4 pi for any convex surface.
double total_curvature(const std::vector<Vector3d>& places, const std::vector<Triangle>& faces) {
  std::vector<double> missing(places.size(), 2 * std::numbers::pi);
  std::vector<bool> rim(places.size(), false), used(places.size(), false);
  for (const Triangle& face : faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      missing[face[i]] -=
          angle_at(places[face[i]], places[face[(i + 1) % 3]], places[face[(i + 2) % 3]]);
      used[face[i]] = true;
    }
  }
  const auto uses = sorted_edge_uses(faces);
  for_each_edge(uses, [&](std::size_t begin, std::size_t end) {
    if (end - begin == 1) rim[uses[begin].low] = rim[uses[begin].high] = true;
  });
  double total = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (used[p] && !rim[p]) total += std::abs(missing[p]);
  }
  return total;
}

}  // namespace

Result<Moments> shell_moments(const TriangleMesh& mesh, double thickness) {
  const Places places = gather_places(mesh.vertices, 0);
  std::set<Triangle> seen;
  std::vector<Triangle> faces;
  for (const Triangle& triangle : mesh.triangles) {
    Triangle face{places.place_of[triangle[0]], places.place_of[triangle[1]],
                  places.place_of[triangle[2]]};
    Triangle key = face;
    std::sort(key.begin(), key.end());
    if (seen.insert(key).second) faces.push_back(face);
  }

  const Vector3d reference = bounds_of(mesh).center();
  CompensatedSum area;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero(), across = Matrix3d::Zero();
  for (const Triangle& face : faces) {
    const Vector3d a = places.positions[face[0]] - reference;
    const Vector3d b = places.positions[face[1]] - reference;
    const Vector3d c = places.positions[face[2]] - reference;
    const Vector3d s = a + b + c;
    const Vector3d normal = (b - a).cross(c - a);
    const double size = 0.5 * normal.norm();
    if (size == 0) continue;
    area.add(size);
    first += size / 3 * s;
    // Of a flat triangle: area / 12 (a a^T + b b^T + c c^T + s s^T).
    second +=
        size / 12 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    // The thickness spreads the mass along the normal by t^2 / 12.
    across +=
        size * thickness * thickness / 12 * normal * normal.transpose() / normal.squaredNorm();
  }
  const double total = area.value();
  if (!(total > 0))
    return Error{"mesh '" + mesh.name + "' has no area: method shell needs faces with area"};

  Moments moments;
  const Vector3d offset = first / total;
  moments.area = total;
  moments.volume = total * thickness;
  moments.center = reference + offset;
  moments.second = thickness * (second - total * offset * offset.transpose() + across);

  // Steiner's formula: a sheet around a surface of Gauss curvature K holds, beside area x t,
  // t^3 / 12 x integral of K; the same share bounds the moments' shift in kind.
  const double curvature = total_curvature(places.positions, faces);
  const double share =
      thickness * thickness / 12 * curvature / total + mesh.coordinate_rounding / std::sqrt(total);
  moments.error.volume = share;
  moments.error.center = share * bounds_of(mesh).diagonal();
  // Material on the outer side of a bend lies farther out by up to half a thickness, on the inner
  // side nearer; what does not cancel is again of second order, seen from the gyration radius.
  const double gyration_squared = moments.second.trace() / moments.volume;
  moments.error.inertia = share + thickness * thickness / gyration_squared;
  moments.error.basis = "sheet around curved or folded faces, second order in the thickness";
  return moments;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
