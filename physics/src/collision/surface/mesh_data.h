// What a triangle mesh keeps: corners and neighbours of its triangles, in the order of its tree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "collision/surface/static_bvh.h"
#include "plumb/triangle_mesh.h"

namespace plumb::inline PLUMB_ABI::detail {

// The neighbour across an edge and how the two meet, in one word.
class EdgeLink {
 public:
  static constexpr std::uint32_t kNobody = (1U << 30) - 1;
  EdgeLink() = default;
  EdgeLink(std::uint32_t triangle, EdgeKind kind)
      : word_(triangle << 2 | static_cast<std::uint32_t>(kind)) {}
  // kNobody where there is none. A sharp open edge may have one: see EdgeKind and mesh creation.
  [[nodiscard]] std::uint32_t triangle() const { return word_ >> 2; }
  [[nodiscard]] EdgeKind kind() const { return static_cast<EdgeKind>(word_ & 3U); }

 private:
  std::uint32_t word_ = kNobody << 2;
};

struct MeshData {
  std::vector<Vec> vertices;                          // [m]
  std::vector<std::array<std::uint32_t, 3>> corners;  // of each triangle
  std::vector<std::array<EdgeLink, 3>> edges;         // the k-th joins corner k to the next
  std::vector<std::uint32_t> source;                  // number in the input
  StaticBvh tree;
  std::size_t dropped = 0, open_edges = 0, odd_edges = 0;
};

}  // namespace plumb::inline PLUMB_ABI::detail
