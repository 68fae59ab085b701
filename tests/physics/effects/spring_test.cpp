// Proves that springs keep their energy and stay stable at any stiffness and step, that bungees
// only pull, and that two bodies keep their momentum.
#include <gtest/gtest.h>

#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

BodyId ball_at(PhysicsWorld& world, double x, double y = 0, double mass = 1) {
  RigidBody body = free_body(mass, Vector3d(1, 1, 1));
  body.pose = at(x, y, 0);
  return must(world.create_body(body));
}
EffectId tie(PhysicsWorld& world, BodyId body, const Spring& spring) {
  return must(world.create_effect({body, spring, 0}));
}

TEST(Spring, AnchoredSwingsAsCosine) {
  PhysicsWorld world(no_gravity());
  const BodyId ball = ball_at(world, 1.5);
  Spring spring;
  spring.stiffness = real(25);  // w = 5 rad/s
  const EffectId id = tie(world, ball, spring);
  EXPECT_NEAR(world.effect_report(id).potential, 0.5 * 25 * 0.25, 1e-5);
  double worst = 0, t = 0;
  run(world, 10, 1.0 / 60, [&] {
    t += 1.0 / 60;
    worst = std::max(worst, std::abs(position(world, ball).x() - 1 - 0.5 * std::cos(5 * t)));
  });
  EXPECT_LT(worst, 1e-3);  // (w h)^2/12 of 50 rad is 1.8e-3 rad
}

TEST(Spring, KeepsItsEnergyAtAnyStiffnessAndStep) {
  for (const double k : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    for (const double dt : {1.0 / 15, 1.0 / 60, 1.0 / 1000}) {
      PhysicsWorld world(no_gravity());
      ball_at(world, 1.25);
      Spring spring;
      spring.stiffness = real(k);
      tie(world, BodyId{0, 1}, spring);
      const double start = world.energy().total();
      for (int i = 0; i < 300; ++i) {
        world.step(dt);
        ASSERT_NEAR(world.energy().total() / start, 1, bar(1e-6, 0.1)) << k << " " << dt;
      }
    }
  }
}

TEST(Spring, DampedStiffSpringComesToRestAtItsLength) {
  for (const double k : {10.0, 1e4, 1e8, 1e12}) {
    PhysicsWorld world(no_gravity());
    const BodyId ball = ball_at(world, 1.25);
    Spring spring;
    spring.stiffness = real(k);
    spring.damping = real(2 * std::sqrt(k));  // critical
    tie(world, ball, spring);
    double farthest = 0;
    run(world, 8, 1.0 / 60,
        [&] { farthest = std::max(farthest, std::abs(position(world, ball).x() - 1)); });
    EXPECT_LE(farthest, 0.25 + 1e-6);
    EXPECT_NEAR(position(world, ball).x(), 1, 1e-3) << k;
    EXPECT_LT(velocity(world, ball).norm(), 1e-3) << k;
  }
}

TEST(Spring, DamperAloneDecaysExactly) {
  PhysicsWorld world(no_gravity());
  RigidBody body = free_body(1, Vector3d(1, 1, 1));
  body.pose = at(10, 0, 0);
  body.linear_velocity = vec(4, 0, 0);
  const BodyId ball = must(world.create_body(body));
  Spring spring;
  spring.rest_length = real(10);
  spring.stiffness = real(1e-9);
  spring.damping = real(3);
  tie(world, ball, spring);
  run(world, 1);
  EXPECT_NEAR(velocity(world, ball).x(), 4 * std::exp(-3.0), bar(1e-8, 1e-5));
}

