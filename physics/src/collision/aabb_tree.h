// A balanced tree of axis-aligned boxes over colliders (broadphase).
//
// Leaves hold the boxes given, inner nodes the union of their two children. Three rules shape it:
//   where a new leaf goes      the place that adds least surface area: the chance that a query
//   meets
//                              a box is proportional to its area [MacDonald 1990], [Catto 2019]
//   what a change repairs      on the way up, a child and a grandchild change places where that
//                              makes the area smaller (tree rotation) [Kopta 2012]
//   what is never given up     the heights of two siblings differ by at most 2. N(h), the fewest
//                              leaves at height h, obeys N(h) = N(h-1) + N(h-3), growth 1.4656 a
//                              level, so height <= 1.82 log2(leaves) after any calls
//                              [Adelson-Velsky 1962] with 2 in the place of 1
//
// The tree depends on the order of calls alone (no clock, no address). Const calls may run in many
// threads at once. Boxes hold no NaN; lower <= upper; +-1e30 m and beyond stand for "no end".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail {

// World bounds in PosReal, so that worlds far from the origin keep tight boxes.
struct WorldAabb {
  PosVec lower, upper;  // [m]
};
inline bool overlaps(const WorldAabb& a, const WorldAabb& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
         b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}
inline bool contains(const WorldAabb& outer, const WorldAabb& inner) {
  return outer.lower.x <= inner.lower.x && outer.lower.y <= inner.lower.y &&
         outer.lower.z <= inner.lower.z && inner.upper.x <= outer.upper.x &&
         inner.upper.y <= outer.upper.y && inner.upper.z <= outer.upper.z;
}
inline WorldAabb union_of(const WorldAabb& a, const WorldAabb& b) {
  return {min_each(a.lower, b.lower), max_each(a.upper, b.upper)};
}

// Distance of two boxes [m]; 0 when they overlap.
inline PosReal distance_of(const WorldAabb& a, const WorldAabb& b) {
  const PosVec gap = max_each(max_each(a.lower - b.upper, b.lower - a.upper), PosVec{0, 0, 0});
  return length(gap);
}

// A ray prepared for many slab tests.
class RayQuery {
 public:
  RayQuery(PosVec origin, PosVec direction);
  // Rounding of a difference, a product and an inverse, twice: fractions compared with this slack
  // lose no box along whose face, edge or corner the ray runs [Ize 2013].
  static constexpr PosReal kSlack = 1 + 4 * std::numeric_limits<PosReal>::epsilon();

  // Whether the segment up to max_fraction meets the box; the fraction where it enters (0 inside).
  bool meets(const WorldAabb& box, PosReal max_fraction, PosReal& entry) const;

 private:
  bool clip(int axis, PosReal lower, PosReal upper, PosReal& entry, PosReal& exit) const;
  std::array<PosReal, 3> origin_, inverse_;  // [m], [1/m]; inverse 0 marks an axis without motion
};

// Last in, first out; the first entries need no allocation and there is no last one.
template <class Entry>
class TraversalStack {
 public:
  void push(const Entry& entry) {
    if (size_ < kInline) {
      inline_[size_] = entry;
    } else {
      more_.push_back(entry);
    }
    ++size_;
  }
  Entry pop() {
    --size_;
    if (size_ < kInline) return inline_[size_];
    const Entry entry = more_.back();
    more_.pop_back();
    return entry;
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }

 private:
  static constexpr std::size_t kInline = 64;  // a walk holds height + 1 entries: 2^34 leaves
  std::array<Entry, kInline> inline_;
  std::vector<Entry> more_;
  std::size_t size_ = 0;
};

class AabbTree {
 public:
  static constexpr std::int32_t kNull = -1;

  // Adds a leaf and returns its proxy, valid until removed.
  std::int32_t insert(const WorldAabb& box, std::uint32_t item);
  void remove(std::int32_t proxy);
  // Gives a leaf another box and restores order on the way up. A leaf that stays within its
  // parent's box keeps its place; another one is taken out and put in anew, under the same proxy.
  void move(std::int32_t proxy, const WorldAabb& box);

  [[nodiscard]] const WorldAabb& box(std::int32_t proxy) const { return node(proxy).box; }
  [[nodiscard]] std::uint32_t item(std::int32_t proxy) const { return node(proxy).item; }
  [[nodiscard]] int height() const;  // 0 for a single leaf, -1 when empty
  [[nodiscard]] std::size_t leaf_count() const { return leaf_count_; }
  void clear();
  // Every inner box is the union of its children, links agree, heights are right and balanced, no
  // node is lost.
  [[nodiscard]] bool is_consistent() const;

  // Calls visit(item) for every leaf whose box overlaps `box` (closed boxes: touching counts), each
  // once.
  template <class Visit>
  void query(const WorldAabb& box, Visit&& visit) const;

  // Calls visit(item, max_fraction) -> new max fraction (not above the old one; <= 0 stops) for
  // leaves whose box the segment origin + t direction, 0 <= t <= max_fraction, meets; of two
  // branches the one entered first is followed first.
  template <class Visit>
  void cast_ray(PosVec origin, PosVec direction, PosReal max_fraction, Visit&& visit) const;

  // The same for a box that moves by t direction from where it is given.
  template <class Visit>
  void cast_box(const WorldAabb& box, PosVec direction, PosReal max_fraction, Visit&& visit) const;

  // Calls visit(item, max_distance) -> new max distance (not above the old one; < 0 stops) for
  // leaves whose box is no farther than max_distance [m] from the given one; of two branches the
  // nearer one is followed first.
  template <class Visit>
  void nearest(const WorldAabb& box, PosReal max_distance, Visit&& visit) const;

 private:
  template <class BoxOf, class Visit>
  void walk_ray(const RayQuery& ray, PosReal max_fraction, BoxOf&& box_of, Visit&& visit) const;

