// Proves, against Box2D 2.4.1, that motors, limits, rods, ropes, springs and pulleys do what their
// closed forms say: the speed that a torque gives, the force that lifts, the moment at which a rope
// is taut, the sag of a suspension. Bars are a few times what was measured, which stands beside
// them where it is more than round-off.
#include <gtest/gtest.h>

#include "box2d/planar_joints.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace box2d_comparison;

// w = T t / I until the target is reached, then the target.
TEST(Box2dHingeMotor, TurnsAWheelUpByItsTorque) {
  JointedPair pair;
  const double radius = 0.5, target = 6, torque = 200;
  const Body wheel = pair.add_disc(radius, {.y = 2});
  const double moment = 1000 * kPi * std::pow(radius, 4) / 2;
  hinge(pair, pair.ground(), wheel, {0, 2}, std::pair(target, torque));
  const double time = moment * target / torque;  // [s] 2.95
  pair.run_both(1);
  EXPECT_NEAR(pair.ours(wheel).spin, torque / moment, 1e-3);
  EXPECT_NEAR(PlanarPair::theirs(wheel).spin, torque / moment, 1e-3);
  pair.run_both(time);
  EXPECT_NEAR(pair.ours(wheel).spin, target, 1e-3);
  EXPECT_NEAR(PlanarPair::theirs(wheel).spin, target, 1e-3);
}

// A level arm held by a motor at rest: it stays while the torque exceeds m g d, and sinks with
// (m g d - T) / I else.
TEST(Box2dHingeMotor, HoldsALoadThatItCanCarry) {
  const double half = 0.5, width = 0.05, mass = 1000 * 4 * half * width;
  const double load = mass * kGravity * half;
  const double moment = mass * ((half * half + width * width) / 3 + half * half);
  for (const double share : {1.2, 0.8}) {
    JointedPair pair;
    const Body arm = pair.add_box(half, width, {.x = half});
    hinge(pair, pair.ground(), arm, {0, 0}, std::pair(0.0, share * load));
    const double t = 0.25;
    pair.run_both(t);
    // The arm sinks by 0.09 rad, which shortens its lever: 0.4 % of 0.734 rad/s in both engines.
    const double exact = share > 1 ? 0 : -(1 - share) * load / moment * t;
    EXPECT_NEAR(pair.ours(arm).spin, exact, 1e-2 * std::abs(exact) + 1e-6) << share;
    EXPECT_NEAR(PlanarPair::theirs(arm).spin, exact, 1e-2 * std::abs(exact) + 1e-6) << share;
  }
}

struct PairedSlider {
  b2PrismaticJoint* theirs;
  JointId ours;
};
PairedSlider slider(PlanarPair& pair, const Body& b, const Vector2d& p, const Vector2d& axis,
                    double lower, double upper, double speed, double force) {
  b2PrismaticJointDef def;
  def.Initialize(pair.ground().theirs, b.theirs, b2(p), b2(axis));
  def.enableLimit = true;
  def.lowerTranslation = f(lower);
  def.upperTranslation = f(upper);
  def.enableMotor = force > 0;
  def.motorSpeed = f(speed);
  def.maxMotorForce = f(force);
  SliderJoint kind;
  kind.axis.limit = JointLimit{real(lower), real(upper)};
  if (force > 0) kind.axis.motor = JointMotor{.target = real(speed), .max_effort = real(force)};
  return {static_cast<b2PrismaticJoint*>(pair.their_world().CreateJoint(&def)),
          join(pair, pair.ground(), b, kind, p, p, in_plane(axis))};
}

// Lifted by F - m g until it runs at the motor's speed, then to the end of the slide, where it
// stays.
TEST(Box2dSlider, LiftsByItsMotorUpToItsLimit) {
  JointedPair pair;
  const Body box = pair.add_box(0.5, 0.5, {.y = 1});
  const double mass = 1000, speed = 1.5, upper = 2;
  const double force = 1.5 * mass * kGravity;
  slider(pair, box, {0, 1}, {0, 1}, 0, upper, speed, force);
  const double a = 0.5 * kGravity, t_speed = speed / a, t = 0.8;
  pair.run_both(t);
  const double exact = 1 + speed * t_speed / 2 + speed * (t - t_speed);
  EXPECT_NEAR(pair.ours(box).y, exact, 1e-4);  // measured 6e-6
  EXPECT_NEAR(pair.ours(box).vy, speed, 1e-5);
  EXPECT_NEAR(PlanarPair::theirs(box).y, exact, 2e-2);  // measured 1.2e-2: a h t / 2
  EXPECT_NEAR(PlanarPair::theirs(box).vy, speed, 1e-5);
  pair.run_both(3);
  EXPECT_NEAR(pair.ours(box).y, 1 + upper, 1e-5);
  EXPECT_NEAR(pair.ours(box).vy, 0, 1e-5);
  EXPECT_NEAR(PlanarPair::theirs(box).y, 1 + upper, 1e-5);
  EXPECT_NEAR(pair.ours(box).x, 0, 1e-5);
}