// REFERENCE_CASES 9.15: a bungee pulls when stretched and does nothing else.
TEST(Spring, BungeePullsOnlyAndBufferPushesOnly) {
  for (const auto acts : {Spring::Acts::WhenStretched, Spring::Acts::WhenCompressed}) {
    for (const double x : {0.5, 1.5}) {
      PhysicsWorld world(no_gravity());
      const BodyId ball = ball_at(world, x);
      Spring spring;
      spring.acts = acts;
      tie(world, ball, spring);
      world.step(1.0 / 60);
      const double v = velocity(world, ball).x();
      const bool stretched = x > 1;
      if (stretched != (acts == Spring::Acts::WhenStretched)) {
        EXPECT_EQ(v, 0);
      } else {
        EXPECT_NEAR(v, (stretched ? -1 : 1) * 100 * 0.5 / 60, 0.02);
      }
    }
  }
}

// A jumper of 80 kg on a bungee of 10 m, k = 100 N/m, from rest at the anchor: the lowest point
// follows from energy: m g y = k (y - 10)^2 / 2.
TEST(Spring, BungeeJumpReachesTheDepthThatEnergyGives) {
  PhysicsWorld world;
  const BodyId jumper = ball_at(world, 0, 0, 80);
  Spring bungee;
  bungee.rest_length = real(10);
  bungee.stiffness = real(100);
  bungee.acts = Spring::Acts::WhenStretched;
  const EffectId id = tie(world, jumper, bungee);
  const double start = world.energy().total(), w = 80 * kGravity / 100;
  double lowest = 0;
  run(world, 12, 1.0 / 60, [&] {
    lowest = std::min(lowest, position(world, jumper).y());
    ASSERT_NEAR(world.energy().total(), start, 10);  // of 23 kJ; when it goes taut in mid-substep
  });
  EXPECT_NEAR(lowest, -(10 + w + std::sqrt(w * w + 20 * w)), 0.02);
  EXPECT_GT(world.effect_report(id).potential, -1e-9);
}

TEST(Spring, TwoBodiesKeepMomentumAndAngularMomentum) {
  PhysicsWorld world(no_gravity());
  const BodyId a =
      add(world, moving(at(0, 0, 0), vec(0, 1, 0), vec(1, 2, 3)), with(box(0.3, 0.2, 0.1)));
  const BodyId b = add(world, moving(at(2, 0.5, 0.3), vec(0, 0, -2)), with(box(0.1, 0.5, 0.2)));
  Spring spring;
  spring.other = b;
  spring.point = vec(0.3, 0.2, -0.1);
  spring.other_point = pos(-0.1, 0.5, 0.2);
  spring.stiffness = real(5000);
  spring.damping = real(10);
  tie(world, a, spring);
  const EnergyReport start = world.energy();
  run(world, 5);
  const EnergyReport end = world.energy();
  const double size = start.momentum.norm() + 300;
  EXPECT_LT((end.momentum - start.momentum).norm(), size * bar(1e-12, 1e-4));
  EXPECT_LT((end.angular_momentum - start.angular_momentum).norm(), size * 1e-3);
  EXPECT_LT(end.total(), start.total());
}

// Springs that share bodies are solved together: ten bodies in a row on springs whose frequency is
// 13 times that of the substeps fall and swing, and gain at most 3 % of what they fell.
TEST(Spring, ChainsOfStiffSpringsStayTogether) {
  PhysicsWorld world;
  BodyId last = ball_at(world, 0.5);
  Spring spring;
  spring.rest_length = real(0.5);
  spring.stiffness = real(1e7);
  spring.damping = real(50);
  tie(world, last, spring);
  for (int i = 1; i < 10; ++i) {
    const BodyId next = ball_at(world, 0.5 * (i + 1));
    spring.other = last;
    tie(world, next, spring);
    last = next;
  }
  const double start = world.energy().total(), fall = 10 * kGravity * 2.75;  // [J] at most
  run(world, 20, 1.0 / 60, [&] { ASSERT_LT(world.energy().total(), start + 0.03 * fall); });
  EXPECT_TRUE(all_finite(world));
  EXPECT_LT(position(world, last).norm(), 5.5);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
