#include "plumb/assets/mesh.h"

#include <limits>

namespace plumb::inline PLUMB_ABI::assets {

MeshBounds bounds_of(const TriangleMesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  MeshBounds bounds{Eigen::Vector3d::Constant(kInfinity), Eigen::Vector3d::Constant(-kInfinity)};
  bool any = false;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) {
      if (index >= mesh.vertices.size() || !mesh.vertices[index].allFinite()) continue;
      bounds.lower = bounds.lower.cwiseMin(mesh.vertices[index]);
      bounds.upper = bounds.upper.cwiseMax(mesh.vertices[index]);
      any = true;
    }
  }
  return any ? bounds : MeshBounds{};
}

TriangleMesh translated(TriangleMesh mesh, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex += offset;
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex *= factor;
  mesh.coordinate_rounding *= factor;
  return mesh;
}

}  // namespace plumb::inline PLUMB_ABI::assets
