// A tree of boxes that is built once and never changes: 16 bytes a node, leaves of up to four
// items.
//
// Node boxes are rounded outwards to 16 bits an axis over the bounds of the whole: a box is at most
// 1/65535 of that too large on each side, which costs a visit now and then and never an answer.
// Nodes stand in depth-first order: the first child of a node is the next one. Items are the
// caller's, put into the order of the leaves by build().
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/aabb_tree.h"
#include "collision/collision_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

struct NumBox {
  NumVec lower, upper;  // [m]
};
inline bool overlaps(const NumBox& a, const NumBox& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}
// 0 where they overlap [m^2].
inline Num squared_gap(const NumBox& a, const NumBox& b) {
  const NumVec d = max_each(max_each(a.lower - b.upper, b.lower - a.upper), NumVec{0, 0, 0});
  return length_squared(d);
}

// A segment origin + t direction, prepared for many boxes.
class SegmentQuery {
 public:
  SegmentQuery(NumVec origin, NumVec direction);
  // Whether the segment up to max_fraction meets the box, and where it enters (0 inside).
  [[nodiscard]] bool meets(const NumBox& box, Num max_fraction, Num& entry) const;

 private:
  std::array<Num, 3> origin_, direction_;
};

class StaticBvh {
 public:
  static constexpr std::uint32_t kLeafItems = 4;
  static constexpr std::uint32_t kMaxItems = 1U << 27;

  // Returns the order of the leaves: order[k] is the box that stands at place k. Needs boxes.
  std::vector<std::uint32_t> build(std::span<const NumBox> boxes);

  [[nodiscard]] std::size_t bytes() const { return nodes_.size() * sizeof(Node); }
  [[nodiscard]] NumBox bounds() const { return bounds_; }

  // Calls visit(place) for every item in a leaf whose box overlaps `box`, in ascending order.
  template <class Visit>
  void query(const NumBox& box, Visit&& visit) const;
  // Calls visit(place, max_fraction) -> new max fraction for items in leaves that the segment
  // meets, near leaves first.
  template <class Visit>
  void cast(const SegmentQuery& ray, Num max_fraction, Visit&& visit) const;
  // Calls visit(place, largest) -> new largest squared distance for items in leaves not farther
  // than that from the box, near leaves first. bound(node box) [m^2] is a lower bound of an item's
  // distance.
  template <class Bound, class Visit>
  void nearest(const Bound& bound, Num largest, Visit&& visit) const;

 private:
  struct Node {
    std::array<std::uint16_t, 3> lower, upper;
    std::uint32_t link;  // inner: second child; leaf: kLeaf | count << kCountShift | first place
  };
  static_assert(sizeof(Node) == 16);
  static constexpr std::uint32_t kLeaf = 1U << 31;
  static constexpr unsigned kCountShift = 27;
  static constexpr std::uint32_t kPlaceMask = (1U << kCountShift) - 1;
  static constexpr Num kSteps = 65535;  // of 16 bits

  struct Builder;
  [[nodiscard]] NumBox box_of(const Node& node) const;
  template <class Visit>
  static void each_item(const Node& node, Visit&& visit) {
    const std::uint32_t first = node.link & kPlaceMask;
    const std::uint32_t count = (node.link >> kCountShift) & 15U;
    for (std::uint32_t k = 0; k < count; ++k) visit(first + k);
  }

  std::vector<Node> nodes_;
  NumBox bounds_{{0, 0, 0}, {0, 0, 0}};
  NumVec step_{0, 0, 0};  // [m] of the rounding
};

template <class Visit>
void StaticBvh::query(const NumBox& box, Visit&& visit) const {
  TraversalStack<std::uint32_t> stack;
  if (!nodes_.empty()) stack.push(0);
  while (!stack.empty()) {
    const std::uint32_t at = stack.pop();
    const Node& node = nodes_[at];
    if (!overlaps(box_of(node), box)) continue;
    if ((node.link & kLeaf) != 0) {
      each_item(node, visit);
    } else {
      stack.push(node.link);
      stack.push(at + 1);
    }
  }
}

template <class Visit>
void StaticBvh::cast(const SegmentQuery& ray, Num max_fraction, Visit&& visit) const {
  struct Entry {
    std::uint32_t node;
    Num fraction;
  };
  TraversalStack<Entry> stack;
  Num entry = 0;
  if (nodes_.empty() || !ray.meets(box_of(nodes_[0]), max_fraction, entry)) return;
  stack.push({0, entry});
  while (!stack.empty()) {
    const Entry from = stack.pop();
    if (from.fraction > max_fraction) continue;
    const Node& node = nodes_[from.node];
    if ((node.link & kLeaf) != 0) {
      each_item(node, [&](std::uint32_t place) { max_fraction = visit(place, max_fraction); });
      continue;
    }
    Num near_first = 0, near_second = 0;
    const std::uint32_t first = from.node + 1, second = node.link;
    const bool meets_first = ray.meets(box_of(nodes_[first]), max_fraction, near_first);
    const bool meets_second = ray.meets(box_of(nodes_[second]), max_fraction, near_second);
    const bool second_is_nearer = near_second < near_first;
    if (meets_first && second_is_nearer) stack.push({first, near_first});
    if (meets_second) stack.push({second, near_second});
    if (meets_first && !second_is_nearer) stack.push({first, near_first});
  }
}

template <class Bound, class Visit>
void StaticBvh::nearest(const Bound& bound, Num largest, Visit&& visit) const {
  struct Entry {
    std::uint32_t node;
    Num distance;
  };
  TraversalStack<Entry> stack;
  if (!nodes_.empty()) stack.push({0, bound(box_of(nodes_[0]))});
  while (!stack.empty()) {
    const Entry from = stack.pop();
    if (from.distance > largest) continue;
    const Node& node = nodes_[from.node];
    if ((node.link & kLeaf) != 0) {
      each_item(node, [&](std::uint32_t place) { largest = visit(place, largest); });
      continue;
    }
    const std::uint32_t first = from.node + 1, second = node.link;
    const Num of_first = bound(box_of(nodes_[first])), of_second = bound(box_of(nodes_[second]));
    if (of_second < of_first) {
      stack.push({first, of_first});
      stack.push({second, of_second});
    } else {
      stack.push({second, of_second});
      stack.push({first, of_first});
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
