#include "plumb/assets/visual.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>

#include "mesh/topology.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using Eigen::Vector3d;

std::array<float, 3> to_float(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

double angle_at(const Vector3d& apex, const Vector3d& p, const Vector3d& q) {
  const Vector3d a = p - apex, b = q - apex;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

VisualMesh visual_mesh(const TriangleMesh& mesh, const VisualOptions& options) {
  std::vector<Vector3d> vertices;
  std::vector<Triangle> faces;
  std::vector<Vector3d> normals;
  for (const Triangle& t : mesh.triangles) {
    bool usable = true;
    for (const std::uint32_t v : t)
      usable = usable && v < mesh.vertices.size() && mesh.vertices[v].allFinite();
    if (!usable) continue;
    const Vector3d normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    if (!(normal.norm() > 0)) continue;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const std::uint32_t v : t) vertices.push_back(mesh.vertices[v]);
    faces.push_back({first, first + 1, first + 2});
    normals.push_back(normal.normalized());
  }
  const detail::Places places = detail::gather_places(vertices, 0);
  std::vector<std::vector<std::uint32_t>> corners_at(places.positions.size());
  for (std::uint32_t corner = 0; corner < vertices.size(); ++corner) {
    corners_at[places.place_of[corner]].push_back(corner);
  }

  // Around each place: corners with the same smoothed normal become one vertex. Normals are
  // weighted by the angle of the corner, which does not depend on how a flat face is cut.
  const double cosine = std::cos(options.crease_angle);
  VisualMesh visual;
  std::vector<std::uint32_t> number(vertices.size(), 0);
  for (const auto& corners : corners_at) {
    std::vector<std::pair<Vector3d, std::uint32_t>> made;
    for (const std::uint32_t corner : corners) {
      const Vector3d& own = normals[corner / 3];
      Vector3d sum = Vector3d::Zero();
      for (const std::uint32_t other : corners) {
        const Vector3d& normal = normals[other / 3];
        if (normal.dot(own) < cosine) continue;
        const std::uint32_t base = other - other % 3, k = other % 3;
        sum +=
            angle_at(vertices[other], vertices[base + (k + 1) % 3], vertices[base + (k + 2) % 3]) *
            normal;
      }
      const Vector3d smooth = sum.norm() > 0 ? Vector3d(sum.normalized()) : own;
      std::size_t match = 0;
      while (match < made.size() && made[match].first != smooth) ++match;
      if (match == made.size()) {
        made.emplace_back(smooth, static_cast<std::uint32_t>(visual.positions.size()));
        visual.positions.push_back(to_float(vertices[corner] - options.origin));
        visual.normals.push_back(to_float(smooth));
      }
      number[corner] = made[match].second;
    }
  }
  for (const Triangle& face : faces)
    visual.triangles.push_back({number[face[0]], number[face[1]], number[face[2]]});
  return visual;
}

VisualMesh visual_mesh(const HullMesh& hull, const VisualOptions& options) {
  return visual_mesh(triangulated(hull), options);
}

}  // namespace plumb::inline PLUMB_ABI::assets
