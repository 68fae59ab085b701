// Proves that joints of order 4 are of fourth order in the substep where motion can be undone, lose
// nothing there, and are those of order 2 where it cannot.
#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;

WorldSettings of_order(int order, int substeps = 4) {
  WorldSettings settings;
  settings.joint_order = order;
  settings.substeps = substeps;
  return settings;
}

// A chain of three rods of unequal lengths that falls out of the horizontal.
struct Chain {
  PhysicsWorld world;
  BodyId last;
  Chain(const WorldSettings& settings, const JointAxis& axis = {}) : world(settings) {
    BodyId above;
    double x = 0;
    for (const double l : {0.5, 0.7, 0.4}) {
      const double mass = 2 * l, across = mass * l * l / 12;
      last = add_body(world, {x + l / 2, 0, 0}, mass, {1e-3, across, across});
      must(world.create_joint(
          joint_at(world, above, last, HingeJoint{axis}, {x, 0, 0}, Vector3d::UnitZ())));
      above = last;
      x += l;
    }
  }
  [[nodiscard]] Vector3d end_after(double seconds) {
    run(world, seconds);
    return position(world, last);
  }
};

TEST(JointOrder, AChainOfRodsConvergesWithTheFourthPowerOfTheSubstep) {
  const Vector3d truth = Chain(of_order(4, 64)).end_after(1);
  const auto error = [&](int order, int substeps) {
    return (Chain(of_order(order, substeps)).end_after(1) - truth).norm();
  };
  EXPECT_LE(error(4, 4), bar(2e-6, 1e-4));  // [m]
  if constexpr (kDouble) {
    EXPECT_GE(error(4, 2) / error(4, 4), 12);  // 16, but for terms of higher order
    EXPECT_GE(error(4, 4) / error(4, 8), 12);
    EXPECT_GE(error(2, 8) / error(4, 8), 100);
  }
}

TEST(JointOrder, AnUndampedSpringSwingsAtItsFrequency) {
  const double k = 60, w = std::sqrt(k);
  for (const int order : {2, 4}) {
    WorldSettings settings = of_order(order);
    settings.gravity = Vec3::Zero();
    JointAxis axis;
    axis.spring = JointSpring{0, real(k), 0};
    PhysicsWorld world(settings);
    const BodyId bob = add_body(world, {0, 0, 0}, 1, {0.1, 0.1, 0.1});
    must(world.create_joint(joint_at(world, {}, bob, SliderJoint{axis}, {0, 0, 0})));
    must(world.set_linear_velocity(bob, vec(1, 0, 0)));
    double worst = 0, t = 0;
    run(world, 5, 1.0 / 60, [&] {
      t += 1.0 / 60;
      worst = std::max(worst, std::abs(position(world, bob).x() - std::sin(w * t) / w));
    });
    EXPECT_LE(worst, order == 2 ? bar(3e-3, 3e-3) : bar(2e-6, 2e-4)) << order;  // [m] of 0.13
  }
}

// Limits far off change nothing: the period is that of the free pendulum (F9).
TEST(JointOrder, LimitsOutOfReachCostNoAccuracy) {
  JointAxis axis;
  axis.limit = JointLimit{real(-4), real(1)};  // it swings from 0, where it was made, to -pi
  Pendulum p(HingeJoint{axis}, kPi / 2, 1, 1, kBobMoment, of_order(4));
  const double period = period_of(p.world, 1.0 / 60, 10, [&] { return p.angle(); });
  EXPECT_NEAR(period / (2.3678419476 * std::sqrt(p.inertia)), 1, bar(1e-7, 1e-3));
}

// What is hit, damped, driven or rubbed goes forward in time alone, and never gains.
TEST(JointOrder, WhatLosesEnergyOnlyLosesIt) {
  JointAxis stopped, damped, rubbed, braked;
  stopped.limit = JointLimit{real(-0.4), real(0.4)};
  damped.spring = JointSpring{0, 2, 1};
  rubbed.friction = real(0.5);
  braked.motor = JointMotor{JointMotor::Mode::Velocity, 0, real(0.5)};
  for (const JointAxis& axis : {stopped, damped, rubbed, braked}) {
    Chain chain(of_order(4), axis);
    const double start = chain.world.energy().total();
    double highest = start;
    run(chain.world, 10, 1.0 / 60,
        [&] { highest = std::max(highest, chain.world.energy().total()); });
    EXPECT_LE(highest - start, bar(2e-4, 2e-3));  // [J] of 9: what order 2 breathes by
    EXPECT_LE(chain.world.energy().total(), start - 1);
    EXPECT_TRUE(all_finite(chain.world));
  }
}

// What hits an elastic limit again and again loses no more than with order 2.
TEST(JointOrder, AnElasticLimitIsHitAsWithOrderTwo) {
  const auto energy_after = [](int order) {
    JointAxis axis;
    axis.limit = JointLimit{real(-0.6), real(3), {}, 1};  // 0.9 rad at the start, then 0.3 at least
    Pendulum p(HingeJoint{axis}, 0.9, 1, 1, kBobMoment, of_order(order));
    run(p.world, 20, 1.0 / 60, [&] { EXPECT_GE(p.angle(), 0.29); });
    return p.world.energy().total();
  };
  const double start = -kGravity * std::cos(0.9);
  EXPECT_LE(energy_after(4), start + 1e-3);
  EXPECT_GE(energy_after(4), energy_after(2) - 0.01);
}

// The force that is read out is the mean over the step, back and forth.
TEST(JointOrder, ReadsOutTheWeightOfWhatHangs) {
  Pendulum p(HingeJoint{}, 0, 1, 3, 0.1, of_order(4));
  run(p.world, 1);
  EXPECT_NEAR(static_cast<double>(p.world.joint_reaction(p.joint).force.y()), 3 * kGravity,
              bar(1e-9, 1e-3));
}

TEST(JointOrder, IsTwoOrFour) {
  PhysicsWorld world;
  for (const int wrong : {-4, 0, 1, 3, 5, 8}) {
    WorldSettings settings = of_order(wrong);
    EXPECT_EQ(world.set_settings(settings).code, StatusCode::OutOfRange) << wrong;
  }
  EXPECT_EQ(world.settings().joint_order, 2);
}

TEST(JointOrder, GoesOnBitByBitAfterARestore) {
  Chain a(of_order(4));
  run(a.world, 0.5);
  PhysicsWorld b;
  must(b.restore(a.world.save()));
  EXPECT_EQ(b.settings().joint_order, 4);
  run(a.world, 0.5);
  run(b, 0.5);
  EXPECT_EQ(a.world.state_hash(), b.state_hash());
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
