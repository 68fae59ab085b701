// Proves that stacks stand: boxes neither sink, drift, lean nor tremble, with or without friction,
// for a minute, and the force at each contact is the weight above it. Sleep is off in every verdict
// on stability, so that it cannot hide one.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]
// Limits of reference section 6: overlap at most 1 % of the smallest thickness once settled.
constexpr double kSettledOverlap = 0.01;

double tilt(const PhysicsWorld& world, BodyId body) {
  const Vector3d up = orientation(world, body) * Vector3d::UnitY();
  return std::acos(std::min(1.0, up.y()));
}

struct Verdict {
  double sideways = 0, sink = 0, lean = 0, speed = 0;
};
// How far a stack of unit boxes is from its ideal place.
Verdict judge(const PhysicsWorld& world, const Built& stack, double edge = 1) {
  Verdict v;
  for (std::size_t i = 0; i < stack.bodies.size(); ++i) {
    const Vector3d p = position(world, stack.bodies[i]);
    v.sideways = std::max(v.sideways, std::hypot(p.x(), p.z()));
    v.sink = std::max(v.sink, std::abs(p.y() - edge * (0.5 + static_cast<double>(i))));
    v.lean = std::max(v.lean, tilt(world, stack.bodies[i]));
    v.speed = std::max(v.speed, velocity(world, stack.bodies[i]).norm());
  }
  return v;
}

TEST(Stacking, TenBoxesStandForAMinute) {
  PhysicsWorld world(no_sleep());
  const Built stack = build_stack(world);
  double fastest = 0, deepest_overlap = 0;
  run(world, 60, kDt, [&] {
    if (world.time() < 1) return;
    fastest = std::max(fastest, max_speed(world));
    deepest_overlap = std::max(deepest_overlap, deepest(world));
  });
  const Verdict v = judge(world, stack);
  EXPECT_LE(v.sideways, 1e-3);
  EXPECT_LE(v.sink, 10 * kSettledOverlap);  // ten contacts
  EXPECT_LE(v.lean, 1e-3);
  EXPECT_LE(v.speed, bar(1e-6, 1e-4));
  EXPECT_LE(fastest, 0.01);
  EXPECT_LE(deepest_overlap, kSettledOverlap);
}

void expect_shifted_boxes_stand_for_a_minute(int count) {
  PhysicsWorld world(no_sleep());
  const Built stack = build_stack(world, {.count = count, .shift = 0.01});
  run(world, 60);
  const Verdict v = judge(world, stack);
  EXPECT_LE(v.sideways, 0.01 + 0.005);
  EXPECT_LE(v.sink, count * kSettledOverlap);
  EXPECT_LE(v.lean, 5e-3);
}
TEST(Stacking, TenShiftedBoxesStandForAMinute) { expect_shifted_boxes_stand_for_a_minute(10); }
// Euler's column on springs that resist tilt as contacts do: 16 boxes of 1 m stand, 17 sway.
TEST(Stacking, FifteenShiftedBoxesStandForAMinute) { expect_shifted_boxes_stand_for_a_minute(15); }

// A contact between two of the boxes is a spring of w^2 times one of their masses, whatever it
// carries: box k of n, on which n - 1 - k rest, sinks into that below by (n - k) g / w^2.
TEST(Stacking, BoxesSinkIntoOneAnotherByTheirLoadOverTheSpring) {
  PhysicsWorld world(no_sleep());
  constexpr int kCount = 8;
  const Built stack = build_stack(world, {.count = kCount});
  run(world, 30);
  const double w = 2 * 3.14159265358979 * static_cast<double>(world.settings().contact_frequency);
  const double unit = world.settings().gravity.cast<double>().norm() / (w * w);  // [m]
  for (int k = 1; k < kCount; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double gap =
        position(world, stack.bodies[i]).y() - position(world, stack.bodies[i - 1]).y() - 1;
    EXPECT_NEAR(-gap, (kCount - k) * unit, 0.02 * (kCount - k) * unit + 1e-6) << "box " << k;
  }
}

TEST(Stacking, TenBoxesFallAsleepAndStayInPlace) {
  PhysicsWorld world;
  const Built stack = build_stack(world);
  run(world, 5);
  EXPECT_EQ(world.last_report().awake_bodies, 0u);
  const std::uint64_t asleep = world.state_hash();
  const std::vector<BodyState> before = states(world);
  run(world, 10);
  const std::vector<BodyState> after = states(world);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].pose.position, after[i].pose.position);
    EXPECT_EQ(before[i].pose.orientation.coeffs(), after[i].pose.orientation.coeffs());
  }
  EXPECT_EQ(asleep, world.state_hash());
  EXPECT_LE(judge(world, stack).sideways, 1e-3);
}

TEST(Stacking, PyramidOfTenRowsStands) {
  PhysicsWorld world(no_sleep());
  const Built pyramid = build_pyramid(world, {.base = 10});
  std::vector<Vector3d> start;
  for (BodyId b : pyramid.bodies) start.push_back(position(world, b));
  run(world, 20);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Vector3d moved = position(world, pyramid.bodies[i]) - start[i];
    ASSERT_LE(std::abs(moved.y()), 0.05) << "box " << i;
    ASSERT_LE(std::hypot(moved.x(), moved.z()), 0.02) << "box " << i;
  }
  EXPECT_LE(max_speed(world), bar(1e-4, 1e-2));
  EXPECT_LE(deepest(world), kSettledOverlap);
}

