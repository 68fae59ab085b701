// Invariant: once a world has warmed up, its steps ask nothing of the heap: contacts, islands,
// bounces, joints, effects, surfaces and events are kept in memory of earlier steps. (Newton's
// method is not among them: it sets up matrices of a new pattern as contacts come and go.)
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "counted_new.h"
#include "plumb/job_system.h"
#include "support/chain.h"
#include "support/scenes.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr double kDt = 1.0 / 60;  // [s]

long allocations(PhysicsWorld& world, int warm_up, int steps) {
  for (int i = 0; i < warm_up; ++i) world.step(kDt);
  test::begin_counting();
  for (int i = 0; i < steps; ++i) world.step(kDt);
  return test::end_counting();
}

// The count itself must see what it is to count.
TEST(SteadyStep, TheCounterCounts) {
  test::begin_counting();
  const std::vector<int> list(100, 1);
  const long count = test::end_counting();
  EXPECT_EQ(list.back(), 1);
  EXPECT_EQ(count, 1);
}

TEST(SteadyStep, AllocatesNothingInAPileThatDoesNotSleep) {
  PhysicsWorld world(no_sleep());
  scenes::build_pile(world, {.side = 5});
  EXPECT_EQ(allocations(world, 400, 200), 0);
}

TEST(SteadyStep, AllocatesNothingWhileAPileMightSleep) {
  WorldSettings settings;
  settings.time_to_sleep = Real(1e3);
  PhysicsWorld world(settings);
  scenes::build_pile(world, {.side = 5});
  EXPECT_EQ(allocations(world, 400, 200), 0);
}

TEST(SteadyStep, AllocatesNothingWithSeveralThreads) {
  const auto jobs = make_thread_pool(3);
  PhysicsWorld world(no_sleep());
  world.set_job_system(jobs.get());
  scenes::build_pile(world, {.side = 5});
  EXPECT_EQ(allocations(world, 400, 200), 0);
}

TEST(SteadyStep, AllocatesNothingWhereHullsRest) {
  PhysicsWorld world(no_sleep());
  const Vec3 corners[] = {vec(0.4, 0, 0),  vec(-0.4, 0, 0), vec(0, 0.4, 0),
                          vec(0, -0.4, 0), vec(0, 0, 0.4),  vec(0, 0, -0.4)};
  const std::uint32_t sizes[] = {3, 3, 3, 3, 3, 3, 3, 3};
  const std::uint32_t loops[] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  const std::vector hulls{HullGeometry::create(corners, sizes, loops).hull};
  ASSERT_TRUE(hulls.front());
  scenes::build_hull_pile(world, hulls, 4);
  EXPECT_EQ(allocations(world, 600, 200), 0);
}

TEST(SteadyStep, AllocatesNothingWhereBallsBounceForEver) {
  PhysicsWorld world(no_sleep());
  scenes::build_bouncing(world);
  EXPECT_EQ(allocations(world, 400, 400), 0);
}

TEST(SteadyStep, AllocatesNothingInATowerThatTheAccurateSolverCarries) {
  PhysicsWorld world(no_sleep());
  scenes::build_column(world, {20, 1, 0.01});
  EXPECT_EQ(allocations(world, 300, 200), 0);
  EXPECT_EQ(world.last_report().newton_islands, 1u);
}

TEST(SteadyStep, AllocatesNothingInASwingingChain) {
  Chain chain(20, 10);
  EXPECT_EQ(allocations(chain.world, 200, 200), 0);
}

TEST(SteadyStep, AllocatesNothingOnAMeshAndAHeightfield) {
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, 0, 0), MotionType::Static),
      with(SurfaceMesh{surfaces::made(surfaces::grid(-8, 8, -8, 8, 16, 16, surfaces::level))},
           material(0.5)));
  for (int i = 0; i < 16; ++i) {
    const Pose pose = at(3.0 * (i % 4) - 5, 0.5, 3.0 * (i / 4) - 5);
    const Collider shapes[] = {with(cube(0.4)), with(sphere(0.4)), with(capsule(0.4, 0.2)),
                               with(cylinder(0.4, 0.3))};
    add(world, body_at(pose), shapes[i % 4]);
  }
  EXPECT_EQ(allocations(world, 300, 200), 0);
}

TEST(SteadyStep, AllocatesNothingWithSensorsBeltsAndRollingFriction) {
  PhysicsWorld world(no_sleep());
  Material rolling = material(0.6);
  rolling.rolling_friction = Real(0.01);
  const BodyId floor = add_floor(world, rolling);
  SurfaceVelocity belt;
  belt.linear = vec(0.1, 0, 0);
  must(world.set_surface_velocity(world.colliders_of(floor)[0], belt));
  Collider eye = with(cube(2));
  eye.is_sensor = true;
  add(world, body_at(at(0, 1, 0), MotionType::Static), eye);
  for (int i = 0; i < 9; ++i)
    add(world, body_at(at(1.5 * (i % 3), 0.5, 1.5 * (i / 3))), with(sphere(0.5), rolling));
  EXPECT_EQ(allocations(world, 300, 200), 0);
}

TEST(SteadyStep, AllocatesNothingUnderEffects) {
  PhysicsWorld world(no_sleep());
  add_floor(world);
  Buoyancy lake;
  lake.level = Real(2);
  must(world.create_effect({.kind = lake}).status);
  BodyId last;
  for (int i = 0; i < 12; ++i) {
    const BodyId body =
        add(world, body_at(at(1.5 * (i % 4), 3, 1.5 * (i / 4))), with(cube(0.5), {}, 600));
    Drag drag;
    drag.linear = Real(1);
    must(world.create_effect({.body = body, .kind = drag}).status);
    must(world.create_effect({.body = body, .kind = Wind{}}).status);
    if (!last.is_null()) {
      Spring spring;
      spring.other = last;
      spring.rest_length = Real(1.5);
      spring.stiffness = Real(1e3);
      spring.damping = Real(10);
      must(world.create_effect({.body = body, .kind = spring}).status);
    }
    last = body;
  }
  EXPECT_EQ(allocations(world, 300, 200), 0);
}

TEST(SteadyStep, AllocatesNothingInAFastTurningBodysFlight) {
  PhysicsWorld world(no_sleep());
  add_floor(world);
  for (int i = 0; i < 8; ++i) {
    RigidBody body = moving(at(3.0 * i, 200, 0), vec(0, -50, 0), vec(3, 20, 5));
    body.continuous = true;
    add(world, body, with(box(1, 0.1, 0.3)));
  }
  EXPECT_EQ(allocations(world, 60, 60), 0);
}

TEST(SteadyStep, AllocatesNothingOnceThePileSleeps) {
  PhysicsWorld world;
  scenes::build_pile(world, {.side = 4});
  world.step(kDt);
  for (int i = 0; i < 2000 && world.last_report().awake_bodies > 0; ++i) world.step(kDt);
  ASSERT_EQ(world.last_report().awake_bodies, 0u);
  EXPECT_EQ(allocations(world, 2, 100), 0);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
