// Proves that bodies that touch nothing move as the closed forms say, at any step length: free fall
// is exact, linear drag is exact, forces and impulses at points agree, locked axes do not move.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kSubsteps = 4;

// Reference case F1. Semi-implicit Euler is off by g h t/2: 0.82 m after 10 s at 1/60.
TEST(FreeMotion, F1_ProjectileIsExactAtAnyStep) {
  const Vector3d x0(1, 2, 3), v0(30, 40, -5), g(0, -kGravity, 0);
  for (double dt : {1.0, 1.0 / 7, 1.0 / 15, 1.0 / 60, 1.0 / 1000}) {
    PhysicsWorld world;
    RigidBody spec = free_body(1, {1, 1, 1});
    spec.pose.position = pos(x0);
    spec.linear_velocity = vec(v0);
    const BodyId body = must(world.create_body(spec));
    const double t = 10;
    run(world, t, dt);
    const Vector3d x = x0 + v0 * t + g * t * t / 2, v = v0 + g * t;
    // Largest values on the way: 300 m, 58 m/s. Each substep rounds v and x once; an error in v
    // acts on x for up to t.
    const double steps = t / dt * kSubsteps;
    const double v_error = sum_error(steps, 60),
                 x_error = v_error * t + sum_error(steps, 300, kPosEps);
    EXPECT_LE((velocity(world, body) - v).norm(), std::min(v_error, bar(1e-12 * 60, 1))) << dt;
    EXPECT_LE((position(world, body) - x).norm(), std::min(x_error, bar(1e-12 * 300, 10))) << dt;
  }
}

// Reference case F2: linear drag with gravity, tau = m/c = 2 s.
TEST(FreeMotion, F2_LinearDragIsExactAtAnyStep) {
  const double tau = 2, t = 4;
  for (double dt : {1.0, 1.0 / 15, 1.0 / 60, 1.0 / 240}) {
    PhysicsWorld world;
    RigidBody spec = free_body(1, {1, 1, 1});
    spec.linear_velocity = vec(30, 40, 0);
    spec.linear_damping = real(1 / tau);
    const BodyId body = must(world.create_body(spec));
    run(world, t, dt);
    const Vector3d x(51.87988300580, 24.62262082687, 0);
    const double v_error = sum_error(t / dt * kSubsteps, 50);
    EXPECT_LE((position(world, body) - x).norm(),
              bar(1e-6, v_error * t + sum_error(t / dt * kSubsteps, 65, kPosEps)))
        << "dt " << dt;
    // y'(t) = (40 + g tau) exp(-t/tau) - g tau
    const double vy = (40 + kGravity * tau) * std::exp(-t / tau) - kGravity * tau;
    EXPECT_NEAR(velocity(world, body).y(), vy, bar(1e-9, v_error)) << "dt " << dt;
  }
}

TEST(FreeMotion, LinearDragIsStableForAnyRate) {
  for (double c_dt : {0.1, 1.0, 10.0, 1e3, 1e6}) {
    const double dt = 1.0 / 60, c = c_dt / dt;
    PhysicsWorld world;
    RigidBody spec = free_body(1, {1, 1, 1});
    spec.linear_velocity = vec(1000, 0, 0);
    spec.linear_damping = real(c);
    spec.angular_damping = real(c);
    spec.angular_velocity = vec(10, 0, 0);
    const BodyId body = must(world.create_body(spec));
    double last = 1000;
    run(world, 10, dt, [&] {
      const double v = velocity(world, body).x();
      ASSERT_GE(v, 0);  // never past rest
      ASSERT_LE(v, last);
      last = v;
    });
    EXPECT_NEAR(velocity(world, body).y(), -kGravity / c,
                1e-6 * kGravity / c + 2 * kEps * kGravity / c / std::min(1.0, c_dt / kSubsteps))
        << "c dt " << c_dt;
    EXPECT_TRUE(all_finite(world));
  }
}

TEST(FreeMotion, DampingDoesNotDependOnTheStep) {
  double previous = 0;
  for (double dt : {1.0 / 8, 1.0 / 64, 1.0 / 512}) {  // exact in binary: only the rule is compared
    PhysicsWorld world(no_gravity());
    RigidBody spec = free_body(1, {0.4, 0.4, 0.4});
    spec.linear_velocity = vec(2, 0, 0);
    spec.linear_damping = real(0.3);
    const BodyId body = must(world.create_body(spec));
    run(world, 3, dt);
    const double x = position(world, body).x();
    EXPECT_NEAR(x, 2 / 0.3 * (1 - std::exp(-0.9)), bar(1e-11, 1e-3)) << "dt " << dt;
    if (previous != 0) {
      EXPECT_NEAR(x, previous, bar(1e-11, 1e-3));
    }
    previous = x;
  }
}

