// The outer iteration; where Newton's method does not get through at once it is helped to a start
// by an interior point, and where that is not enough either the interior point is what remains: its
// cost is bounded, its impulses lie in their cones, and the report tells by how much the laws are
// missed.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/newton/interior_point.h"
#include "solver/newton/island_laws.h"
#include "solver/newton/newton_method.h"
#include "solver/newton/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

double slip(const IslandPoint& p, const Twist& u) {
  const Vec3d v = at_point(p, u);
  return std::sqrt((v.y + p.drive1) * (v.y + p.drive1) + (v.z + p.drive2) * (v.z + p.drive2));
}

// Centres from the remembered impulses, shifts and bounds from them and the velocities.
void start_over(Island& island) {
  for (IslandContact& c : island.contacts) {
    c.now = relative(c, island.v) + c.fixed;
    for (int i = 0; i < c.count; ++i) {
      IslandPoint& p = c.points[i];
      p.center = p.warm;
      p.shift = slip(p, c.now);
    }
    c.turn_center = c.turn_warm;
  }
  for (ScalarLaw& law : island.laws) law.center = law.warm;
  island.has_factor = false;
}

void choose_discs(Island& island, bool allowed) {
  for (IslandContact& c : island.contacts) {
    double load = 0;
    for (int i = 0; i < c.count; ++i) {
      IslandPoint& p = c.points[i];
      const bool disc = allowed && p.slid && p.center.x > 0;
      p.disc = disc;
      p.radius = disc ? c.mu * p.center.x : 0;
      load += p.center.x;
    }
    c.spin_radius = c.torsional * load;
    c.roll_radius = c.rolling * load;
  }
}

// The impulses found become the centres. Returns by how much the laws were missed [m/s].
double take_over(Island& island) {
  const double rho = island.step_length * island.mass;
  double lack = 0;
  for (IslandContact& c : island.contacts) {
    double load = 0;
    for (int i = 0; i < c.count; ++i) {
      IslandPoint& p = c.points[i];
      lack = std::max(lack, length(p.g - p.center) / rho);
      const double now = slip(p, c.now);
      if (p.disc) {
        lack = std::max(lack, std::abs(c.mu * p.g.x - p.radius) * c.response);
      } else if (p.g.x > 0) {
        lack = std::max(lack, c.mu * std::abs(now - p.shift));
      }
      p.center = p.g;
      p.shift = now;
      const double friction = std::sqrt(p.g.y * p.g.y + p.g.z * p.g.z);
      p.slid = p.g.x > 0 && friction > c.mu * p.g.x * (1 - 1e-9) && now > island.slides;
      load += p.g.x;
    }
    if (!c.resists_turning) continue;
    const double change = length(c.turn_g - c.turn_center) / rho;
    lack = std::max(lack, change / std::sqrt(c.lever2));
    const double radius = std::max(c.torsional, c.rolling) * load;
    const double before = std::max(c.spin_radius, c.roll_radius);
    lack = std::max(lack, std::abs(radius - before) * c.response / std::sqrt(c.lever2));
    c.turn_center = c.turn_g;
  }
  for (const IslandJoint& joint : island.joints)
    for (std::uint32_t k = joint.first_law; k < joint.first_law + joint.laws; ++k) {
      ScalarLaw& law = island.laws[k];
      lack = std::max(lack, std::abs(law.g - law.center) / (rho * std::sqrt(joint.unit2[law.row])));
      law.center = law.g;
      if (!law.bounces || law.g == 0) continue;
      law.bias = law.bounce;
      law.bounces = false;
      lack = std::max(lack, 2 * island.speed);  // once more
    }
  return lack;
}

// Where the solve ends early, discs may have left friction with a point that presses no more.
void drop_idle_friction(Island& island) {
  for (IslandContact& c : island.contacts) {
    bool presses = false;
    for (int i = 0; i < c.count; ++i) {
      IslandPoint& p = c.points[i];
      if (p.center.x > 0) {
        presses = true;
      } else {
        p.center = {0, 0, 0};
      }
    }
    if (!presses) c.turn_center = {0, 0, 0};
  }
}

