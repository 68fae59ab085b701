// Proves that a one-way collider stops what comes from its solid side and nothing else: bodies rise
// through it as if it were not there and land on it, at any orientation and speed; what begins
// inside is never pushed; queries see it from all sides.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr double kHalf = 0.05;    // [m] half thickness of the plates

Collider plate(double half = kHalf) {
  Collider collider = with(box(3, half, 3));
  collider.one_way = vec(0, 2, 0);  // any length
  return collider;
}

// The world turned as a whole: up is where the plate is solid.
struct Turned {
  explicit Turned(const Quaterniond& q, double gravity = kGravity) : R(q) {
    WorldSettings settings = no_sleep();
    settings.gravity = vec(R * Vector3d(0, -gravity, 0));
    world = PhysicsWorld(settings);
  }
  BodyId add_plate(double half = kHalf) {
    return add(world, body_at(pose(Vector3d::Zero()), MotionType::Static), plate(half));
  }
  [[nodiscard]] Pose pose(const Vector3d& p) const { return at(R * p, Quat(R.cast<Real>())); }
  [[nodiscard]] BodyId put(const Shape& shape, const Vector3d& p, const Vector3d& v,
                           const Vector3d& w = Vector3d::Zero()) {
    return add(world, moving(pose(p), vec(R * v), vec(R * w)), with(shape));
  }
  [[nodiscard]] Vector3d place(BodyId body) const { return R.inverse() * position(world, body); }
  [[nodiscard]] Vector3d speed(BodyId body) const { return R.inverse() * velocity(world, body); }
  Quaterniond R;
  PhysicsWorld world;
};

std::vector<Quaterniond> orientations() {
  Random random(11);
  std::vector<Quaterniond> all{Quaterniond::Identity()};
  for (int i = 0; i < 6; ++i) all.push_back(wide(random.rotation(kPi)).normalized());
  return all;
}

// Up through the plate on a free parabola, then down onto it.
TEST(OneWay, BodiesJumpThroughFromBelowAndLandFromAbove) {
  for (const Shape& shape : {Shape(sphere(0.25)), Shape(cube(0.25)), Shape(capsule(0.2, 0.25))}) {
    for (const Quaterniond& R : orientations()) {
      Turned scene(R);
      scene.add_plate();
      const double from = -1.5, v0 = 8, top = from + v0 * v0 / (2 * kGravity);
      const BodyId body = scene.put(shape, {0, from, 0}, {0, v0, 0});
      double highest = from;
      run(scene.world, 1.0, kDt, [&] {
        const double t = scene.world.time();
        highest = std::max(highest, scene.place(body).y());
        EXPECT_NEAR(scene.place(body).y(), from + v0 * t - 0.5 * kGravity * t * t, bar(1e-9, 1e-4))
            << t;
      });
      EXPECT_GT(highest, top - 0.05);
      run(scene.world, 3);
      const double stands = std::holds_alternative<Capsule>(shape) ? 0.45 : 0.25;
      EXPECT_NEAR(scene.place(body).y(), kHalf + stands, 0.002);
      EXPECT_LE(scene.speed(body).norm(), 1e-3);
      // Held from now on, also when it is pushed down.
      must(scene.world.apply_impulse(
          body, vec(R * Vector3d(0, -2 * scene.world.mass_properties(body).mass, 0))));
      run(scene.world, 1);
      EXPECT_GT(scene.place(body).y(), kHalf + 0.9 * stands);
    }
  }
}

// A body that has not got wholly out of it falls back through it.
TEST(OneWay, WhatTurnsBackInsideFallsBackThrough) {
  Turned scene(Quaterniond::Identity());
  scene.add_plate();
  // The apex of the centre lies at the plate's top.
  const BodyId body =
      scene.put(cube(0.25), {0, -1, 0}, {0, std::sqrt(2 * kGravity * (1 + kHalf)), 0});
  run(scene.world, 2, kDt, [&] {
    const double t = scene.world.time();
    const double v0 = std::sqrt(2 * kGravity * (1 + kHalf));
    EXPECT_NEAR(scene.place(body).y(), -1 + v0 * t - 0.5 * kGravity * t * t, bar(1e-9, 1e-3));
  });
}