TEST(FreeMotion, AngularDampingActsOnAngularMomentum) {
  PhysicsWorld world(no_gravity());
  RigidBody spec = free_body(1, {1, 2, 3});
  spec.angular_velocity = vec(1, 2, 0.5);
  spec.angular_damping = real(0.8);
  const BodyId body = must(world.create_body(spec));
  const Vector3d L0 = wide(world.angular_momentum(body));
  run(world, 2);
  // Its direction stays, its size decays: L' = -c L.
  EXPECT_LE((wide(world.angular_momentum(body)) - L0 * std::exp(-1.6)).norm(),
            sum_error(120 * kSubsteps, L0.norm()));
}

TEST(FreeMotion, GravityScale) {
  PhysicsWorld world;
  const double scales[] = {0, 0.5, -1, 3};
  std::vector<BodyId> bodies;
  for (double scale : scales) {
    RigidBody spec = free_body(1, {1, 1, 1});
    spec.gravity_scale = real(scale);
    bodies.push_back(must(world.create_body(spec)));
  }
  run(world, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(position(world, bodies[i]).y(), -scales[i] * kGravity / 2,
                sum_error(60 * kSubsteps, std::abs(scales[i]) * kGravity) + 1e-300)
        << "scale " << scales[i];
  }
}

TEST(FreeMotion, ForceThroughoutAStepIsAnExactParabola) {
  PhysicsWorld world(no_gravity());
  const BodyId body = must(world.create_body(free_body(4, {1, 1, 1})));
  const double h = 0.25;
  must(world.apply_force(body, vec(8, 0, 0)));
  world.step(h);
  EXPECT_NEAR(position(world, body).x(), 0.5 * 2 * h * h, 16 * kEps);
  EXPECT_NEAR(velocity(world, body).x(), 2 * h, 16 * kEps);
  EXPECT_NEAR(static_cast<double>(world.last_acceleration(body).x()), 2, 16 * kEps);
}

TEST(FreeMotion, ForcesAndImpulsesAtPointsAgree) {
  const double h = 1.0 / 60;
  const Vector3d J(1, -2, 0.5), p_B(0.3, -0.2, 0.6), x0(1, 2, 3);
  const Quat q = turn(1.1, {1, -2, 0.5});
  const Vector3d r = q.cast<double>() * p_B;
  enum Way { ImpulseAt, ImpulseAtBody, CentreAndTurn, ForceAt, ForceAtBody, ForceAndTorque };
  for (Way way : {ImpulseAt, ImpulseAtBody, CentreAndTurn, ForceAt, ForceAtBody, ForceAndTorque}) {
    PhysicsWorld world(no_gravity());
    RigidBody spec = free_body(2, {1, 2, 3});
    spec.pose = at(x0, q);
    const BodyId body = must(world.create_body(spec));
    switch (way) {
      case ImpulseAt:
        must(world.apply_impulse_at(body, vec(J), pos(x0 + r)));
        break;
      case ImpulseAtBody:
        must(world.apply_impulse_at_body_point(body, vec(J), vec(p_B)));
        break;
      case CentreAndTurn:
        must(world.apply_impulse(body, vec(J)));
        must(world.apply_angular_impulse(body, vec(r.cross(J))));
        break;
      case ForceAt:
        must(world.apply_force_at(body, vec(J / h), pos(x0 + r)));
        break;
      case ForceAtBody:
        must(world.apply_force_at_body_point(body, vec(J / h), vec(p_B)));
        break;
      case ForceAndTorque:
        must(world.apply_force(body, vec(J / h)));
        must(world.apply_torque(body, vec(r.cross(J) / h)));
        break;
    }
    world.step(h);
    EXPECT_LE((velocity(world, body) - J / 2).norm(), 16 * kEps * J.norm()) << way;
    // World points carry the rounding of a position near 4 m into the lever arm.
    EXPECT_LE((wide(world.angular_momentum(body)) - r.cross(J)).norm(),
              (16 * kEps + 4 * kPosEps) * J.norm())
        << way;
  }
}

TEST(FreeMotion, VelocityAtAPoint) {
  PhysicsWorld world(no_gravity());
  RigidBody spec = free_body(1, {1, 2, 3});
  spec.pose = at({1, 2, 3}, turn(0.4, {0, 1, 1}));
  spec.linear_velocity = vec(1, 0, -1);
  spec.angular_velocity = vec(0.5, -2, 1);
  const BodyId body = must(world.create_body(spec));
  const Vector3d r(0.5, 0.25, -1);
  const Vector3d expected = Vector3d(1, 0, -1) + Vector3d(0.5, -2, 1).cross(r);
  const Vector3d got = wide(world.velocity_at(body, pos(Vector3d(1, 2, 3) + r)));
  EXPECT_LE((got - expected).norm(), 32 * kEps * expected.norm());
}

