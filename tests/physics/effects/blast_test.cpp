// Proves that thrust and explosions give what they promise: the impulse of a blast falls with
// distance as stated, arrives when the front does, and does not depend on the time step.
#include <gtest/gtest.h>

#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

TEST(Thrust, PushesAndTurnsWithTheBody) {
  PhysicsWorld world(no_gravity());
  RigidBody body = free_body(2, Vector3d(1, 1, 1));
  body.pose.orientation = turn(kPi / 2, Vector3d::UnitZ());
  const BodyId rocket = must(world.create_body(body));
  const EffectId id = must(world.create_effect({rocket, Thrust{vec(10, 0, 0), Vec3::Zero()}, 0}));
  run(world, 2);
  EXPECT_NEAR((velocity(world, rocket) - Vector3d(0, 10, 0)).norm(), 0, bar(1e-9, 1e-4));
  EXPECT_NEAR((position(world, rocket) - Vector3d(0, 10, 0)).norm(), 0, bar(1e-9, 1e-3));
  EXPECT_NEAR(world.effect_report(id).work, 0.5 * 2 * 100, 1e-3);
  must(world.set_effect(id, {rocket, Thrust{vec(10, 0, 0), vec(0, 0.5, 0)}, 0}));
  world.step(1.0 / 60);
  EXPECT_NEAR(spin(world, rocket).z(), -5.0 / 60, 1e-4);
}

BodyId target(PhysicsWorld& world, double x) {
  RigidBody body = free_body(400, Vector3d(1, 1, 1));
  body.pose = at(x, 0, 0);
  return must(world.create_body(body));
}
Explosion bang() {
  Explosion blast;
  blast.impulse = Real(100);
  blast.area = Real(0.5);
  blast.speed = Real(100);
  blast.thickness = Real(10);
  return blast;
}

TEST(Explosion, ImpulseFallsWithDistanceAtAnyStep) {
  for (const double falloff : {1.0, 2.0, 2.5}) {
    for (const double dt : {1.0 / 15, 1.0 / 60, 1.0 / 500}) {
      PhysicsWorld world(no_gravity());
      std::vector<BodyId> bodies;
      for (const double x : {0.5, 1.0, 2.0, 5.0, 20.0, 49.0}) bodies.push_back(target(world, x));
      const BodyId outside = target(world, 60);
      Explosion blast = bang();
      blast.falloff = real(falloff);
      must(world.create_effect({{}, blast, 0}));
      run(world, 1, dt);
      int i = 0;
      for (const double x : {0.5, 1.0, 2.0, 5.0, 20.0, 49.0}) {
        const double expected = 100 * 0.5 / 400 * std::pow(1 / std::max(x, 1.0), falloff);
        // The body runs from the front at up to 0.125 of its 100 m/s and moves while it passes.
        EXPECT_NEAR(velocity(world, bodies[i++]).x(), expected, 0.02 * expected) << x << " " << dt;
      }
      EXPECT_EQ(velocity(world, outside).norm(), 0);
    }
  }
}

// Heavy bodies hardly move while the front passes: then the law holds to their speed over its.
TEST(Explosion, TheLawIsExactForWhatDoesNotMove) {
  for (const double dt : {1.0 / 15, 1.0 / 77}) {
    PhysicsWorld world(no_gravity());
    RigidBody body = free_body(1e6, Vector3d(1e6, 1e6, 1e6));
    body.pose = at(3, 4, 0);
    const BodyId rock = must(world.create_body(body));
    must(world.create_effect({{}, bang(), 0}));
    run(world, 1, dt);
    EXPECT_NEAR(velocity(world, rock).norm() * 1e6, 100 * 0.5 / 25, bar(1e-5, 1e-3)) << dt;
    EXPECT_NEAR(velocity(world, rock).y() / velocity(world, rock).x(), 4.0 / 3, 1e-5);
  }
}

TEST(Explosion, ArrivesWithTheFrontAndWakesWhatItReaches) {
  PhysicsWorld world;
  add_floor(world, material(0.1));
  const BodyId crate = add(world, body_at(at(30, 0.5, 0)), with(cube(0.5), material(0.1)));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(crate));
  Explosion blast = bang();
  blast.center = pos(0, 0.5, 0);
  blast.impulse = Real(1e6);
  blast.area = Real(0);
  must(world.create_effect({{}, blast, 0}));
  run(world, 0.25);
  EXPECT_TRUE(world.is_awake(crate));
  EXPECT_LT(velocity(world, crate).norm(), 1e-2);  // the front needs 0.3 s
  run(world, 0.35);
  EXPECT_GT(velocity(world, crate).x(), 0.3);
}

TEST(Explosion, HotAirLiftsInsideItsChimneyForItsTime) {
  PhysicsWorld world(no_gravity());
  const BodyId inside = target(world, 1), beside = target(world, 6);
  Explosion blast = bang();
  blast.impulse = Real(0);
  blast.updraft = Real(10);
  blast.updraft_duration = Real(0.5);
  must(world.create_effect({{}, blast, 0}));
  run(world, 2);
  EXPECT_NEAR(velocity(world, inside).y(), 10 * 0.8 * 0.5, 0.2);  // thinner as it rises
  EXPECT_EQ(velocity(world, beside).norm(), 0);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