  struct Node {
    WorldAabb box;
    std::int32_t parent = kNull;  // the next free node while the node is free
    std::array<std::int32_t, 2> child{kNull, kNull};
    std::int32_t height = 0;  // leaf 0, free kFree
    std::uint32_t item = 0;   // leaves only
    [[nodiscard]] bool is_leaf() const { return child[0] == kNull; }
  };
  static constexpr std::int32_t kFree = -1;
  static constexpr std::int32_t kMaxImbalance = 2;  // between heights of siblings, see above

  Node& node(std::int32_t i) { return nodes_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Node& node(std::int32_t i) const {
    return nodes_[static_cast<std::size_t>(i)];
  }
  std::int32_t allocate();
  void release(std::int32_t i);
  void link_leaf(std::int32_t leaf);
  void unlink_leaf(std::int32_t leaf);
  [[nodiscard]] std::int32_t best_sibling(const WorldAabb& box) const;
  [[nodiscard]] std::size_t nearer_child(const Node& parent, const WorldAabb& box) const;
  void set_child(std::int32_t parent, int slot, std::int32_t child);
  void replace_child(std::int32_t parent, std::int32_t old_child, std::int32_t new_child);
  void update(std::int32_t i);
  std::int32_t balance(std::int32_t i);
  void rotate(std::int32_t i);
  void repair_upwards(std::int32_t i);
  [[nodiscard]] bool is_node_consistent(std::int32_t i) const;

  std::vector<Node> nodes_;
  std::int32_t root_ = kNull;
  std::int32_t first_free_ = kNull;
  std::size_t leaf_count_ = 0;
};

template <class Visit>
void AabbTree::query(const WorldAabb& box, Visit&& visit) const {
  if (root_ == kNull || !overlaps(node(root_).box, box)) return;
  TraversalStack<std::int32_t> stack;
  stack.push(root_);
  while (!stack.empty()) {
    const Node& at = node(stack.pop());
    if (at.is_leaf()) {
      visit(at.item);
      continue;
    }
    for (const std::int32_t child : at.child) {
      if (overlaps(node(child).box, box)) stack.push(child);
    }
  }
}

template <class Visit>
void AabbTree::nearest(const WorldAabb& box, PosReal max_distance, Visit&& visit) const {
  struct Entry {
    std::int32_t node;
    PosReal distance;
  };
  if (root_ == kNull) return;
  TraversalStack<Entry> stack;
  stack.push({root_, distance_of(node(root_).box, box)});
  while (!stack.empty()) {
    const Entry entry = stack.pop();
    if (!(entry.distance <= max_distance * RayQuery::kSlack)) continue;
    const Node& at = node(entry.node);
    if (at.is_leaf()) {
      max_distance = visit(at.item, max_distance);
      if (max_distance < PosReal(0)) return;
      continue;
    }
    const Entry a{at.child[0], distance_of(node(at.child[0]).box, box)};
    const Entry b{at.child[1], distance_of(node(at.child[1]).box, box)};
    const bool b_is_nearer = b.distance < a.distance;
    stack.push(b_is_nearer ? a : b);
    stack.push(b_is_nearer ? b : a);
  }
}

// box_of(box): what the ray has to meet in place of a node's box.
template <class BoxOf, class Visit>
void AabbTree::walk_ray(const RayQuery& ray, PosReal max_fraction, BoxOf&& box_of,
                        Visit&& visit) const {
  struct Entry {
    std::int32_t node;
    PosReal fraction;
  };
  PosReal at_root;
  if (root_ == kNull || !ray.meets(box_of(node(root_).box), max_fraction, at_root)) return;
  TraversalStack<Entry> stack;
  stack.push({root_, at_root});
  while (!stack.empty()) {
    const Entry entry = stack.pop();
    if (entry.fraction > max_fraction * RayQuery::kSlack) continue;
    const Node& at = node(entry.node);
    if (at.is_leaf()) {
      max_fraction = visit(at.item, max_fraction);
      if (!(max_fraction > PosReal(0))) return;
      continue;
    }
    std::array<PosReal, 2> fraction{};
    const bool first = ray.meets(box_of(node(at.child[0]).box), max_fraction, fraction[0]);
    const bool second = ray.meets(box_of(node(at.child[1]).box), max_fraction, fraction[1]);
    const bool second_is_nearer = fraction[1] < fraction[0];
    if (first && second_is_nearer) stack.push({at.child[0], fraction[0]});
    if (second) stack.push({at.child[1], fraction[1]});
    if (first && !second_is_nearer) stack.push({at.child[0], fraction[0]});
  }
}

template <class Visit>
void AabbTree::cast_ray(PosVec origin, PosVec direction, PosReal max_fraction,
                        Visit&& visit) const {
  walk_ray(
      RayQuery(origin, direction), max_fraction,
      [](const WorldAabb& box) -> const WorldAabb& { return box; }, visit);
}

template <class Visit>
void AabbTree::cast_box(const WorldAabb& box, PosVec direction, PosReal max_fraction,
                        Visit&& visit) const {
  const PosVec centre = PosReal(0.5) * (box.lower + box.upper);
  // Rounding of the centre must not make the box smaller.
  constexpr PosReal kRounding = 4 * std::numeric_limits<PosReal>::epsilon();
  const PosVec reach = max_each(box.upper - centre, centre - box.lower) +
                       kRounding * max_each(absolute(box.lower), absolute(box.upper));
  walk_ray(
      RayQuery(centre, direction), max_fraction,
      [reach](const WorldAabb& node_box) {
        return WorldAabb{node_box.lower - reach, node_box.upper + reach};
      },
      visit);
}

}  // namespace plumb::inline PLUMB_ABI::detail
