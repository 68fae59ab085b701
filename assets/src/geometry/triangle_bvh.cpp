#include "geometry/triangle_bvh.h"

#include <algorithm>
#include <utility>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

constexpr std::uint32_t kLeafSize = 4;  // triangles: below this a box test costs what a leaf costs

}  // namespace

TriangleBvh::TriangleBvh(const std::vector<Eigen::Vector3d>& vertices,
                         const std::vector<Triangle>& triangles, std::vector<std::uint32_t> which)
    : order_(std::move(which)) {
  if (order_.empty()) return;
  std::vector<Eigen::AlignedBox3d> box_of(triangles.size());
  for (const std::uint32_t t : order_) {
    for (const std::uint32_t v : triangles[t]) box_of[t].extend(vertices[v]);
  }
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(order_.size())});
  for (std::size_t n = 0; n < nodes_.size(); ++n) {  // nodes_ grows while we walk it
    const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
    Eigen::AlignedBox3d centers;
    for (std::uint32_t i = first; i < first + count; ++i) {
      nodes_[n].box.extend(box_of[order_[i]]);
      centers.extend(box_of[order_[i]].center());
    }
    if (count <= kLeafSize) continue;
    Eigen::Index axis = 0;
    centers.sizes().maxCoeff(&axis);
    const auto begin = order_.begin() + first;
    const auto middle = begin + count / 2;
    // Ties are broken by number, so that the tree is the same everywhere.
    std::nth_element(begin, middle, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      const double ca = box_of[a].center()[axis], cb = box_of[b].center()[axis];
      return ca != cb ? ca < cb : a < b;
    });
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_[n].first = left;
    nodes_[n].count = 0;
    nodes_.push_back({{}, first, count / 2});
    nodes_.push_back({{}, first + count / 2, count - count / 2});
  }
  boxes_.reserve(order_.size());
  for (const std::uint32_t t : order_) boxes_.push_back(box_of[t]);
}

void TriangleBvh::overlapping_pairs(
    const std::function<bool(std::uint32_t, std::uint32_t)>& visit) const {
  if (nodes_.empty()) return;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    const Node& node_a = nodes_[a];
    const Node& node_b = nodes_[b];
    if (a != b && !node_a.box.intersects(node_b.box)) continue;
    if (node_a.count > 0 && node_b.count > 0) {
      for (std::uint32_t i = node_a.first; i < node_a.first + node_a.count; ++i) {
        for (std::uint32_t j = (a == b ? i + 1 : node_b.first); j < node_b.first + node_b.count;
             ++j) {
          if (boxes_[i].intersects(boxes_[j]) && !visit(order_[i], order_[j])) return;
        }
      }
    } else if (a == b) {
      stack.push_back({node_a.first, node_a.first});
      stack.push_back({node_a.first + 1, node_a.first + 1});
      stack.push_back({node_a.first, node_a.first + 1});
    } else if (node_b.count > 0 ||
               (node_a.count == 0 && node_a.box.volume() >= node_b.box.volume())) {
      stack.push_back({node_a.first, b});
      stack.push_back({node_a.first + 1, b});
    } else {
      stack.push_back({a, node_b.first});
      stack.push_back({a, node_b.first + 1});
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
