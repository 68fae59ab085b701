// Places, edges and components of a mesh: what the certificate and the repair both need.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// Vertices gathered into places.
struct Places {
  std::vector<std::uint32_t> place_of;     // of each vertex
  std::vector<Eigen::Vector3d> positions;  // [m] of each place, that of its first vertex
};

// tolerance [m] >= 0; 0 gathers vertices at exactly the same place (-0 equals 0). With a tolerance,
// chains of near vertices become one place. All vertices must be finite.
Places gather_places(const std::vector<Eigen::Vector3d>& vertices, double tolerance);

// One side of a face.
struct EdgeUse {
  std::uint32_t low, high;  // places, low < high
  std::uint32_t face;
  std::uint8_t corner;  // the edge runs from this corner to the next
  bool forward;         // from low to high
};

// All sides of the faces, sorted so that the uses of an edge stand together. Sides that join a
// place to itself are left out (a face of repeated vertices has two opposite uses of the same edge
// left).
std::vector<EdgeUse> sorted_edge_uses(const std::vector<Triangle>& faces);

// Calls visit(begin, end) for the uses of each edge.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, Visit&& visit) {
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high)
      ++end;
    visit(begin, end);
    begin = end;
  }
}

// Disjoint sets with path halving.
class UnionFind {
 public:
  explicit UnionFind(std::size_t count);
  std::uint32_t find(std::uint32_t item);
  void join(std::uint32_t a, std::uint32_t b);  // the smaller number becomes the root

 private:
  std::vector<std::uint32_t> parent_;
};

// For every face whether it must be flipped so that neighbours across two-sided edges agree, the
// first face of each patch being kept. `orientable` is false if a patch contradicts itself.
struct Flips {
  std::vector<bool> flip;
  std::vector<std::uint32_t> patch_of;  // faces joined by two-sided edges
  std::size_t patches = 0;
  bool orientable = true;
};
Flips consistent_flips(std::size_t face_count, const std::vector<EdgeUse>& uses);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
