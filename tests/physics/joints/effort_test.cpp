// Proves what acts along a joint's free coordinate against closed forms: springs, motors (speed,
// place, largest effort, power), friction, limits, gears, racks, pulleys, and the force at which a
// joint breaks.
#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;
constexpr double kDt = 1.0 / 60;

HingeJoint hinge(const JointAxis& axis) { return HingeJoint{axis}; }
// A wheel of moment of inertia 2 about z, its centre on a hinge on the world.
struct Wheel {
  PhysicsWorld world{no_gravity()};
  BodyId body;
  JointId joint;
  explicit Wheel(const JointAxis& axis) {
    body = add_body(world, Vector3d::Zero(), 1, {1.5, 1, 2});
    joint = must(
        world.create_joint(joint_at(world, {}, body, hinge(axis), {0, 0, 0}, Vector3d::UnitZ())));
  }
  [[nodiscard]] double speed() const { return spin(world, body).z(); }
  [[nodiscard]] double angle() const { return static_cast<double>(world.joint_state(joint).angle); }
};

// The implicit midpoint rule is slow by (w h)^2/12: 2e-4 at 2 Hz and 240 substeps a second.
constexpr double kFrequencyError = bar(1e-3, 2e-3);

TEST(JointSpring, SwingsAtItsNaturalFrequencyAndDecaysByItsDamping) {
  for (const double ratio : {0.0, 0.05}) {
    PhysicsWorld world(no_gravity());
    const BodyId body = add_body(world, {1.2, 0, 0}, 2, {1, 1, 1});
    const double w0 = 2 * kPi * 2, k = 2 * w0 * w0, c = 2 * ratio * 2 * w0;
    Joint joint;
    joint.body_b = body;
    joint.kind = SpringJoint{real(1), real(k), real(c)};
    must(world.create_joint(joint));
    double late = 0;
    const double w = w0 * std::sqrt(1 - ratio * ratio);
    const double period = period_of(world, kDt, 6, [&] { return position(world, body).x() - 1; });
    EXPECT_NEAR(period * w / (2 * kPi), 1, kFrequencyError) << ratio;
    // From there on over one more second: the amplitude has decayed by exp(-z w0 t).
    const double t0 = world.time();
    run(world, 0.5, kDt, [&] { late = std::max(late, position(world, body).x() - 1); });
    EXPECT_NEAR(late / (0.2 * std::exp(-ratio * w0 * t0)), 1, ratio > 0 ? 0.2 : 0.02) << ratio;
  }
}

TEST(JointSpring, TorsionSpringTurnsAWheelAboutItsHinge) {
  JointAxis axis;
  const double w = 2 * kPi * 1.5;
  axis.spring = JointSpring{real(0.4), real(2 * w * w), 0};
  Wheel wheel(axis);
  const double period = period_of(wheel.world, kDt, 6, [&] { return wheel.angle() - 0.4; });
  EXPECT_NEAR(period * w / (2 * kPi), 1, kFrequencyError);
}

TEST(JointSpring, SoftHoldHasTheFrequencyOfTheMassThatItCarries) {
  // A weld of 3 Hz holds a body whose centre is 0.5 m off: I + m l^2 about the joint's axis.
  PhysicsWorld world(no_gravity());
  const BodyId body = add_body(world, {0.5, 0, 0}, 2, {0.3, 0.3, 0.3});
  JointAxis axis;
  axis.motor = JointMotor{JointMotor::Mode::Position, real(0.1), kUnlimited, {real(3), real(0)}};
  const JointId joint = must(
      world.create_joint(joint_at(world, {}, body, hinge(axis), {0, 0, 0}, Vector3d::UnitZ())));
  const double period = period_of(
      world, kDt, 6, [&] { return static_cast<double>(world.joint_state(joint).angle) - 0.1; });
  EXPECT_NEAR(period * 3, 1, 2 * kFrequencyError);
}

TEST(JointMotorTest, ReachesItsSpeedAfterTheTimeThatItsTorqueNeeds) {
  JointAxis axis;
  axis.motor = JointMotor{JointMotor::Mode::Velocity, real(10), real(5)};
  Wheel wheel(axis);
  run(wheel.world, 2);  // 5 N m on 2 kg m^2: 2.5 rad/s^2
  EXPECT_NEAR(wheel.speed(), 5, bar(1e-9, 1e-4));
  const JointReaction reaction = wheel.world.joint_reaction(wheel.joint);
  EXPECT_NEAR(static_cast<double>(reaction.effort), 5, bar(1e-9, 1e-4));
  EXPECT_NEAR(static_cast<double>(reaction.torque.z()), 5, bar(1e-9, 1e-4));
  // Power: the kinetic energy is the torque times the angle turned.
  EXPECT_NEAR(wheel.world.energy().total(), 5 * wheel.angle(), bar(1e-8, 1e-2));
  run(wheel.world, 3);
  EXPECT_NEAR(wheel.speed(), 10, bar(1e-9, 1e-4));
  EXPECT_NEAR(static_cast<double>(wheel.world.joint_reaction(wheel.joint).effort), 0,
              bar(1e-8, 1e-2));
}

