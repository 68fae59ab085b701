#include "collision/surface/static_bvh.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Num kInfinity = std::numeric_limits<Num>::infinity();
constexpr NumBox kEmptyBox{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

NumBox united(const NumBox& a, const NumBox& b) {
  return {min_each(a.lower, b.lower), max_each(a.upper, b.upper)};
}
NumVec doubled_middle(const NumBox& box) { return box.lower + box.upper; }
Num half_area(const NumBox& box) {
  const NumVec d = box.upper - box.lower;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

// Places of a cut that are tried [-]; more gain little [MacDonald 1990].
constexpr int kBins = 16;
// Below this depth nodes are cut where areas are least, above it in the middle of the list, so that
// no input makes a tree deeper than this and log2 of its items.
constexpr int kFreeDepth = 40;
// Rounding of a difference and a product, for the ends of boxes.
constexpr Num kRounding = 4 * kNumEpsilon;

}  // namespace

SegmentQuery::SegmentQuery(NumVec origin, NumVec direction)
    : origin_{origin.x, origin.y, origin.z}, direction_{direction.x, direction.y, direction.z} {}

bool SegmentQuery::meets(const NumBox& box, Num max_fraction, Num& entry) const {
  const std::array<Num, 3> lower{box.lower.x, box.lower.y, box.lower.z};
  const std::array<Num, 3> upper{box.upper.x, box.upper.y, box.upper.z};
  Num enter = 0, leave = max_fraction;
  for (std::size_t i = 0; i < 3; ++i) {
    if (direction_[i] == Num(0)) {
      if (origin_[i] < lower[i] || origin_[i] > upper[i]) return false;
      continue;
    }
    Num in = (lower[i] - origin_[i]) / direction_[i], out = (upper[i] - origin_[i]) / direction_[i];
    if (in > out) std::swap(in, out);
    // A ray along a face or an edge of the box must not lose it to rounding [Ize 2013].
    enter = std::max(enter, in - kRounding * std::abs(in));
    leave = std::min(leave, out + kRounding * std::abs(out));
    if (!(enter <= leave)) return false;
  }
  entry = enter;
  return true;
}

struct StaticBvh::Builder {
  StaticBvh& tree;
  std::span<const NumBox> boxes;
  std::vector<std::uint32_t> order;

  [[nodiscard]] NumBox bounds_of_range(std::uint32_t begin, std::uint32_t end) const {
    NumBox box = kEmptyBox;
    for (std::uint32_t i = begin; i < end; ++i) box = united(box, boxes[order[i]]);
    return box;
  }

  std::uint32_t cut_in_the_middle(std::uint32_t begin, std::uint32_t end, int axis) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const Num of_a = component(doubled_middle(boxes[a]), axis);
                       const Num of_b = component(doubled_middle(boxes[b]), axis);
                       return of_a != of_b ? of_a < of_b : a < b;
                     });
    return middle;
  }

  // Where areas times counts are least; the middle where no cut is better than none.
  std::uint32_t cut(std::uint32_t begin, std::uint32_t end, int depth) {
    NumVec low{kInfinity, kInfinity, kInfinity}, high = -low;
    for (std::uint32_t i = begin; i < end; ++i) {
      low = min_each(low, doubled_middle(boxes[order[i]]));
      high = max_each(high, doubled_middle(boxes[order[i]]));
    }
    const NumVec spread = high - low;
    const int axis =
        spread.x >= spread.y ? (spread.x >= spread.z ? 0 : 2) : (spread.y >= spread.z ? 1 : 2);
    const Num from = component(low, axis), width = component(spread, axis);
    if (!(width > Num(0)) || depth > kFreeDepth) return cut_in_the_middle(begin, end, axis);
    const auto bin_of = [&](std::uint32_t item) {
      const Num along = (component(doubled_middle(boxes[item]), axis) - from) / width;
      return std::min(static_cast<int>(along * kBins), kBins - 1);
    };
    std::array<NumBox, kBins> bin;
    std::array<std::uint32_t, kBins> count{};
    bin.fill(kEmptyBox);
    for (std::uint32_t i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(bin_of(order[i]));
      bin[k] = united(bin[k], boxes[order[i]]);
      ++count[k];
    }
    std::array<Num, kBins> cost_above{};
    NumBox sum = kEmptyBox;
    std::uint32_t counted = 0;
    for (std::size_t k = kBins - 1; k > 0; --k) {
      sum = united(sum, bin[k]);
      counted += count[k];
      cost_above[k] = counted > 0 ? half_area(sum) * static_cast<Num>(counted) : kInfinity;
    }
    sum = kEmptyBox;
    counted = 0;
    Num least = kInfinity;
    int best = -1;
    for (std::size_t k = 0; k + 1 < kBins; ++k) {
      sum = united(sum, bin[k]);
      counted += count[k];
      if (counted == 0) continue;
      const Num cost = half_area(sum) * static_cast<Num>(counted) + cost_above[k + 1];
      if (cost < least) least = cost, best = static_cast<int>(k);
    }
    if (best < 0) return cut_in_the_middle(begin, end, axis);
    const auto middle =
        std::stable_partition(order.begin() + begin, order.begin() + end,
                              [&](std::uint32_t item) { return bin_of(item) <= best; });
    return static_cast<std::uint32_t>(middle - order.begin());
  }

  void add_node(std::uint32_t begin, std::uint32_t end, int depth) {
    const std::size_t at = tree.nodes_.size();
    tree.nodes_.push_back(rounded_out(bounds_of_range(begin, end)));
    if (end - begin <= kLeafItems) {
      tree.nodes_[at].link = kLeaf | ((end - begin) << kCountShift) | begin;
      return;
    }
    const std::uint32_t middle = cut(begin, end, depth);
    add_node(begin, middle, depth + 1);
    tree.nodes_[at].link = static_cast<std::uint32_t>(tree.nodes_.size());
    add_node(middle, end, depth + 1);
  }

  [[nodiscard]] Node rounded_out(const NumBox& box) const {
    Node node{};
    for (int i = 0; i < 3; ++i) {
      const Num step = component(tree.step_, i), origin = component(tree.bounds_.lower, i);
      const auto k = static_cast<std::size_t>(i);
      // One step more than needed makes up for the rounding of the division.
      const Num low = std::floor((component(box.lower, i) - origin) / step) - Num(1);
      const Num high = std::ceil((component(box.upper, i) - origin) / step) + Num(1);
      node.lower[k] = static_cast<std::uint16_t>(std::clamp(low, Num(0), kSteps));
      node.upper[k] = static_cast<std::uint16_t>(std::clamp(high, Num(0), kSteps));
    }
    return node;
  }
};

