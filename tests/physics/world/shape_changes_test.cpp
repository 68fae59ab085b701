// Proves that a living collider can have another shape, place or density: the mass follows, the
// body's frame and motion do not, what lay on it wakes, and contacts last where surfaces still
// touch.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/recorder.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

ColliderId collider_of(const PhysicsWorld& world, BodyId body) {
  return world.colliders_of(body)[0];
}

TEST(ShapeChanges, MassFollowsShapeDensityAndPlace) {
  PhysicsWorld world(no_gravity());
  const BodyId body =
      add(world, moving(at(1, 2, 3), vec(1, 0, 0), vec(0, 0, 2)), with(sphere(0.5)));
  const ColliderId collider = collider_of(world, body);
  must(world.set_shape(collider, box(0.5, 1, 1.5)));
  const double mass = 1000 * 1 * 2 * 3;
  EXPECT_NEAR(world.mass_properties(body).mass, mass, 1e-9 * mass);
  EXPECT_NEAR(world.mass_properties(body).I_Bcm_B(0, 0), mass * (4 + 9) / 12, 1e-9 * mass);
  EXPECT_NEAR(wide(world.angular_momentum(body)).z(), 2 * mass * (1 + 4) / 12,
              8 * kEps * mass);  // turns on as before
  must(world.set_density(collider, 10));
  EXPECT_NEAR(world.mass_properties(body).mass, mass / 100, 1e-9 * mass);
  LocalPose aside;
  aside.position = vec(0, 1, 0);
  must(world.set_local_pose(collider, aside));
  EXPECT_LT((position(world, body) - Vector3d(1, 3, 3)).norm(), 8 * kPosEps);
  EXPECT_LT((wide(world.pose(body).position) - Vector3d(1, 2, 3)).norm(), 8 * kPosEps);
  EXPECT_LT((wide(world.velocity_at(body, pos(1, 2, 3))) - Vector3d(1, 0, 0)).norm(), 16 * kEps);
  EXPECT_LT((velocity(world, body) - Vector3d(-1, 0, 0)).norm(), 16 * kEps);  // 1 - 2 rad/s * 1 m
  MassProperties own = world.mass_properties(body);
  own.mass = 3;
  must(world.set_mass(body, own));
  must(world.set_shape(collider, sphere(2)));
  EXPECT_EQ(world.mass_properties(body).mass, 3);  // its own does not follow
  EXPECT_TRUE(std::holds_alternative<Sphere>(world.collider(collider).shape));
}

class Pedestal : public ::testing::Test {
 protected:
  Pedestal() {
    add_floor(world_);
    foot_ = add(world_, body_at(at(0, 0.5, 0), MotionType::Static), with(cube(0.5)));
    load_ = add(world_, body_at(at(0, 1.25, 0)), with(cube(0.25)));
    run(world_, 3);
    world_.attach(&events_);
  }
  void SetUp() override { ASSERT_FALSE(world_.is_awake(load_)); }
  PhysicsWorld world_;
  BodyId foot_, load_;
  EventRecorder events_;
};

TEST_F(Pedestal, OneThatGrowsLiftsWhatLiesOnIt) {
  must(world_.set_shape(collider_of(world_, foot_), box(0.5, 0.55, 0.5)));
  EXPECT_TRUE(world_.is_awake(load_));
  run(world_, 3);
  EXPECT_NEAR(position(world_, load_).y(), 1.3, 0.005);
  EXPECT_TRUE(events_.contacts.empty());  // the two have touched all the time
}

TEST_F(Pedestal, OneThatShrinksLetsItFallOntoItself) {
  must(world_.set_shape(collider_of(world_, foot_), cylinder(0.2, 0.6)));
  EXPECT_TRUE(world_.is_awake(load_));
  run(world_, 3);
  EXPECT_NEAR(position(world_, load_).y(), 0.95, 0.005);
  ASSERT_EQ(events_.contacts.size(), 2u);
  EXPECT_EQ(events_.contacts[0].kind, ContactEvent::Kind::End);
  EXPECT_EQ(events_.contacts[1].kind, ContactEvent::Kind::Begin);
}

TEST_F(Pedestal, OneThatIsPlacedElsewhereLetsItFall) {
  LocalPose aside;
  aside.position = vec(5, 0, 0);
  must(world_.set_local_pose(collider_of(world_, foot_), aside));
  EXPECT_TRUE(world_.is_awake(load_));
  run(world_, 3);
  EXPECT_NEAR(position(world_, load_).y(), 0.25, 0.005);
  EXPECT_EQ(world_.cast_ray(pos(5, 3, 0), vec(0, -5, 0))->collider, collider_of(world_, foot_));
}

// The load takes another shape where it lies: nothing ends, and it stays where it is.
TEST_F(Pedestal, AContactOutlivesTheShape) {
  must(world_.set_shape(collider_of(world_, load_), box(0.4, 0.25, 0.3)));
  run(world_, 2);
  EXPECT_TRUE(events_.contacts.empty());
  EXPECT_LT((position(world_, load_) - Vector3d(0, 1.25, 0)).norm(), 0.005);
  EXPECT_FALSE(world_.is_awake(load_));
}

// What is seen by queries is the new shape at once.
TEST_F(Pedestal, QueriesSeeTheNewShapeAtOnce) {
  must(world_.set_shape(collider_of(world_, load_), sphere(0.25)));
  const auto hit = world_.cast_ray(pos(0.2, 3, 0.2), vec(0, -5, 0));
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->collider, collider_of(world_, foot_));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