TEST(JointMotorTest, HoldsALoadAndReportsItsWeight) {
  // A servo carries 2 kg at 0.5 m, straight out: 9.81 N m, and sags by torque / stiffness.
  PhysicsWorld world;
  const BodyId body = add_body(world, {0.5, 0, 0}, 2, {0.3, 0.3, 0.3});
  JointAxis axis;
  axis.motor = JointMotor{JointMotor::Mode::Position, 0, real(50), {real(20), real(1)}};
  const JointId joint = must(
      world.create_joint(joint_at(world, {}, body, hinge(axis), {0, 0, 0}, Vector3d::UnitZ())));
  run(world, 3);
  const double stiffness = 0.8 * std::pow(2 * kPi * 20, 2);
  const double angle = static_cast<double>(world.joint_state(joint).angle);
  EXPECT_NEAR(angle, -kGravity / stiffness, bar(1e-6, 1e-5));
  const JointReaction reaction = world.joint_reaction(joint);
  EXPECT_NEAR(static_cast<double>(reaction.effort), kGravity, bar(1e-4, 1e-2));
  EXPECT_NEAR(static_cast<double>(reaction.force.y()), 2 * kGravity, bar(1e-4, 1e-2));
  // Too weak, it lets go.
  must(world.set_joint_motor(
      joint, JointMotor{JointMotor::Mode::Position, 0, real(5), {real(20), real(1)}}));
  run(world, 0.5);
  EXPECT_LT(static_cast<double>(world.joint_state(joint).angle), -0.5);
}

TEST(JointFriction, HoldsBelowItsTorqueAndBrakesByIt) {
  JointAxis axis;
  axis.friction = 3;
  Wheel wheel(axis);
  for (int i = 0; i < 60; ++i) {
    must(wheel.world.apply_torque(wheel.body, vec(0, 0, 2.9)));
    wheel.world.step(kDt);
  }
  EXPECT_NEAR(wheel.angle(), 0, bar(1e-9, 1e-5));
  must(wheel.world.set_angular_velocity(wheel.body, vec(0, 0, 6)));
  run(wheel.world, 2);                             // 3 N m on 2 kg m^2: 1.5 rad/s^2
  EXPECT_NEAR(wheel.speed(), 3, bar(1e-9, 2e-4));  // 120 steps of single precision
  run(wheel.world, 3);
  EXPECT_NEAR(wheel.speed(), 0, bar(1e-9, 1e-5));
}

TEST(JointLimitTest, AHitNeverGainsEnergy) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    JointAxis axis;
    axis.limit = JointLimit{real(-0.5), real(0.7)};
    axis.limit->restitution = real(restitution);
    // In single precision 1e-6 gains: at each bounce up to a tenth of m g l, and once most of it.
    Pendulum p(hinge(axis), 0.65, 1, 1, bar(1e-6, 1e-2));
    double energy = p.world.energy().total();
    run(p.world, 10, kDt, [&] {
      const double now = p.world.energy().total();
      // Between hits the energy breathes by (w h)^2, 3e-4 of it here.
      EXPECT_LE(now, energy + 2e-3 * kGravity) << restitution << " at " << p.world.time();
      EXPECT_GE(p.angle(), -0.5 - 1e-3);
      energy = std::min(energy, now);
    });
    const double left = p.world.energy().total() / kGravity;
    if (restitution == 1.0) {
      EXPECT_NEAR(left, -std::cos(0.65), 0.02);  // four bounces a second for ten seconds
    } else {
      EXPECT_NEAR(left, -std::cos(0.15), 1e-3) << restitution;  // at rest on the limit
    }
  }
}

TEST(JointLimitTest, SliderStopsAtItsEndAndRestsOnIt) {
  PhysicsWorld world;
  const BodyId body = add_body(world, {0, 0, 0}, 3, {1, 1, 1});
  SliderJoint slider;
  slider.axis.limit = JointLimit{real(-1), real(2)};
  const JointId joint =
      must(world.create_joint(joint_at(world, {}, body, slider, {0.4, 0, 0.3}, Vector3d::UnitY())));
  run(world, 3);
  const JointState state = world.joint_state(joint);
  EXPECT_NEAR(static_cast<double>(state.translation), -1, bar(1e-5, 1e-4));
  EXPECT_TRUE(state.at_lower);
  EXPECT_FALSE(state.at_upper);
  EXPECT_NEAR(static_cast<double>(world.joint_reaction(joint).effort), 3 * kGravity,
              bar(1e-4, 1e-2));
  EXPECT_LE(velocity(world, body).norm(), bar(1e-6, 1e-4));
}

