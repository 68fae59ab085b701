// How often a surface winds around a point: 1 inside a solid, 0 outside, a fraction near the holes
// of an open surface. The sum of the signed solid angles of all faces over 4 pi [Van Oosterom
// 1983], with far groups of faces replaced by one dipole each [Barill 2018].
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

class WindingField {
 public:
  // The arrays must outlive the field. `which` lists the triangles to use, all with finite
  // vertices.
  WindingField(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles,
               std::vector<std::uint32_t> which);

  // At a point off the surface; error below 0.02.
  [[nodiscard]] double at(const Eigen::Vector3d& point) const;

  // Just in front of and just behind a face, at a point inside it. Faces that lie on it are seen.
  struct Sides {
    double front, back;
  };
  [[nodiscard]] Sides beside(std::uint32_t triangle, const Eigen::Vector3d& point) const;
  // At its centroid.
  [[nodiscard]] Sides beside(std::uint32_t triangle) const;

 private:
  struct Cluster {
    Eigen::Vector3d center;  // [m] centroid of the faces
    Eigen::Vector3d area;    // [m^2] sum of the area vectors
    double radius;           // [m] of the ball around the center that holds the faces
  };
  // Sums over faces other than `skip`; `lie_on` counts faces through the point, +1 for those that
  // look the same way as `normal`, -1 for the others.
  double sum(const Eigen::Vector3d& point, std::uint32_t skip, const Eigen::Vector3d& normal,
             double& lie_on) const;

  const std::vector<Eigen::Vector3d>& vertices_;
  const std::vector<Triangle>& triangles_;
  TriangleBvh bvh_;
  std::vector<Cluster> clusters_;  // of the tree's nodes
};

}  // namespace plumb::inline PLUMB_ABI::assets::detail
