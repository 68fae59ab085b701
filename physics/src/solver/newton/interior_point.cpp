#include "solver/newton/interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/newton/cone_scaling.h"
#include "solver/newton/island_laws.h"
#include "solver/newton/newton_method.h"
#include "solver/newton/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

constexpr double kInside = 0.99;      // [-] of the way to the boundary that a step goes
constexpr double kSmall = 1e-12;      // [-] of the complementarity at the start: done
constexpr double kNearlyDone = 1e-8;  // [-] then a step of less than this ends it:
constexpr double kShortStep = 0.2;
constexpr double kNoStep = 1e-8;   // [-] of the whole: stuck
constexpr double kLeastMu = 1e-3;  // [-] friction below which a contact counts as smooth

// A contact point between its two cones.
struct InnerPoint {
  double mu = 1;       // 0: only the normal, between two half-lines
  Vec3d x, z;          // impulse and velocity, scaled
  Vec3d dx, dz;        // step
  Vec3d miss;          // z - T (J v + b)
  Vec3d from_scaling;  // W d
  Sym3d W2;
};
// A scalar between bounds, whose velocity is what the multipliers of the bounds are.
struct InnerBound {
  double lower = 0, upper = 0;
  double soft = 0, offset = 0, center = 0;  // rate + soft l + offset is what vanishes between them
  double g = 0, at_lower = 0, at_upper = 0;
  double dg = 0, d_lower = 0, d_upper = 0;
  double miss = 0, D = 0, pull = 0;
  bool acts = true;
};

class InteriorPoint {
 public:
  explicit InteriorPoint(Island& island)
      : island_(island), rho_(island.step_length * island.mass) {}

  void run() {
    begin();
    const double first = complementarity();
    for (int k = 0; k < tolerance::kInteriorIterations; ++k) {
      const double mu = complementarity();
      if (!(mu > kSmall * first) && k > 0) break;
      linearize();
      direction(0, mu, false);
      const double reach = std::min(1.0, room());
      const double sigma = (1 - reach) * (1 - reach) * (1 - reach);
      direction(sigma, mu, true);
      const double t = std::min(1.0, kInside * room());
      if (!is_finite_step() || t < (mu > kNearlyDone * first ? kNoStep : kShortStep)) break;
      advance(t);
    }
    end();
  }

 private:
  template <class Task>
  void for_points(Task&& task) {
    std::size_t k = 0;
    for (IslandContact& c : island_.contacts)
      for (int i = 0; i < c.count; ++i) task(c, c.points[i], points_[k++]);
  }
  // Calls task(bound, rate, add(g)) ... rates: of the joints' rows, of turning contacts.
  template <class Task>
  void for_bounds(Task&& task) {
    std::size_t k = 0;
    for (IslandJoint& joint : island_.joints)
      for (std::uint32_t l = joint.first_law; l < joint.first_law + joint.laws; ++l)
        task(bounds_[k++], joint, island_.laws[l]);
  }
  template <class Task>
  void for_turns(Task&& task) {
    std::size_t k = island_.laws.size();
    for (IslandContact& c : island_.contacts)
      if (c.resists_turning && c.count > 0)
        for (int i = 0; i < 3; ++i) task(bounds_[k++], c, i);
  }

  // Velocity plus bias of a point, scaled.
  [[nodiscard]] Vec3d target(const IslandContact& c, const IslandPoint& p, double mu,
                             const Twist& twist) const {
    Vec3d u = at_point(p, twist);
    u.x += p.gap + (island_.solves_positions ? p.push : 0) + c.mu * p.shift;
    u.y += p.drive1;
    u.z += p.drive2;
    return mu > 0 ? Vec3d{u.x / mu, u.y, u.z} : Vec3d{u.x, 0, 0};
  }
  static Vec3d impulse(const InnerPoint& q, Vec3d x) {
    return q.mu > 0 ? Vec3d{x.x / q.mu, x.y, x.z} : Vec3d{x.x, 0, 0};
  }
  [[nodiscard]] double law_bias(const ScalarLaw& law) const {
    return law.bias + (island_.solves_positions ? law.push : 0);
  }

