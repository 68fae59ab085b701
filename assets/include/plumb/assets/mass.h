// Volume, centre of mass and the full inertia tensor of a mesh.
//
// The method is chosen by name and never changed behind the caller's back: asking for Solid on a
// mesh that is not the boundary of a solid is an error that names the remedies.
#pragma once

#include <string>

#include "plumb/assets/certificate.h"
#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI::assets {

enum class MassMethod {
  Solid,  // exact integrals over the polyhedron; needs a certified solid
  Shell,  // a sheet of the given thickness around the faces; works for open meshes
  Hull,   // exact integrals over the convex hull of the vertices
  Voxel,  // little cubes whose centre is inside by winding number; for holes and self-crossings
};

struct MassOptions {
  MassMethod method = MassMethod::Solid;
  double density = 1000;       // [kg/m^3] > 0
  double total_mass = 0;       // [kg] > 0: overrides the density; 0 = use the density
  double shell_thickness = 0;  // [m] > 0 for Shell
  int voxel_resolution = 64;   // cubes along the longest side, 8 .. 512
};

// What the numbers may be off by, for the polyhedron as given. How well a polyhedron
// stands for the curved body it was made from is not known from the mesh alone.
struct MassError {
  double volume = 0;   // relative
  double center = 0;   // [m]
  double inertia = 0;  // relative to the largest principal moment
  std::string basis;   // where the figures come from
};

struct MeshMass {
  MassMethod method = MassMethod::Solid;
  double volume = 0;                                 // [m^3] of material
  double area = 0;                                   // [m^2] of the surface used
  double density = 0;                                // [kg/m^3]
  double mass = 0;                                   // [kg]
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // [m] centre of mass, mesh frame
  Eigen::Matrix3d I_Bcm_B =
      Eigen::Matrix3d::Zero();  // [kg m^2] about the centre, mesh axes, minus signs in
  Eigen::Vector3d principal_moments = Eigen::Vector3d::Zero();  // [kg m^2] ascending
  Eigen::Matrix3d R_BP = Eigen::Matrix3d::Identity();  // principal axes as columns, right-handed
  double inertia_condition = 0;                        // largest over smallest principal moment
  // (I1 + I2 - I3) / I3 of the ascending moments; a body has >= 0, a flat plate has 0.
  double triangle_margin = 0;
  MassError error;
};

Result<MeshMass> mass_of_mesh(const TriangleMesh& mesh, const MassOptions& options = {});
// With a certificate made before, so that it is not made again.
Result<MeshMass> mass_of_mesh(const TriangleMesh& mesh, const MeshCertificate& certificate,
                              const MassOptions& options);

const char* name_of(MassMethod method);
// "solid", "shell", "hull", "voxel".
Result<MassMethod> mass_method_from(const std::string& name);

}  // namespace plumb::inline PLUMB_ABI::assets