// Whether the impulses are so much larger than what acts that their sum has no digits left.
// Friction can hold a jammed body under any stress: where overlap is to be worked off against that,
// there may be no velocities that do it, and impulses that cancel grow without bound.
bool impulses_cancel(const Island& island) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  double acts = 0, given = 0;
  for (const IslandBody& body : island.bodies)
    acts += body.weight + length(body.p.v) + length(body.p.w) / body.size;
  for (const IslandContact& c : island.contacts)
    for (int i = 0; i < c.count; ++i) given += length(c.points[i].center);
  return !(kEpsilon * given <= tolerance::kMomentum * acts);
}

// M v = p + J^T l, with no part of the momentum lost to the tolerance of the solve, or to its end.
void velocities_from_impulses(Island& island) {
  std::vector<Twist>& sum = island.gradient;
  for (std::size_t i = 0; i < island.bodies.size(); ++i) sum[i] = island.bodies[i].p;
  for (const IslandContact& c : island.contacts) {
    Twist wrench;
    for (int i = 0; i < c.count; ++i) add_at_point(c.points[i], c.points[i].center, wrench);
    wrench.w += c.turn_center;
    if (c.count > 0) add_wrench(island, c, wrench, 1, sum);
  }
  for (const IslandJoint& joint : island.joints) {
    double impulse[kMaxJointRows] = {};
    for (std::uint32_t k = joint.first_law; k < joint.first_law + joint.laws; ++k)
      impulse[island.laws[k].row] += island.laws[k].center;
    add_impulses(island, joint, impulse, 1, sum);
  }
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const IslandBody& body = island.bodies[i];
    island.v[i] = {{sum[i].v.x / body.mass.x, sum[i].v.y / body.mass.y, sum[i].v.z / body.mass.z},
                   body.inverse_inertia * sum[i].w};
  }
}

// What an interior point has found, kept while Newton's method tries to better it.
void keep(Island& island, std::vector<Twist>& v) {
  v = island.v;
  for (IslandContact& c : island.contacts) {
    for (int i = 0; i < c.count; ++i) c.points[i].center = c.points[i].g;
    c.turn_center = c.turn_g;
  }
  for (ScalarLaw& law : island.laws) law.center = law.g;
}
void take_back(Island& island, const std::vector<Twist>& v) {
  island.v = v;
  for (IslandContact& c : island.contacts) {
    c.now = relative(c, island.v) + c.fixed;
    for (int i = 0; i < c.count; ++i) c.points[i].g = c.points[i].center;
    c.turn_g = c.turn_center;
  }
  for (ScalarLaw& law : island.laws) law.g = law.center;
}

}  // namespace

void solve(Island& island) {
  island.step_length = tolerance::kStepLength;
  island.factorizations = 0;
  island.fell_back = false;
  island.has_factor = false;
  start_over(island);
  std::vector<Twist>& start = island.v_start;
  start = island.v;
  int interior_points = 0;
  const auto most_interior_points = [&] {
    const auto done =
        island.total_factorizations + static_cast<std::uint32_t>(island.factorizations);
    return done < island.budget ? tolerance::kInteriorPoints : 1;
  };
  bool done = false, found = true;
  for (int outer = 0; outer < tolerance::kOuterIterations && !done; ++outer) {
    choose_discs(island, found && outer < tolerance::kDiscIterations);
    found = minimize(
        island, interior_points == 0 ? tolerance::kPlainIterations : tolerance::kInnerIterations);
    if (!found) {
      if (interior_points >= most_interior_points()) break;
      if (interior_points++ == 0) {
        island.v = start;
        start_over(island);
      }
      choose_discs(island, false);
      island.step_length = tolerance::kStepLength;
      find_interior_point(island);
      keep(island, start);
      island.step_length = tolerance::kShortStepLength;
      found = minimize(island, tolerance::kInnerIterations);
      if (!found) take_back(island, start);
    }
    island.lack = take_over(island);
    done = found && island.lack < island.speed;
    if (done || !found || island.step_length == tolerance::kStepLength) continue;
    island.step_length =
        std::min(tolerance::kStepLength, tolerance::kStepGrowth * island.step_length);
    island.has_factor = false;
  }
  if (!done) drop_idle_friction(island);
  island.fell_back = !found || island.lack > tolerance::kNotConverged * island.speed;
  if (island.solves_positions && impulses_cancel(island)) {
    island.v = island.v_rest;  // the overlap waits until the body is free
    island.fell_back = true;
    return;
  }
  velocities_from_impulses(island);
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
