// Proves that what a body was made with can be changed while it lives: locks, damping, the pull of
// gravity, sleeping, its own mass, the engine's own data. What is set acts as if the body had been
// made with it.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

TEST(BodyChanges, LocksEndTheMotionThatTheyForbid) {
  PhysicsWorld world;
  const BodyId body =
      add(world, moving(at(0, 5, 0), vec(1, 2, 3), vec(1, 2, 3)), with(box(0.2, 0.3, 0.4)));
  run(world, 0.2);
  MotionLocks locks;
  locks.linear_y = locks.angular_x = true;
  must(world.set_locks(body, locks));
  EXPECT_EQ(world.linear_velocity(body).y(), 0);
  EXPECT_NEAR(world.angular_velocity(body).x(), 0, 16 * kEps);
  EXPECT_TRUE(world.body(body).locks.linear_y);
  const double height = position(world, body).y();
  run(world, 1, kDt, [&] {
    ASSERT_EQ(position(world, body).y(), height);
    ASSERT_NEAR(spin(world, body).x(), 0, 64 * kEps);
  });
  EXPECT_GT(spin(world, body).norm(), 0.5);
  must(world.set_locks(body, {}));
  run(world, 1);
  EXPECT_NEAR(position(world, body).y(), height - 0.5 * kGravity, bar(1e-9, 1e-4));
}

// The centre of mass that a new mass brings must not carry a turning body along a locked axis.
TEST(BodyChanges, ANewCentreOfMassKeepsToTheLocks) {
  PhysicsWorld world(no_gravity());
  RigidBody made = moving(Pose{}, vec(1, 0, 0), vec(0, 0, 2));
  made.locks.linear_y = true;
  const BodyId body = add(world, made, with(cube(0.5)));
  MassProperties moved = world.mass_properties(body);
  moved.center = {0.3, 0, 0};
  must(world.set_mass(body, moved));
  const double height = position(world, body).y();
  run(world, 1, kDt, [&] { ASSERT_EQ(position(world, body).y(), height); });
}

TEST(BodyChanges, DampingIsThatOfTheMomentItIsSet) {
  PhysicsWorld world(no_gravity());
  const BodyId body = add(world, moving(Pose{}, vec(2, 0, 0), vec(0, 3, 0)), with(sphere(0.5)));
  run(world, 1);
  EXPECT_EQ(velocity(world, body), Vector3d(2, 0, 0));
  must(world.set_damping(body, real(0.5), real(0.25)));
  run(world, 1);
  EXPECT_NEAR(velocity(world, body).x(), 2 * std::exp(-0.5), 60 * 4 * kEps);
  EXPECT_NEAR(spin(world, body).y(), 3 * std::exp(-0.25), 60 * 8 * kEps);
}

TEST(BodyChanges, GravityThatComesBackWakesAndPulls) {
  PhysicsWorld world;
  RigidBody floating = body_at(at(0, 10, 0));
  floating.gravity_scale = 0;
  const BodyId body = add(world, floating, with(sphere(0.5)));
  run(world, 2);
  ASSERT_FALSE(world.is_awake(body));
  must(world.set_gravity_scale(body, real(-0.5)));
  EXPECT_TRUE(world.is_awake(body));
  run(world, 1);
  EXPECT_NEAR(position(world, body).y(), 10 + 0.25 * kGravity, bar(1e-12, 1e-4));
}

TEST(BodyChanges, OneThatMayNotSleepKeepsItsIslandAwake) {
  PhysicsWorld world;
  const Built stack = build_stack(world, {.count = 2});
  run(world, 3);
  ASSERT_FALSE(world.is_awake(stack.bodies[0]));
  must(world.set_can_sleep(stack.bodies[1], false));
  EXPECT_TRUE(world.is_awake(stack.bodies[0]));
  run(world, 3);
  EXPECT_TRUE(world.is_awake(stack.bodies[0]));
  must(world.set_can_sleep(stack.bodies[1], true));
  run(world, 3);
  EXPECT_FALSE(world.is_awake(stack.bodies[0]));
}

