// Proves F5, F8 and F9 of the reference cases: an orbit by the user's own force, a heavy top on a
// ball joint in all its motions, and the period and energy of a pendulum, against closed forms.
#include "physics/joints/joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;
constexpr double kDt = 1.0 / 60;

// F5: e = 0.5, a = mu = 1, 100 orbits of 200 steps. The force changes along the orbit, so the user
// gives it as half an impulse before and half after each step (Stormer-Verlet); the drift between
// is exact. Symplectic: the energy breathes by (w h)^2 within an orbit and drifts no further.
TEST(Kepler, F5_EnergyStaysWithinBoundsForAHundredOrbits) {
  PhysicsWorld world(no_gravity());
  RigidBody planet = free_body(1, {1, 1, 1});
  planet.pose = at(0.5, 0, 0);
  planet.linear_velocity = vec(0, std::sqrt(3.0), 0);
  const BodyId body = must(world.create_body(planet));
  const double h = 2 * kPi / 200;
  const auto half_kick = [&] {
    const Vector3d r = position(world, body);
    must(world.apply_impulse(body, vec(-0.5 * h / std::pow(r.norm(), 3) * r)));
  };
  double first = 0, last = 0;  // in the first and in the last ten orbits
  for (int i = 0; i < 100 * 200; ++i) {
    half_kick();
    world.step(h);
    half_kick();
    const double energy =
        velocity(world, body).squaredNorm() / 2 - 1 / position(world, body).norm();
    const double error = std::abs(energy / -0.5 - 1);
    if (i < 10 * 200) first = std::max(first, error);
    if (i >= 90 * 200) last = std::max(last, error);
  }
  EXPECT_LE(first, 3e-3);                     // 2.69e-3 measured
  EXPECT_NEAR(last, first, bar(1e-9, 2e-4));  // no secular drift
}

struct HeavyTop {
  PhysicsWorld world;
  BodyId body;
  // I1 = 1, I3 = 0.5 about the tip, m g l = 4.905.
  HeavyTop(double tilt, double spin, double precession, int substeps = 4, int joint_order = 2) {
    WorldSettings settings;
    settings.substeps = substeps;
    settings.joint_order = joint_order;
    must(world.set_settings(settings));
    constexpr double l = 0.5;
    RigidBody top = free_body(1, {1 - l * l, 0.5, 1 - l * l});
    const Quaterniond q(Eigen::AngleAxisd(-tilt, Vector3d::UnitZ()));
    const Vector3d axis = q * Vector3d::UnitY();
    const Vector3d w = spin * axis + precession * (Vector3d::UnitY() - axis.y() * axis);
    top.pose = at(l * axis, Quat(q.cast<Real>()));
    top.angular_velocity = vec(w);
    top.linear_velocity = vec(w.cross(l * axis));
    top.can_sleep = false;
    body = must(world.create_body(top));
    must(world.create_joint(joint_at(world, {}, body, BallJoint{}, Vector3d::Zero())));
  }
  [[nodiscard]] double tilt() const {
    const Vector3d x = position(world, body);
    return std::atan2(std::hypot(x.x(), x.z()), x.y());
  }
};

// Relative error of the rate of precession over ten seconds.
double precession_error(double rate, int substeps, int joint_order = 2) {
  HeavyTop top(kPi / 6, 40, rate, substeps, joint_order);
  double turned = 0, last = 0;
  run(top.world, 10, kDt, [&] {
    const Vector3d x = position(top.world, top.body);
    const double now = -std::atan2(x.z(), x.x());
    turned += std::remainder(now - last, 2 * kPi);
    last = now;
  });
  return turned / (10 * rate) - 1;
}