// However deep, and from whatever side it is nearest to.
TEST(OneWay, WhatIsInsideWhenItIsCreatedIsNeverPushed) {
  for (const Quaterniond& R : orientations()) {
    for (const double depth : {0.02, 0.1, 0.25, 0.4, 0.55}) {
      Turned scene(R, 0);
      scene.add_plate();
      const BodyId still = scene.put(cube(0.25), {0, kHalf + 0.25 - depth, 0}, Vector3d::Zero());
      const BodyId drifting = scene.put(sphere(0.25), {1.5, kHalf + 0.25 - depth, 0}, {0, 0.1, 0});
      const double from = scene.place(drifting).y();
      run(scene.world, 2);
      EXPECT_EQ(velocity(scene.world, still).norm(), 0) << "depth " << depth;
      EXPECT_NEAR(scene.place(drifting).y(), from + 0.2, bar(1e-9, 1e-5)) << "depth " << depth;
    }
  }
}

// It stands on the ground with its head in the plate, sleeps, is woken, and is left in peace.
TEST(OneWay, APassingPairRemembersThroughSleep) {
  PhysicsWorld world;
  add_floor(world);
  add(world, body_at(at(0, 1, 0), MotionType::Static), plate());
  const BodyId box_body = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));  // 5 cm in it
  run(world, 3);
  ASSERT_FALSE(world.is_awake(box_body));
  const Vector3d before = position(world, box_body);
  EXPECT_NEAR(before.y(), 0.5, 0.002);
  must(world.set_awake(box_body, true));
  run(world, 3);
  EXPECT_FALSE(world.is_awake(box_body));
  EXPECT_LE((position(world, box_body) - before).norm(), 1e-5);
}

// From below nothing is felt at any speed; from above nothing gets through.
TEST(OneWay, FastBodiesPassFromBelowAndStopFromAbove) {
  Random random(5);
  for (const Quaterniond& R : orientations()) {
    for (int i = 0; i < 20; ++i) {
      const double v = std::exp(random.uniform(std::log(5.0), std::log(400.0)));
      const double far = random.uniform(1.0, 1.0 + v * kDt);
      Turned scene(R, 0);
      scene.add_plate(0.02);
      const BodyId up = scene.put(sphere(0.1), {-1, -far, 0}, {0, v, 0});
      const BodyId down = scene.put(sphere(0.1), {1, far, 0}, {0, -v, 0});
      const double seconds = std::ceil(2 * far / v / kDt + 3) * kDt;
      run(scene.world, seconds, kDt, [&] { EXPECT_GT(scene.place(down).y(), 0) << v << " m/s"; });
      EXPECT_NEAR(scene.speed(up).y(), v, bar(1e-12, 1e-5) * v);
      EXPECT_NEAR(scene.place(up).y(), v * seconds - far, bar(1e-9, 1e-4) * (v * seconds));
      EXPECT_LE(std::abs(scene.speed(down).y()), 0.2);
    }
  }
}

// Spinning bodies are followed by the continuous stage, which knows the side as well.
TEST(OneWay, FastSpinningBodiesToo) {
  Random random(6);
  for (int i = 0; i < 60; ++i) {
    const double v = random.uniform(20, 200);
    const double far = random.uniform(2.0, 2.0 + v * kDt);
    Turned scene(wide(random.rotation(kPi)).normalized(), 0);
    scene.add_plate(0.02);
    const Vector3d w(random.uniform(-60, 60), random.uniform(-60, 60), random.uniform(-60, 60));
    const BodyId up = scene.put(box(0.4, 0.05, 0.1), {-1.5, -far, 0}, {0, v, 0}, w);
    const BodyId down = scene.put(box(0.4, 0.05, 0.1), {1.5, far, 0}, {0, -v, 0}, w);
    const double seconds = std::ceil(2 * far / v / kDt + 3) * kDt;
    run(scene.world, seconds, kDt, [&] { EXPECT_GT(scene.place(down).y(), 0) << v << " m/s"; });
    EXPECT_NEAR(scene.speed(up).y(), v, bar(1e-12, 1e-5) * v) << v << " m/s";
    EXPECT_NEAR(scene.place(up).y(), v * seconds - far, bar(1e-9, 1e-4) * (v * seconds));
  }
}

