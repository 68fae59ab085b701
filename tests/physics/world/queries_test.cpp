// Proves that every query finds what a look at every single collider finds, in worlds of all
// shapes; that filters, order and ends of range are as documented; that threads, restoring and
// distance from the origin change nothing.
#include <gtest/gtest.h>

#include <atomic>

#include "collision/collide.h"
#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using oracle::Solid;
using oracle::V;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());
constexpr double kSpan = 12;  // [m] worlds reach from -kSpan to kSpan about their middle
// Coordinates of the world are rounded where it stands, shapes in their own frame: a few roundings
// of each, and of the products that place them.
double rounding_at(double distance) {
  return 64 * kEps * kSpan +
         16 * static_cast<double>(std::numeric_limits<PosReal>::epsilon()) * distance;
}

struct Thing {  // one collider, seen on its own
  ColliderId id;
  BodyId body;
  detail::CollisionShape shape;
  V p;  // [m] from the world's middle
  Eigen::Quaterniond q;
  Solid solid;
  V normal = V::Zero();  // half-space
  double offset = 0;
  bool sensor = false;
  std::uint32_t layers = 1;
};

struct Scene {
  PhysicsWorld world;
  V middle;
  std::vector<Thing> things;
};

Shape random_shape(oracle::Random& random, double size) {
  const auto side = [&] { return static_cast<Real>(size * random.uniform(0.15, 1)); };
  switch (random.below(4)) {
    case 0:
      return Sphere{side()};
    case 1:
      return Capsule{side(), side()};
    case 2:
      return Box{Vec3(side(), side(), side())};
    default:
      return ConvexHull{oracle::random_hull(random, 9, size)};
  }
}
Quat random_turn(oracle::Random& random) {
  const detail::Rotation q = random.rotation();
  return Quat(q.w, q.x, q.y, q.z).normalized();
}
Solid placed(const Solid& local, const V& p, const Eigen::Quaterniond& q) {
  Solid s = local;
  for (V& v : s.vertices) v = p + q * v;
  for (V& n : s.normals) n = q * n;
  return s;
}
Solid local_solid(const detail::CollisionShape& shape) {
  return oracle::solid_of(shape, {{0, 0, 0}, {0, 0, 0, 1}});
}

// Where everything stands, from what the world says of it.
void look_at_things(Scene& scene) {
  scene.things.clear();
  std::vector<BodyState> bodies;
  scene.world.copy_body_states(bodies);
  for (const BodyState& body : bodies) {
    for (const ColliderId id : scene.world.colliders_of(body.id)) {
      const Collider collider = scene.world.collider(id);
      Thing thing;
      thing.id = id;
      thing.body = body.id;
      thing.shape = detail::make_collision_shape(collider.shape);
      const Eigen::Quaterniond R = body.pose.orientation.cast<double>().normalized();
      thing.p = body.pose.position.cast<double>() - scene.middle +
                R * collider.pose.position.cast<double>();
      thing.q = (R * collider.pose.orientation.cast<double>()).normalized();
      thing.sensor = collider.is_sensor;
      thing.layers = collider.filter.layers;
      if (const auto* plane = std::get_if<HalfSpace>(&collider.shape)) {
        thing.normal = thing.q * plane->normal.cast<double>().normalized();
        thing.offset = static_cast<double>(plane->offset) + thing.normal.dot(thing.p);
      } else {
        thing.solid = placed(local_solid(thing.shape), thing.p, thing.q);
      }
      scene.things.push_back(thing);
    }
  }
  std::sort(scene.things.begin(), scene.things.end(),
            [](const Thing& a, const Thing& b) { return a.id < b.id; });
}

// Bodies of all kinds about a middle, some with several colliders, some moved on by a few steps.
void build(Scene& scene, unsigned seed, const V& middle = V::Zero(), int count = 120) {
  oracle::Random random(seed);
  scene.middle = middle;
  must(scene.world.set_settings(no_gravity()));
  for (int i = 0; i < count; ++i) {
    const V p =
        middle + kSpan * V(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    RigidBody body = body_at(at(p, random_turn(random)));
    body.type = std::array{MotionType::Static, MotionType::Dynamic,
                           MotionType::Kinematic}[static_cast<std::size_t>(i % 3)];
    if (body.type == MotionType::Dynamic) body.linear_velocity = vec(2 * random.direction());
    const BodyId id = must(scene.world.create_body(body));
    for (int k = random.below(3); k >= 0; --k) {
      Collider collider = with(random_shape(random, random.uniform(0.3, 1.5)));
      collider.pose.position = vec(random.uniform(0, 1) * random.direction());
      collider.pose.orientation = random_turn(random);
      collider.is_sensor = random.below(8) == 0;
      collider.filter.layers = 1u << random.below(3);
      collider.filter.collides_with = 0;  // nothing pushes
      must(scene.world.create_collider(id, collider));
    }
  }
  Collider ground = with(HalfSpace{vec(0.1, 1, 0), real(-kSpan / 2)});
  const V foot = middle;
  add(scene.world, body_at(at(foot, Quat::Identity()), MotionType::Static), ground);
  for (int i = 0; i < 5; ++i) scene.world.step(1.0 / 60);
  look_at_things(scene);
}

double signed_distance(const Thing& thing, const Solid& query) {
  if (thing.normal.squaredNorm() > 0) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const V& v : query.vertices) lowest = std::min(lowest, thing.normal.dot(v));
    return lowest - query.radius - thing.offset;
  }
  return oracle::signed_distance(thing.solid, query);
}
Solid point_solid(const V& p) {
  Solid s;
  s.vertices = {p};
  return s;
}

