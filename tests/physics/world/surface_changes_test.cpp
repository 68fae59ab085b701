// Proves that a living collider's surface can change: contacts that exist take the new friction,
// restitution, kind and side in the next step, asleep or awake.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

ColliderId collider_of(const PhysicsWorld& world, BodyId body) {
  return world.colliders_of(body)[0];
}

// A block asleep on a slope of 30 degrees slides with g (sin - mu cos) as soon as mu is small.
class Block : public ::testing::Test {
 protected:
  Block()
      : built_(build_slope(world_, {.friction = 0.9, .shape = box(0.5, 0.2, 0.5), .height = 0.2})) {
    run(world_, 3);
  }
  void SetUp() override { ASSERT_FALSE(world_.is_awake(built_.body)); }
  void expect_sliding(double friction) {
    EXPECT_TRUE(world_.is_awake(built_.body));
    run(world_, 1);
    const double a = kGravity * (std::sin(kPi / 6) - friction * std::cos(kPi / 6));
    EXPECT_NEAR(velocity(world_, built_.body).dot(built_.down), a, 0.02 * a);
  }
  PhysicsWorld world_;
  OnSlope built_;
};

TEST_F(Block, SlidesWhenItsFrictionFalls) {
  Material slick = material(0.1);
  slick.friction_rule = CombineRule::Minimum;
  must(world_.set_material(collider_of(world_, built_.body), slick));
  EXPECT_EQ(world_.collider(collider_of(world_, built_.body)).material.friction, real(0.1));
  expect_sliding(0.1);
}

TEST_F(Block, SlidesWhenTheGroundGetsSlippery) {
  Material slick = material(0.2);
  slick.friction_rule = CombineRule::Minimum;
  must(world_.set_material(collider_of(world_, built_.ground), slick));
  expect_sliding(0.2);
}

TEST_F(Block, SlidesWhenItsKindBecomesOneOfTheTable) {
  Material ground = material(0.9), body = material(0.9);
  ground.kind = 3;
  body.kind = 5;
  must(world_.set_material(collider_of(world_, built_.ground), ground));
  must(world_.set_material_pair(3, 5, MaterialPair{.friction = real(0.05)}));
  run(world_, 3);
  ASSERT_FALSE(world_.is_awake(built_.body));
  must(world_.set_material(collider_of(world_, built_.body), body));
  expect_sliding(0.05);
}

TEST(SurfaceChanges, RestitutionCounts) {
  PhysicsWorld world;
  add_floor(world, material(0.5));
  const BodyId ball = add(world, body_at(at(0, 2, 0)), with(sphere(0.2), material(0.5)));
  run(world, 0.2);
  must(world.set_material(collider_of(world, ball), material(0.5, 1)));
  double highest = 0;
  run(world, 2, kDt, [&] {
    if (velocity(world, ball).y() > 0) highest = std::max(highest, position(world, ball).y());
  });
  EXPECT_NEAR(highest, 2, 0.02);
}

TEST(SurfaceChanges, RollingFrictionThatComesLaterStopsTheBall) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId ball =
      add(world, moving(at(0, 0.5, 0), vec(1, 0, 0), vec(0, 0, -2)), with(sphere(0.5)));
  run(world, 0.5);
  ASSERT_NEAR(velocity(world, ball).x(), 1, 1e-3);
  Material dull = world.collider(collider_of(world, ball)).material;
  dull.rolling_friction = real(0.05);
  must(world.set_material(collider_of(world, ball), dull));
  run(world, 3);
  EXPECT_NEAR(velocity(world, ball).x(), 0, bar(1e-6, 1e-4));
}

// A shelf that becomes solid from below only drops what slept on it; one that is turned while it
// holds something goes on holding it.
TEST(SurfaceChanges, TheSolidSideCanBeChosenLater) {
  PhysicsWorld world;
  add_floor(world);
  BodyId shelves[2], boxes[2];
  for (int i = 0; i < 2; ++i) {
    Collider shelf = with(box(1, 0.1, 1));
    if (i == 1) shelf.one_way = vec(0, 1, 0);
    shelves[i] = add(world, body_at(at(5.0 * i, 2, 0), MotionType::Static), shelf);
    boxes[i] = add(world, body_at(at(5.0 * i, 2.35, 0)), with(cube(0.25)));
  }
  run(world, 3);
  for (int i = 0; i < 2; ++i) {
    ASSERT_FALSE(world.is_awake(boxes[i]));
    must(world.set_one_way(collider_of(world, shelves[i]), vec(0, -3, 0)));
    EXPECT_TRUE(world.is_awake(boxes[i]));
    EXPECT_EQ(world.collider(collider_of(world, shelves[i])).one_way, vec(0, -1, 0));
  }
  run(world, 3);
  EXPECT_NEAR(position(world, boxes[0]).y(), 0.25, 0.01);
  EXPECT_NEAR(position(world, boxes[1]).y(), 2.35, 0.01);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
