// Proves that every query finds what a look at every single collider finds, in worlds of all
// shapes; that filters, order and ends of range are as documented; that threads, restoring and
// distance from the origin change nothing.
#include <gtest/gtest.h>

#include <atomic>

#include "support/query_scene.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace query_scene;
constexpr double kEps = query_scene::kEps;

TEST(Queries, OverlapsAreThoseOfEveryPair) {
  Scene scene;
  build(scene, 4);
  oracle::Random random(41);
  int overlapping = 0;
  for (int i = 0; i < 250; ++i) {
    const Shape shape = random_shape(random, random.uniform(0.2, 3));
    const Pose pose =
        at(V(kSpan * V(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))),
           random_turn(random));
    QueryFilter filter;
    filter.sensors = i % 2 == 0;
    filter.layers = i % 3 == 0 ? 3 : 7;
    const Solid query = placed(local_solid(detail::make_collision_shape(shape)),
                               pose.position.cast<double>(), pose.orientation.cast<double>());
    std::vector<ColliderId> found;
    scene.world.overlap_shape(shape, pose, found, filter);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (const Thing& thing : scene.things) {
      const bool is_found = std::binary_search(found.begin(), found.end(), thing.id);
      if (!seen(thing, filter)) {
        EXPECT_FALSE(is_found);
        continue;
      }
      const double d = signed_distance(thing, query);
      if (std::abs(d) <= rounding_at(0)) continue;  // rounding decides
      ASSERT_EQ(is_found, d < 0) << "query " << i << " distance " << d;
      overlapping += d < 0 ? 1 : 0;
    }
  }
  EXPECT_GT(overlapping, 100);
}

TEST(Queries, NearestPointsAreThoseOfEveryCollider) {
  Scene scene;
  build(scene, 5);
  oracle::Random random(51);
  int inside = 0, outside = 0, nothing = 0;
  for (int i = 0; i < 250; ++i) {
    const bool is_point = i % 2 == 0;
    const Shape shape = random_shape(random, random.uniform(0.1, 1));
    const Pose pose =
        at(V(kSpan * V(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))),
           random_turn(random));
    const double reach = random.uniform(0.2, 4);
    const V p = pose.position.cast<double>();
    const Solid query = is_point ? point_solid(p)
                                 : placed(local_solid(detail::make_collision_shape(shape)), p,
                                          pose.orientation.cast<double>());
    double truth = std::numeric_limits<double>::infinity();
    std::size_t within = 0, border = 0;
    for (const Thing& thing : scene.things) {
      if (!seen(thing, {})) continue;
      const double d = signed_distance(thing, query);
      truth = std::min(truth, d);
      within += d <= reach ? 1 : 0;
      border += std::abs(d - reach) <= rounding_at(0) ? 1 : 0;
    }
    const auto found = is_point ? scene.world.closest_point(pose.position, real(reach))
                                : scene.world.closest_point(shape, pose, real(reach));
    std::vector<ClosestPointResult> all;
    if (is_point) {
      scene.world.closest_points(pose.position, real(reach), all);
    } else {
      scene.world.closest_points(shape, pose, real(reach), all);
    }
    if (border == 0) {
      ASSERT_EQ(all.size(), within) << "query " << i;
    }
    if (std::abs(truth - reach) <= rounding_at(0)) continue;
    ASSERT_EQ(found.has_value(), truth < reach) << "query " << i << " distance " << truth;
    if (!found) {
      ++nothing;
      continue;
    }
    ++(truth < 0 ? inside : outside);
    EXPECT_EQ(found->collider, all[0].collider);
    EXPECT_NEAR(found->distance, truth, rounding_at(0)) << "query " << i;
    // The two points are that far apart along the normal, and on both surfaces.
    const V a = found->on_collider.cast<double>(), b = found->on_query.cast<double>();
    EXPECT_LE((b - a - static_cast<double>(found->distance) * found->normal.cast<double>()).norm(),
              rounding_at(0));
    const auto thing = std::find_if(scene.things.begin(), scene.things.end(),
                                    [&](const Thing& t) { return t.id == found->collider; });
    EXPECT_NEAR(signed_distance(*thing, point_solid(a)), 0, 2 * rounding_at(0));
    EXPECT_NEAR(oracle::signed_distance(b, query), 0, 2 * rounding_at(0));
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 40);
  EXPECT_GT(nothing, 10);
}

