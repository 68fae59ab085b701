// Proves rolling and torsional friction against closed forms: a torque of at most a lever arm times
// the normal force, opposed to the turning of one surface over the other.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

Material resisting(double rolling, double torsional, double friction = 0.8) {
  Material m = material(friction);
  m.rolling_friction = real(rolling);
  m.torsional_friction = real(torsional);
  return m;
}

// Rolling ball: m dv/dt = -F, I dw/dt = F r - e m g, v = w r, so that dv/dt = -(5/7) e g / r.
TEST(TurningFriction, ABallRollsToAStop) {
  const double r = 0.5, e = 0.02, v0 = 3, a = 5.0 / 7 * e * kGravity / r;
  for (const double heading : {0.0, 0.7, 2.1, 4.0}) {
    PhysicsWorld world(no_sleep());
    add_floor(world, material(0.8));  // the larger of two values counts
    const Vector3d along(std::cos(heading), 0, std::sin(heading));
    const Vector3d w = v0 / r * Vector3d::UnitY().cross(along);
    const BodyId ball =
        add(world, moving(at(0, r, 0), vec(v0 * along), vec(w)), with(sphere(r), resisting(e, 0)));
    run(world, 5, kDt, [&] {
      EXPECT_NEAR(velocity(world, ball).norm(), v0 - a * world.time(), bar(1e-5, 1e-4) * v0);
    });
    run(world, v0 / a - 5 + 1);
    EXPECT_LE(velocity(world, ball).norm(), bar(1e-6, 1e-5));
    const double way = v0 * v0 / (2 * a);
    EXPECT_NEAR(position(world, ball).dot(along), way, bar(1e-4, 1e-3) * way) << heading;
  }
}

// Without it a ball rolls on for ever.
TEST(TurningFriction, WithoutItABallRollsOn) {
  PhysicsWorld world(no_sleep());
  add_floor(world, material(0.8));
  const BodyId ball = add(world, moving(at(0, 0.5, 0), vec(3, 0, 0), vec(0, 0, -6)),
                          with(sphere(0.5), material(0.8)));
  run(world, 10);
  EXPECT_NEAR(velocity(world, ball).x(), 3, bar(1e-6, 1e-4) * 3);
}

// A ball stays on slopes up to tan = e / r, and rolls down steeper ones.
TEST(TurningFriction, HoldsABallOnASlope) {
  const double r = 0.5, e = 0.05;
  for (const double share : {0.9, 1.1}) {
    const double slope = std::atan(share * e / r);
    PhysicsWorld world(no_sleep());
    const Vector3d normal(std::sin(slope), std::cos(slope), 0);
    add_floor(world, material(0.8), normal);
    const BodyId ball =
        add(world, body_at(at(r * normal, Quat::Identity())), with(sphere(r), resisting(e, 0)));
    run(world, 1);  // while its load builds up it has moved a little
    const Vector3d place = position(world, ball);
    const double speed = velocity(world, ball).norm();
    run(world, 3);
    const double a = 5.0 / 7 * kGravity * (std::sin(slope) - e / r * std::cos(slope));
    if (share < 1) {
      EXPECT_LE((position(world, ball) - place).norm(), bar(1e-9, 1e-5));
    } else {
      EXPECT_NEAR(velocity(world, ball).norm() - speed, 3 * a, bar(1e-3, 1e-2) * 3 * a);
    }
  }
}

// Spinning on the spot: I dw/dt = -e m g, w = w0 - (5/2) e g t / r^2.
TEST(TurningFriction, ASpinningBallStops) {
  const double r = 0.5, e = 0.01, w0 = 5, alpha = 2.5 * e * kGravity / (r * r);
  PhysicsWorld world(no_sleep());
  add_floor(world, material(0.8));
  const BodyId ball = add(world, moving(at(0, r, 0), Vec3::Zero(), vec(0, w0, 0)),
                          with(sphere(r), resisting(0, e)));
  run(world, 4, kDt,
      [&] { EXPECT_NEAR(spin(world, ball).y(), w0 - alpha * world.time(), bar(1e-5, 1e-4) * w0); });
  run(world, 2);
  EXPECT_NEAR(spin(world, ball).y(), 0, bar(1e-9, 1e-5));
  EXPECT_LE(position(world, ball).head<1>().norm(), 1e-6);
}

// Torsion alone does not hinder rolling, nor rolling friction spinning.
TEST(TurningFriction, TheTwoAreIndependent) {
  PhysicsWorld world(no_sleep());
  add_floor(world, material(0.8));
  const BodyId roller = add(world, moving(at(0, 0.5, 0), vec(2, 0, 0), vec(0, 0, -4)),
                            with(sphere(0.5), resisting(0, 0.1)));
  const BodyId spinner = add(world, moving(at(0, 0.5, 5), Vec3::Zero(), vec(0, 4, 0)),
                             with(sphere(0.5), resisting(0.1, 0)));
  run(world, 3);
  EXPECT_NEAR(velocity(world, roller).x(), 2, bar(1e-6, 1e-4) * 2);
  EXPECT_NEAR(spin(world, spinner).y(), 4, bar(1e-6, 1e-4) * 4);
}

// The same torque on both: two free balls without other friction that are pressed together keep
// their angular momentum, lose energy, and come to turn as one.
TEST(TurningFriction, TwoFreeBodiesKeepTheirMomenta) {
  PhysicsWorld world(no_gravity());
  const BodyId a = add(world, moving(at(-0.5, 0, 0), Vec3::Zero(), vec(3, 1, 2)),
                       with(sphere(0.5), resisting(0.05, 0.05, 0)));
  const BodyId b = add(world, moving(at(0.5, 0, 0), Vec3::Zero(), vec(-1, 2, 0)),
                       with(sphere(0.5), resisting(0.05, 0.05, 0)));
  const EnergyReport before = world.energy();
  run(world, 1, kDt, [&] {
    if (world.time() < 0.5) {
      must(world.apply_force(a, vec(20000, 0, 0)));
      must(world.apply_force(b, vec(-20000, 0, 0)));
    }
  });
  const EnergyReport after = world.energy();
  const double scale = before.angular_momentum.norm();
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), bar(1e-9, 1e-4) * scale);
  EXPECT_LE((after.momentum - before.momentum).norm(), bar(1e-9, 1e-3) * scale);
  EXPECT_LT(after.total(), before.total());
  EXPECT_LE((spin(world, a) - spin(world, b)).norm(), bar(1e-6, 1e-4));
}

// The table of pairs can ask for it where no collider does.
TEST(TurningFriction, TheTableOfMaterialsAsksForItToo) {
  PhysicsWorld world(no_sleep());
  Material grass = material(0.8), leather = material(0.8);
  grass.kind = 1;
  leather.kind = 2;
  must(world.set_material_pair(1, 2, MaterialPair{.rolling_friction = real(0.05)}));
  EXPECT_FALSE(world.plan().active(PlanItem::RollingFriction));  // nothing is there to roll
  add_floor(world, grass);
  const BodyId ball =
      add(world, moving(at(0, 0.5, 0), vec(2, 0, 0), vec(0, 0, -4)), with(sphere(0.5), leather));
  EXPECT_TRUE(world.plan().active(PlanItem::RollingFriction));
  run(world, 1);
  EXPECT_NEAR(velocity(world, ball).x(), 2 - 5.0 / 7 * 0.05 * kGravity / 0.5, bar(1e-5, 1e-4));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
