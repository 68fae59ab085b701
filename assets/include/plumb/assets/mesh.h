// A triangle soup with shared vertices: what every importer produces and every mesh routine reads.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/math.h"
#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets {

using Triangle =
    std::array<std::uint32_t, 3>;  // vertex indices, counter-clockwise seen from outside

struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;  // [m]
  std::vector<Triangle> triangles;
  std::string name;
  // How far a stored coordinate may be from the one meant, because of the number type it came
  // through [m] >= 0; 0 = doubles, one rounding of their own. Enters the error estimates.
  double coordinate_rounding = 0;
};

struct MeshBounds {
  Eigen::Vector3d lower = Eigen::Vector3d::Zero();  // [m]
  Eigen::Vector3d upper = Eigen::Vector3d::Zero();  // [m]

  [[nodiscard]] Eigen::Vector3d center() const { return 0.5 * lower + 0.5 * upper; }
  [[nodiscard]] Eigen::Vector3d size() const { return upper - lower; }
  [[nodiscard]] double diagonal() const { return size().norm(); }  // [m]
};

// Of the vertices that triangles use and that are finite; zero if there are none.
MeshBounds bounds_of(const TriangleMesh& mesh);

// The mesh shifted by an offset [m].
TriangleMesh translated(TriangleMesh mesh, const Eigen::Vector3d& offset);
// The mesh scaled about the origin, factor > 0.
TriangleMesh scaled(TriangleMesh mesh, double factor);

}  // namespace plumb::inline PLUMB_ABI::assets