// Reference case H4, the part a substepped soft solver is meant for: ratios up to 10.
TEST(Stacking, HeavyOnLightStands) {
  for (double ratio : {0.1, 2.0, 5.0, 10.0}) {
    PhysicsWorld world(no_sleep());
    const Built stack = build_stack(world, {.count = 2, .growth = ratio});
    run(world, 10);
    const Verdict v = judge(world, stack);
    EXPECT_LE(v.sideways, 1e-3) << ratio;
    EXPECT_LE(v.sink, 2 * kSettledOverlap * std::max(1.0, ratio / 5)) << ratio;
    EXPECT_LE(v.lean, 1e-3) << ratio;
    EXPECT_LE(v.speed, 1e-3) << ratio;
  }
}

TEST(Stacking, LightAndHeavyInTurn) {
  PhysicsWorld world(no_sleep());
  Built stack;
  stack.ground = add_floor(world);
  for (int i = 0; i < 5; ++i)
    stack.bodies.push_back(
        add(world, body_at(at(0, 0.5 + i, 0)), with(cube(0.5), {}, i % 2 == 0 ? 300.0 : 3000.0)));
  run(world, 10);
  const Verdict v = judge(world, stack);
  EXPECT_LE(v.sideways, 1e-3);
  EXPECT_LE(v.lean, 1e-3);
}

// Reference case H18: an aligned stack needs no friction; enormous friction adds no energy.
TEST(Stacking, StandsWithoutFrictionAndWithHugeFriction) {
  for (double mu : {0.0, 1e9}) {
    PhysicsWorld world(no_sleep());
    const Built stack = build_stack(world, {.count = 5, .surface = material(mu)});
    const double E0 = world.energy().total();
    run(world, 10, kDt, [&] {
      ASSERT_TRUE(all_finite(world));
      ASSERT_LE(world.energy().total(), E0 * (1 + 1e-2));
    });
    const Verdict v = judge(world, stack);
    EXPECT_LE(v.sideways, 1e-3) << "mu " << mu;
    EXPECT_LE(v.lean, 1e-3) << "mu " << mu;
  }
}

// Reference case C18: the k-th contact of a column of n carries (n - k) m g.
void expect_weights_above(int n) {
  PhysicsWorld world(no_sleep());
  const Built stack = build_stack(world, {.count = n});
  const double m = world.mass_properties(stack.bodies[0]).mass;
  run(world, 1);
  // The mean of one more second: the target is the force at rest, not its last ripple.
  std::vector<double> sum(static_cast<std::size_t>(n), 0);
  run(world, 1, kDt, [&] {
    BodyId below = stack.ground;
    for (int k = 0; k < n; ++k) {
      const BodyId above = stack.bodies[static_cast<std::size_t>(k)];
      sum[static_cast<std::size_t>(k)] += normal_impulse(world, below, above);
      below = above;
    }
  });
  for (int k = 0; k < n; ++k) {
    const double force = sum[static_cast<std::size_t>(k)] / 1.0;
    const double weight = (n - k) * m * kGravity;
    EXPECT_NEAR(force, weight, 1e-3 * weight) << "contact " << k << " of " << n;
  }
}
TEST(Stacking, C18_ContactForcesAreTheWeightAbove) {
  expect_weights_above(10);
  expect_weights_above(100);
}

// The floor feels the weight of a sphere, a capsule and a box, each at rest.
TEST(Stacking, WeightOnTheFloorForEveryShape) {
  for (const Shape& shape : {Shape(sphere(0.5)), Shape(capsule(0.5, 0.5)), Shape(cube(0.5))}) {
    PhysicsWorld world(no_sleep());
    const BodyId floor = add_floor(world);
    RigidBody spec = body_at(at(0, 0.5, 0));
    spec.pose.orientation = turn(kPi / 2, Vector3d::UnitZ());  // the capsule lies
    const BodyId body = add(world, spec, with(shape));
    run(world, 2);
    const double weight = world.mass_properties(body).mass * kGravity;
    EXPECT_NEAR(normal_impulse(world, floor, body) / kDt, weight, 1e-3 * weight) << shape.index();
    EXPECT_NEAR(position(world, body).y(), 0.5, 0.5 * kSettledOverlap) << shape.index();
  }
}

// A stack dropped from a small height settles without being thrown about.
TEST(Stacking, SettlesAfterASmallDrop) {
  PhysicsWorld world(no_sleep());
  const Built stack = build_stack(world, {.count = 5, .gap = 0.02});
  const double E0 = world.energy().total();
  run(world, 10, kDt, [&] { ASSERT_LE(world.energy().total(), E0 * (1 + 1e-6)); });
  const Verdict v = judge(world, stack);
  EXPECT_LE(v.sideways, 0.01);
  EXPECT_LE(v.lean, 0.01);
  EXPECT_LE(v.speed, 1e-3);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