TEST(BodyChanges, MassIsGivenAndDerivedAgain) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId body = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  run(world, 3);
  const MassProperties derived = world.mass_properties(body);
  MassProperties own = derived;
  own.mass = 7;
  own.I_Bcm_B *= 0.5;
  must(world.set_mass(body, own));
  EXPECT_TRUE(world.body(body).mass.has_value());
  run(world, 3);
  ASSERT_FALSE(world.is_awake(body));
  must(world.derive_mass(body));
  EXPECT_TRUE(world.is_awake(body));
  EXPECT_FALSE(world.body(body).mass.has_value());
  EXPECT_EQ(world.mass_properties(body).mass, derived.mass);
  EXPECT_EQ(world.mass_properties(body).I_Bcm_B, derived.I_Bcm_B);
  const BodyId bare = must(world.create_body(free_body(5, {1, 1, 1})));
  must(world.derive_mass(bare));
  EXPECT_EQ(world.mass_properties(bare).mass, 1);  // a point mass
}

TEST(BodyChanges, TheEnginesOwnDataAreKept) {
  PhysicsWorld world;
  const Built stack = build_stack(world, {.count = 1});
  run(world, 3);
  const BodyId body = stack.bodies[0];
  const ColliderId collider = world.colliders_of(body)[0];
  constexpr std::uint64_t kData = 0xfedcba9876543210u;
  const std::uint64_t hash = world.state_hash();
  must(world.set_user_data(body, kData));
  must(world.set_user_data(collider, ~kData));
  EXPECT_EQ(world.state_hash(), hash);
  EXPECT_FALSE(world.is_awake(body));
  PhysicsWorld restored;
  must(restored.restore(world.save()));
  for (const PhysicsWorld* w : {&world, &restored}) {
    EXPECT_EQ(w->state(body).user_data, kData);
    EXPECT_EQ(w->body(body).user_data, kData);
    EXPECT_EQ(w->collider(collider).user_data, ~kData);
  }
}

// A scene of bodies that were made with all fields, and one in which they were set afterwards: the
// same bits from then on.
TEST(BodyChanges, WhatIsSetIsAsIfMadeSo) {
  PhysicsWorld made, set;
  for (PhysicsWorld* world : {&made, &set}) add_slab(*world, 30, 30);
  for (int i = 0; i < 24; ++i) {
    RigidBody body = moving(at(1.1 * (i % 6) - 3, 0.6 + 0.9 * (i / 6), 0.1 * (i % 4)),
                            vec(0, -1, 0.2 * i), vec(0, i % 5, 1));
    body.locks.angular_z = i % 4 == 1;
    body.locks.linear_x = i % 6 == 2;
    body.linear_damping = real(0.1 * (i % 3));
    body.angular_damping = real(0.2 * (i % 2));
    body.gravity_scale = real(1 - 0.1 * (i % 4));
    body.can_sleep = i % 5 != 0;
    body.continuous = i % 7 == 0;
    body.user_data = static_cast<std::uint64_t>(i);
    Collider collider = with(i % 2 == 0 ? Shape(cube(0.3)) : Shape(sphere(0.35)),
                             material(0.1 * (i % 8), 0.2 * (i % 3)), 500 + 100 * (i % 4));
    collider.material.rolling_friction = real(0.01 * (i % 2));
    collider.user_data = 7;
    add(made, body, collider);

    RigidBody plain = moving(body.pose, body.linear_velocity, body.angular_velocity);
    const BodyId id = add(set, plain, with(capsule(0.2, 0.2)));
    must(set.set_locks(id, body.locks));
    must(set.set_damping(id, body.linear_damping, body.angular_damping));
    must(set.set_gravity_scale(id, body.gravity_scale));
    must(set.set_can_sleep(id, body.can_sleep));
    must(set.set_continuous(id, body.continuous));
    must(set.set_user_data(id, body.user_data));
    const ColliderId shape = set.colliders_of(id)[0];
    must(set.set_shape(shape, collider.shape));
    must(set.set_density(shape, collider.density));
    must(set.set_material(shape, collider.material));
    must(set.set_user_data(shape, collider.user_data));
  }
  for (int i = 0; i < 180; ++i) {
    made.step(kDt);
    set.step(kDt);
    ASSERT_EQ(made.state_hash(), set.state_hash()) << "step " << i;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
