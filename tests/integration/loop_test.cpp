// Invariant: the loop turns any sequence of tick times into steps of one length and loses no time:
// fed = steps * dt + dropped + remainder; what it cannot do it says.
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "gtest/gtest.h"
#include "plumb/integration/fixed_step_loop.h"

namespace {

using plumb::PhysicsWorld;
using plumb::StatusCode;
using plumb::integration::FixedStepLoop;
using plumb::integration::LoopSettings;
using plumb::integration::TickReport;

// Times that are multiples of 2^-20 s add up without rounding, so the account must balance exactly.
TEST(FixedStepLoop, LosesNoTimeAtAll) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 1.0 / 64, .max_steps_per_tick = 1000});
  std::mt19937 random(1);
  double fed = 0;
  std::uint64_t steps = 0;
  for (int k = 0; k < 10000; ++k) {
    const double elapsed = static_cast<double>(random() % 100000) * 0x1p-20;
    fed += elapsed;
    const TickReport report = loop.tick(elapsed);
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(report.dropped, 0);
    steps += static_cast<std::uint64_t>(report.steps);
    ASSERT_EQ(static_cast<double>(steps) / 64 + loop.remainder(), fed);
    ASSERT_GE(loop.remainder(), 0);
    ASSERT_LT(loop.remainder(), 1.0 / 64);
  }
  EXPECT_EQ(loop.step_total(), steps);
  EXPECT_EQ(world.step_count(), steps);
}

// Times and steps that no double can hold exactly: the number of steps is still the exact quotient
// of the exact sums, found here in whole numbers of 2^-80 s.
TEST(FixedStepLoop, CountsStepsAsExactArithmeticDoes) {
  using Wide = unsigned __int128;
  const auto exact = [](double time) {
    int exponent = 0;
    const double mantissa = std::frexp(time, &exponent);
    const auto bits = static_cast<Wide>(std::ldexp(mantissa, 53));
    return bits << (80 + exponent - 53);
  };
  PhysicsWorld world;
  const double dt = 1.0 / 60, elapsed = 1.0 / 144;
  FixedStepLoop loop(world, {.dt = dt});
  Wide fed = 0;
  for (int k = 0; k < 200000; ++k) {
    fed += exact(elapsed);
    loop.tick(elapsed);
    ASSERT_EQ(loop.step_total(), static_cast<std::uint64_t>(fed / exact(dt))) << "tick " << k;
  }
}

// A display of exactly the step rate: one step a frame for ever, never none and two.
TEST(FixedStepLoop, DoesOneStepATickAtTheStepRate) {
  PhysicsWorld world;
  FixedStepLoop loop(world);
  for (int k = 0; k < 100000; ++k) ASSERT_EQ(loop.tick(1.0 / 60).steps, 1) << "tick " << k;
  EXPECT_EQ(loop.remainder(), 0);
}

TEST(FixedStepLoop, CapsStepsAndReportsWhatItDrops) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 1.0 / 64, .max_steps_per_tick = 4});
  // 10 steps and a half: 4 are done, 6 dropped, half of one is kept.
  const TickReport report = loop.tick(10.5 / 64);
  EXPECT_TRUE(report.status.ok());
  EXPECT_EQ(report.steps, 4);
  EXPECT_EQ(report.dropped, 6.0 / 64);
  EXPECT_EQ(report.alpha, 0.5);
  EXPECT_EQ(loop.dropped_total(), 6.0 / 64);
  EXPECT_EQ(world.time(), 4.0 / 64);
}

TEST(FixedStepLoop, SurvivesHugeTicks) {
  PhysicsWorld world;
  FixedStepLoop loop(world);
  for (const double huge : {1e4, 1e9, 1e300, std::numeric_limits<double>::max()}) {
    const TickReport report = loop.tick(huge);
    EXPECT_TRUE(report.status.ok());
    EXPECT_EQ(report.steps, loop.settings().max_steps_per_tick);
    // All but the steps done and the remainder; relative rounding of a sum of three.
    EXPECT_NEAR(report.dropped / huge, 1, 1e-4);
    EXPECT_GE(report.alpha, 0);
    EXPECT_LT(report.alpha, 1);
  }
}