  void begin() {
    double speed = 0;
    for (std::size_t i = 0; i < island_.bodies.size(); ++i)
      speed = std::max(speed, island_.bodies[i].weight / island_.bodies[i].m);
    for (IslandContact& c : island_.contacts) {
      if (c.count == 0) continue;
      c.now = relative(c, island_.v) + c.fixed;
      for (int i = 0; i < c.count; ++i)
        speed = std::max(speed, 0.1 * length(at_point(c.points[i], c.now)));
    }
    speed = std::max(speed, island_.speed);
    std::size_t count = 0;
    for (const IslandContact& c : island_.contacts) count += static_cast<std::size_t>(c.count);
    points_.assign(count, {});
    for_points([&](IslandContact& c, IslandPoint& p, InnerPoint& q) {
      q.mu = c.mu > kLeastMu ? c.mu : 0;
      const double m = c.response > 0 ? 1 / c.response : island_.mass;
      const double scale = q.mu > 0 ? q.mu : 1;
      // Inside both cones: what is remembered, with room for all that is tangential.
      q.x = {scale * (std::max(p.center.x, 0.0) + speed * m), 0, 0};
      q.z = {speed / scale, 0, 0};
    });
    std::size_t turns = 0;
    for (const IslandContact& c : island_.contacts)
      if (c.resists_turning && c.count > 0) turns += 3;
    bounds_.assign(island_.laws.size() + turns, {});
    for_bounds([&](InnerBound& q, IslandJoint& joint, ScalarLaw& law) {
      const double unit2 = joint.unit2[law.row], unit = std::sqrt(unit2);
      const double give = 1 / (rho_ * unit2);
      q = {law.lower, law.upper, law.compliance + give, -give * law.center, law.center};
      for (int b = 0; b < joint.balls; ++b) {
        const auto k = static_cast<int>(&law - island_.laws.data());
        if (k < joint.ball[b].first || k >= joint.ball[b].first + 3) continue;
        q.lower = -joint.ball[b].radius;
        q.upper = joint.ball[b].radius;
      }
      place_inside(q, speed * island_.mass * unit, speed * unit);
    });
    for_turns([&](InnerBound& q, IslandContact& c, int i) {
      const double radius = i == 0 ? c.spin_radius : c.roll_radius, unit = std::sqrt(c.lever2);
      const double give = 1 / (rho_ * c.lever2), center = component(c.turn_center, i);
      q = {-radius, radius, give, -give * center, center};
      place_inside(q, speed * island_.mass * unit, speed / unit);
    });
  }
  static void place_inside(InnerBound& q, double impulse, double rate) {
    const bool low = std::isfinite(q.lower), high = std::isfinite(q.upper);
    q.acts = q.lower < q.upper;
    q.g = !q.acts       ? q.lower
          : low && high ? (q.lower + q.upper) / 2
          : low         ? std::max(q.center, q.lower + impulse)
          : high        ? std::min(q.center, q.upper - impulse)
                        : q.center;
    q.at_lower = low ? rate : 0;
    q.at_upper = high ? rate : 0;
  }