TEST(FreeMotion, CentreOfMassAwayFromTheOriginMovesOnTheParabola) {
  PhysicsWorld world;
  RigidBody spec = free_body(1, {1, 2, 3});
  spec.mass->center = {0.4, -0.3, 0.2};
  spec.linear_velocity = vec(2, 5, 0);
  spec.angular_velocity = vec(3, 1, -2);
  const BodyId body = must(world.create_body(spec));
  const Vector3d c0 = position(world, body);
  EXPECT_LE((c0 - Vector3d(0.4, -0.3, 0.2)).norm(), 4 * kEps);
  run(world, 1);
  const Vector3d expected = c0 + Vector3d(2, 5 - kGravity / 2, 0);
  EXPECT_LE((position(world, body) - expected).norm(), sum_error(60 * kSubsteps, 5));
  // The body's origin turns about it at a fixed distance.
  const Vector3d origin = wide(world.pose(body).position);
  EXPECT_NEAR((origin - position(world, body)).norm(), spec.mass->center.norm(), 32 * kEps);
}

TEST(FreeMotion, LockedAxesDoNotMove) {
  PhysicsWorld world;
  RigidBody spec = free_body(1, {1, 2, 3});
  spec.locks = MotionLocks::planar();
  spec.linear_velocity = vec(1, 2, 3);
  spec.angular_velocity = vec(4, 5, 6);
  const BodyId body = must(world.create_body(spec));
  const double dt = 1.0 / 60;
  for (int i = 0; i < 60; ++i) {
    must(world.apply_force_at(body, vec(3, 4, 5), pos(0.1, 0.2, 0.3)));
    must(world.apply_torque(body, vec(1, 1, 1)));
    must(world.apply_impulse_at_body_point(body, vec(0.1, 0.1, 0.1), vec(0.5, -0.5, 0.5)));
    world.step(dt);
    ASSERT_EQ(position(world, body).z(), 0);
    ASSERT_EQ(velocity(world, body).z(), 0);
    const Vector3d w = spin(world, body);
    ASSERT_EQ(w.x(), 0);
    ASSERT_EQ(w.y(), 0);
    // Still turned about z only.
    const Eigen::Quaterniond q = orientation(world, body);
    ASSERT_EQ(q.x(), 0);
    ASSERT_EQ(q.y(), 0);
  }
  EXPECT_GT(std::abs(position(world, body).x()), 1);
  EXPECT_GT(std::abs(spin(world, body).z()), 1);
}

TEST(FreeMotion, AFullyLockedBodyCarriesAStack) {
  PhysicsWorld world(no_sleep());
  RigidBody spec = body_at(at(0, 0.5, 0));
  spec.locks = {true, true, true, true, true, true};
  const BodyId shelf = add(world, spec, with(cube(0.5)));
  const BodyId box_id = add(world, body_at(at(0, 1.5, 0)), with(cube(0.5)));
  run(world, 3);
  EXPECT_EQ((position(world, shelf) - Vector3d(0, 0.5, 0)).norm(), 0);
  EXPECT_NEAR(position(world, box_id).y(), 1.5, 0.005);
}

TEST(FreeMotion, APointMassDoesNotRotate) {
  PhysicsWorld world;
  RigidBody spec;
  spec.linear_velocity = vec(1, 0, 0);
  spec.angular_velocity = vec(1, 2, 3);
  const BodyId body = must(world.create_body(spec));
  EXPECT_EQ(world.mass_properties(body).mass, 1);
  must(world.apply_torque(body, vec(5, 5, 5)));
  run(world, 1);
  EXPECT_LE(angle_between(orientation(world, body), Eigen::Quaterniond::Identity()), 0);
  EXPECT_NEAR(position(world, body).x(), 1, sum_error(240, 1));
}

TEST(FreeMotion, KinematicBodiesFollowTheirVelocityOnly) {
  PhysicsWorld world;
  RigidBody spec = body_at(at(0, 1, 0), MotionType::Kinematic);
  spec.linear_velocity = vec(1, 0, 0);
  spec.angular_velocity = vec(0, 0.5, 0);
  const BodyId lift = add(world, spec, with(cube(0.5)));
  const BodyId load = add(world, body_at(at(0, 2, 0)), with(cube(0.5)));
  run(world, 2);
  EXPECT_LE((position(world, lift) - Vector3d(2, 1, 0)).norm(), sum_error(480, 2));
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(1, Vector3d::UnitY()));
  EXPECT_LE(angle_between(orientation(world, lift), turned), sum_error(480, 1));
  EXPECT_GT(position(world, load).x(), 1);  // carried by friction
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