// The solid of a cast shape at a part of its way.
Solid cast_at(const Solid& local, const ShapeCast& cast, double t) {
  const V turn = t * cast.rotation.cast<double>();
  Eigen::Quaterniond q = cast.start.orientation.cast<double>();
  if (turn.norm() > 0)
    q = Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * q;
  return placed(local, cast.start.position.cast<double>() + t * cast.translation.cast<double>(),
                q.normalized());
}

TEST(Queries, MovingShapesStopAtWhatTheyMeetFirst) {
  Scene scene;
  build(scene, 6, V::Zero(), 60);
  oracle::Random random(61);
  int met = 0, free = 0, overlapping = 0;
  for (int i = 0; i < 80; ++i) {
    const RandomRay path = random_ray(random);
    ShapeCast cast{random_shape(random, random.uniform(0.1, 1)),
                   at(path.origin, random_turn(random)), vec(path.path), vec(0, 0, 0)};
    if (i % 2 == 0) cast.rotation = vec(random.uniform(0, 5) * random.direction());
    const detail::CollisionShape shape = detail::make_collision_shape(cast.shape);
    const Solid local = local_solid(shape);
    // A thousandth of the thinner shape's thickness is the documented rest.
    const double rest = 1e-3 * static_cast<double>(smallest_thickness(shape)) + rounding_at(0);
    const auto hit = scene.world.cast_shape(cast);
    std::vector<ShapeHitResult> all;
    scene.world.cast_shape_all(cast, all);
    ASSERT_EQ(hit.has_value(), !all.empty());
    if (hit) {
      EXPECT_EQ(hit->collider, all[0].collider);
      EXPECT_EQ(hit->fraction, all[0].fraction);
    }
    const double until = hit ? static_cast<double>(hit->fraction) : 1;
    double start = std::numeric_limits<double>::infinity();
    for (const Thing& thing : scene.things) {
      if (!seen(thing, {})) continue;
      const double first = signed_distance(thing, cast_at(local, cast, 0));
      start = std::min(start, first);
      if (first < rest) continue;
      for (int k = 0; k <= 20; ++k)
        ASSERT_GE(signed_distance(thing, cast_at(local, cast, until * k / 20)), -rounding_at(0))
            << "cast " << i << " of " << until;
    }
    if (!hit) {
      ++free;
      EXPECT_GT(start, -rounding_at(0));
      continue;
    }
    const auto thing = std::find_if(scene.things.begin(), scene.things.end(),
                                    [&](const Thing& t) { return t.id == hit->collider; });
    const double there = signed_distance(*thing, cast_at(local, cast, until));
    if (start < -rounding_at(0)) {
      ++overlapping;
      EXPECT_EQ(hit->fraction, Real(0));
      EXPECT_NEAR(hit->separation, there, 2 * rounding_at(0));
      EXPECT_LT(hit->separation, Real(0));
    } else if (start > rest) {
      ++met;
      EXPECT_LE(there, rest) << "cast " << i;
      EXPECT_LT(
          hit->normal.cast<double>().dot(cast.translation.cast<double>()) - (i % 2 == 0 ? 1e3 : 0),
          0);
    }
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(free, 4);
  EXPECT_GT(overlapping, 2);
}

// What a character does all the time: it stands on the ground and slides along it.
TEST(Queries, AShapeThatTouchesMayMoveAlongAndAway) {
  PhysicsWorld world(no_gravity());
  add(world, body_at(at(0, -1, 0), MotionType::Static), with(box(50, 1, 50)));
  ShapeCast cast{box(0.5, 0.5, 0.5), at(0, 0.5, 0), vec(10, 0, 0), vec(0, 0, 0)};
  EXPECT_FALSE(world.cast_shape(cast).has_value());
  cast.translation = vec(0, 3, 0);
  EXPECT_FALSE(world.cast_shape(cast).has_value());
  cast.translation = vec(0, -3, 0);
  ASSERT_TRUE(world.cast_shape(cast).has_value());
  EXPECT_LE(world.cast_shape(cast)->fraction, Real(1e-3));
  EXPECT_GT(world.cast_shape(cast)->normal.y(), Real(0.99));
  cast.start = at(0, 0.4, 0);
  EXPECT_EQ(world.cast_shape(cast)->fraction, Real(0));
  EXPECT_NEAR(world.cast_shape(cast)->separation, -0.1, 16 * kEps);
}

template <class Hit>
bool same_hit(const Hit& a, const Hit& b) {
  return a.collider == b.collider && a.body == b.body && a.fraction == b.fraction &&
         a.point == b.point && a.normal == b.normal;
}

TEST(Queries, BatchesThreadsAndRestoredWorldsGiveTheSameBits) {
  Scene scene;
  build(scene, 7);
  PhysicsWorld restored;
  must(restored.restore(scene.world.save()));
  const auto pool = make_thread_pool(4);
  oracle::Random random(71);
  std::vector<Ray> rays(3000);
  std::vector<ShapeCast> casts(300);
  std::vector<Pos3> points(1000);
  for (Ray& ray : rays) {
    const RandomRay r = random_ray(random);
    ray = {pos(r.origin), vec(r.path)};
  }
  for (ShapeCast& cast : casts) {
    const RandomRay r = random_ray(random);
    cast = {random_shape(random, 0.5), at(r.origin, random_turn(random)), vec(r.path),
            vec(random.direction())};
  }
  for (Pos3& point : points) point = pos(random_ray(random).origin);
  std::vector<RayHitResult> hits[3];
  std::vector<ShapeHitResult> shape_hits[3];
  std::vector<ClosestPointResult> nearest[3];
  const std::uint64_t hash = scene.world.state_hash();
  for (int run = 0; run < 3; ++run) {
    const PhysicsWorld& world = run == 2 ? restored : scene.world;
    JobSystem* jobs = run == 0 ? nullptr : pool.get();
    hits[run].resize(rays.size());
    shape_hits[run].resize(casts.size());
    nearest[run].resize(points.size());
    must(world.cast_rays(rays, hits[run], {}, jobs));
    must(world.cast_shapes(casts, shape_hits[run], {}, jobs));
    must(world.closest_points(points, 5, nearest[run], {}, jobs));
  }
  int found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto one = scene.world.cast_ray(rays[i].origin, rays[i].translation);
    ASSERT_TRUE(same_hit(hits[0][i], one.value_or(RayHitResult{})));
    ASSERT_TRUE(same_hit(hits[0][i], hits[1][i]));
    ASSERT_TRUE(same_hit(hits[0][i], hits[2][i]));
    found += one.has_value() ? 1 : 0;
  }
  for (std::size_t i = 0; i < casts.size(); ++i) {
    ASSERT_TRUE(
        same_hit(shape_hits[0][i], scene.world.cast_shape(casts[i]).value_or(ShapeHitResult{})));
    ASSERT_TRUE(same_hit(shape_hits[0][i], shape_hits[1][i]));
    ASSERT_TRUE(same_hit(shape_hits[0][i], shape_hits[2][i]));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int run = 1; run < 3; ++run) {
      ASSERT_EQ(nearest[0][i].collider, nearest[run][i].collider);
      ASSERT_EQ(nearest[0][i].distance, nearest[run][i].distance);
      ASSERT_EQ(nearest[0][i].on_collider, nearest[run][i].on_collider);
    }
  }
  EXPECT_GT(found, 500);
  EXPECT_EQ(scene.world.state_hash(), hash);
  EXPECT_FALSE(scene.world.cast_rays(rays, std::span(hits[0]).first(5)).ok());
}

TEST(Queries, AKinematicBodyArrivesAtItsTarget) {
  PhysicsWorld world;
  const BodyId lift = add(world, body_at(at(1, 2, 3), MotionType::Kinematic), with(box(1, 0.1, 1)));
  oracle::Random random(8);
  for (int i = 0; i < 50; ++i) {
    const Pose target = at(V(5 * random.direction()), random_turn(random));
    must(world.move_kinematic(lift, target, 1.0 / 60));
    world.step(1.0 / 60);
    const Pose there = world.pose(lift);
    EXPECT_LE((there.position - target.position).template cast<double>().norm(), 64 * kEps * 10);
    EXPECT_LE(static_cast<double>(there.orientation.angularDistance(target.orientation)),
              std::sqrt(kEps));  // what acos leaves of a rounding near 1
  }
  EXPECT_FALSE(world.move_kinematic(lift, Pose{}, 0).ok());
  EXPECT_FALSE(world.move_kinematic(BodyId{}, Pose{}, 1).ok());
  const BodyId ball = add(world, body_at(at(9, 9, 9)), with(sphere(1)));
  EXPECT_EQ(world.move_kinematic(ball, Pose{}, 1).code, StatusCode::WrongMotionType);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
