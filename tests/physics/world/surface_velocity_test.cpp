// Proves that friction acts relative to a running surface: what lies on a belt gets exactly mu m g
// until it moves with it, a turntable carries in a circle, two free bodies keep their momentum, and
// nothing sleeps on a belt that runs.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

Collider belt(const Shape& shape, double friction, const Vector3d& linear,
              const Vector3d& angular = Vector3d::Zero()) {
  Collider collider = with(shape, material(friction));
  collider.surface_velocity = {vec(linear), vec(angular)};
  return collider;
}
// A ball that cannot turn: one point under a known load.
RigidBody slider(const Vector3d& place, const Vector3d& v = Vector3d::Zero()) {
  RigidBody body = moving(at(place, Quat::Identity()), vec(v));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  return body;
}

// v = mu g t until T = v_belt / (mu g); behind by v_belt^2 / (2 mu g) ever after.
TEST(SurfaceVelocity, ABeltAcceleratesWithMuGUntilItsOwnSpeed) {
  const double mu = 0.3, speed = 2, until = speed / (mu * kGravity);
  for (const MotionType type : {MotionType::Static, MotionType::Kinematic}) {
    PhysicsWorld world(no_sleep());
    add(world, body_at(at(0, -1, 0), type), belt(box(50, 1, 5), mu, {speed, 0, 0}));
    const BodyId ball = add(world, slider({0, 0.5, 0}), with(sphere(0.5), material(mu)));
    run(world, 2, kDt, [&] {
      const double t = world.time();
      const double v = t < until ? mu * kGravity * t : speed;
      if (std::abs(t - until) > kDt) {
        EXPECT_NEAR(velocity(world, ball).x(), v, bar(1e-6, 1e-4) * speed) << "at " << t << " s";
      }
    });
    const double x = speed * world.time() - speed * speed / (2 * mu * kGravity);
    EXPECT_NEAR(position(world, ball).x(), x, bar(1e-5, 1e-4) * x);
  }
}

// The belt does m v^2 of work; half of it is the ball's kinetic energy, the other half is heat.
TEST(SurfaceVelocity, TheBeltDoesTwiceTheWorkThatTheBodyKeeps) {
  const double mu = 0.4, speed = 3;
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, -1, 0), MotionType::Static), belt(box(50, 1, 5), mu, {0, 0, speed}));
  const BodyId ball = add(world, slider({0, 0.5, 0}), with(sphere(0.5), material(mu)));
  const double m = world.mass_properties(ball).mass;
  double work = 0, slip_heat = 0;
  Vector3d before = velocity(world, ball);
  run(world, 1.5, kDt, [&] {
    const Vector3d now = velocity(world, ball);
    for (const ContactState& contact : contacts(world)) {
      const double sign = contact.body_b == ball ? 1 : -1;
      for (int i = 0; i < contact.point_count; ++i) {
        const double given = sign * wide(contact.points[i].friction_impulse).z();
        work += given * speed;
        slip_heat += given * (speed - 0.5 * (now + before).z());
      }
    }
    before = now;
  });
  const double kept = 0.5 * m * speed * speed;
  EXPECT_NEAR(work, 2 * kept, bar(1e-9, 1e-5) * kept);
  EXPECT_NEAR(slip_heat, kept, bar(1e-9, 1e-5) * kept);
  EXPECT_NEAR(0.5 * m * velocity(world, ball).squaredNorm(), kept, bar(1e-9, 1e-5) * kept);
}

// The direction belongs to the collider, wherever its body and its place in it have turned.
TEST(SurfaceVelocity, IsGivenInTheAxesOfTheCollider) {
  PhysicsWorld world(no_sleep());
  Collider collider = belt(box(20, 1, 20), 0.5, {1, 0, 0});
  collider.pose.orientation = turn(kPi / 2, Vector3d::UnitY());  // x to -z
  RigidBody body = body_at(at({0, -1, 0}, turn(kPi / 6, Vector3d::UnitY())), MotionType::Static);
  add(world, body, collider);
  const BodyId ball = add(world, slider({0, 0.5, 0}), with(sphere(0.5), material(0.5)));
  run(world, 1);
  const Vector3d expected(std::cos(kPi / 2 + kPi / 6), 0, -std::sin(kPi / 2 + kPi / 6));
  EXPECT_LE((velocity(world, ball) - expected).norm(), bar(1e-6, 1e-4));
}

TEST(SurfaceVelocity, AddsToTheMotionOfAKinematicBody) {
  PhysicsWorld world(no_sleep());
  RigidBody carrier = body_at(at(0, -1, 0), MotionType::Kinematic);
  carrier.linear_velocity = vec(2, 0, 0);
  add(world, carrier, belt(box(30, 1, 5), 0.6, {1, 0, 0.5}));
  const BodyId ball = add(world, slider({0, 0.5, 0}), with(sphere(0.5), material(0.6)));
  run(world, 2);
  EXPECT_LE((velocity(world, ball) - Vector3d(3, 0, 0.5)).norm(), bar(1e-9, 1e-5));
}

// A body with treads drives itself: v = -v_belt over the ground, which pushes with mu m g.
TEST(SurfaceVelocity, TreadsDriveTheirOwnBody) {
  const double mu = 0.5, speed = 4;
  PhysicsWorld world(no_sleep());
  add_floor(world, material(mu));
  const BodyId tank = add(world, slider({0, 0.1, 0}), belt(box(1, 0.1, 0.5), mu, {-speed, 0, 0}));
  run(world, 0.5);
  EXPECT_NEAR(velocity(world, tank).x(), mu * kGravity * 0.5, bar(1e-5, 1e-4) * speed);
  run(world, 1.5);
  EXPECT_NEAR(velocity(world, tank).x(), speed, bar(1e-6, 1e-4) * speed);
}

