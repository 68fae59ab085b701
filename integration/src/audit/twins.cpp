#include "audit/twins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/audit.h"
#include "audit/must.h"

namespace plumb::inline PLUMB_ABI::audit {
namespace {

constexpr std::uint32_t kTwins = 8;
// A twin is a rounding apart for each of as many operations as a substep has one after the other
// for a body, by the least count: kick, warm start, solve, drift, relax [-].
constexpr double kRoundings = 5;
constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
constexpr double kPlaceEpsilon = static_cast<double>(std::numeric_limits<PosReal>::epsilon());
// What a twin is moved by is small against what counts as a change [-].
constexpr double kMostOfTolerance = 0.125;
// Of nine draws from one lot any one is the largest once in nine, for each body anew: that a change
// outdoes all twins says nothing yet. Twice the largest of eight lengths of Gaussian vectors is
// outdone once in a thousand [-].
constexpr double kAboveTwins = 2;

// Heads or tails, the same everywhere.
class Coin {
 public:
  explicit Coin(std::uint32_t seed) : state_(seed * 2654435761u + 77u) {}
  double toss() {
    state_ = state_ * 1664525u + 1013904223u;
    return (state_ >> 16 & 1u) != 0 ? 1.0 : -1.0;
  }

 private:
  std::uint32_t state_;
};

double size_of(const double* x, std::uint32_t width) {
  double sum = 0;
  for (std::uint32_t k = 0; k < width; ++k) sum += x[k] * x[k];
  return std::sqrt(sum);
}

// [the column's unit] by which a twin's numbers of a body differ; 0: this column is left alone.
double unit_of(const SnapshotColumn& column, const double* x, const BodySample& body,
               double v_turn) {
  const double size = size_of(x, column.width);
  if (column.name == "body.velocity") return kRoundings * kEpsilon * std::max(size, v_turn);
  if (column.name == "body.angular_momentum")
    return kRoundings * kEpsilon * std::max(size, body.weight_turn);
  if (column.name == "body.position") {
    const double most = kMostOfTolerance * tolerance_of(PlanItem::Continuous) * body.size;
    return std::min(std::max(kEpsilon * body.size, kPlaceEpsilon * size), most);
  }
  return column.name == "body.orientation" ? kEpsilon : 0;
}

Snapshot twin_of(const Snapshot& snapshot, const Sample& bodies, double v_turn,
                 std::uint32_t seed) {
  Snapshot out = snapshot;
  Coin coin(seed);
  for (SnapshotColumn& column : out.columns) {
    if (column.name.rfind("body.", 0) != 0 || column.reals.empty()) continue;
    const bool is_place = column.name == "body.position";
    for (const BodySample& body : bodies) {
      if (!body.state.awake) continue;
      double* const x = &column.reals[column.width * body.state.id.index];
      const double unit = unit_of(column, x, body, v_turn);
      for (std::uint32_t k = 0; unit > 0 && k < column.width; ++k) {
        const double moved = x[k] + coin.toss() * unit;
        x[k] = is_place ? static_cast<double>(static_cast<PosReal>(moved))
                        : static_cast<double>(static_cast<Real>(moved));
      }
    }
  }
  return out;
}

}  // namespace

void Twins::step_all() {
  PhysicsWorld world;
  for (std::uint32_t seed = 0; seed < kTwins; ++seed) {
    must(world.restore(snapshot_));
    const double g = world.settings().gravity.cast<double>().norm();
    must(world.restore(twin_of(snapshot_, before_, g * dt_, seed)));
    world.step(dt_);
    twins_.push_back(sample_of(world, dt_));
  }
}

bool Twins::explain(PlanItem item, const Sample& other) {
  if (twins_.empty()) step_all();
  for (std::size_t i = 0; i < after_.size() && i < other.size(); ++i) {
    const double change = change_between(item, after_, other, i, dt_);
    if (change <= tolerance_of(item)) continue;
    const bool explained = std::any_of(twins_.begin(), twins_.end(), [&](const Sample& twin) {
      return kAboveTwins * change_between(item, after_, twin, i, dt_) >= change;
    });
    if (!explained) return false;
  }
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::audit
