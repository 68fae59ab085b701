// Proves that destroying things at bad moments is safe, that a stale handle is always recognised,
// and that a body whose state becomes non-finite is put aside while all others go on bit for bit.
#include <gtest/gtest.h>

#include <limits>

#include "support/measure.h"
#include "support/recorder.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

TEST(Handles, AStaleHandleIsRecognisedAlsoWhenItsPlaceIsTakenAgain) {
  PhysicsWorld world;
  const BodyId first = add(world, body_at(at(0, 5, 0)), with(sphere(0.5)));
  const ColliderId collider = world.colliders_of(first)[0];
  must(world.destroy_body(first));
  const BodyId second = add(world, body_at(at(0, 5, 0)), with(sphere(0.5)));
  EXPECT_NE(first, second);
  EXPECT_FALSE(world.is_valid(first));
  EXPECT_FALSE(world.is_valid(collider));  // colliders go with their body
  EXPECT_EQ(world.apply_force(first, vec(1, 0, 0)).code, StatusCode::StaleHandle);
  EXPECT_EQ(world.destroy_body(first).code, StatusCode::StaleHandle);
  EXPECT_EQ(world.destroy_collider(collider).code, StatusCode::StaleHandle);
  EXPECT_TRUE(world.is_valid(second));
  EXPECT_EQ(world.body_count(), 1u);
}

TEST(Handles, ValuesRoundTrip) {
  const BodyId id{123456, 789};
  EXPECT_EQ(BodyId::from_value(id.value()), id);
  EXPECT_TRUE(BodyId{}.is_null());
}

TEST(Handles, DestroyDuringContact) {
  for (int victim = 0; victim < 4; ++victim) {
    PhysicsWorld world(no_sleep());
    EventRecorder events;
    world.attach(&events);
    const Built stack = build_stack(world, {.count = 4});
    run(world, 0.5);
    ASSERT_EQ(world.last_report().touching_pairs, 4u);
    must(world.destroy_body(stack.bodies[static_cast<std::size_t>(victim)]));
    run(world, 3);
    EXPECT_TRUE(all_finite(world));
    EXPECT_EQ(world.body_count(), 4u);
    // The others have closed the gap.
    EXPECT_EQ(world.last_report().touching_pairs, 3u);
    int balance = 0;
    for (const ContactEvent& e : events.contacts)
      balance += e.kind == ContactEvent::Kind::Begin ? 1 : -1;
    EXPECT_EQ(balance, 3);
  }
}

TEST(Handles, DestroyTheGround) {
  PhysicsWorld world;
  const Built stack = build_stack(world, {.count = 4});
  run(world, 3);
  must(world.destroy_body(stack.ground));
  run(world, 1);
  // The load kept between the boxes goes in the passes of one step; what is left of it is less than
  // the speed that gravity adds in one substep.
  for (BodyId b : stack.bodies) EXPECT_NEAR(velocity(world, b).y(), -kGravity, kGravity * kDt / 4);
}

TEST(Handles, DestroyAColliderDuringContact) {
  PhysicsWorld world(no_sleep());
  add_floor(world);
  const BodyId body = must(world.create_body(body_at(at(0, 0.5, 0))));
  const ColliderId left = must(world.create_collider(body, with(sphere(0.5))));
  Collider other = with(sphere(0.5));
  other.pose.position = vec(2, 0, 0);
  must(world.create_collider(body, other));
  run(world, 0.5);
  EXPECT_EQ(world.last_report().touching_pairs, 2u);
  const double mass = world.mass_properties(body).mass;
  must(world.destroy_collider(left));
  EXPECT_NEAR(world.mass_properties(body).mass, mass / 2, 1e-6 * mass);
  EXPECT_EQ(world.colliders_of(body).size(), 1u);
  run(world, 1);
  EXPECT_EQ(world.last_report().touching_pairs, 1u);
  EXPECT_TRUE(all_finite(world));
}

TEST(Handles, CallsFromAnObserverAreRefused) {
  struct Meddler : StepObserver {
    PhysicsWorld* world = nullptr;
    BodyId body;
    Status create, push, nested;
    void on_step(const StepView&) override {
      create = world->create_body({}).status;
      push = world->apply_impulse(body, vec(1, 0, 0));
      nested = world->step(1.0 / 60).status;
    }
  };
  PhysicsWorld world;
  Meddler meddler;
  meddler.world = &world;
  meddler.body = add(world, body_at(at(0, 5, 0)), with(sphere(0.5)));
  world.attach(&meddler);
  world.step(kDt);
  EXPECT_EQ(meddler.create.code, StatusCode::InsideStep);
  EXPECT_EQ(meddler.push.code, StatusCode::InsideStep);
  EXPECT_EQ(meddler.nested.code, StatusCode::InsideStep);
  EXPECT_EQ(world.body_count(), 1u);
  EXPECT_EQ(world.step_count(), 1u);
  world.detach(&meddler);
}

// A finite force can still overflow a velocity. The body goes aside; the others never notice.
TEST(Quarantine, ANonFiniteBodyIsPutAsideAndReported) {
  PhysicsWorld world, twin;
  BodyId doomed;
  std::vector<BodyId> others;
  for (PhysicsWorld* w : {&world, &twin}) {
    others = build_stack(*w, {.count = 3, .gap = 0.1}).bodies;
    others.push_back(
        add(*w, moving(at(5, 3, 0), vec(1, 2, 3), vec(4, 5, 6)), with(box(0.2, 0.3, 0.4))));
    RigidBody far = body_at(at(50, 10, 0));
    doomed = add(*w, far, with(sphere(0.5), {}, 1e-3));
    run(*w, 0.2);
  }
  const Pose last = world.pose(doomed);
  const double huge = static_cast<double>(std::numeric_limits<Real>::max()) / 2;
  int reported = 0;
  for (int i = 0; i < 60; ++i) {
    // The body weighs half a gram: the force is finite, its acceleration is not.
    if (i == 10) must(world.apply_force(doomed, vec(huge, huge, 0)));
    const StepReport& report = world.step(kDt);
    twin.step(kDt);
    reported += static_cast<int>(report.quarantined);
    for (const QuarantineEvent& e : world.events().quarantined) EXPECT_EQ(e.body, doomed);
    ASSERT_TRUE(all_finite(world));
    for (BodyId b : others) {
      ASSERT_EQ(world.pose(b).position, twin.pose(b).position) << "step " << i;
      ASSERT_EQ(world.linear_velocity(b), twin.linear_velocity(b)) << "step " << i;
    }
  }
  EXPECT_EQ(reported, 1);
  // Still there, at a finite place near where it was.
  EXPECT_TRUE(world.is_valid(doomed));
  EXPECT_LE((wide(world.pose(doomed).position) - wide(last.position)).norm(), 5);
  must(world.destroy_body(doomed));
  run(world, 0.5);
  EXPECT_TRUE(all_finite(world));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