// X 1e-4; in double 5.1e-6.
TEST(HeavyTop, F8_SlowPrecession) {
  EXPECT_LE(std::abs(precession_error(0.2479112965, 4)), bar(1e-5, 1e-3));
}
// X 1e-4 is met from 8 substeps on, and with joints of fourth order; with 4 substeps of second
// order the error is 3.3e-4 (22.8 rad/s turn by 0.1 rad in one).
TEST(HeavyTop, F8_FastPrecession) {
  EXPECT_LE(std::abs(precession_error(22.8460994711, 4, 4)), bar(2e-5, 1e-3));
  EXPECT_LE(std::abs(precession_error(22.8460994711, 4)), bar(4e-4, 1e-3));
  EXPECT_LE(std::abs(precession_error(22.8460994711, 16)), bar(2.5e-5, 1e-3));
}

TEST(HeavyTop, F8_NutatesBetweenItsTwoTilts) {
  HeavyTop top(kPi / 6, 40, 0);
  double lowest = 90, highest = 0;  // [deg]
  run(top.world, 5, 1.0 / 240, [&] {
    lowest = std::min(lowest, top.tilt() * 180 / kPi);
    highest = std::max(highest, top.tilt() * 180 / kPi);
  });
  // Sampled 65 times a nutation: 1e-3 of the swing of 0.73 degrees short at the worst.
  EXPECT_NEAR(highest, 30.7256976, bar(1e-3, 2e-2));
  EXPECT_NEAR(lowest, 30, bar(1e-3, 2e-2));
}

// The sleeping top stands above w3 = 8.85889 rad/s. X 1 %; held to 0.15 %.
TEST(HeavyTop, F8_SleepingTopStandsAboveItsThreshold) {
  const auto farthest = [](double spin) {
    HeavyTop top(1e-4, spin, spin / 4);  // the double root of its precession: 0.5 I3 w3/I1
    double tilt = 0;
    run(top.world, 60, kDt, [&] { tilt = std::max(tilt, top.tilt()); });
    return tilt;
  };
  for (const double spin : {8.87, 8.95}) EXPECT_LE(farthest(spin), bar(1.1e-4, 2e-3)) << spin;
  for (const double spin : {8.77, 8.845}) EXPECT_GE(farthest(spin), 1e-2) << spin;
}

// F9: X 1e-5 for the period and 1e-6 for the energy over 100 periods, at 1/60. The scheme is second
// order in the substep: with four 2.4e-5 and 6.5e-5 of m g l, with 16 1.7e-6 and 1.8e-5. So X holds
// for the period from 8 substeps on; for the energy it does not: what is left breathes within a
// swing and does not grow (Pendulum.LosesNothingInTheLongRun). Joints of fourth order meet both
// with one substep: 1.1e-7 and 1.8e-7; with four 3.8e-8 (what reading the period off the steps
// leaves) and 7e-10.
TEST(PendulumAccuracy, F9_PeriodAndEnergy) {
  struct Setting {
    int joint_order, substeps;
    double period, energy;  // bars, relative and in m g l
  };
  for (const Setting& set : {Setting{2, 4, bar(3e-5, 1e-3), bar(7e-5, 2e-3)},
                             Setting{2, 16, bar(1e-5, 1e-3), bar(2e-5, 2e-3)},
                             Setting{4, 1, bar(2e-7, 1e-3), bar(3e-7, 2e-3)},
                             Setting{4, 4, bar(6e-8, 1e-3), bar(2e-9, 2e-3)}}) {
    WorldSettings settings;
    settings.substeps = set.substeps;
    settings.joint_order = set.joint_order;
    Pendulum timed(HingeJoint{}, kPi / 2, 1, 1, kBobMoment, settings);
    const double period = period_of(timed.world, kDt, 10, [&] { return timed.angle(); });
    const double exact = 2.3678419476 * std::sqrt(timed.inertia);
    EXPECT_NEAR(period / exact, 1, set.period) << set.joint_order << ' ' << set.substeps;
    Pendulum swung(HingeJoint{}, kPi / 2, 1, 1, kBobMoment, settings);
    const double start = swung.world.energy().total();
    double worst = 0;
    run(swung.world, 236.8, kDt, [&] {
      worst = std::max(worst, std::abs(swung.world.energy().total() - start) / kGravity);
    });
    EXPECT_LE(worst, set.energy) << set.joint_order << ' ' << set.substeps;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
