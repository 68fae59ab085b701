// Worlds of all shapes for tests of queries, each collider also seen on its own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "collision/collide.h"
#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace query_scene {

using namespace testing_support;
using oracle::Solid;
using oracle::V;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());
constexpr double kSpan = 12;  // [m] worlds reach from -kSpan to kSpan about their middle
// Coordinates of the world are rounded where it stands, shapes in their own frame: a few roundings
// of each, and of the products that place them.
inline double rounding_at(double distance) {
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

inline Shape random_shape(oracle::Random& random, double size) {
  return oracle::random_shape(random, random.below(4), size, 0.15, 9);
}
inline Quat random_turn(oracle::Random& random) {
  const detail::Rotation q = random.rotation();
  return Quat(q.w, q.x, q.y, q.z).normalized();
}
inline Solid placed(const Solid& local, const V& p, const Eigen::Quaterniond& q) {
  Solid s = local;
  for (V& v : s.vertices) v = p + q * v;
  for (V& n : s.normals) n = q * n;
  return s;
}
inline Solid local_solid(const detail::CollisionShape& shape) {
  return oracle::solid_of(shape, {{0, 0, 0}, {0, 0, 0, 1}});
}

// Where everything stands, from what the world says of it.
inline void look_at_things(Scene& scene) {
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
inline void build(Scene& scene, unsigned seed, const V& middle = V::Zero(), int count = 120) {
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

inline double signed_distance(const Thing& thing, const Solid& query) {
  if (thing.normal.squaredNorm() > 0) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const V& v : query.vertices) lowest = std::min(lowest, thing.normal.dot(v));
    return lowest - query.radius - thing.offset;
  }
  return oracle::signed_distance(thing.solid, query);
}
inline Solid point_solid(const V& p) {
  Solid s;
  s.vertices = {p};
  return s;
}

// The collider alone, by the routine for single shapes (proven in cast_ray_test).
inline bool hits_alone(const Thing& thing, const V& origin, const V& path, double& fraction) {
  const detail::NumRotation q{thing.q.x(), thing.q.y(), thing.q.z(), thing.q.w()};
  const V o = origin - thing.p;
  detail::NumRayHit hit;
  if (!detail::cast_ray(thing.shape, q, {o.x(), o.y(), o.z()}, {path.x(), path.y(), path.z()}, 1,
                        hit))
    return false;
  fraction = hit.fraction;
  return true;
}

inline bool seen(const Thing& thing, const QueryFilter& filter) {
  return (thing.layers & filter.layers) != 0 && (!thing.sensor || filter.sensors) &&
         (filter.ignore.is_null() || thing.body != filter.ignore);
}

struct RandomRay {
  V origin, path;  // from the world's middle
};
inline RandomRay random_ray(oracle::Random& random) {
  const V from =
      kSpan * V(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
  const V to = kSpan * V(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return {from, random.uniform(0.1, 2) * (to - from)};
}
// As a world that stands at the scene's middle can be given them.
inline RandomRay as_given(const Scene& scene, const RandomRay& ray) {
  return {pos(V(scene.middle + ray.origin)).cast<double>() - scene.middle,
          vec(ray.path).cast<double>()};
}

inline void compare_rays(const Scene& scene, unsigned seed, const QueryFilter& filter,
                         double tolerance) {
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

}  // namespace query_scene
}  // namespace plumb::inline PLUMB_ABI
