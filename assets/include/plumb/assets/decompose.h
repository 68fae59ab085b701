// A concave solid as a few convex parts, so that a body of it can move and keep its hollows.
//
// The solid is cut by planes, exactly, each time where the convex hulls of the two pieces are
// together smallest, until the hull of every piece stays near the mesh; pieces whose common hull
// stays near it too are joined again. The same mesh gives the same parts, bit for bit.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "plumb/assets/certificate.h"
#include "plumb/assets/hull.h"
#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"
#include "plumb/compound.h"

namespace plumb::inline PLUMB_ABI::assets {

// A hollow narrower or flatter than a fiftieth of the body is seldom one that something rests in;
// half of it makes about twice the parts.
inline constexpr double kPartsDistance = 0.02;  // of the longest side of the mesh
// What a body of a game can carry: each part that touches has contacts of its own.
inline constexpr std::size_t kDefaultMostParts = 32;
inline constexpr std::size_t kMostParts = 1024;
inline constexpr std::size_t kMostPartVertices = 256;  // what HullGeometry takes

struct DecomposeOptions {
  // How far a part may reach out of the mesh: no point of a part is farther from the solid than
  // this. Hollows narrower than twice of it may be filled. [m] > 0; 0 = kPartsDistance.
  double max_distance = 0;
  // Where the distance would need more parts, this wins, and the report says so. 1 .. kMostParts.
  std::size_t max_parts = kDefaultMostParts;
  // Rounder parts are simplified as convex_hull() does. 4 .. kMostPartVertices.
  std::size_t max_part_vertices = kColliderHullVertices;
};

struct DecompositionReport {
  std::size_t parts = 0;
  std::size_t vertices = 0;       // of all parts together
  std::size_t most_vertices = 0;  // of one part
  double mesh_volume = 0;         // [m^3]
  double parts_volume = 0;        // [m^3] sum over the parts
  double overlap_volume = 0;      // [m^3] sum over pairs of parts of what they share
  double largest_overlap = 0;     // [m^3] of one pair
  double max_distance = 0;        // [m] as asked for
  // The farthest from the solid, of points of the parts max_distance / 4 apart [m].
  double parts_beyond_mesh = 0;
  // The farthest that a point of the mesh lies outside of all parts [m]: the largest of samples on
  // every face, what simplifying the parts cost. 0 up to rounding where none was simplified.
  double mesh_beyond_parts = 0;
  std::size_t samples = 0;       // of mesh_beyond_parts
  bool within_distance = false;  // both are at most max_distance; of the parts, proven

  // One line for people, or several where something is worth a word.
  [[nodiscard]] std::string text() const;
};

struct Decomposition {
  std::vector<HullMesh> parts;  // [m] in the frame of the mesh
  DecompositionReport report;
};

// Fails, with the remedy, on anything but a certified solid: an open mesh has no inside to fill.
Result<Decomposition> decompose(const TriangleMesh& mesh, const DecomposeOptions& options = {});
// With a certificate made before, so that it is not made again.
Result<Decomposition> decompose(const TriangleMesh& mesh, const MeshCertificate& certificate,
                                const DecomposeOptions& options);

// One collider for the engine, parts in place. `origin` [m] becomes (0, 0, 0). The mass of a body
// of it is that of the mesh (mass.h): parts that overlap would count twice.
Result<std::shared_ptr<const CompoundGeometry>> to_physics(
    const Decomposition& decomposition, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace plumb::inline PLUMB_ABI::assets
