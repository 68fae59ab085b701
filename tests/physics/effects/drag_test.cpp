// Proves that drag follows its closed forms at any time step and never turns a body back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

BodyId point(PhysicsWorld& world, const Vector3d& v, double mass = 1) {
  RigidBody body = free_body(mass, Vector3d(1, 1, 1));
  body.linear_velocity = vec(v);
  return must(world.create_body(body));
}
EffectId drag(PhysicsWorld& world, double linear, double quadratic) {
  return must(world.create_effect({{}, Drag{real(linear), real(quadratic)}, 0}));
}

// F2: m/c = 2 s, v0 = (30, 40), 4 s under gravity.
TEST(Drag, LinearIsExactAtAnyStep) {
  for (const double dt : {1.0 / 1000, 1.0 / 60, 1.0 / 15, 1.0, 4.0}) {
    PhysicsWorld world;
    const BodyId ball = point(world, {30, 40, 0});
    drag(world, 0.5, 0);
    run(world, 4, dt);
    const Vector3d x = position(world, ball);
    EXPECT_NEAR(x.x(), 51.87988300580, bar(1e-9, 5e-3)) << dt;
    EXPECT_NEAR(x.y(), 24.62262082687, bar(1e-9, 5e-3)) << dt;
  }
}

TEST(Drag, StopsAtOnceWhereItIsOverwhelming) {
  PhysicsWorld world(no_gravity());
  const BodyId ball = point(world, {100, 0, 0});
  drag(world, 1e9, 0);
  world.step(1.0 / 60);
  EXPECT_NEAR(position(world, ball).x(), 100 / 1e9, 1e-9);
  EXPECT_EQ(velocity(world, ball).x(), 0);
}

// F3: terminal speed 20 m/s.
TEST(Drag, QuadraticFallAndThrow) {
  const double k = kGravity / 400;
  {
    PhysicsWorld world;
    const BodyId ball = point(world, Vector3d::Zero());
    drag(world, 0, k);
    run(world, 5);
    EXPECT_NEAR(position(world, ball).y(), -72.03812222, bar(1e-4, 3e-3));
    EXPECT_NEAR(velocity(world, ball).y(), -19.70580212, bar(1e-4, 1e-3));
  }
  PhysicsWorld world;
  const BodyId ball = point(world, {0, 50, 0});
  drag(world, 0, k);
  double highest = 0;
  run(world, 4, 1.0 / 960, [&] { highest = std::max(highest, position(world, ball).y()); });
  EXPECT_NEAR(highest, 40.387389783, bar(1e-4, 1e-2));
}

// F4: k/m = 0.005 1/m, 50 m/s at 45 degrees, 4 s.
TEST(Drag, QuadraticInTwoDimensions) {
  PhysicsWorld world;
  const double s = 50 / std::sqrt(2.0);
  const BodyId ball = point(world, {s, s, 0});
  drag(world, 0, 0.005);
  run(world, 4);
  const Vector3d x = position(world, ball), v = velocity(world, ball);
  EXPECT_NEAR(x.x(), 102.30420848, bar(1e-4, 1e-2));
  EXPECT_NEAR(x.y(), 36.59526949, bar(1e-4, 1e-2));
  EXPECT_NEAR(v.x(), 19.65938268, bar(1e-4, 1e-3));
  EXPECT_NEAR(v.y(), -11.31015145, bar(1e-4, 1e-3));
}

TEST(Drag, NeverTurnsBackAndKeepsTheTerminalSpeed) {
  for (const double dt : {1.0 / 240, 1.0 / 15, 1.0, 10.0}) {
    for (const double v0 : {1.0, 1000.0, 1e5}) {
      PhysicsWorld world(no_gravity());
      const BodyId ball = point(world, {v0, 0, 0});
      drag(world, 0, 0.5);
      for (int i = 0; i < 20; ++i) {
        world.step(dt);
        ASSERT_GE(velocity(world, ball).x(), 0) << dt << " " << v0;
        ASSERT_LE(velocity(world, ball).x(), v0);
      }
    }
    PhysicsWorld world;
    const BodyId falling = point(world, {0, -20, 0});
    drag(world, 0, kGravity / 400);
    for (int i = 0; i < 100; ++i) world.step(dt);
    EXPECT_NEAR(velocity(world, falling).y(), -20, bar(1e-9, 1e-3)) << dt;
  }
}

TEST(Drag, CarriesAlongWithItsMedium) {
  PhysicsWorld world(no_gravity());
  const BodyId leaf = point(world, Vector3d::Zero());
  Drag river{real(2), real(1)};
  river.medium = vec(3, 0, 0);
  must(world.create_effect({leaf, river, 0}));
  run(world, 20);
  EXPECT_NEAR((velocity(world, leaf) - Vector3d(3, 0, 0)).norm(), 0,
              bar(1e-9, 1e-4));  // float: 1 - decay has lost c h
}

// Equal moments: w decays as exp(-b t / I), exactly. Unequal ones: never faster than at the start.
TEST(Drag, AngularDecaysExactlyAndIsStable) {
  for (const double dt : {1.0 / 240, 1.0 / 60, 1.0 / 4}) {
    PhysicsWorld world(no_gravity());
    RigidBody body = free_body(1, Vector3d(2, 2, 2));
    body.angular_velocity = vec(0, 0, 5);
    const BodyId top = must(world.create_body(body));
    must(world.create_effect({top, Drag{0, 0, real(3), 0}, 0}));
    run(world, 2, dt);
    EXPECT_NEAR(spin(world, top).z(), 5 * std::exp(-3.0), bar(1e-12, 1e-5)) << dt;
  }
  PhysicsWorld world(no_gravity());
  RigidBody body = free_body(1, Vector3d(1, 2, 3));
  body.angular_velocity = vec(20, 50, 3);
  const BodyId top = must(world.create_body(body));
  must(world.create_effect({top, Drag{0, 0, real(1e6), real(1e6)}, 0}));
  double last = world.energy().kinetic_angular;
  // [J] of rates below the smallest normal number, which are rounded to no relative accuracy.
  const double nothing = 3 * std::pow(double{std::numeric_limits<Real>::min()}, 2);
  for (int i = 0; i < 20; ++i) {
    world.step(1.0 / 15);
    const double now = world.energy().kinetic_angular;
    ASSERT_LE(now, last * (1 + 1e-6) + nothing);
    last = now;
  }
}

// The ledger: what drag took is what the bodies lost.
TEST(Drag, TheBooksBalance) {
  for (const double k : {0.0, 0.02}) {
    PhysicsWorld world;
    const BodyId ball = point(world, {30, 40, 0});
    const EffectId effect = drag(world, 0.1, k);
    const double before = world.energy().total();
    run(world, 2);
    const double lost = world.energy().total() - before;
    EXPECT_NEAR(world.effect_report(effect).work, lost, std::abs(lost) * bar(1e-5, 1e-3));
    EXPECT_LT(lost, 0);
    (void)ball;
  }
}

// In contact: a block slides to rest over a floor without friction by drag alone, as far as m v/c.
TEST(Drag, ActsOnWhatTouches) {
  PhysicsWorld world;
  add_floor(world, material(0));
  RigidBody body = moving(at(0, 0.5, 0), vec(10, 0, 0));
  const BodyId block = add(world, body, with(cube(0.5), material(0)));
  const double mass = world.mass_properties(block).mass;
  must(world.create_effect({block, Drag{real(2 * mass)}, 0}));
  run(world, 8);
  EXPECT_NEAR(position(world, block).x(), 5, 0.02);  // h v/2: contacts may be first order
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