  double complementarity() {
    double sum = 0;
    std::size_t count = 0;
    for (const InnerPoint& q : points_) {
      sum += detail::dot(q.x, q.z);
      ++count;
    }
    for (const InnerBound& q : bounds_) {
      if (!q.acts) continue;
      if (std::isfinite(q.lower)) sum += q.at_lower * (q.g - q.lower), ++count;
      if (std::isfinite(q.upper)) sum += q.at_upper * (q.upper - q.g), ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

  // Residuals and the factored matrix.
  void linearize() {
    std::vector<Twist>& gradient = island_.gradient;
    gradient.resize(island_.bodies.size());
    for (std::size_t i = 0; i < island_.bodies.size(); ++i)
      gradient[i] = momentum_of(island_.bodies[i], island_.v[i]) - island_.bodies[i].p;
    for (IslandContact& c : island_.contacts)
      if (c.count > 0) c.now = relative(c, island_.v) + c.fixed;
    for (IslandJoint& joint : island_.joints)
      for (int i = 0; i < joint.rows; ++i)
        joint.now[i] = rate_of(joint, i, island_.v) + joint.fixed[i];
    for_points([&](IslandContact& c, IslandPoint& p, InnerPoint& q) {
      q.miss = q.z - target(c, p, q.mu, c.now);
      if (q.mu > 0) {
        q.W2 = ConeScaling(q.x, q.z).squared();
        const double s = 1 / q.mu;
        p.D = {s * s * q.W2.xx, q.W2.yy, q.W2.zz, s * q.W2.xy, s * q.W2.xz, q.W2.yz};
      } else {
        q.W2 = {q.x.x / q.z.x, 0, 0, 0, 0, 0};
        p.D = q.W2;
      }
      p.D = scaled(p.D, 1 / rho_);
      p.g = impulse(q, q.x);
    });
    for_bounds([&](InnerBound& q, IslandJoint& joint, ScalarLaw& law) {
      linearize_bound(q, joint.now[law.row] + law_bias(law));
      law.D = q.D / rho_;
      law.g = q.g;
    });
    for (IslandJoint& joint : island_.joints)
      for (auto& ball : joint.ball_D) ball[0] = ball[1] = ball[2] = 0;
    for_turns([&](InnerBound& q, IslandContact& c, int i) {
      linearize_bound(q, component(c.now.w, i) + (i == 0 ? c.spin_drive : 0));
      if (i == 0) c.turn_D = {};
      (i == 0 ? c.turn_D.xx : i == 1 ? c.turn_D.yy : c.turn_D.zz) = q.D / rho_;
      set_component(c.turn_g, i, q.g);
    });
    add_all(
        -1, gradient, [](const InnerPoint& q) { return impulse(q, q.x); },
        [](const InnerBound& q) { return q.g; });
    factor(island_);
    island_.has_factor = false;
  }
  static Sym3d scaled(const Sym3d& m, double k) {
    return {k * m.xx, k * m.yy, k * m.zz, k * m.xy, k * m.xz, k * m.yz};
  }
  static void linearize_bound(InnerBound& q, double rate) {
    q.miss = rate + q.soft * q.g + q.offset - q.at_lower + q.at_upper;
    double stiff = q.soft;
    if (std::isfinite(q.lower)) stiff += q.at_lower / (q.g - q.lower);
    if (std::isfinite(q.upper)) stiff += q.at_upper / (q.upper - q.g);
    q.D = q.acts ? 1 / stiff : 0;
  }

  // momentum += sign J^T (impulses)
  template <class OfPoint, class OfBound>
  void add_all(double sign, std::vector<Twist>& momentum, OfPoint&& of_point, OfBound&& of_bound) {
    std::size_t k = 0, turn = island_.laws.size(), law = 0;
    for (const IslandContact& c : island_.contacts) {
      if (c.count == 0) continue;
      Twist wrench;
      for (int i = 0; i < c.count; ++i) add_at_point(c.points[i], of_point(points_[k++]), wrench);
      if (c.resists_turning)
        for (int i = 0; i < 3; ++i)
          set_component(wrench.w, i, component(wrench.w, i) + of_bound(bounds_[turn++]));
      add_wrench(island_, c, wrench, sign, momentum);
    }
    for (const IslandJoint& joint : island_.joints) {
      double impulses[kMaxJointRows] = {};
      for (std::uint32_t l = joint.first_law; l < joint.first_law + joint.laws; ++l)
        impulses[island_.laws[l].row] += of_bound(bounds_[law++]);
      add_impulses(island_, joint, impulses, sign, momentum);
    }
  }

  // The step for complementarity sigma mu; the corrector makes up for the predictor's square.
  void direction(double sigma, double mu, bool correct) {
    for (InnerPoint& q : points_) {
      if (q.mu > 0) {
        const ConeScaling W(q.x, q.z);
        const Vec3d lambda = W.apply(q.z);
        Vec3d d = -lambda;
        if (correct) {
          Vec3d wanted = -cone_product(W.apply_inverse(q.dx), W.apply(q.dz));
          wanted.x += sigma * mu;
          d = d + cone_quotient(lambda, wanted);
        }
        q.from_scaling = W.apply(d);
      } else {
        const double wanted = -q.x.x * q.z.x + sigma * mu - (correct ? q.dx.x * q.dz.x : 0);
        q.from_scaling = {wanted / q.z.x, 0, 0};
      }
    }
    for (InnerBound& q : bounds_) {
      q.pull = -q.miss;
      if (!q.acts) continue;
      if (std::isfinite(q.lower))
        q.pull += (sigma * mu - (correct ? q.d_lower * q.dg : 0)) / (q.g - q.lower) - q.at_lower;
      if (std::isfinite(q.upper))
        q.pull -= (sigma * mu + (correct ? q.d_upper * q.dg : 0)) / (q.upper - q.g) - q.at_upper;
    }
    std::vector<Twist>& step = island_.step;
    step.resize(island_.bodies.size());
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = -1.0 * island_.gradient[i];
    add_all(
        1, step, [](const InnerPoint& q) { return impulse(q, q.from_scaling + q.W2 * q.miss); },
        [](const InnerBound& q) { return q.D * q.pull; });
    island_.matrix.solve(&step[0].v.x);
    for (IslandContact& c : island_.contacts)
      if (c.count > 0) c.change = relative(c, step);
    for (IslandJoint& joint : island_.joints)
      for (int i = 0; i < joint.rows; ++i) joint.change[i] = rate_of(joint, i, step);
    for_points([&](IslandContact& c, IslandPoint& p, InnerPoint& q) {
      const Vec3d u = at_point(p, c.change);
      q.dz = (q.mu > 0 ? Vec3d{u.x / q.mu, u.y, u.z} : Vec3d{u.x, 0, 0}) - q.miss;
      q.dx = q.from_scaling - q.W2 * q.dz;
      if (!(q.mu > 0)) q.dx.y = q.dx.z = q.dz.y = q.dz.z = 0;
    });
    const auto step_bound = [&](InnerBound& q, double rate) {
      const double before = correct ? q.dg : 0;
      const double square_lower = q.d_lower * before, square_upper = q.d_upper * before;
      q.dg = q.D * (q.pull - rate);
      if (!q.acts) return;
      if (std::isfinite(q.lower))
        q.d_lower = (sigma * mu - square_lower - q.at_lower * q.dg) / (q.g - q.lower) - q.at_lower;
      if (std::isfinite(q.upper))
        q.d_upper = (sigma * mu + square_upper + q.at_upper * q.dg) / (q.upper - q.g) - q.at_upper;
    };
    for_bounds([&](InnerBound& q, IslandJoint& joint, ScalarLaw& law) {
      step_bound(q, joint.change[law.row]);
    });
    for_turns(
        [&](InnerBound& q, IslandContact& c, int i) { step_bound(q, component(c.change.w, i)); });
  }

  double room() {
    double t = std::numeric_limits<double>::infinity();
    const auto keep_positive = [&](double a, double d) {
      if (d < 0) t = std::min(t, -a / d);
    };
    for (const InnerPoint& q : points_) {
      if (q.mu > 0) {
        t = std::min(t, std::min(cone_room(q.x, q.dx), cone_room(q.z, q.dz)));
      } else {
        keep_positive(q.x.x, q.dx.x);
        keep_positive(q.z.x, q.dz.x);
      }
    }
    for (const InnerBound& q : bounds_) {
      if (!q.acts) continue;
      if (std::isfinite(q.lower)) {
        keep_positive(q.g - q.lower, q.dg);
        keep_positive(q.at_lower, q.d_lower);
      }
      if (std::isfinite(q.upper)) {
        keep_positive(q.upper - q.g, -q.dg);
        keep_positive(q.at_upper, q.d_upper);
      }
    }
    return t;
  }

  [[nodiscard]] bool is_finite_step() const {
    for (const Twist& d : island_.step)
      if (!is_finite(d.v) || !is_finite(d.w)) return false;
    for (const InnerPoint& q : points_)
      if (!is_finite(q.dx) || !is_finite(q.dz)) return false;
    return true;
  }
  void advance(double t) {
    for (std::size_t i = 0; i < island_.v.size(); ++i)
      island_.v[i] = island_.v[i] + t * island_.step[i];
    for (InnerPoint& q : points_) {
      q.x = q.x + t * q.dx;
      q.z = q.z + t * q.dz;
    }
    for (InnerBound& q : bounds_) {
      if (!q.acts) continue;
      q.g += t * q.dg;
      q.at_lower += t * q.d_lower;
      q.at_upper += t * q.d_upper;
    }
  }

  void end() {
    for (IslandContact& c : island_.contacts)
      if (c.count > 0) c.now = relative(c, island_.v) + c.fixed;
    for_points([](IslandContact&, IslandPoint& p, InnerPoint& q) { p.g = impulse(q, q.x); });
    for_bounds([](InnerBound& q, IslandJoint&, ScalarLaw& law) { law.g = q.g; });
    for_turns([](InnerBound& q, IslandContact& c, int i) { set_component(c.turn_g, i, q.g); });
  }

  Island& island_;
  double rho_;
  std::vector<InnerPoint> points_;
  std::vector<InnerBound> bounds_;
};

}  // namespace

void find_interior_point(Island& island) { InteriorPoint(island).run(); }

}  // namespace plumb::inline PLUMB_ABI::detail::newton
