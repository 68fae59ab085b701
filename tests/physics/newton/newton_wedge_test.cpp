// Proves that the accurate solver keeps its head where friction can hold a wedged body under any
// stress: the velocities stay those of a body at rest, however the impulses cancel.
#include <gtest/gtest.h>

#include <random>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

// The fastest a capsule moves that lies in a groove between two steep walls and is nudged a little,
// in another way each time, every 0.1 s.
double fastest(double friction, double steepness) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::Newton;
  PhysicsWorld world(settings);
  const Material surface = material(friction);
  for (const double side : {-1.0, 1.0})
    add_floor(world, surface, Vector3d(side * std::sin(steepness), std::cos(steepness), 0));
  const double radius = 0.026;
  const BodyId body = add(
      world,
      body_at(at(Vector3d(0, radius / std::cos(steepness), 0), turn(kPi / 2, Vector3d::UnitX()))),
      with(capsule(0.042, radius), surface, 365));
  std::mt19937 random(0);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  double speed = 0;
  for (int i = 0; i < 240; ++i) {
    if (i % 12 == 0) {
      must(world.set_linear_velocity(body, vec(0.1 * number(), -0.1 * number(), 0.1 * number())));
      must(world.set_angular_velocity(body, vec(number(), number(), number())));
    }
    world.step(1.0 / 120);
    const Vector3d v = world.linear_velocity(body).cast<double>();
    const Vector3d w = world.angular_velocity(body).cast<double>();
    if (!v.allFinite() || !w.allFinite() || world.last_report().quarantined > 0) return 1e30;
    speed = std::max(speed, v.norm() + radius * w.norm());
  }
  return speed;
}

TEST(NewtonWedge, WhatIsJammedRests) {
  for (const double friction : {0.9, 1.2, 2.0})
    for (const double steepness : {0.87, 1.0})
      EXPECT_LT(fastest(friction, steepness), 0.3)
          << "friction " << friction << " steepness " << steepness;
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
