// Proves who meets whom: groups over layers and masks, pairs excluded by name over both, changed
// between steps with what follows from it.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// Two balls flying at each other: whether they have met.
bool meet(const Filter& a, const Filter& b) {
  PhysicsWorld world(no_gravity());
  Collider left = with(sphere(0.5)), right = with(sphere(0.5));
  left.filter = a;
  right.filter = b;
  const BodyId one = add(world, moving(at(-1, 0, 0), vec(2, 0, 0)), left);
  add(world, moving(at(1, 0, 0), vec(-2, 0, 0)), right);
  run(world, 1);
  return std::abs(velocity(world, one).x() - 2) > 0.5;
}

TEST(PairFilter, GroupsComeBeforeLayersAndMasks) {
  const Filter plain, blind{1, 0, 0};
  EXPECT_TRUE(meet(plain, plain));
  EXPECT_FALSE(meet(plain, blind));
  const auto grouped = [](Filter filter, std::int32_t group) {
    filter.group = group;
    return filter;
  };
  EXPECT_FALSE(meet(grouped(plain, -3), grouped(plain, -3)));
  EXPECT_TRUE(meet(grouped(blind, 3), grouped(blind, 3)));
  EXPECT_TRUE(meet(grouped(plain, -3), grouped(plain, -4)));
  EXPECT_TRUE(meet(grouped(plain, -3), plain));
  EXPECT_FALSE(meet(grouped(blind, 3), grouped(plain, 4)));
  EXPECT_FALSE(meet(grouped(blind, 3), grouped(plain, -3)));
}

// A body sleeps on a shelf above the ground; the pair of body and shelf is excluded and let again.
class Shelf : public ::testing::Test {
 protected:
  Shelf() {
    add_floor(world_);
    shelf_ = add(world_, body_at(at(0, 2, 0), MotionType::Static), with(box(1, 0.1, 1)));
    body_ = add(world_, body_at(at(0, 2.35, 0)), with(cube(0.25)));
    other_ = add(world_, body_at(at(0.6, 2.35, 0)), with(cube(0.25)));
    run(world_, 3);
  }
  void SetUp() override { ASSERT_FALSE(world_.is_awake(body_)); }
  [[nodiscard]] ColliderId collider(BodyId body) const { return world_.colliders_of(body)[0]; }
  void expect_fallen_alone() {
    EXPECT_TRUE(world_.is_awake(body_));
    int ended = 0;
    run(world_, 3, kDt, [&] {
      for (const ContactEvent& event : world_.events().contacts)
        ended += event.kind == ContactEvent::Kind::End &&
                         (event.body_a == shelf_ || event.body_b == shelf_)
                     ? 1
                     : 0;
    });
    EXPECT_EQ(ended, 1);
    EXPECT_NEAR(position(world_, body_).y(), 0.25, 0.01);
    EXPECT_NEAR(position(world_, other_).y(), 2.35, 0.01);
  }
  void expect_stopped_by_the_shelf() {
    must(world_.set_pose(body_, at(0, 3, 0)));
    run(world_, 3);
    EXPECT_NEAR(position(world_, body_).y(), 2.35, 0.01);
  }
  PhysicsWorld world_;
  BodyId shelf_, body_, other_;
};

TEST_F(Shelf, AnExcludedPairOfBodiesNeverMeets) {
  must(world_.exclude_pair(body_, shelf_));
  EXPECT_TRUE(world_.is_excluded(shelf_, body_));
  EXPECT_FALSE(world_.is_excluded(shelf_, other_));
  expect_fallen_alone();
  must(world_.exclude_pair(shelf_, body_, false));
  EXPECT_FALSE(world_.is_excluded(shelf_, body_));
  expect_stopped_by_the_shelf();
}

TEST_F(Shelf, AnExcludedPairOfCollidersNeverMeets) {
  must(world_.exclude_pair(collider(shelf_), collider(body_)));
  EXPECT_TRUE(world_.is_excluded(collider(body_), collider(shelf_)));
  EXPECT_FALSE(world_.is_excluded(body_, shelf_));
  expect_fallen_alone();
  must(world_.exclude_pair(collider(shelf_), collider(body_), false));
  expect_stopped_by_the_shelf();
}

TEST_F(Shelf, AFilterCanBeChanged) {
  Filter filter;
  filter.layers = 2;
  filter.collides_with = 1;
  Filter blind;
  blind.collides_with = ~2u;
  must(world_.set_filter(collider(body_), filter));
  must(world_.set_filter(collider(shelf_), blind));
  expect_fallen_alone();
  must(world_.set_filter(collider(shelf_), Filter{}));
  expect_stopped_by_the_shelf();
}

// Lifted while the two overlap, the ban ends as with any overlap: they are pushed apart.
TEST_F(Shelf, ExclusionsEndWithTheirMembers) {
  must(world_.exclude_pair(body_, shelf_));
  const BodyId gone = body_;
  must(world_.destroy_body(body_));
  EXPECT_FALSE(world_.is_excluded(gone, shelf_));
  body_ = add(world_, body_at(at(0, 3, 0)), with(cube(0.25)));
  ASSERT_EQ(body_.index, gone.index);  // the same place, another body
  run(world_, 3);
  EXPECT_NEAR(position(world_, body_).y(), 2.35, 0.01);
}

// Fast bodies do not stop at what they may not meet; sensors do not see it.
TEST(PairFilter, ExclusionHoldsForFastBodiesAndSensors) {
  PhysicsWorld world(no_gravity());
  const BodyId wall = add(world, body_at(at(5, 0, 0), MotionType::Static), with(box(0.05, 5, 5)));
  Collider sensor = with(cube(1));
  sensor.is_sensor = true;
  const BodyId zone = add(world, body_at(at(8, 0, 0), MotionType::Static), sensor);
  RigidBody shot = moving(at(0, 0, 0), vec(200, 0, 0), vec(5, 40, 30));
  shot.continuous = true;
  const BodyId bullet = add(world, shot, with(box(0.1, 0.2, 0.3)));
  must(world.exclude_pair(bullet, wall));
  must(world.exclude_pair(bullet, zone));
  const double far = kDt * 200;
  run(world, 0.5, kDt / 8, [&] { EXPECT_TRUE(world.events().sensors.empty()); });
  EXPECT_GT(position(world, bullet).x(), 10 + far);
}

TEST(PairFilter, BadPairsAreRefused) {
  PhysicsWorld world;
  const BodyId a = add(world, body_at(at(0, 0, 0)), with(cube(0.5)));
  const BodyId b = add(world, body_at(at(5, 0, 0)), with(cube(0.5)));
  EXPECT_EQ(world.exclude_pair(a, a).code, StatusCode::OutOfRange);
  EXPECT_EQ(world.exclude_pair(a, BodyId{}).code, StatusCode::StaleHandle);
  const ColliderId c = world.colliders_of(a)[0], d = world.colliders_of(b)[0];
  EXPECT_EQ(world.exclude_pair(c, c).code, StatusCode::OutOfRange);
  EXPECT_EQ(world.exclude_pair(ColliderId{}, d).code, StatusCode::StaleHandle);
  must(world.destroy_body(b));
  EXPECT_EQ(world.exclude_pair(a, b).code, StatusCode::StaleHandle);
  EXPECT_EQ(world.exclude_pair(c, d).code, StatusCode::StaleHandle);
  EXPECT_EQ(world.set_filter(d, {}).code, StatusCode::StaleHandle);
  EXPECT_FALSE(world.is_excluded(a, b));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
