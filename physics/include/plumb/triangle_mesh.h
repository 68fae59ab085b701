// Surfaces of triangles, for bodies that nothing pushes (static and kinematic ones).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plumb/math.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

namespace detail {
struct MeshData;
}

// How a triangle meets its neighbour across an edge, seen from the front.
enum class EdgeKind : std::uint8_t {
  Open,     // no neighbour there: the surface ends
  Concave,  // the surfaces rise towards each other: nothing can touch the edge alone
  Flat,     // one plane goes on: the edge is no feature
  Convex,   // a ridge
};

// Triangles with a search tree and their neighbours, checked once when it is made, then shared by
// any number of colliders. A triangle's front is where its corners run counter-clockwise; only
// fronts collide. About 50 bytes a triangle in single precision (see bytes()).
class TriangleMeshGeometry {
 public:
  struct Result {
    std::shared_ptr<const TriangleMeshGeometry> mesh;
    Status status;
  };
  // vertices: [m] finite, within +-1e6 m. indices: three a triangle. Vertices at the same place are
  // one vertex. Triangles without area are left out and counted.
  static Result create(std::span<const Vec3> vertices, std::span<const std::uint32_t> indices);

  // Triangles are numbered in the order of the search tree.
  [[nodiscard]] std::size_t triangle_count() const;
  [[nodiscard]] std::array<Vec3, 3> triangle(std::size_t t) const;  // [m] corners
  [[nodiscard]] std::uint32_t source_of(std::size_t t) const;       // its number in `indices` / 3
  // Of the edge from corner k to the next.
  [[nodiscard]] EdgeKind edge_kind(std::size_t t, int k) const;
  [[nodiscard]] const Vec3& lower() const { return lower_; }  // [m] bounds
  [[nodiscard]] const Vec3& upper() const { return upper_; }  // [m]

  // What the input was worth. A surface that should be closed has no open edges.
  [[nodiscard]] std::size_t dropped_triangles() const;  // without area
  [[nodiscard]] std::size_t open_edges() const;
  [[nodiscard]] std::size_t odd_edges() const;  // of three or more triangles, or turned against
  [[nodiscard]] std::size_t bytes() const;      // of memory

  // The triangles as create() takes them to make the same mesh again, bit for bit.
  void copy_input(std::vector<Vec3>& vertices, std::vector<std::uint32_t>& indices) const;
  [[nodiscard]] const detail::MeshData& data() const { return *data_; }

 private:
  std::shared_ptr<const detail::MeshData> data_;
  Vec3 lower_ = Vec3::Zero(), upper_ = Vec3::Zero();
};

}  // namespace plumb::inline PLUMB_ABI
