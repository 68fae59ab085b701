#include "decompose/join_parts.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "decompose/hollow.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

// A joined part may share no more than this of its volume with others: what lies in two parts has
// contacts twice.
constexpr double kMostShared = 0.01;

constexpr double kNever = std::numeric_limits<double>::infinity();

// What the common hulls of all pairs fill beyond the two.
class Pairs {
 public:
  Pairs(std::vector<PartHull>& parts, double reach) : parts_(parts), reach_(reach) {
    cost_.assign(parts.size() * parts.size(), kNever);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = i + 1; j < parts.size(); ++j) cost(i, j) = measured(i, j);
  }

  struct Pair {
    double cost = kNever;
    std::size_t first = 0, second = 0;
  };
  [[nodiscard]] Pair cheapest() {
    Pair best;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t j = i + 1; j < parts_.size(); ++j)
        if (cost(i, j) < best.cost) best = {cost(i, j), i, j};
    return best;
  }
  void forbid(const Pair& pair) { cost(pair.first, pair.second) = kNever; }

  void join(const Pair& pair, PartHull both) {
    parts_[pair.first] = std::move(both);
    parts_[pair.second] = {};  // nothing joins it any more
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const auto [low, high] = std::minmax(k, pair.first);
      if (low != high) cost(low, high) = measured(low, high);
      const auto [low_gone, high_gone] = std::minmax(k, pair.second);
      cost(low_gone, high_gone) = kNever;
    }
  }

 private:
  double& cost(std::size_t i, std::size_t j) { return cost_[i * parts_.size() + j]; }

  [[nodiscard]] double measured(std::size_t i, std::size_t j) const {
    const PartHull &a = parts_[i], &b = parts_[j];
    if (a.corners.empty() || b.corners.empty()) return kNever;
    if (a.box.exteriorDistance(b.box) > reach_) return kNever;
    const std::optional<PartHull> both = joined(a, b);
    return both ? both->volume - a.volume - b.volume : kNever;
  }

  std::vector<PartHull>& parts_;
  double reach_;  // parts farther apart than this are no pair
  std::vector<double> cost_;
};

bool shares_little(const PartHull& both, const std::vector<PartHull>& parts,
                   const Pairs::Pair& pair) {
  double shared = 0;
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (k != pair.first && k != pair.second && !parts[k].corners.empty())
      shared += shared_volume(both, parts[k]);
  return shared <= kMostShared * both.volume;
}

void drop_empty(std::vector<PartHull>& parts) {
  std::erase_if(parts, [](const PartHull& part) { return part.corners.empty(); });
}

}  // namespace

void join_parts(std::vector<PartHull>& parts, const SolidField& solid, const Tolerances& tolerances,
                std::size_t max_parts) {
  Pairs near(parts, tolerances.limit);
  for (Pairs::Pair pair = near.cheapest(); pair.cost < kNever; pair = near.cheapest()) {
    std::optional<PartHull> both = joined(parts[pair.first], parts[pair.second]);
    if (both && shares_little(*both, parts, pair) && stays_within(*both, solid, tolerances.limit)) {
      // Nothing filled: the two were halves of one convex part.
      both->reach = pair.cost <= tolerances.film
                        ? std::max(parts[pair.first].reach, parts[pair.second].reach)
                        : tolerances.limit;
      near.join(pair, std::move(*both));
    } else {
      near.forbid(pair);
    }
  }
  drop_empty(parts);
  if (parts.size() <= max_parts) return;

  Pairs all(parts, kNever);
  for (std::size_t left = parts.size(); left > max_parts; --left) {
    const Pairs::Pair pair = all.cheapest();
    if (!(pair.cost < kNever)) break;
    std::optional<PartHull> both = joined(parts[pair.first], parts[pair.second]);
    all.join(pair, std::move(*both));
  }
  drop_empty(parts);
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
