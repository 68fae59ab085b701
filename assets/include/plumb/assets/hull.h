// The convex hull of points (Qhull), with coplanar faces merged into polygons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI::assets {

// A convex polyhedron: outward polygon faces, counter-clockwise seen from outside.
struct HullMesh {
  std::vector<Eigen::Vector3d> vertices;          // [m]
  std::vector<std::vector<std::uint32_t>> faces;  // at least 3 vertices each
  // The farthest that any input point stands out of any face plane [m]; about the merge width.
  double max_outside = 0;
  // What simplification cost: the farthest that a left-out hull vertex lies outside, and the share
  // of the volume lost.
  std::size_t full_vertex_count = 0;      // of the hull before simplification
  double simplification_distance = 0;     // [m]
  double simplification_volume_loss = 0;  // relative
};

struct HullOptions {
  // Neighbouring faces that are flat to this share of the size become one polygon. The default
  // stands above the rounding of coordinates that came through floats (6e-8).
  double coplanar_tolerance = 1e-6;  // relative, 0 .. 1e-2
  std::size_t max_vertices = 0;      // at least 4; 0 = all
};

// Vertex budget for colliders: enough for any shape a game throws, and a hull's cost grows with it.
inline constexpr std::size_t kColliderHullVertices = 64;

// Points [m]. Fails with a clear text on fewer than 4 points, non-finite points, and points that
// lie in one point, on one line or in one plane.
Result<HullMesh> convex_hull(std::span<const Eigen::Vector3d> points,
                             const HullOptions& options = {});

// The polygons cut into triangles.
TriangleMesh triangulated(const HullMesh& hull);

}  // namespace plumb::inline PLUMB_ABI::assets
