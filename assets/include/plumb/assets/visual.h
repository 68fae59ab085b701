// What a viewer draws of a mesh: single precision, a normal at every corner, hard edges kept hard.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plumb/assets/hull.h"
#include "plumb/assets/mesh.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI::assets {

struct VisualMesh {
  std::vector<std::array<float, 3>> positions;  // [m] relative to the origin given
  std::vector<std::array<float, 3>> normals;    // [1] unit, one per position
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct VisualOptions {
  // The point of the mesh that becomes (0, 0, 0) [m]: the centre of mass where bodies are drawn
  // there.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  // Faces that meet at less than this share their normals; a larger angle stays an edge [rad].
  double crease_angle = 0.6;
};

// Triangles that are not finite or name no vertex are left out: there is nothing to draw.
VisualMesh visual_mesh(const TriangleMesh& mesh, const VisualOptions& options = {});
VisualMesh visual_mesh(const HullMesh& hull, const VisualOptions& options = {});

}  // namespace plumb::inline PLUMB_ABI::assets