// Both free: they part with the belt's speed between them, and the sum of momenta stays nothing.
TEST(SurfaceVelocity, TwoDynamicBodiesKeepTheirMomentum) {
  PhysicsWorld world(no_sleep());
  add_floor(world, material(0));
  RigidBody flat = slider({0, 0.25, 0});
  const BodyId plank = add(world, flat, belt(box(6, 0.25, 1), 0.5, {1.5, 0, 0}));
  const BodyId block = add(world, slider({0, 0.75, 0}), with(cube(0.25), material(0.5)));
  const double m = world.mass_properties(block).mass, M = world.mass_properties(plank).mass;
  run(world, 1.5, kDt, [&] {
    const double p = m * velocity(world, block).x() + M * velocity(world, plank).x();
    EXPECT_NEAR(p, 0, 1.5 * m * bar(1e-12, 1e-4));
  });
  EXPECT_NEAR(velocity(world, block).x() - velocity(world, plank).x(), 1.5, bar(1e-6, 1e-4));
  EXPECT_NEAR(velocity(world, block).x(), 1.5 * M / (m + M), bar(1e-6, 1e-4));
}

// What rides on a turntable stays on its circle and turns with it.
TEST(SurfaceVelocity, ATurntableCarriesInACircle) {
  const double w = 1.5, r = 0.8;
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, -0.5, 0), MotionType::Static),
      belt(box(2, 0.5, 2), 0.8, Vector3d::Zero(), {0, w, 0}));
  const BodyId ball =
      add(world, slider({r, 0.25, 0}, {0, 0, -w * r}), with(sphere(0.25), material(0.8)));
  // Each substep is off by (w h)^4 / 8 of the radius and 5 (w h)^3 / 12 of a radian: its middle is
  // sought along the velocity of the one before.
  const double h = kDt / 4, steps = 300, wander = std::pow(w * h, 4) / 8 * 4 * steps * r;
  run(world, steps * kDt, kDt, [&] {
    const Vector3d p = position(world, ball);
    EXPECT_NEAR(std::hypot(p.x(), p.z()), r, 2 * wander + bar(1e-6, 1e-5)) << world.time();
  });
  const Vector3d p = position(world, ball);
  const double turned = std::remainder(std::atan2(-p.z(), p.x()) - w * steps * kDt, 2 * kPi);
  const double ahead = 5.0 / 12 * std::pow(w * h, 3) * 4 * steps;
  EXPECT_NEAR(turned, ahead, 0.05 * ahead + bar(1e-6, 1e-4));
}

// A box in the middle of it is spun up by its four corners: alpha = mu g rho / (I/m).
TEST(SurfaceVelocity, ATurntableSpinsUpWhatStandsInItsMiddle) {
  const double mu = 0.2, w = 6;
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, -0.5, 0), MotionType::Static),
      belt(box(2, 0.5, 2), mu, Vector3d::Zero(), {0, w, 0}));
  const BodyId slab = add(world, body_at(at(0, 0.1, 0)), with(box(0.5, 0.1, 0.5), material(mu)));
  const double alpha = mu * kGravity * std::sqrt(0.5) * 6;
  run(world, 0.5);
  EXPECT_NEAR(spin(world, slab).y(), alpha * 0.5, bar(1e-5, 1e-4) * w);
  run(world, 1.5);
  EXPECT_NEAR(spin(world, slab).y(), w, bar(1e-6, 1e-4) * w);
}

// A bounce meets the belt too: it takes mu (1 + e) m v_n along it.
TEST(SurfaceVelocity, ABounceIsDrivenByTheBelt) {
  const double mu = 0.1, e = 1;
  WorldSettings settings = no_sleep();
  PhysicsWorld world(settings);
  Collider top = belt(box(50, 1, 5), mu, {30, 0, 0});
  top.material.restitution = real(e);
  add(world, body_at(at(0, -1, 0), MotionType::Static), top);
  const BodyId ball = add(world, slider({0, 3, 0}), with(sphere(0.5), material(mu, e)));
  run(world, 1);  // falls 2.5 m in 0.714 s
  const double impact = std::sqrt(2 * kGravity * 2.5);
  EXPECT_NEAR(velocity(world, ball).x(), mu * (1 + e) * impact, bar(1e-6, 1e-4) * impact);
}

TEST(SurfaceVelocity, NothingSleepsOnABeltThatRuns) {
  PhysicsWorld world;
  const BodyId ground =
      add(world, body_at(at(0, -1, 0), MotionType::Static), belt(box(5, 1, 5), 0.5, {1e-3, 0, 0}));
  const BodyId lower = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5), material(0.5)));
  const BodyId upper = add(world, body_at(at(0, 1.5, 0)), with(cube(0.5), material(0.5)));
  run(world, 5);
  EXPECT_TRUE(world.is_awake(lower));
  EXPECT_TRUE(world.is_awake(upper));
  EXPECT_NEAR(position(world, upper).x(), 5e-3, 1e-4);
  // Stopped, it lets them sleep; started again, it wakes them.
  const ColliderId top = world.colliders_of(ground)[0];
  must(world.set_surface_velocity(top, {}));
  run(world, 5);
  EXPECT_FALSE(world.is_awake(lower));
  EXPECT_FALSE(world.is_awake(upper));
  must(world.set_surface_velocity(top, {vec(1, 0, 0), Vec3::Zero()}));
  EXPECT_TRUE(world.is_awake(lower));
  EXPECT_TRUE(world.is_awake(upper));
  run(world, 2);
  EXPECT_NEAR(velocity(world, upper).x(), 1, bar(1e-6, 1e-4));
  EXPECT_EQ(world.collider(top).surface_velocity.linear, vec(1, 0, 0));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