// Down a slide of 30 degrees without friction: g sin 30 t, and a stop at the end.
TEST(Box2dSlider, RunsDownASlopeToItsEnd) {
  JointedPair pair;
  const Vector2d down(std::cos(kPi / 6), -std::sin(kPi / 6));
  const Body box = pair.add_box(0.25, 0.25, {});
  slider(pair, box, {0, 0}, down, 0, 3, 0, 0);
  const double t = 1;
  pair.run_both(t);
  const double way = kGravity / 2 * t * t / 2;
  const Planar a = PlanarPair::theirs(box), b = pair.ours(box);
  EXPECT_NEAR(Vector2d(b.x, b.y).dot(down), way, 1e-5);
  // Box2D's semi-implicit step falls g h t / 2 too far.
  EXPECT_NEAR(Vector2d(a.x, a.y).dot(down), way + kGravity / 2 * kDt * t / 2, 1e-4);
  pair.run_both(2);
  const Planar c = PlanarPair::theirs(box), d = pair.ours(box);
  EXPECT_NEAR(Vector2d(d.x, d.y).dot(down), 3, 1e-5);
  EXPECT_NEAR(Vector2d(c.x, c.y).dot(down), 3, 1e-5);
}

b2DistanceJoint* their_distance(PlanarPair& pair, const Body& b, const Vector2d& from,
                                const Vector2d& to, double lower, double upper, double stiffness) {
  b2DistanceJointDef def;
  def.Initialize(pair.ground().theirs, b.theirs, b2(from), b2(to));
  def.minLength = f(lower);
  def.maxLength = f(upper);
  def.stiffness = f(stiffness);
  return static_cast<b2DistanceJoint*>(pair.their_world().CreateJoint(&def));
}

// A disc on a rod that ends at its middle does not turn: a mathematical pendulum.
TEST(Box2dRod, IsAMathematicalPendulum) {
  JointedPair pair;
  const double length = 2, amplitude = kPi / 4;
  const Vector2d start = length * Vector2d(std::sin(amplitude), -std::cos(amplitude));
  const Body bob = pair.add_disc(0.2, {.x = start.x(), .y = start.y()});
  their_distance(pair, bob, {0, 0}, start, length, length, 0);
  join(pair, pair.ground(), bob, DistanceJoint{real(length)}, {0, 0}, start,
       Eigen::Quaterniond::Identity());
  const double exact = swing_period(std::sqrt(kGravity / length), amplitude);
  const Periods seen =
      periods_of(pair, 5, [&] { return std::pair(PlanarPair::theirs(bob).x, pair.ours(bob).x); });
  EXPECT_NEAR(seen.ours / exact, 1, 5e-5);    // measured 6e-6
  EXPECT_NEAR(seen.theirs / exact, 1, 2e-2);  // measured -5.8e-3
}

// Falls freely until the rope is taut, keeps only what is across the rope, and swings down:
// v_bottom^2 = (v x / l)^2 + 2 g (l - depth).
TEST(Box2dRope, TakesWhatPullsAtItAndNothingElse) {
  JointedPair pair;
  const double length = 2, x = 1.2, depth = std::sqrt(length * length - x * x);
  const Body bob = pair.add_disc(0.2, {.x = x});
  their_distance(pair, bob, {0, 0}, {x, 0}, 0, length, 0);
  join(pair, pair.ground(), bob, RopeJoint{real(length)}, {0, 0}, {x, 0},
       Eigen::Quaterniond::Identity());
  const double fall = std::sqrt(2 * kGravity * depth);
  const double across = fall * x / length;
  const double bottom = std::sqrt(across * across + 2 * kGravity * (length - depth));
  double fastest_theirs = 0, fastest_ours = 0, longest_ours = 0;
  for (int i = 0; i < 120; ++i) {
    const Planar before_a = PlanarPair::theirs(bob), before_b = pair.ours(bob);
    pair.step();
    const Planar a = PlanarPair::theirs(bob), b = pair.ours(bob);
    if (before_a.x > 0 && a.x <= 0 && fastest_theirs == 0) fastest_theirs = std::hypot(a.vx, a.vy);
    if (before_b.x > 0 && b.x <= 0 && fastest_ours == 0) fastest_ours = std::hypot(b.vx, b.vy);
    longest_ours = std::max(longest_ours, std::hypot(b.x, b.y));
  }
  EXPECT_NEAR(fastest_ours, bottom, 1e-3 * bottom);    // measured 2e-4
  EXPECT_NEAR(fastest_theirs, bottom, 3e-2 * bottom);  // measured -1e-2
  EXPECT_LT(longest_ours, length + 1e-3);
}