TEST(Coupling, GearsKeepTheirRatioAndTheTorqueFollows) {
  PhysicsWorld world(no_gravity());
  const BodyId a = add_body(world, {0, 0, 0}, 1, {1, 1, 2}),
               b = add_body(world, {3, 0, 0}, 1, {1, 1, 0.5});
  JointAxis driven;
  driven.motor = JointMotor{JointMotor::Mode::Velocity, real(100), real(4)};
  const JointId first =
      must(world.create_joint(joint_at(world, {}, a, hinge(driven), {0, 0, 0}, Vector3d::UnitZ())));
  const JointId second =
      must(world.create_joint(joint_at(world, {}, b, hinge({}), {3, 0, 0}, Vector3d::UnitZ())));
  Joint gear;
  gear.kind = GearJoint{first, second, real(0.5)};  // b turns twice as fast, backwards
  const JointId id = must(world.create_joint(gear));
  run(world, 2);
  // Seen from a: 2 + 0.5 * 2^2 = 4 kg m^2 under 4 N m.
  EXPECT_NEAR(spin(world, a).z(), 2, bar(1e-6, 1e-3));
  EXPECT_NEAR(spin(world, b).z(), -4, bar(1e-6, 1e-3));
  EXPECT_NEAR(static_cast<double>(world.joint_state(id).linear_error), 0, bar(1e-6, 1e-4));
}

TEST(Coupling, RackAndPinionRollWithoutSlip) {
  PhysicsWorld world(no_gravity());
  const BodyId wheel = add_body(world, {0, 0, 0}, 1, {1, 1, 2}),
               bar_body = add_body(world, {0, -1, 0}, 3, {1, 1, 1});
  JointAxis driven;
  driven.motor = JointMotor{JointMotor::Mode::Velocity, real(5), real(10)};
  const JointId pinion = must(
      world.create_joint(joint_at(world, {}, wheel, hinge(driven), {0, 0, 0}, Vector3d::UnitZ())));
  const JointId rack = must(world.create_joint(
      joint_at(world, {}, bar_body, SliderJoint{}, {0, -1, 0}, Vector3d::UnitX())));
  Joint joint;
  joint.kind = RackPinionJoint{pinion, rack, real(0.5)};
  must(world.create_joint(joint));
  run(world, 3);
  EXPECT_NEAR(spin(world, wheel).z(), 5, bar(1e-6, 1e-3));
  EXPECT_NEAR(position(world, bar_body).x(),
              0.5 * static_cast<double>(world.joint_state(pinion).angle), bar(1e-6, 1e-3));
}

TEST(Coupling, PulleyAcceleratesAsAtwoodSays) {
  PhysicsWorld world;
  const BodyId a = add_body(world, {-1, 0, 0}, 3, {1, 1, 1}),
               b = add_body(world, {1, 0, 0}, 1, {1, 1, 1});
  Joint joint;
  joint.body_a = a;
  joint.body_b = b;
  PulleyJoint pulley;
  pulley.over_a = pos(-1, 5, 0);
  pulley.over_b = pos(1, 5, 0);
  pulley.ratio = 2;  // 3 kg against 1 kg at twice the force on b
  joint.kind = pulley;
  must(world.create_joint(joint));
  run(world, 1);
  // y_a + 2 y_b = const, tensions T and 2 T: a = g (m_a r^2 - m_b r)/(m_a r^2 + m_b).
  const double r = 2, acceleration = kGravity * (3 * r * r - 1 * r) / (3 * r * r + 1);
  EXPECT_NEAR(velocity(world, a).y(), -acceleration, bar(1e-6, 1e-3));
  EXPECT_NEAR(velocity(world, b).y(), acceleration / r, bar(1e-6, 1e-3));
}

TEST(Rope, FreeUntilTautThenHolds) {
  PhysicsWorld world;
  const BodyId body = add_body(world, {0, 0, 0}, 2, {1, 1, 1});
  Joint joint;
  joint.body_b = body;
  joint.kind = RopeJoint{2};
  const JointId id = must(world.create_joint(joint));
  run(world, 0.5);
  EXPECT_NEAR(velocity(world, body).y(), -kGravity * 0.5, bar(1e-9, 1e-5));
  run(world, 2);
  EXPECT_NEAR(position(world, body).y(), -2, bar(1e-5, 1e-4));
  EXPECT_NEAR(static_cast<double>(world.joint_reaction(id).force.y()), 2 * kGravity,
              bar(1e-4, 1e-2));
}

TEST(Breaking, AtTheStatedForceAndNotBelow) {
  for (const double factor : {0.999, 1.001}) {
    PhysicsWorld world;
    const BodyId body = add_body(world, {0, -1, 0}, 2, {1, 1, 1});
    Joint joint = joint_at(world, {}, body, FixedJoint{}, {0, 0, 0});
    joint.break_force = real(2 * kGravity * factor);
    joint.user_data = 7;
    const JointId id = must(world.create_joint(joint));
    std::size_t broken = 0;
    run(world, 2, kDt, [&] {
      for (const JointBreakEvent& event : world.events().broken_joints) {
        ++broken;
        EXPECT_EQ(event.joint, id);
        EXPECT_EQ(event.body_b, body);
        EXPECT_EQ(event.user_data, 7u);
        EXPECT_NEAR(static_cast<double>(event.force), 2 * kGravity, 0.05);
      }
    });
    EXPECT_EQ(broken, factor < 1 ? 1u : 0u) << factor;
    EXPECT_EQ(world.is_valid(id), factor > 1);
    EXPECT_EQ(velocity(world, body).y() < -1, factor < 1);
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
