#include "collision/surface/edge_arc.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Arcs wider than this (by cosine: 37 degrees) are searched in quarters.
constexpr Num kNarrowArc = 0.8;
// A bracket this narrow [rad] is a direction.
constexpr Num kBracket = 1e-13;
// Where the growth jumps every second step halves the bracket; else 6 to 10 steps are usual.
constexpr int kMaxSteps = 84;

// A direction with the room along it and how the room grows on.
struct Sample {
  NumVec n;
  Num room, growth;  // [m], [m/rad]
};

class Search {
 public:
  Search(const ConvexCore& core, const EdgeArc& arc, Num enough)
      : core_(core), arc_(arc), enough_(enough), best_{arc.from, kNone} {}

  ArcRoom run() {
    const Sample from = sample(arc_.from), to = sample(arc_.to);
    if (dot(arc_.from, arc_.to) > kNarrowArc) {
      climb(from, to);
      return best_;
    }
    const Sample half = sample(middle(from.n, to.n));
    const Sample first = sample(middle(from.n, half.n)), third = sample(middle(half.n, to.n));
    climb(from, first);
    climb(first, half);
    climb(half, third);
    climb(third, to);
    return best_;
  }

 private:
  static constexpr Num kNone = -std::numeric_limits<Num>::infinity();

  // What turns the normal moves the farthest point of the core no farther (its room has no slope
  // there), so that the room grows by what the point gains on the turning plane.
  Sample sample(NumVec n) {
    const NumVec x = core_.support(-n) - arc_.corner;
    const Num room = dot(n, x);
    if (room > best_.room) best_ = {n, room};
    return {n, room, dot(cross(arc_.along, n), x)};
  }

  [[nodiscard]] NumVec middle(NumVec a, NumVec b) const {
    const NumVec sum = dot(a, b) > Num(0) ? a + b : cross(arc_.along, a - b);
    return normalized_or(sum, a);
  }

  // Between two directions less than 45 degrees apart where the room grows from both inwards.
  void climb(Sample a, Sample b) {
    if (best_.room > enough_ || !(a.growth > Num(0) && b.growth < Num(0))) return;
    for (int i = 0; i < kMaxSteps && length_squared(b.n - a.n) > kBracket * kBracket; ++i) {
      // The secant of the growth, and in turn the middle: at a bend, where a side or an end begins
      // to face the edge, the growth jumps.
      const Num part = i % 2 == 1 ? Num(0.5) : a.growth / (a.growth - b.growth);
      const Sample c = sample(normalized_or(a.n + part * (b.n - a.n), a.n));
      if (best_.room > enough_ || c.growth == Num(0)) return;
      (c.growth > Num(0) ? a : b) = c;
    }
  }

  const ConvexCore& core_;
  const EdgeArc& arc_;
  Num enough_;
  ArcRoom best_;
};

}  // namespace

ArcRoom most_room_on_arc(const ConvexCore& core, const EdgeArc& arc, Num enough) {
  return Search(core, arc, enough).run();
}

}  // namespace plumb::inline PLUMB_ABI::detail
