// The moments of a body up to the second, about a point of choice: what each mass method yields and
// what the inertia tensor is made of.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plumb/assets/mass.h"
#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

struct Moments {
  double volume = 0;                                 // [m^3]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // [m] mesh frame
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // [m^5] integral of r r^T about the center
  double area = 0;                                   // [m^2]
  MassError error;                                   // inertia: relative to the trace of `second`
};

// Exact integrals over the body that closed, oriented triangles bound.
Moments polyhedron_moments(const TriangleMesh& mesh);

// A sheet of the given thickness, half of it on either side of the faces. Faces that are there
// twice count once.
Result<Moments> shell_moments(const TriangleMesh& mesh, double thickness);

// Cubes whose centre is inside; `resolution` of them along the longest side.
Result<Moments> voxel_moments(const TriangleMesh& mesh, const MeshCertificate& certificate,
                              int resolution);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
