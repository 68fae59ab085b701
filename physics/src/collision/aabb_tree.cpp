#include "collision/aabb_tree.h"

#include <cassert>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Half the surface of a box [m^2]. In double, because the boxes of half-spaces are 2e30 m wide; the
// cap keeps squares of anything wider finite, so that differences of costs are never NaN.
constexpr double kWidestSide = 1e100;  // [m]

double cost_of(const WorldAabb& box) {
  const auto side = [](PosReal lower, PosReal upper) {
    return std::min(static_cast<double>(upper) - static_cast<double>(lower), kWidestSide);
  };
  const double x = side(box.lower.x, box.upper.x);
  const double y = side(box.lower.y, box.upper.y);
  const double z = side(box.lower.z, box.upper.z);
  return x * y + y * z + z * x;
}

// Twice the distance between the centres, summed over the axes [m]: decides between equal costs.
double remoteness(const WorldAabb& a, const WorldAabb& b) {
  const auto along = [](PosReal la, PosReal ua, PosReal lb, PosReal ub) {
    return std::abs((static_cast<double>(la) + static_cast<double>(ua)) -
                    (static_cast<double>(lb) + static_cast<double>(ub)));
  };
  return along(a.lower.x, a.upper.x, b.lower.x, b.upper.x) +
         along(a.lower.y, a.upper.y, b.lower.y, b.upper.y) +
         along(a.lower.z, a.upper.z, b.lower.z, b.upper.z);
}

bool is_same(const WorldAabb& a, const WorldAabb& b) { return contains(a, b) && contains(b, a); }

}  // namespace

RayQuery::RayQuery(PosVec origin, PosVec direction) : origin_{origin.x, origin.y, origin.z} {
  const auto inverse = [](PosReal d) {
    const PosReal value = d == PosReal(0) ? PosReal(0) : PosReal(1) / d;
    return std::isfinite(value) ? value : PosReal(0);
  };
  inverse_ = {inverse(direction.x), inverse(direction.y), inverse(direction.z)};
}

bool RayQuery::clip(int axis, PosReal lower, PosReal upper, PosReal& entry, PosReal& exit) const {
  const auto k = static_cast<std::size_t>(axis);
  if (inverse_[k] == PosReal(0)) return lower <= origin_[k] && origin_[k] <= upper;
  const PosReal a = (lower - origin_[k]) * inverse_[k];
  const PosReal b = (upper - origin_[k]) * inverse_[k];
  entry = std::max(entry, std::min(a, b));
  exit = std::min(exit, std::max(a, b) * kSlack);
  return entry <= exit;
}

bool RayQuery::meets(const WorldAabb& box, PosReal max_fraction, PosReal& entry) const {
  entry = PosReal(0);
  PosReal exit = max_fraction * kSlack;
  // All three in any case: which axis parts a ray from a box cannot be foretold.
  const bool x = clip(0, box.lower.x, box.upper.x, entry, exit);
  const bool y = clip(1, box.lower.y, box.upper.y, entry, exit);
  const bool z = clip(2, box.lower.z, box.upper.z, entry, exit);
  return x & y & z;
}

std::int32_t AabbTree::insert(const WorldAabb& box, std::uint32_t item) {
  const std::int32_t leaf = allocate();
  node(leaf).box = box;
  node(leaf).item = item;
  link_leaf(leaf);
  ++leaf_count_;
  return leaf;
}

void AabbTree::remove(std::int32_t proxy) {
  assert(node(proxy).height == 0);
  unlink_leaf(proxy);
  release(proxy);
  --leaf_count_;
}

void AabbTree::move(std::int32_t proxy, const WorldAabb& box) {
  assert(node(proxy).height == 0);
  const std::int32_t parent = node(proxy).parent;
  if (parent == kNull || contains(node(parent).box, box)) {
    node(proxy).box = box;
    repair_upwards(parent);
    return;
  }
  unlink_leaf(proxy);
  node(proxy).box = box;
  link_leaf(proxy);
}

int AabbTree::height() const { return root_ == kNull ? -1 : node(root_).height; }

void AabbTree::clear() {
  nodes_.clear();
  root_ = kNull;
  first_free_ = kNull;
  leaf_count_ = 0;
}

// Which child's centre is nearer to that of a box; the lower child where both are as near.
std::size_t AabbTree::nearer_child(const Node& parent, const WorldAabb& box) const {
  const Node& a = node(parent.child[0]);
  const Node& b = node(parent.child[1]);
  const double to_a = remoteness(a.box, box), to_b = remoteness(b.box, box);
  return to_b < to_a || (to_b == to_a && b.height < a.height) ? 1 : 0;
}

