// Proves that rays find what a look at every single collider finds, in worlds of all shapes; that
// filters, order and ends of range are as documented.
#include <gtest/gtest.h>

#include <atomic>

#include "support/query_scene.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace query_scene;
constexpr double kEps = query_scene::kEps;

TEST(Queries, RaysFindWhatEveryColliderAloneFinds) {
  for (unsigned seed : {1u, 2u}) {
    Scene scene;
    build(scene, seed);
    QueryFilter filter;
    compare_rays(scene, 10 + seed, filter, rounding_at(0));
    filter.sensors = true;
    filter.layers = 5;
    filter.ignore = scene.things[7].body;
    compare_rays(scene, 20 + seed, filter, rounding_at(0));
  }
}

// Positions of single precision get coarse at some kilometres; of double they do not in any world.
TEST(Queries, FarFromTheOriginNothingChanges) {
  const double far = std::is_same_v<PosReal, float> ? 1e3 : 1e6;
  Scene scene;
  build(scene, 3, far * V(1, -2, 0.5));
  compare_rays(scene, 30, {}, rounding_at(2 * far));
}

TEST(Queries, RaysThatStartInsideHaveNoLengthOrNoNumber) {
  PhysicsWorld world(no_gravity());
  const BodyId ball = add(world, body_at(at(0, 0, 0), MotionType::Static), with(sphere(1)));
  const auto inside = world.cast_ray(pos(0.5, 0, 0), vec(3, 4, 0));
  ASSERT_TRUE(inside.has_value());
  EXPECT_EQ(inside->fraction, Real(0));
  EXPECT_EQ(inside->body, ball);
  EXPECT_LE((inside->normal - vec(-0.6, -0.8, 0)).norm(), Real(4 * kEps));
  EXPECT_TRUE(world.cast_ray(pos(0.5, 0, 0), vec(0, 0, 0)).has_value());
  EXPECT_TRUE(world.ray_is_blocked(pos(0.5, 0, 0), vec(0, 0, 0)));
  EXPECT_FALSE(world.cast_ray(pos(2, 0, 0), vec(0, 0, 0)).has_value());
  EXPECT_TRUE(world.cast_ray(pos(3, 0, 0), vec(-2, 0, 0)).has_value());  // ends on the surface
  std::vector<RayHitResult> all{RayHitResult{}};
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(world.cast_ray(pos(bad, 0, 0), vec(1, 0, 0)).has_value());
    EXPECT_FALSE(world.cast_ray(pos(0, 0, 0), vec(0, bad, 0)).has_value());
    EXPECT_FALSE(world.ray_is_blocked(pos(0, 0, 0), vec(0, bad, 0)));
    world.cast_ray_all(pos(0, 0, bad), vec(1, 0, 0), all);
    EXPECT_TRUE(all.empty());
    EXPECT_FALSE(world.closest_point(pos(bad, 0, 0), 10).has_value());
    EXPECT_FALSE(world.closest_point(pos(0, 0, 0), real(-1)).has_value());
    ShapeCast cast;
    cast.rotation = vec(0, bad, 0);
    EXPECT_FALSE(world.cast_shape(cast).has_value());
    std::vector<ColliderId> found{ColliderId{}};
    world.overlap_shape(sphere(bad), Pose{}, found);
    EXPECT_TRUE(found.empty());
  }
  std::vector<ColliderId> found;
  world.overlap_shape(HalfSpace{}, Pose{}, found);  // not a shape to ask with
  EXPECT_TRUE(found.empty());
}

TEST(Queries, OfEqualsTheSmallerIdIsTheNearest) {
  PhysicsWorld world(no_gravity());
  std::vector<ColliderId> ids;
  for (const double y : {3.0, -3.0, 0.0, 1.0, 2.0}) {
    const BodyId body = must(world.create_body(body_at(at(0, 0, y), MotionType::Static)));
    ids.push_back(must(world.create_collider(body, with(box(1, 1, 5)))));
  }
  std::vector<RayHitResult> all;
  world.cast_ray_all(pos(-4, 0, 0), vec(8, 0, 0), all);
  ASSERT_EQ(all.size(), ids.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].collider, ids[i]);
    EXPECT_EQ(all[i].fraction, Real(3) / 8);
  }
  EXPECT_EQ(world.cast_ray(pos(-4, 0, 0), vec(8, 0, 0))->collider, ids[0]);
  EXPECT_EQ(world.cast_ray(pos(0, 0, 0), vec(8, 0, 0))->collider, ids[0]);  // inside all of them
  EXPECT_EQ(world.closest_point(pos(-4, 0, 0), 10)->collider, ids[0]);
  ShapeCast cast{sphere(0.5), at(-4, 0, 0), vec(8, 0, 0), vec(0, 0, 0)};
  EXPECT_EQ(world.cast_shape(cast)->collider, ids[0]);
  std::vector<ColliderId> found;
  world.overlap_shape(sphere(0.5), at(0, 0, 0), found);
  EXPECT_EQ(found, ids);
}

bool accept_odd(const PhysicsWorld& world, ColliderId collider, void* context) {
  ++*static_cast<std::atomic<int>*>(context);
  return world.collider(collider).user_data % 2 == 1;
}

TEST(Queries, ThePredicateHasTheLastWord) {
  PhysicsWorld world(no_gravity());
  std::vector<ColliderId> ids;
  for (int i = 0; i < 10; ++i) {
    Collider collider = with(sphere(0.4));
    collider.user_data = static_cast<std::uint64_t>(i);
    const BodyId body = must(world.create_body(body_at(at(i, 0, 0), MotionType::Static)));
    ids.push_back(must(world.create_collider(body, collider)));
  }
  std::atomic<int> asked = 0;
  QueryFilter filter;
  filter.accept = accept_odd;
  filter.context = &asked;
  EXPECT_EQ(world.cast_ray(pos(-2, 0, 0), vec(20, 0, 0), filter)->collider, ids[1]);
  std::vector<RayHitResult> all;
  world.cast_ray_all(pos(-2, 0, 0), vec(20, 0, 0), all, filter);
  EXPECT_EQ(all.size(), 5u);
  EXPECT_FALSE(world.ray_is_blocked(pos(-2, 0, 0), vec(2, 0, 0), filter));
  EXPECT_EQ(world.closest_point(pos(-2, 0, 0), 20, filter)->collider, ids[1]);
  ShapeCast cast{sphere(0.1), at(-2, 0, 0), vec(20, 0, 0), vec(0, 0, 0)};
  EXPECT_EQ(world.cast_shape(cast, filter)->collider, ids[1]);
  std::vector<ColliderId> found;
  world.overlap_bounds({pos(-9, -9, -9), pos(20, 9, 9)}, found, filter);
  EXPECT_EQ(found.size(), 5u);
  EXPECT_GT(asked, 10);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
