// A bounding volume tree over the triangles of a mesh, for self-crossing and winding numbers.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "plumb/assets/mesh.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

class TriangleBvh {
 public:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first =
        0;  // leaf: first entry of order(); inner: left child, the right one follows
    std::uint32_t count = 0;  // triangles of a leaf; 0 = inner node
  };

  // Over the triangles listed in `which`; all their vertices must be finite.
  TriangleBvh(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles,
              std::vector<std::uint32_t> which);

  [[nodiscard]] const std::vector<Node>& nodes() const {
    return nodes_;
  }  // root first; empty if no triangle
  [[nodiscard]] const std::vector<std::uint32_t>& order() const {
    return order_;
  }  // triangle numbers, leaf by leaf

  // Every pair of triangles whose boxes overlap, each once. The visitor returns false to stop.
  void overlapping_pairs(const std::function<bool(std::uint32_t, std::uint32_t)>& visit) const;

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // of the triangles, in order()
};

}  // namespace plumb::inline PLUMB_ABI::assets::detail
