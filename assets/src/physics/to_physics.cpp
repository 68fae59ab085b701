#include "plumb/assets/to_physics.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace plumb::inline PLUMB_ABI::assets {

Result<MassProperties> to_physics(const MeshMass& mass) {
  MassProperties properties{mass.mass, mass.center, mass.I_Bcm_B};
  if (const Status status = check(properties); !status.ok()) return Error{status.message};
  return properties;
}

Result<std::shared_ptr<const HullGeometry>> to_physics(const HullMesh& hull,
                                                       const Eigen::Vector3d& origin) {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> sizes, indices;
  for (const Eigen::Vector3d& vertex : hull.vertices)
    vertices.push_back((vertex - origin).cast<Real>());
  for (const std::vector<std::uint32_t>& face : hull.faces) {
    sizes.push_back(static_cast<std::uint32_t>(face.size()));
    indices.insert(indices.end(), face.begin(), face.end());
  }
  HullGeometry::Result result = HullGeometry::create(vertices, sizes, indices);
  if (!result.status.ok()) return Error{std::string("hull geometry: ") + result.status.message};
  return std::move(result.hull);
}

Result<std::shared_ptr<const TriangleMeshGeometry>> to_physics(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  for (const Eigen::Vector3d& vertex : mesh.vertices) vertices.push_back(vertex.cast<Real>());
  for (const Triangle& triangle : mesh.triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  TriangleMeshGeometry::Result result = TriangleMeshGeometry::create(vertices, indices);
  if (!result.status.ok()) return Error{std::string("surface: ") + result.status.message};
  return std::move(result.mesh);
}

}  // namespace plumb::inline PLUMB_ABI::assets
