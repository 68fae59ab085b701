// The plane that cuts a piece best: where the hulls of the two sides fill least beyond the solid.
#pragma once

#include <optional>
#include <vector>

#include "decompose/concave_edges.h"
#include "decompose/part_hull.h"
#include "decompose/piece.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

struct Node {
  Piece piece;
  std::vector<ConcaveEdge> concave;
  PartHull hull;

  // What the hull fills beyond the piece.
  [[nodiscard]] double excess() const { return hull.volume - piece.volume; }
};

struct BestCut {
  Node front, back;
};

// None if no plane leaves two bodies. `on_plane`: see in_front().
std::optional<BestCut> best_cut(const Node& node, double on_plane);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
