// The function that Newton's method minimises is convex along every step, and its derivative there
// is what the search looks at: a full step where it has fallen to a tenth, else the zero between,
// by false position.
#include <algorithm>
#include <cmath>

#include "solver/newton/island_laws.h"
#include "solver/newton/newton_method.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

constexpr double kEnough = 0.1;     // [-] of the slope at the start
constexpr double kLeastCut = 0.05;  // [-] of the interval, from either end
constexpr int kMostTrials = 20;

class Slope {
 public:
  explicit Slope(Island& island) : island_(island), rho_(island.step_length * island.mass) {
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
      const Twist& d = island.step[i];
      const Twist Md = momentum_of(island.bodies[i], d);
      linear_ += dot(d, momentum_of(island.bodies[i], island.v[i]) - island.bodies[i].p);
      quadratic_ += dot(d, Md);
      start += dot(d, island.gradient[i]);
    }
    for (IslandContact& c : island.contacts)
      if (c.count > 0) c.change = relative(c, island.step);
    for (IslandJoint& joint : island.joints)
      for (int i = 0; i < joint.rows; ++i) joint.change[i] = rate_of(joint, i, island.step);
  }
  double operator()(double t) const {
    double slope = linear_ + t * quadratic_;
    for (const IslandContact& c : island_.contacts)
      if (c.count > 0) slope -= dot(wrench_of(island_, c, rho_, c.now + t * c.change), c.change);
    for (const IslandJoint& joint : island_.joints) {
      double rates[kMaxJointRows], impulse[kMaxJointRows];
      for (int i = 0; i < joint.rows; ++i) rates[i] = joint.now[i] + t * joint.change[i];
      impulses_of(island_, joint, rho_, rates, impulse);
      for (int i = 0; i < joint.rows; ++i) slope -= impulse[i] * joint.change[i];
    }
    return slope;
  }
  double start = 0;

 private:
  const Island& island_;
  double rho_, linear_ = 0, quadratic_ = 0;
};

}  // namespace

double length_of_step(Island& island) {
  const Slope slope(island);
  const double enough = kEnough * std::abs(slope.start);
  double low = 0, high = 1, at_low = slope.start, at_high = slope(1);
  if (!(at_high > enough)) return 1;
  double t = 1;
  for (int k = 0; k < kMostTrials; ++k) {
    const double width = high - low;
    t = low - width * at_low / (at_high - at_low);
    t = std::min(std::max(t, low + kLeastCut * width), high - kLeastCut * width);
    const double at = slope(t);
    if (std::abs(at) < enough) break;
    if (at > 0) {
      high = t;
      at_high = at;
    } else {
      low = t;
      at_low = at;
    }
  }
  return t;
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
