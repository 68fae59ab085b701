// What tests measure, and the round-off that the build's number types allow. (For tests only: needs
// Google Test. Benchmarks and demos take build.h and scenes.h.)
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

inline constexpr bool kDouble = std::is_same_v<Real, double>;
inline constexpr double kEps = std::numeric_limits<Real>::epsilon();        // of velocities
inline constexpr double kPosEps = std::numeric_limits<PosReal>::epsilon();  // of positions

// The bar in double, and what single precision can carry instead.
constexpr double bar(double in_double, double in_float) { return kDouble ? in_double : in_float; }

// n additions of numbers no larger than `largest` are off by at most n/2 units in the last place
// each; rounding of a repeated addition is not random, so the worst case is the honest one.
inline double sum_error(double n, double largest, double eps = kEps) { return n * eps * largest; }

inline Eigen::Vector3d wide(const Vec3& v) { return v.cast<double>(); }
template <class P>
  requires(std::is_same_v<P, Pos3> && !std::is_same_v<Pos3, Vec3>)
Eigen::Vector3d wide(const P& p) {
  return p.template cast<double>();
}
inline Eigen::Quaterniond wide(const Quat& q) { return q.cast<double>(); }

inline Eigen::Vector3d position(const PhysicsWorld& world, BodyId body) {
  return wide(world.center_of_mass(body));
}
inline Eigen::Vector3d velocity(const PhysicsWorld& world, BodyId body) {
  return wide(world.linear_velocity(body));
}
inline Eigen::Vector3d spin(const PhysicsWorld& world, BodyId body) {
  return wide(world.angular_velocity(body));
}
inline Eigen::Quaterniond orientation(const PhysicsWorld& world, BodyId body) {
  return wide(world.pose(body).orientation);
}
// Angle of the rotation between two attitudes [rad].
inline double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond d = a.conjugate() * b;
  return 2 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

inline std::vector<BodyState> states(const PhysicsWorld& world) {
  std::vector<BodyState> out;
  world.copy_body_states(out);
  return out;
}
inline std::vector<ContactState> contacts(const PhysicsWorld& world) {
  std::vector<ContactState> out;
  world.copy_contacts(out);
  return out;
}

inline bool all_finite(const PhysicsWorld& world) {
  for (const BodyState& s : states(world)) {
    if (!s.pose.position.allFinite() || !s.pose.orientation.coeffs().allFinite() ||
        !s.linear_velocity.allFinite() || !s.angular_velocity.allFinite())
      return false;
  }
  return true;
}
inline double max_speed(const PhysicsWorld& world) {
  double fastest = 0;
  for (const BodyState& s : states(world))
    fastest = std::max(fastest, wide(s.linear_velocity).norm());
  return fastest;
}
// Deepest overlap of any contact point [m] >= 0.
inline double deepest(const PhysicsWorld& world) {
  double depth = 0;
  for (const ContactState& c : contacts(world))
    for (int i = 0; i < c.point_count; ++i)
      depth = std::max(depth, -static_cast<double>(c.points[i].separation));
  return depth;
}
// The touching pair of two bodies, in either order; null when they do not touch.
inline const ContactState* find_contact(const std::vector<ContactState>& all, BodyId a, BodyId b) {
  for (const ContactState& c : all)
    if ((c.body_a == a && c.body_b == b) || (c.body_a == b && c.body_b == a)) return &c;
  return nullptr;
}
// Normal impulse between two bodies over the last step [N s].
inline double normal_impulse(const PhysicsWorld& world, BodyId a, BodyId b) {
  double sum = 0;
  for (const ContactState& c : contacts(world)) {
    if (!((c.body_a == a && c.body_b == b) || (c.body_a == b && c.body_b == a))) continue;
    for (int i = 0; i < c.point_count; ++i) sum += static_cast<double>(c.points[i].normal_impulse);
  }
  return sum;
}

// Steps through `seconds` (a whole number of steps, to round-off).
inline void run(PhysicsWorld& world, double seconds, double dt = 1.0 / 60) {
  const long steps = std::lround(seconds / dt);
  for (long i = 0; i < steps; ++i) world.step(dt);
}
// The same, looking at the world after every step; an ASSERT that fails in there ends the run.
template <class Look>
void run(PhysicsWorld& world, double seconds, double dt, const Look& look) {
  const long steps = std::lround(seconds / dt);
  for (long i = 0; i < steps && !::testing::Test::HasFatalFailure(); ++i) {
    world.step(dt);
    look();
  }
}

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
