// Proves that what a motor carries on does not fall asleep, however slow it is, and that what no
// motor moves any more does: a stalled motor, one told to stand still, a servo that has arrived.
#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;
constexpr double kDt = 1.0 / 60;
constexpr double kLong = 30;  // [s]

// A box of 1 m that may sleep, in space, held to the world by one joint along z.
struct Driven {
  PhysicsWorld world;
  BodyId body;
  JointId joint;

  explicit Driven(const JointKind& kind, const Vector3d& gravity = {0, 0, 0})
      : world([&] {
          WorldSettings settings;
          settings.gravity = vec(gravity.x(), gravity.y(), gravity.z());
          return settings;
        }()) {
    body = add(world, body_at(at(0, 0, 0)), with(cube(0.5)));
    joint = must(world.create_joint(joint_at(world, {}, body, kind, {0, 0, 0}, Vector3d::UnitZ())));
  }
  [[nodiscard]] double value() const {  // [rad] or [m]
    const JointState now = world.joint_state(joint);
    return double{now.angle} + double{now.translation};
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kDt + 0.5); ++i) world.step(kDt);
  }
};

JointAxis motor_of(double target, double effort) {
  JointAxis axis;
  axis.motor = JointMotor{JointMotor::Mode::Velocity, real(target), real(effort)};
  return axis;
}

JointAxis servo_of(double target, double frequency, double effort) {
  JointAxis axis;
  axis.motor = JointMotor{
      JointMotor::Mode::Position, real(target), real(effort), {real(frequency), real(1)}};
  return axis;
}

TEST(DrivenSleep, MotorsOfAnySpeedGoOn) {
  for (const double speed : {0.0002, 0.003, 0.02, -0.02, 0.3}) {
    SCOPED_TRACE(speed);
    Driven hinge(HingeJoint{motor_of(speed, 1e4)});
    hinge.run(kLong);
    EXPECT_NEAR(hinge.value(), speed * kLong, 1e-3 * std::abs(speed) * kLong);
    EXPECT_TRUE(hinge.world.is_awake(hinge.body));
    Driven slider(SliderJoint{motor_of(speed, 1e4)}, {0, -9.81, 0});
    slider.run(kLong);
    EXPECT_NEAR(slider.value(), speed * kLong, 1e-3 * std::abs(speed) * kLong);
    EXPECT_TRUE(slider.world.is_awake(slider.body));
  }
}

// A weak motor gathers speed for a long time: alpha = torque / inertia.
TEST(DrivenSleep, WeakMotorsSpeedUpWithoutEnd) {
  Driven hinge(HingeJoint{motor_of(10, 2)});
  const double inertia = hinge.world.mass_properties(hinge.body).I_Bcm_B(2, 2);
  hinge.run(kLong);
  EXPECT_NEAR(hinge.value(), 0.5 * 2 / inertia * kLong * kLong, 0.01 * hinge.value());
}

TEST(DrivenSleep, WhatAMotorCarriesOnATableGoesOnAsWell) {
  // A table that turns by 0.6 degrees a second, with a box on it.
  Driven table(HingeJoint{motor_of(0.01, 1e6)}, {0, 0, -9.81});
  RigidBody box = body_at(at(0.2, 0.1, 0.6));
  const BodyId on = add(table.world, box, with(cube(0.1), material(0.6)));
  table.run(kLong);
  EXPECT_TRUE(table.world.is_awake(on));
  const Vector3d x = position(table.world, on);
  EXPECT_NEAR(std::atan2(x.y(), x.x()) - std::atan2(0.1, 0.2), 0.01 * kLong, 0.01);
}

TEST(DrivenSleep, ServosArriveAndThenRest) {
  Driven hinge(HingeJoint{servo_of(0.8, 0.05, 1e5)});
  hinge.run(60);
  EXPECT_NEAR(hinge.value(), 0.8, 2e-3);
  EXPECT_FALSE(hinge.world.is_awake(hinge.body));
}

TEST(DrivenSleep, WhatStandsStillRests) {
  // Told to.
  Driven brake(HingeJoint{motor_of(0, 1e4)});
  brake.run(3);
  EXPECT_FALSE(brake.world.is_awake(brake.body));
  // At its limit.
  JointAxis stopped = motor_of(0.02, 50);
  stopped.limit = JointLimit{real(-0.1), real(0.1)};
  Driven stop(HingeJoint{stopped});
  stop.run(kLong);
  EXPECT_NEAR(stop.value(), 0.1, 1e-3);
  EXPECT_FALSE(stop.world.is_awake(stop.body));
  // Too weak to lift what it holds: it lies on the floor.
  Driven weak(SliderJoint{motor_of(0.5, 20)}, {0, 0, -9.81});
  add_floor(weak.world, material(0.5), Vector3d::UnitZ(), -0.5);
  weak.run(5);
  EXPECT_FALSE(weak.world.is_awake(weak.body));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