std::int32_t AabbTree::allocate() {
  if (first_free_ == kNull) {
    nodes_.emplace_back();
    return static_cast<std::int32_t>(nodes_.size()) - 1;
  }
  const std::int32_t i = first_free_;
  first_free_ = node(i).parent;
  node(i) = Node{};
  return i;
}

void AabbTree::release(std::int32_t i) {
  node(i) = Node{};
  node(i).height = kFree;
  node(i).parent = first_free_;
  first_free_ = i;
}

// The node beside which a new leaf adds least area. Putting it beside node s costs
//   area(s with box) + sum over the ancestors a of s of [area(a with box) - area(a)],
// the new parent and the growth of those above it. The walk goes down the cheaper side and keeps
// the best node passed, until neither side can beat it [Catto 2019].
std::int32_t AabbTree::best_sibling(const WorldAabb& box) const {
  const double own = cost_of(box);
  std::int32_t at = root_, best = root_;
  double direct = cost_of(union_of(node(at).box, box));
  double inherited = 0, best_cost = direct;
  while (!node(at).is_leaf()) {
    inherited += direct - cost_of(node(at).box);
    std::array<double, 2> child_direct{}, bound{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Node& child = node(node(at).child[k]);
      child_direct[k] = cost_of(union_of(child.box, box));
      const double cost = child_direct[k] + inherited;
      // Ties go down: in a heap of equal boxes the tree then grows at its leaves.
      if (cost < best_cost || (cost == best_cost && child.is_leaf())) {
        best = node(at).child[k];
        best_cost = cost;
      }
      // Below an inner child at least its growth and the new leaf's own area have to be paid.
      bound[k] = child.is_leaf() ? std::numeric_limits<double>::infinity()
                                 : cost + std::min(own - cost_of(child.box), 0.0);
    }
    const std::size_t next =
        bound[0] == bound[1] ? nearer_child(node(at), box) : (bound[1] < bound[0] ? 1 : 0);
    if (!(bound[next] <= best_cost)) break;
    at = node(at).child[next];
    direct = child_direct[next];
  }
  return best;
}

void AabbTree::link_leaf(std::int32_t leaf) {
  if (root_ == kNull) {
    root_ = leaf;
    node(leaf).parent = kNull;
    return;
  }
  const std::int32_t sibling = best_sibling(node(leaf).box);
  const std::int32_t parent = allocate();
  replace_child(node(sibling).parent, sibling, parent);
  set_child(parent, 0, sibling);
  set_child(parent, 1, leaf);
  repair_upwards(parent);
}

void AabbTree::unlink_leaf(std::int32_t leaf) {
  const std::int32_t parent = node(leaf).parent;
  if (parent == kNull) {
    root_ = kNull;
    return;
  }
  const std::int32_t sibling = node(parent).child[node(parent).child[0] == leaf ? 1 : 0];
  const std::int32_t grandparent = node(parent).parent;
  replace_child(grandparent, parent, sibling);
  release(parent);
  repair_upwards(grandparent);
}

void AabbTree::set_child(std::int32_t parent, int slot, std::int32_t child) {
  node(parent).child[static_cast<std::size_t>(slot)] = child;
  node(child).parent = parent;
}

void AabbTree::replace_child(std::int32_t parent, std::int32_t old_child, std::int32_t new_child) {
  if (parent == kNull) {
    root_ = new_child;
    node(new_child).parent = kNull;
  } else {
    set_child(parent, node(parent).child[0] == old_child ? 0 : 1, new_child);
  }
}

void AabbTree::update(std::int32_t i) {
  const Node& a = node(node(i).child[0]);
  const Node& b = node(node(i).child[1]);
  node(i).box = union_of(a.box, b.box);
  node(i).height = 1 + std::max(a.height, b.height);
}

