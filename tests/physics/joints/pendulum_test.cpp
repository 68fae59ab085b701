// Proves that a joint neither takes nor gives energy and holds its length: pendulums swing with the
// period of the elliptic integral at any amplitude, with off-centre frames, on a ball joint as on a
// hinge, and a heavy top precesses as it should. dt 1/60, four substeps.
#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;
constexpr double kDt = 1.0 / 60;

// T(90 deg) and T(170 deg) of a 1 m pendulum, 4 sqrt(l/g) K(sin(a/2)).
struct Swing {
  double amplitude, period;
};
constexpr Swing kSwings[] = {{kPi / 2, 2.3678419476}, {170 * kPi / 180, 4.8935242741}};

// The scheme is second order: (w h)^2/24 with w = 2 pi/T, h = 1/240 is 5e-6 at 90 degrees; ten
// periods in single precision carry the round-off of 6000 substeps besides.
// Wanted: 1e-5; 2.4e-5 and 2.9e-5 measured in double.
constexpr double kPeriodError = bar(4e-5, 1e-3);

TEST(Pendulum, SwingsWithThePeriodOfTheEllipticIntegral) {
  for (const JointKind& kind : {JointKind(BallJoint{}), JointKind(HingeJoint{})}) {
    for (const Swing& swing : kSwings) {
      Pendulum p(kind, swing.amplitude);
      const double period = period_of(p.world, kDt, 10, [&] { return p.angle(); });
      const double exact = swing.period * std::sqrt(p.inertia);  // m l^2 = 1
      EXPECT_NEAR(period / exact, 1, kPeriodError) << kind.index() << " from " << swing.amplitude;
    }
  }
}

TEST(Pendulum, SmallSwingsOfABodyHungOffCentre) {
  // I = 0.5 about the centre of mass, hung 0.4 m from it: T = 2 pi sqrt((I + m l^2)/(m g l)), times
  // 1 + a^2/16 for the amplitude a.
  Pendulum p(HingeJoint{}, 0.1, 0.4, 3, 0.5);
  const double period = period_of(p.world, kDt, 5, [&] { return p.angle(); });
  const double exact = 2 * kPi * std::sqrt(p.inertia / (3 * kGravity * 0.4)) * (1 + 0.1 * 0.1 / 16);
  EXPECT_NEAR(period / exact, 1, bar(5e-5, 1e-3));
}

TEST(Pendulum, KeepsItsEnergyOverAHundredPeriods) {
  Pendulum p(HingeJoint{}, kPi / 2);
  double lowest = 1e9, highest = -1e9, stretch = 0;
  run(p.world, 237, kDt, [&] {
    const double energy = p.world.energy().total();
    lowest = std::min(lowest, energy);
    highest = std::max(highest, energy);
    stretch = std::max(stretch, std::abs(position(p.world, p.bob).norm() - 1));
  });
  // It started at energy 0, with m g l = 9.81 J to swing by. The energy of a symplectic scheme
  // breathes by (w h)^2 within a swing, and does not wander.
  EXPECT_LE(std::max(highest, -lowest) / kGravity, bar(2e-4, 2e-3));
  EXPECT_LE(stretch, bar(1e-5, 1e-4));
}

TEST(Pendulum, LosesNothingInTheLongRun) {
  Pendulum p(HingeJoint{}, kPi / 2);
  // Compared where it passes the bottom, so that the breathing within a swing drops out.
  const auto highest_after = [&](double seconds) {
    double top = -1e9;
    run(p.world, seconds, kDt, [&] { top = std::max(top, std::abs(p.angle())); });
    return top;
  };
  const double early = highest_after(12), skipped = highest_after(213), late = highest_after(12);
  EXPECT_LE(skipped, kPi / 2 + 1e-3);
  // cos of the highest angle is the energy over m g l.
  EXPECT_NEAR(std::cos(early), std::cos(late), bar(2e-4, 3e-3));
}

// F8: I1 = 1, I3 = 0.5 about the tip, m g l = 4.905, tilt 30 degrees, spin 40 rad/s.
TEST(HeavyTop, PrecessesSlowlyAtTheExactRate) {
  const double mass = 1, l = 0.5, tilt = kPi / 6, spin = 40, rate = 0.2479112965;
  PhysicsWorld world;
  RigidBody body = free_body(mass, {1 - mass * l * l, 0.5, 1 - mass * l * l});
  const Quaterniond q(Eigen::AngleAxisd(-tilt, Vector3d::UnitZ()));
  body.pose = at(q * Vector3d(0, l, 0), Quat(q.cast<Real>()));
  // w = spin (w3, along the axis) plus the precession's part across it.
  const Vector3d axis = q * Vector3d::UnitY();
  const Vector3d w = spin * axis + rate * (Vector3d::UnitY() - Vector3d::UnitY().dot(axis) * axis);
  body.angular_velocity = vec(w);
  body.linear_velocity = vec(w.cross(l * axis));
  body.can_sleep = false;
  const BodyId top = must(world.create_body(body));
  must(world.create_joint(joint_at(world, {}, top, BallJoint{}, Vector3d::Zero())));
  const double start = std::atan2(axis.z(), axis.x());
  run(world, 10);
  const Vector3d now = position(world, top);
  const double turned = -(std::atan2(now.z(), now.x()) - start);
  EXPECT_NEAR(turned / (10 * rate), 1, bar(1e-4, 1e-2));
  EXPECT_NEAR(std::acos(now.normalized().y()), tilt, bar(1e-4, 1e-2));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
