// Proves that air acts as its laws say: Magnus without work, lift and drag of a plate at an angle,
// tensors of the book's surfaces with their controls, and all of it stable at any density.
#include <gtest/gtest.h>

#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

TEST(Magnus, TurnsTheVelocityAndKeepsTheSpeed) {
  for (const double s : {0.01, 1.0, 1000.0}) {
    PhysicsWorld world(no_gravity());
    RigidBody body = free_body(1, Vector3d(1, 1, 1));
    body.linear_velocity = vec(10, 0, 0);
    body.angular_velocity = vec(0, 5, 0);
    const BodyId ball = must(world.create_body(body));
    must(world.create_effect({{}, Magnus{real(s), Vec3::Zero()}, 0}));
    run(world, 2);
    EXPECT_NEAR(velocity(world, ball).norm(), 10, bar(1e-9, 1e-2)) << s;
    if (s > 0.1) continue;
    // v' = s w x v: about y by s w t.
    const double angle = s * 5 * 2;
    EXPECT_NEAR(velocity(world, ball).x(), 10 * std::cos(angle), bar(1e-9, 1e-4));
    EXPECT_NEAR(velocity(world, ball).z(), -10 * std::sin(angle), bar(1e-9, 1e-4));
    EXPECT_NEAR(position(world, ball).x(), 10 * std::sin(angle) / (s * 5), 1e-4);
  }
}

// A plate of 2 m^2 whose normal lies at 30 degrees to the wind: F = rho/2 A p v (v . n) n, within
// the little that it moves in one step.
TEST(Wind, GivesAPlateLiftAndDrag) {
  PhysicsWorld world(no_gravity());
  const BodyId plate = add(world, body_at(at(Vector3d::Zero(), turn(kPi / 6, Vector3d::UnitZ()))),
                           with(box(0.005, 0.5, 1)));
  Wind wind;
  wind.velocity = vec(10, 0, 0);
  wind.friction = Real(0);
  const EffectId id = must(world.create_effect({plate, wind, 0}));
  world.step(1e-4);
  const double cosine = std::cos(kPi / 6);
  const double force = 0.5 * 1.2 * 2 * 1.5 * 100 * cosine;
  const Vector3d f = world.effect_report(id).force;
  // The edges of the plate, 1 cm thick, take 0.6 % of it.
  EXPECT_NEAR(f.x(), force * cosine, 0.02 * force);  // drag
  EXPECT_NEAR(f.y(), force * 0.5, 0.02 * force);     // lift
  EXPECT_NEAR(f.z(), 0, 1e-3);
}

TEST(Wind, BlowsABallAlongAndNeverFasterThanItself) {
  for (const double density : {1.2, 1e3, 1e9}) {
    PhysicsWorld world(no_gravity());
    const BodyId ball = add(world, RigidBody{}, with(sphere(0.1), {}, 10));
    Wind wind;
    wind.velocity = vec(0, 0, 20);
    wind.density = real(density);
    must(world.create_effect({{}, wind, 0}));
    run(world, 20, 1.0 / 15,
        [&] { ASSERT_LE(velocity(world, ball).z(), 20 + bar(1e-9, 1e-4)) << density; });
    EXPECT_GT(velocity(world, ball).z(), 16);
  }
}

TEST(Wind, StopsWhatSpins) {
  for (const Shape& shape :
       {Shape(box(0.5, 0.02, 0.2)), Shape(capsule(0.5, 0.1)), Shape(cone(0.4, 0.3))}) {
    PhysicsWorld world(no_gravity());
    RigidBody body;
    body.angular_velocity = vec(3, 20, 30);
    const BodyId rotor = add(world, body, with(shape, {}, 20));
    must(world.create_effect({{}, Wind{}, 0}));
    double last = world.energy().kinetic_angular + world.energy().kinetic_linear;
    const double start = last;
    run(world, 5, 1.0 / 60, [&] {
      const double now = world.energy().kinetic_angular + world.energy().kinetic_linear;
      ASSERT_LE(now, last * (1 + 1e-4));
      last = now;
    });
    EXPECT_LT(last, 0.95 * start);
    (void)rotor;
  }
}

// F = T u at the point: a fin behind the centre of mass turns the body into the wind.
TEST(AeroSurface, AFinTurnsTheBodyIntoTheFlow) {
  PhysicsWorld world(no_gravity());
  RigidBody body = free_body(10, Vector3d(2, 5, 5));
  body.linear_velocity = vec(30, 0, 5);
  const BodyId dart = must(world.create_body(body));
  AeroSurface fin;
  fin.tensor.diagonal() = vec(-0.02, -0.02, -2);
  fin.point = vec(-2, 0, 0);
  must(world.create_effect({dart, fin, 0}));
  run(world, 10);
  const Vector3d nose = orientation(world, dart) * Vector3d::UnitX();
  EXPECT_GT(nose.dot(velocity(world, dart).normalized()), 0.99);
}

TEST(AeroSurface, ControlLeadsFromMinimumToMaximum) {
  double spin_after[5];
  int k = 0;
  for (const double control : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    PhysicsWorld world(no_gravity());
    RigidBody body = free_body(10, Vector3d(2, 2, 2));
    body.linear_velocity = vec(20, 0, 0);
    const BodyId plane = must(world.create_body(body));
    AeroSurface elevator;
    elevator.is_controlled = true;
    elevator.minimum(1, 0) = Real(-0.5);  // lift from the flow along x
    elevator.maximum(1, 0) = Real(0.5);
    elevator.control = real(control);
    elevator.point = vec(-3, 0, 0);
    const EffectId id = must(world.create_effect({plane, elevator, 0}));
    world.step(1.0 / 60);
    spin_after[k++] = spin(world, plane).z();
    EXPECT_NEAR(world.effect_report(id).force.y(), 0.5 * control * 20, 0.05);
  }
  EXPECT_NEAR(spin_after[2], 0, 1e-9);
  EXPECT_LT(spin_after[4], 0);  // up at the tail: nose down
  EXPECT_NEAR(spin_after[0], -spin_after[4], 1e-4);
  EXPECT_NEAR(spin_after[3], 0.5 * spin_after[4], 1e-3);
}

TEST(AeroSurface, IsStableHoweverStrong) {
  for (const double strength : {1.0, 1e4, 1e9}) {
    PhysicsWorld world(no_gravity());
    RigidBody body = free_body(1, Vector3d(0.1, 0.2, 0.3));
    body.linear_velocity = vec(100, 20, 3);
    body.angular_velocity = vec(3, 8, 9);
    const BodyId wing = must(world.create_body(body));
    AeroSurface surface;
    surface.tensor = -real(strength) * Mat3::Identity();
    surface.point = vec(0.5, 0.2, 0);
    must(world.create_effect({wing, surface, 0}));
    double last = world.energy().total();
    run(world, 3, 1.0 / 15, [&] {
      const double now = world.energy().total();
      ASSERT_LE(now, last * (1 + 1e-5) + 1e-9) << strength;
      last = now;
    });
    EXPECT_TRUE(all_finite(world));
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