// Joins two balanced children whose heights may differ by any amount; returns the node that now
// stands in the place of i, up to date.
//        i                 tall
//      /   \              /    \          low and `joins` may again differ too much:
//    low   tall    ->    i    stays       the same one level further down, where the result has
//          /  \         / \               the height of `joins`, or one more, so tall is balanced
//     joins   stays   low joins
std::int32_t AabbTree::balance(std::int32_t i) {
  const int tall_slot = node(node(i).child[1]).height > node(node(i).child[0]).height ? 1 : 0;
  const std::int32_t tall = node(i).child[static_cast<std::size_t>(tall_slot)];
  const std::int32_t low = node(i).child[static_cast<std::size_t>(1 - tall_slot)];
  const std::int32_t low_height = node(low).height, tall_height = node(tall).height;
  if (tall_height - low_height <= kMaxImbalance) {
    update(i);
    return i;
  }
  // The lower of tall's children joins; where both may, the one that makes the smaller box.
  const std::array<std::int32_t, 2> below = node(tall).child;
  std::size_t joins = node(below[1]).height < node(below[0]).height ? 1 : 0;
  if (node(below[joins]).height >= tall_height - kMaxImbalance) {
    const double first = cost_of(union_of(node(low).box, node(below[0]).box));
    const double second = cost_of(union_of(node(low).box, node(below[1]).box));
    if (first != second) joins = second < first ? 1 : 0;
  }
  replace_child(node(i).parent, i, tall);
  set_child(tall, static_cast<int>(joins), i);
  set_child(i, tall_slot, below[joins]);
  balance(i);
  update(tall);
  return tall;
}

// Exchanges one child of i with a child of the other one, where that makes the other one's box
// smaller and keeps the balance. The box of i itself stays as it is.
void AabbTree::rotate(std::int32_t i) {
  int best_slot = -1;  // of the child that goes down
  std::size_t best_below = 0;
  double best_gain = 0;
  for (int slot = 0; slot < 2; ++slot) {
    const Node& down = node(node(i).child[static_cast<std::size_t>(slot)]);
    const Node& other = node(node(i).child[static_cast<std::size_t>(1 - slot)]);
    if (other.is_leaf()) continue;
    for (std::size_t below = 0; below < 2; ++below) {
      const Node& up = node(other.child[below]);
      const Node& stays = node(other.child[1 - below]);
      const std::int32_t other_height = 1 + std::max(down.height, stays.height);
      if (std::abs(down.height - stays.height) > kMaxImbalance ||
          std::abs(other_height - up.height) > kMaxImbalance) {
        continue;
      }
      const double gain = cost_of(other.box) - cost_of(union_of(down.box, stays.box));
      if (gain > best_gain) {
        best_gain = gain;
        best_slot = slot;
        best_below = below;
      }
    }
  }
  if (best_slot < 0) return;
  const std::int32_t down = node(i).child[static_cast<std::size_t>(best_slot)];
  const std::int32_t other = node(i).child[static_cast<std::size_t>(1 - best_slot)];
  set_child(i, best_slot, node(other).child[best_below]);
  set_child(other, static_cast<int>(best_below), down);
  update(other);
  update(i);
}

// Boxes, heights, balance and area from i to the root; stops where nothing changes any more.
void AabbTree::repair_upwards(std::int32_t i) {
  while (i != kNull) {
    const WorldAabb box_before = node(i).box;
    const std::int32_t height_before = node(i).height;
    const std::int32_t top = balance(i);
    rotate(top);
    if (top == i && node(i).height == height_before && is_same(node(i).box, box_before)) return;
    i = node(top).parent;
  }
}

bool AabbTree::is_node_consistent(std::int32_t i) const {
  const Node& at = node(i);
  if (at.is_leaf()) return at.height == 0 && at.child[1] == kNull;
  const Node& a = node(at.child[0]);
  const Node& b = node(at.child[1]);
  return a.parent == i && b.parent == i && at.height == 1 + std::max(a.height, b.height) &&
         std::abs(a.height - b.height) <= kMaxImbalance && is_same(at.box, union_of(a.box, b.box));
}

bool AabbTree::is_consistent() const {
  std::size_t free_nodes = 0;
  for (std::int32_t i = first_free_; i != kNull; i = node(i).parent) {
    if (node(i).height != kFree || ++free_nodes > nodes_.size()) return false;
  }
  std::size_t leaves = 0, inner = 0;
  if (root_ != kNull) {
    if (node(root_).parent != kNull) return false;
    TraversalStack<std::int32_t> stack;
    stack.push(root_);
    while (!stack.empty()) {
      const std::int32_t i = stack.pop();
      if (!is_node_consistent(i) || leaves + inner > nodes_.size()) return false;
      if (node(i).is_leaf()) {
        ++leaves;
        continue;
      }
      ++inner;
      for (const std::int32_t child : node(i).child) stack.push(child);
    }
  }
  return leaves == leaf_count_ && inner + (leaves > 0 ? 1 : 0) == leaves &&
         leaves + inner + free_nodes == nodes_.size();
}

}  // namespace plumb::inline PLUMB_ABI::detail
