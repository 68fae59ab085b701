// Proves that fields move bodies as their potentials say: orbits close and keep their energy, the
// ledger knows the potential, a field of the user's own is one of them.
#include <gtest/gtest.h>

#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

BodyId planet(PhysicsWorld& world) {
  RigidBody body = free_body(2, Vector3d(1, 1, 1));
  body.pose = at(0.5, 0, 0);
  body.linear_velocity = vec(0, std::sqrt(3.0), 0);
  return must(world.create_body(body));
}

// F5: e = 0.5, a = mu = 1, 200 steps an orbit.
double orbit_energy_error(PhysicsWorld& world, double* drift) {
  const double dt = 2 * kPi / 200, start = world.energy().total();
  double worst = 0, first = 0, last = 0;
  for (int orbit = 0; orbit < 100; ++orbit) {
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      world.step(dt);
      const double error = (world.energy().total() - start) / std::abs(start);
      worst = std::max(worst, std::abs(error));
      sum += error / 200;
    }
    if (orbit < 10) first += sum / 10;
    if (orbit >= 90) last += sum / 10;
  }
  *drift = std::abs(last - first);
  return worst;
}

TEST(PointGravity, KeplerOrbitKeepsItsEnergyWithoutDrift) {
  PhysicsWorld world(no_gravity());
  const BodyId body = planet(world);
  must(world.create_effect({body, PointGravity{Pos3::Zero(), real(1)}, 0}));
  EXPECT_NEAR(world.energy().total(), -1, bar(1e-12, 1e-5));  // m (v^2/2 - mu/r) = -m mu/(2a)
  double drift = 0;
  EXPECT_LT(orbit_energy_error(world, &drift), 2e-3);
  EXPECT_LT(drift, bar(1e-6, 1e-3));
}

TEST(PointGravity, ComesBackAfterOnePeriod) {
  double error[2];
  for (const int k : {0, 1}) {
    PhysicsWorld world(no_gravity());
    const BodyId body = planet(world);
    must(world.create_effect({body, PointGravity{Pos3::Zero(), real(1)}, 0}));
    const int steps = 1000 << k;
    for (int i = 0; i < steps; ++i) world.step(2 * kPi / steps);
    error[k] = (position(world, body) - Vector3d(0.5, 0, 0)).norm();
    EXPECT_LT(error[k], 1e-3);
  }
  if (kDouble) {
    EXPECT_NEAR(error[0] / error[1], 4, 0.2);  // second order
  }
}

FieldForce kepler(const FieldSample& at, void*) {
  const double r = at.position.norm();
  return {-at.mass / (r * r * r) * at.position, Vector3d::Zero(), -at.mass / r};
}

TEST(ForceField, OfTheUsersOwnIsAsGoodAsOneBuiltIn) {
  PhysicsWorld mine(no_gravity()), own(no_gravity());
  const BodyId a = planet(mine), b = planet(own);
  must(mine.set_force_field(7, kepler));
  ForceField field;
  field.field = 7;
  must(mine.create_effect({a, field, 0}));
  must(own.create_effect({b, PointGravity{Pos3::Zero(), real(1)}, 0}));
  EXPECT_NEAR(mine.energy().effects, own.energy().effects, 1e-6);
  for (int i = 0; i < 500; ++i) {
    mine.step(0.01);
    own.step(0.01);
  }
  EXPECT_LT((position(mine, a) - position(own, b)).norm(), bar(1e-12, 1e-4));
}

TEST(ForceField, AnAnswerThatIsNotFiniteCountsAsNone) {
  PhysicsWorld world(no_gravity());
  const BodyId a = planet(world);
  must(world.set_force_field(1, [](const FieldSample&, void*) {
    return FieldForce{Vector3d::Constant(std::nan("")), Vector3d::Zero(), 0};
  }));
  ForceField field;
  field.field = 1;
  must(world.create_effect({a, field, 0}));
  run(world, 1, 0.01);
  EXPECT_NEAR(position(world, a).y(), std::sqrt(3.0), 1e-4);
  EXPECT_TRUE(world.last_report().quarantined == 0);
}

TEST(Attractor, OscillatesWithItsFrequencyAtAnyStrength) {
  // Linear: w^2 = strength / m, energy kept by the implicit midpoint.
  for (const double strength : {1.0, 1e4, 1e8, 1e11}) {
    PhysicsWorld world(no_gravity());
    RigidBody body = free_body(1, Vector3d(1, 1, 1));
    body.pose = at(1, 0, 0);
    const BodyId ball = must(world.create_body(body));
    Attractor pull;
    pull.strength = real(strength);
    pull.law = Attractor::Law::Linear;
    must(world.create_effect({{}, pull, 0}));
    const double start = world.energy().total();
    double worst = 0;
    run(world, 5, 1.0 / 60,
        [&] { worst = std::max(worst, std::abs(world.energy().total() / start - 1)); });
    EXPECT_LT(worst, bar(1e-6, 0.05)) << strength;
    if (strength == 1.0) {
      EXPECT_NEAR(position(world, ball).x(), std::cos(5.0), bar(2e-5, 1e-4));
    }
  }
}

TEST(Attractor, PushesAwayWithinItsRange) {
  PhysicsWorld world(no_gravity());
  Attractor push;
  push.strength = real(-10);
  push.range = real(5);
  must(world.create_effect({{}, push, 0}));
  RigidBody body = free_body(1, Vector3d(1, 1, 1));
  body.pose = at(1, 0, 0);
  const BodyId near = must(world.create_body(body));
  body.pose = at(20, 0, 0);
  const BodyId far = must(world.create_body(body));
  run(world, 3);
  // v^2/2 = 10 N over the 4 m to the range's end.
  EXPECT_NEAR(velocity(world, near).x(), std::sqrt(80.0), 0.1);
  EXPECT_EQ(velocity(world, far).norm(), 0);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