// The collider alone, by the routine for single shapes (proven in cast_ray_test).
bool hits_alone(const Thing& thing, const V& origin, const V& path, double& fraction) {
  const detail::NumRotation q{thing.q.x(), thing.q.y(), thing.q.z(), thing.q.w()};
  const V o = origin - thing.p;
  detail::NumRayHit hit;
  if (!detail::cast_ray(thing.shape, q, {o.x(), o.y(), o.z()}, {path.x(), path.y(), path.z()}, 1,
                        hit))
    return false;
  fraction = hit.fraction;
  return true;
}

bool seen(const Thing& thing, const QueryFilter& filter) {
  return (thing.layers & filter.layers) != 0 && (!thing.sensor || filter.sensors) &&
         (filter.ignore.is_null() || thing.body != filter.ignore);
}

struct RandomRay {
  V origin, path;  // from the world's middle
};
RandomRay random_ray(oracle::Random& random) {
  const V from =
      kSpan * V(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
  const V to = kSpan * V(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return {from, random.uniform(0.1, 2) * (to - from)};
}
// As a world that stands at the scene's middle can be given them.
RandomRay as_given(const Scene& scene, const RandomRay& ray) {
  return {pos(V(scene.middle + ray.origin)).cast<double>() - scene.middle,
          vec(ray.path).cast<double>()};
}

void compare_rays(const Scene& scene, unsigned seed, const QueryFilter& filter, double tolerance) {
  oracle::Random random(seed);
  int hits = 0, blocked = 0;
  for (int i = 0; i < 1500; ++i) {
    const RandomRay ray = as_given(scene, random_ray(random));
    const Pos3 origin = pos(V(scene.middle + ray.origin));
    const Vec3 path = vec(ray.path);
    std::vector<std::pair<double, ColliderId>> truth;
    for (const Thing& thing : scene.things) {
      double fraction = 0;
      if (seen(thing, filter) && hits_alone(thing, ray.origin, ray.path, fraction))
        truth.emplace_back(fraction, thing.id);
    }
    std::sort(truth.begin(), truth.end());
    const auto nearest = scene.world.cast_ray(origin, path, filter);
    ASSERT_EQ(nearest.has_value(), !truth.empty()) << "ray " << i;
    ASSERT_EQ(scene.world.ray_is_blocked(origin, path, filter), !truth.empty()) << "ray " << i;
    std::vector<RayHitResult> all;
    scene.world.cast_ray_all(origin, path, all, filter);
    ASSERT_EQ(all.size(), truth.size()) << "ray " << i;
    for (std::size_t k = 0; k < all.size(); ++k) {
      // A ray that grazes goes far along the surface for a little across it.
      const double into = std::abs(all[k].normal.cast<double>().dot(ray.path));
      const double along = tolerance / std::max(into, 1e-3 * ray.path.norm());
      EXPECT_NEAR(all[k].fraction, truth[k].first, along);
      if (k > 0) {
        EXPECT_TRUE(
            all[k - 1].fraction < all[k].fraction ||
            (all[k - 1].fraction == all[k].fraction && all[k - 1].collider < all[k].collider));
      }
    }
    blocked += truth.size() > 1 ? 1 : 0;
    if (truth.empty()) continue;
    ++hits;
    EXPECT_EQ(nearest->collider, all[0].collider);
    EXPECT_EQ(nearest->fraction, all[0].fraction);
    EXPECT_EQ(nearest->body, scene.world.body_of(nearest->collider));
    const V there = nearest->point.cast<double>() - scene.middle;
    EXPECT_LE((there - ray.origin - static_cast<double>(nearest->fraction) * ray.path).norm(),
              tolerance);
    EXPECT_NEAR(nearest->normal.cast<double>().norm(), 1, 4 * kEps);
  }
  EXPECT_GT(hits, 300);
  EXPECT_GT(blocked, 100);
}

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