// The ceiling behind a plate still stops what has passed the plate.
TEST(OneWay, WhatPassesOneStopsAtAnother) {
  Turned scene(Quaterniond::Identity(), 0);
  scene.add_plate(0.02);
  add(scene.world, body_at(at(0, 1, 0), MotionType::Static), with(box(3, 0.02, 3)));
  const BodyId up = scene.put(sphere(0.1), {0, -3, 0}, {0, 300, 0});
  run(scene.world, 0.5, kDt, [&] { EXPECT_LT(scene.place(up).y(), 1); });
  EXPECT_GT(scene.place(up).y(), 0.5);
}

// The edges of a plate are no walls.
TEST(OneWay, TheSidesLetThrough) {
  Turned scene(Quaterniond::Identity(), 0);
  scene.add_plate();
  const BodyId block = scene.put(cube(0.5), {-5, 0, 0}, {2, 0, 0});
  run(scene.world, 5);
  EXPECT_NEAR(scene.speed(block).x(), 2, bar(1e-12, 1e-6));
  EXPECT_NEAR(scene.place(block).x(), 5, bar(1e-9, 1e-4));
}

// A plate that rises carries what is above it; one that sinks goes through what is below.
TEST(OneWay, AMovingPlateLiftsFromItsSolidSideOnly) {
  for (const double v : {1.0, -1.0, 30.0, -30.0}) {
    Turned scene(Quaterniond::Identity(), 0);
    RigidBody lift = body_at(scene.pose(Vector3d::Zero()), MotionType::Kinematic);
    lift.linear_velocity = vec(0, v, 0);
    add(scene.world, lift, plate());
    const BodyId ball = scene.put(sphere(0.25), {0, v > 0 ? 1.0 : -1.0, 0}, Vector3d::Zero());
    run(scene.world, 3 / std::abs(v));
    if (v > 0) {
      EXPECT_GE(scene.place(ball).y(), 3 + kHalf + 0.24);
    } else {
      EXPECT_EQ(scene.speed(ball).norm(), 0);
    }
  }
}

TEST(OneWay, QueriesSeeItFromAllSides) {
  Turned scene(Quaterniond::Identity());
  scene.add_plate();
  EXPECT_TRUE(scene.world.cast_ray(pos(0, -1, 0), vec(0, 2, 0)).has_value());
  EXPECT_TRUE(scene.world.cast_ray(pos(0, 1, 0), vec(0, -2, 0)).has_value());
  std::vector<ColliderId> found;
  scene.world.overlap_shape(sphere(0.2), at(0, -0.1, 0), found);
  EXPECT_EQ(found.size(), 1u);
  ShapeCast cast;
  cast.shape = sphere(0.2);
  cast.start = at(0, -1, 0);
  cast.translation = vec(0, 2, 0);
  EXPECT_TRUE(scene.world.cast_shape(cast).has_value());
}

// A passing body touches nothing: no contact, no event; landed, it does.
TEST(OneWay, PassingIsNoContact) {
  Turned scene(Quaterniond::Identity());
  scene.add_plate();
  const BodyId body = scene.put(sphere(0.25), {0, -1, 0}, {0, 7, 0});
  int begun = 0;
  run(scene.world, 0.5, kDt, [&] {
    begun += static_cast<int>(scene.world.events().contacts.size());
    EXPECT_TRUE(contacts(scene.world).empty());
  });
  EXPECT_EQ(begun, 0);
  EXPECT_GT(scene.place(body).y(), 0.5);
  run(scene.world, 2);
  EXPECT_EQ(contacts(scene.world).size(), 1u);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