NumBox StaticBvh::box_of(const Node& node) const {
  const NumVec low{static_cast<Num>(node.lower[0]), static_cast<Num>(node.lower[1]),
                   static_cast<Num>(node.lower[2])};
  const NumVec high{static_cast<Num>(node.upper[0]), static_cast<Num>(node.upper[1]),
                    static_cast<Num>(node.upper[2])};
  return {bounds_.lower + multiply_each(low, step_), bounds_.lower + multiply_each(high, step_)};
}

std::vector<std::uint32_t> StaticBvh::build(std::span<const NumBox> boxes) {
  nodes_.clear();
  Builder builder{*this, boxes, std::vector<std::uint32_t>(boxes.size())};
  std::iota(builder.order.begin(), builder.order.end(), 0U);
  bounds_ = builder.bounds_of_range(0, static_cast<std::uint32_t>(boxes.size()));
  // A flat bound still needs a step to divide by, far below anything that matters.
  const NumVec size = bounds_.upper - bounds_.lower;
  const Num largest = std::max({size.x, size.y, size.z, length(bounds_.lower), kSmallestSize});
  const auto step = [&](Num extent) {
    return (std::max(extent, kNumEpsilon * 16 * largest) * (Num(1) + kRounding)) /
           (kSteps - Num(1));
  };
  step_ = {step(size.x), step(size.y), step(size.z)};
  builder.add_node(0, static_cast<std::uint32_t>(boxes.size()), 0);
  nodes_.shrink_to_fit();
  return std::move(builder.order);
}

}  // namespace plumb::inline PLUMB_ABI::detail