// An undamped spring: T = 2 pi sqrt(m / k), and the amplitude that it was given. Box2D's springs
// are implicit Euler, which damps.
TEST(Box2dSpring, SwingsUndamped) {
  JointedPair pair(0);
  const double mass = 1000 * kPi * 0.04, stiffness = 5000, rest = 2, pulled = 0.3;
  const Body bob = pair.add_disc(0.2, {.y = -rest - pulled});
  b2DistanceJoint* spring =
      their_distance(pair, bob, {0, 0}, {0, -rest - pulled}, 0.1, 100, stiffness);
  spring->SetLength(f(rest));
  join(pair, pair.ground(), bob, SpringJoint{real(rest), real(stiffness)}, {0, 0},
       {0, -rest - pulled}, Eigen::Quaterniond::Identity());
  const double exact = 2 * kPi * std::sqrt(mass / stiffness);
  double largest_theirs = 0, largest_ours = 0;
  const Periods seen = periods_of(pair, 10, [&] {
    const double a = PlanarPair::theirs(bob).y + rest, b = pair.ours(bob).y + rest;
    return std::pair(a, b);
  });
  // Of the swings that follow.
  for (int i = 0; i < 120; ++i) {
    pair.step();
    largest_theirs = std::max(largest_theirs, std::abs(PlanarPair::theirs(bob).y + rest));
    largest_ours = std::max(largest_ours, std::abs(pair.ours(bob).y + rest));
  }
  EXPECT_NEAR(seen.ours / exact, 1, 3e-4);           // measured 6e-5, (w h)^2 / 12
  EXPECT_NEAR(largest_ours, pulled, 2e-3 * pulled);  // measured 3e-4
  EXPECT_NEAR(seen.theirs / exact, 1, 2e-2);         // measured 4e-3
  EXPECT_LT(largest_theirs, 0.1 * pulled);           // measured 0.03: the rest is damped away
}

// A wheel held by a spring along the upright axis, free to turn, under a weight: it sags m g / k.
TEST(Box2dWheel, SagsByItsWeightOnItsSpringAndTurns) {
  JointedPair pair;
  const double mass = 1000 * kPi * 0.09, stiffness = 20000, damping = 2000, spin = 4;
  const Body wheel = pair.add_disc(0.3, {.spin = spin});
  b2WheelJointDef def;
  def.Initialize(pair.ground().theirs, wheel.theirs, b2(Vector2d(0, 0)), b2(Vector2d(0, 1)));
  def.stiffness = f(stiffness);
  def.damping = f(damping);
  pair.their_world().CreateJoint(&def);
  SixDofJoint kind;
  using Freedom = SixDofJoint::Freedom;
  // The frame's x axis is the wheel's own, its y axis points up.
  const Eigen::Quaterniond R_WJ(
      Eigen::AngleAxisd(-kPi / 2, Eigen::Vector3d::UnitY()));  // x to z, y stays
  kind.coordinates[1] = {Freedom::Free, {.spring = JointSpring{0, real(stiffness), real(damping)}}};
  kind.coordinates[3] = {Freedom::Free, {}};
  join(pair, pair.ground(), wheel, kind, {0, 0}, {0, 0}, R_WJ);
  pair.run_both(4);
  const double sag = mass * kGravity / stiffness;
  EXPECT_NEAR(pair.ours(wheel).y, -sag, 1e-5);
  EXPECT_NEAR(PlanarPair::theirs(wheel).y, -sag, 1e-5);
  EXPECT_NEAR(pair.ours(wheel).x, 0, 1e-5);
  EXPECT_NEAR(pair.ours(wheel).spin, spin, 1e-4);
  EXPECT_NEAR(PlanarPair::theirs(wheel).spin, spin, 1e-4);
}

// Atwood's machine: a = g (m - M) / (m + M).
TEST(Box2dPulley, AcceleratesAsAtwoodSays) {
  JointedPair pair;
  const Body light = pair.add_box(0.25, 0.25, {.x = -1}, {}, 1000);
  const Body heavy = pair.add_box(0.25, 0.25, {.x = 1}, {}, 2000);
  const Vector2d over_a(-1, 3), over_b(1, 3), at_a(-1, 0), at_b(1, 0);
  b2PulleyJointDef def;
  def.Initialize(light.theirs, heavy.theirs, b2(over_a), b2(over_b), b2(at_a), b2(at_b), 1);
  pair.their_world().CreateJoint(&def);
  PulleyJoint kind;
  kind.over_a = pos(-1, 3, 0);
  kind.over_b = pos(1, 3, 0);
  join(pair, light, heavy, kind, at_a, at_b, Eigen::Quaterniond::Identity());
  const double t = 1, way = kGravity / 3 * t * t / 2;
  pair.run_both(t);
  EXPECT_NEAR(pair.ours(light).y, way, 1e-4);
  EXPECT_NEAR(pair.ours(heavy).y, -way, 1e-4);
  EXPECT_NEAR(pair.ours(heavy).vy, -kGravity / 3 * t, 1e-4);
  EXPECT_NEAR(PlanarPair::theirs(heavy).y, -way - kGravity / 3 * kDt * t / 2, 1e-4);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
