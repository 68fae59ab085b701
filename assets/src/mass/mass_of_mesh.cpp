#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "mass/integrals.h"
#include "plumb/assets/hull.h"
#include "plumb/assets/mass.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMinResolution = 8, kMaxResolution = 512;

// Products of inertia below this share of the trace are rounding: the axes stay the mesh's own
// instead of being spun by noise.
constexpr double kDiagonal = 1e-13;

// How far a computed tensor may miss the triangle inequality I1 + I2 >= I3 by rounding, relative.
constexpr double kTriangleSlack = 1e-9;

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// Moments ascending and a right-handed set of axes.
void principal_axes(MeshMass& mass) {
  const Matrix3d& tensor = mass.I_Bcm_B;
  const double off =
      std::max({std::abs(tensor(0, 1)), std::abs(tensor(0, 2)), std::abs(tensor(1, 2))});
  if (off <= kDiagonal * tensor.trace()) {
    std::array<Eigen::Index, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return tensor(a, a) < tensor(b, b); });
    mass.R_BP.setZero();
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index axis = order[static_cast<std::size_t>(k)];
      mass.principal_moments[k] = tensor(axis, axis);
      mass.R_BP(axis, k) = 1;
    }
  } else {
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(tensor);
    mass.principal_moments = solver.eigenvalues();
    mass.R_BP = solver.eigenvectors();
  }
  if (mass.R_BP.determinant() < 0) mass.R_BP.col(2) = -mass.R_BP.col(2);
}

Result<detail::Moments> moments_by(const TriangleMesh& mesh, const MeshCertificate& certificate,
                                   const MassOptions& options) {
  switch (options.method) {
    case MassMethod::Solid:
      if (!certificate.solid) {
        return Error{"mesh '" + mesh.name +
                     "' is not the boundary of a solid: " + certificate.fault_text()};
      }
      return detail::polyhedron_moments(mesh);
    case MassMethod::Shell:
      if (!(options.shell_thickness > 0) || !std::isfinite(options.shell_thickness)) {
        return Error{"mesh '" + mesh.name + "': method shell needs shell_thickness > 0 m"};
      }
      return detail::shell_moments(mesh, options.shell_thickness);
    case MassMethod::Hull: {
      std::vector<Vector3d> points;
      for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) points.push_back(mesh.vertices[v]);
      }
      const Result<HullMesh> hull = convex_hull(points);
      if (!hull) return Error{"mesh '" + mesh.name + "': " + hull.error()};
      TriangleMesh body = triangulated(*hull);
      body.coordinate_rounding = std::max(mesh.coordinate_rounding, hull->max_outside);
      detail::Moments moments = detail::polyhedron_moments(body);
      moments.error.basis =
          "rounding and merged faces; how far the hull is from the mesh is not counted";
      return moments;
    }
    case MassMethod::Voxel:
      if (options.voxel_resolution < kMinResolution || options.voxel_resolution > kMaxResolution) {
        return Error{"voxel_resolution must be " + std::to_string(kMinResolution) + " to " +
                     std::to_string(kMaxResolution)};
      }
      if (!certificate.consistently_oriented) {
        return Error{"mesh '" + mesh.name +
                     "': method voxel needs faces that agree on the outside; they disagree at " +
                     std::to_string(certificate.inconsistent_edges) +
                     " edges (remedy: repair with orient = true, or method shell or hull)"};
      }
      return detail::voxel_moments(mesh, certificate, options.voxel_resolution);
  }
  return Error{"unknown mass method"};
}

}  // namespace

Result<MeshMass> mass_of_mesh(const TriangleMesh& mesh, const MassOptions& options) {
  return mass_of_mesh(mesh, certify(mesh), options);
}

Result<MeshMass> mass_of_mesh(const TriangleMesh& mesh, const MeshCertificate& certificate,
                              const MassOptions& options) {
  if (certificate.non_finite_vertices > 0 || certificate.out_of_range_triangles > 0 ||
      mesh.triangles.empty()) {
    return Error{"mesh '" + mesh.name + "': " + certificate.fault_text()};
  }
  const bool by_mass = options.total_mass != 0;
  if (by_mass ? !(options.total_mass > 0 && std::isfinite(options.total_mass))
              : !(options.density > 0 && std::isfinite(options.density))) {
    return Error{"mesh '" + mesh.name + "': density and total_mass must be finite and above 0"};
  }
  const Result<detail::Moments> result = moments_by(mesh, certificate, options);
  if (!result) return Error{result.error()};
  const detail::Moments& moments = *result;
  if (!(moments.volume > 0) || !moments.second.allFinite() || !moments.center.allFinite()) {
    return Error{"mesh '" + mesh.name + "': volume " + short_number(moments.volume) +
                 " m^3 is not that of a body; scale the mesh to metres, or use method shell"};
  }

  MeshMass mass;
  mass.method = options.method;
  mass.volume = moments.volume;
  mass.area = moments.area;
  mass.mass = by_mass ? options.total_mass : options.density * moments.volume;
  mass.density = by_mass ? options.total_mass / moments.volume : options.density;
  mass.center = moments.center;
  // I = integral of (|r|^2 E - r r^T) dm
  mass.I_Bcm_B = mass.density * (moments.second.trace() * Matrix3d::Identity() - moments.second);
  principal_axes(mass);
  const Vector3d& principal = mass.principal_moments;
  if (!(principal[0] > 0) || !principal.allFinite()) {
    return Error{"mesh '" + mesh.name + "': the inertia tensor is not positive (smallest moment " +
                 short_number(principal[0]) + " kg m^2); the body is too thin for doubles"};
  }
  mass.inertia_condition = principal[2] / principal[0];
  mass.triangle_margin = (principal[0] + principal[1] - principal[2]) / principal[2];
  if (mass.triangle_margin < -kTriangleSlack) {
    return Error{"mesh '" + mesh.name + "': the moments break the triangle inequality by " +
                 short_number(-mass.triangle_margin) + "; the mesh is not that of a body"};
  }
  mass.error = moments.error;
  // The largest moment is at least half of the trace of the second moments times the density.
  mass.error.inertia *= moments.second.trace() * mass.density / principal[2];
  return mass;
}

const char* name_of(MassMethod method) {
  switch (method) {
    case MassMethod::Solid:
      return "solid";
    case MassMethod::Shell:
      return "shell";
    case MassMethod::Hull:
      return "hull";
    case MassMethod::Voxel:
      return "voxel";
  }
  return "?";
}

Result<MassMethod> mass_method_from(const std::string& name) {
  for (const MassMethod method :
       {MassMethod::Solid, MassMethod::Shell, MassMethod::Hull, MassMethod::Voxel}) {
    if (name == name_of(method)) return method;
  }
  return Error{"unknown mass method '" + name + "'; known are solid, shell, hull and voxel"};
}

}  // namespace plumb::inline PLUMB_ABI::assets