TEST(FixedStepLoop, RefusesTimesThatAreNone) {
  PhysicsWorld world;
  FixedStepLoop loop(world);
  loop.tick(0.01);
  const double before = loop.remainder();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(loop.tick(nan).status.code, StatusCode::NotFinite);
  EXPECT_EQ(loop.tick(infinite).status.code, StatusCode::NotFinite);
  EXPECT_EQ(loop.tick(-infinite).status.code, StatusCode::NotFinite);
  EXPECT_EQ(loop.tick(-0.001).status.code, StatusCode::OutOfRange);
  EXPECT_NE(std::string(loop.tick(-0.001).status.message), "");
  EXPECT_EQ(loop.remainder(), before);
  EXPECT_EQ(world.step_count(), 0u);
  // No time at all is a tick like any other.
  const TickReport none = loop.tick(0);
  EXPECT_TRUE(none.status.ok());
  EXPECT_EQ(none.steps, 0);
  EXPECT_EQ(loop.remainder(), before);
}

TEST(FixedStepLoop, RefusesSettingsOutOfRange) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 0.01});
  for (const LoopSettings& bad :
       {LoopSettings{.dt = 0}, LoopSettings{.dt = -1}, LoopSettings{.dt = std::nan("")},
        LoopSettings{.dt = 1e9}, LoopSettings{.max_steps_per_tick = 0},
        LoopSettings{.time_scale = -1},
        LoopSettings{.time_scale = std::numeric_limits<double>::infinity()}}) {
    EXPECT_FALSE(loop.set_settings(bad).ok());
    EXPECT_EQ(loop.settings().dt, 0.01);
  }
}

TEST(FixedStepLoop, AlphaStaysBelowOne) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 0.1});
  loop.tick(std::nextafter(0.1, 0.0));  // all but the last bit of a step
  EXPECT_EQ(world.step_count(), 0u);
  EXPECT_LT(loop.alpha(), 1);
  std::mt19937 random(2);
  for (int k = 0; k < 10000; ++k) {
    const TickReport report = loop.tick(static_cast<double>(random() % 1000) * 1e-4);
    ASSERT_GE(report.alpha, 0);
    ASSERT_LT(report.alpha, 1);
  }
}

TEST(FixedStepLoop, ScalesTime) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 1.0 / 64, .max_steps_per_tick = 100, .time_scale = 0.25});
  EXPECT_EQ(loop.tick(1).steps, 16);
  ASSERT_TRUE(loop.set_settings({.dt = 1.0 / 64, .max_steps_per_tick = 100, .time_scale = 0}).ok());
  EXPECT_EQ(loop.tick(1).steps, 0);
  ASSERT_TRUE(loop.set_settings({.dt = 1.0 / 64, .max_steps_per_tick = 200, .time_scale = 2}).ok());
  EXPECT_EQ(loop.tick(1).steps, 128);
}

TEST(FixedStepLoop, PausesAndSteps) {
  PhysicsWorld world;
  FixedStepLoop loop(world);
  loop.set_paused(true);
  EXPECT_EQ(loop.tick(1).steps, 0);
  loop.request_steps(2);
  EXPECT_EQ(loop.tick(1).steps, 1);
  EXPECT_EQ(loop.tick(0).steps, 1);
  EXPECT_EQ(loop.tick(1).steps, 0);
  EXPECT_EQ(world.step_count(), 2u);
  // The time of the pause is not made up for.
  loop.set_paused(false);
  EXPECT_EQ(loop.remainder(), 0);
  EXPECT_EQ(loop.tick(1.0 / 60).steps, 1);
}

TEST(FixedStepLoop, CallsHooksAroundEveryStepInOrder) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 1.0 / 64});
  std::string calls;
  loop.before_step([&](PhysicsWorld& w, double dt) {
    EXPECT_EQ(&w, &world);
    EXPECT_EQ(dt, 1.0 / 64);
    calls += "a" + std::to_string(w.step_count());
  });
  loop.before_step([&](PhysicsWorld&, double) { calls += "b"; });
  loop.after_step([&](PhysicsWorld& w, double) { calls += "c" + std::to_string(w.step_count()); });
  loop.after_step([&](PhysicsWorld&, double) { calls += "d "; });
  loop.tick(2.0 / 64);
  EXPECT_EQ(calls, "a0bc1d a1bc2d ");
}

// A hook that pauses stops the loop after that step; the steps that were due are reported as
// dropped.
TEST(FixedStepLoop, HooksCanPause) {
  PhysicsWorld world;
  FixedStepLoop loop(world, {.dt = 1.0 / 64});
  loop.after_step([&](PhysicsWorld&, double) { loop.set_paused(true); });
  const TickReport report = loop.tick(5.0 / 64);
  EXPECT_EQ(report.steps, 1);
  EXPECT_EQ(report.dropped, 4.0 / 64);
}

}  // namespace
