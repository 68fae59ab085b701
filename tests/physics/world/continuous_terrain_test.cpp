// Proves that what is stopped on a surface of triangles gets going again: small bodies that dash
// over rough terrain, and are stopped in its hollows, are never held where they stand while they
// have speed.
#include <gtest/gtest.h>

#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

double hills(double x, double z) { return 0.5 * std::sin(1.3 * x) * std::cos(0.9 * z); }

// The longest time [s] for which a body does not get on: it goes less than a hundredth of the way
// that its speed tells, although that is more than a tenth of its size in a step.
double longest_hold(const Shape& shape, double size, double heading) {
  PhysicsWorld world;
  const auto terrain = surfaces::made(surfaces::grid(-8, 8, -8, 8, 64, 64, hills));
  add(world, body_at(Pose{}, MotionType::Static), with(SurfaceMesh{terrain}, material(0.7, 0.1)));
  const BodyId body = add(
      world,
      moving(at(0, 0.8, 0), vec(3 * std::cos(heading), -4, 3 * std::sin(heading)), vec(5, 3, 2)),
      with(shape, material(0.7, 0.1)));
  double held = 0, longest = 0;
  for (int i = 0; i < 240; ++i) {
    const Vector3d before = world.center_of_mass(body).cast<double>();
    world.step(kDt);
    const double way = (world.center_of_mass(body).cast<double>() - before).norm();
    const double told = kDt * static_cast<double>(world.linear_velocity(body).norm());
    held = told > 0.1 * size && way < 0.01 * told ? held + kDt : 0;
    longest = std::max(longest, held);
  }
  return longest;
}

TEST(ContinuousTerrain, WhatIsStoppedInAHollowGetsGoingAgain) {
  for (int k = 0; k < 24; ++k) {
    const double heading = 2 * kPi * k / 24;
    EXPECT_LT(longest_hold(sphere(0.01), 0.01, heading), 0.1) << "ball, heading " << heading;
    EXPECT_LT(longest_hold(capsule(0.021, 0.0136), 0.0136, heading), 0.1)
        << "capsule, heading " << heading;
    EXPECT_LT(longest_hold(rounded_box(0.004, 0.006, 0.005, 0.003), 0.007, heading), 0.1)
        << "pebble, heading " << heading;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
