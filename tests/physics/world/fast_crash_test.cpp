// Invariant: bodies that fly at each other, past each other and into piles at any speed and with
// any number of substeps lose energy by it and do not gain: by the rule of the hard cases, no more
// than 1 % of the kinetic energy that they came with.
#include <gtest/gtest.h>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr double kDt = 1.0 / 60;  // [s]

// Steps, and asks that the energy (no restitution, nothing that drives) does not rise again.
void expect_no_gain(PhysicsWorld& world, int steps, const std::string& what) {
  const EnergyReport start = world.energy();
  const double allowed = 0.01 * (start.kinetic_linear + start.kinetic_angular);
  double lowest = start.total();
  for (int i = 0; i < steps; ++i) {
    world.step(kDt);
    const double energy = world.energy().total();
    ASSERT_EQ(world.last_report().quarantined, 0u) << what << " step " << i;
    ASSERT_LE(energy, lowest + allowed) << what << " step " << i;
    lowest = std::min(lowest, energy);
  }
}

TEST(FastCrash, IntoAPileOfSmallBoxesGainsNothing) {
  for (const double size : {0.04, 0.5})
    for (const double speed : {40.0, 100.0, 400.0, 1000.0})
      for (const int substeps : {1, 2, 4, 8}) {
        WorldSettings settings = no_sleep();
        settings.substeps = substeps;
        PhysicsWorld world(settings);
        add_floor(world);
        std::vector<BodyId> boxes;
        for (int i = 0; i < 12; ++i)
          boxes.push_back(add(world,
                              body_at(at((i % 2) * 1.01 * size, size * (1 + 2 * (i / 2)), 0)),
                              with(box(0.5 * size, size, 0.5 * size))));
        for (int i = 0; i < 30; ++i) world.step(kDt);
        const double v = speed * size / 0.04;
        must(world.set_linear_velocity(boxes[10], vec(-0.37 * v, -0.92 * v, -0.003 * v)));
        must(world.set_linear_velocity(boxes[11], vec(0.61 * v, -0.79 * v, -0.003 * v)));
        ASSERT_NO_FATAL_FAILURE(expect_no_gain(world, 30,
                                               "size " + std::to_string(size) + " speed " +
                                                   std::to_string(v) + " substeps " +
                                                   std::to_string(substeps)));
      }
}

TEST(FastCrash, OfASwarmOfThinBodiesGainsNothing) {
  for (const double speed : {30.0, 300.0})
    for (const int substeps : {1, 4}) {
      WorldSettings settings = no_gravity();
      settings.substeps = substeps;
      settings.sleeping = false;
      PhysicsWorld world(settings);
      for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d place(0.7 * (i % 5) - 1.4, 0.5 * (i / 5 % 4), 0.6 * (i / 20));
        const Quat q = turn(0.7 * i, Eigen::Vector3d(1, 0.3 * (i % 4), 0.2 * (i % 7)).normalized());
        RigidBody body = moving(at(place, q), vec(-speed * place));
        add(world, body, with(i % 2 == 0 ? Shape(box(0.5, 0.02, 0.1)) : Shape(capsule(0.4, 0.03))));
      }
      ASSERT_NO_FATAL_FAILURE(expect_no_gain(
          world, 60, "speed " + std::to_string(speed) + " substeps " + std::to_string(substeps)));
    }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
