// The usable part of a mesh as a surface over places, with its edges and components.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/topology.h"
#include "plumb/assets/certificate.h"
#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

struct Surface {
  std::vector<Eigen::Vector3d> places;  // [m]
  std::vector<Triangle> faces;          // of places; faces with a repeated place are left out
  std::vector<std::uint32_t> source;    // triangle number in the mesh, of each face
  std::vector<double> areas;            // [m^2] of each face, 0 for a degenerate one
  std::vector<EdgeUse> uses;
  std::vector<std::uint32_t> component_of;  // of each face
};

// Builds the surface and fills in the counts of the certificate up to the components.
Surface examine_surface(const TriangleMesh& mesh, MeshCertificate& certificate);

// How the surface lies in space: fills in the crossing counts, the winding numbers and the
// cavities. Needs a finite mesh.
void examine_embedding(const Surface& surface, const CertifyOptions& options,
                       MeshCertificate& certificate);

// Turns what was found into faults, notes and the verdict.
void conclude(const Surface& surface, MeshCertificate& certificate);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
