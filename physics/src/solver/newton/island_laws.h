// Impulses of an island's contacts and joints at given velocities, by the laws of contact_law.h.
#pragma once

#include "solver/newton/island.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

inline Vec3d to_frame(const IslandContact& c, Vec3d a) {
  return {detail::dot(c.n, a), detail::dot(c.t1, a), detail::dot(c.t2, a)};
}
inline Vec3d to_world(const IslandContact& c, Vec3d a) {
  return a.x * c.n + a.y * c.t1 + a.z * c.t2;
}

// Relative velocity of the island's own bodies at the contact's centre, in its frame.
inline Twist relative(const IslandContact& c, const std::vector<Twist>& velocity) {
  Vec3d v{0, 0, 0}, w{0, 0, 0};
  if (c.b != kFixed) {
    const Twist& b = velocity[static_cast<std::size_t>(c.b)];
    v = b.v + cross(b.w, c.arm_b);
    w = b.w;
  }
  if (c.a != kFixed) {
    const Twist& a = velocity[static_cast<std::size_t>(c.a)];
    v -= a.v + cross(a.w, c.arm_a);
    w -= a.w;
  }
  return {to_frame(c, v), to_frame(c, w)};
}
inline Vec3d at_point(const IslandPoint& p, const Twist& u) {
  return {u.v.x + p.b * u.w.y - p.a * u.w.z, u.v.y - p.b * u.w.x, u.v.z + p.a * u.w.x};
}
inline void add_at_point(const IslandPoint& p, Vec3d g, Twist& wrench) {
  wrench.v += g;
  wrench.w += Vec3d{p.a * g.z - p.b * g.y, p.b * g.x, -p.a * g.x};
}

// rho: step length [kg].
inline Projected law_of(const Island& island, const IslandContact& c, const IslandPoint& p,
                        double rho, Vec3d u) {
  u.x += p.gap + (island.solves_positions ? p.push : 0);
  u.y += p.drive1;
  u.z += p.drive2;
  if (!p.disc) u.x += c.mu * p.shift;
  const Vec3d y = p.center - rho * u;
  return p.disc ? project_column(p.radius, y) : project_cone(c.mu, y);
}
// Rolling and torsional friction: about n an interval, about t1 and t2 a disc.
inline Projected turning_law(const IslandContact& c, double rho, Vec3d w) {
  w.x += c.spin_drive;
  const Vec3d y = c.turn_center - (rho * c.lever2) * w;
  Projected p;
  p.g.x = std::min(std::max(y.x, -c.spin_radius), c.spin_radius);
  p.D.xx = p.g.x == y.x && c.torsional > 0 ? c.lever2 : 0;
  if (c.rolling > 0) {
    project_disc(c.roll_radius, y.y, y.z, p.g.y, p.g.z, p.D.yy, p.D.zz, p.D.yz);
    p.D.yy *= c.lever2;
    p.D.zz *= c.lever2;
    p.D.yz *= c.lever2;
  }
  return p;
}

// The wrench of all points, in the frame; u: their relative velocity.
inline Twist wrench_of(const Island& island, const IslandContact& c, double rho, const Twist& u) {
  Twist wrench;
  for (int i = 0; i < c.count; ++i)
    add_at_point(c.points[i], law_of(island, c, c.points[i], rho, at_point(c.points[i], u)).g,
                 wrench);
  if (c.resists_turning) wrench.w += turning_law(c, rho, u.w).g;
  return wrench;
}

struct ScalarResult {
  double g, D;
};
// unit2: of the joint's row; D: of the step length.
inline ScalarResult law_of(const Island& island, const ScalarLaw& law, double rho, double unit2,
                           double u) {
  const double r = rho * unit2, soft = 1 + r * law.compliance;
  const double miss = u + law.bias + (island.solves_positions ? law.push : 0);
  const double y = (law.center - r * miss) / soft;
  const double g = std::min(std::max(y, law.lower), law.upper);
  return {g, g == y ? unit2 / soft : 0};
}
// Three laws with one bound: y of each, and what is left of them.
inline Projected law_of_ball(const Island& island, const IslandJoint& joint, const BallBound& ball,
                             double rho, const double* rates, double& scale) {
  Vec3d y{};
  scale = 1;
  for (int k = 0; k < 3; ++k) {
    const ScalarLaw& law = island.laws[static_cast<std::size_t>(ball.first + k)];
    const double unit2 = joint.unit2[law.row], r = rho * unit2;
    const double soft = 1 + r * law.compliance;
    const double miss = rates[law.row] + law.bias + (island.solves_positions ? law.push : 0);
    set_component(y, k, (law.center - r * miss) / soft);
    scale = unit2 / soft;
  }
  return project_ball(ball.radius, y);
}

inline double rate_of(const IslandJoint& joint, int row, const std::vector<Twist>& velocity) {
  double rate = 0;
  for (int k = 0; k < joint.bodies; ++k)
    if (joint.body[k] != kFixed)
      rate += dot(joint.J[row][k], velocity[static_cast<std::size_t>(joint.body[k])]);
  return rate;
}

// Impulses along the rows at these rates (what is fixed included).
inline void impulses_of(const Island& island, const IslandJoint& joint, double rho,
                        const double* rates, double* impulse) {
  for (int i = 0; i < joint.rows; ++i) impulse[i] = 0;
  const std::uint32_t balls = static_cast<std::uint32_t>(3 * joint.balls);
  for (std::uint32_t k = joint.first_law; k < joint.first_law + joint.laws - balls; ++k) {
    const ScalarLaw& law = island.laws[k];
    impulse[law.row] += law_of(island, law, rho, joint.unit2[law.row], rates[law.row]).g;
  }
  for (int b = 0; b < joint.balls; ++b) {
    double scale;
    const Vec3d g = law_of_ball(island, joint, joint.ball[b], rho, rates, scale).g;
    for (int k = 0; k < 3; ++k)
      impulse[island.laws[static_cast<std::size_t>(joint.ball[b].first + k)].row] +=
          component(g, k);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
