// Invariant: friction with a grain lies on an ellipse, all of it across the grain and a share of it
// along, and opposes the slip with the most power; the grain turns with its collider, and where it
// is not used no bit changes.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb/job_system.h"
#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr double kDt = 1.0 / 60, kMu = 0.5;  // [s], [-]

Material grained(double share, const Eigen::Vector3d& grain = Eigen::Vector3d::UnitX()) {
  Material m = material(kMu);
  m.grain = vec(grain);
  m.grain_friction = real(share);
  return m;
}

// A box on the floor that does not turn, so that it slides as a point does.
struct Slider {
  PhysicsWorld world{no_sleep()};
  BodyId box;
  explicit Slider(const Material& surface, const Eigen::Vector3d& velocity,
                  const Quat& heading = Quat::Identity()) {
    add_floor(world, material(kMu));
    RigidBody body = moving(at(0, 0.5, 0), vec(velocity));
    body.pose.orientation = heading;
    body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
    box = add(world, body, with(cube(0.5), surface));
  }
  Eigen::Vector3d place() const { return world.pose(box).position.cast<double>(); }
  Eigen::Vector3d velocity() const { return world.linear_velocity(box).cast<double>(); }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kDt + 0.5); ++i) world.step(kDt);
  }
};

// Path of a point under friction of most power on an ellipse, by Runge-Kutta in small steps.
Eigen::Vector2d path_on_ellipse(double share, Eigen::Vector2d v, double seconds) {
  constexpr double h = 1e-5;
  Eigen::Vector2d x(0, 0);
  const auto slow = [&](const Eigen::Vector2d& w) -> Eigen::Vector2d {
    const Eigen::Vector2d scaled(share * w.x(), w.y());
    const double size = scaled.norm();
    if (size < 1e-9) return Eigen::Vector2d::Zero();
    return -kMu * kGravity / size * Eigen::Vector2d(share * scaled.x(), scaled.y());
  };
  for (double t = 0; t < seconds; t += h) {
    const Eigen::Vector2d middle = v + 0.5 * h * slow(v);
    x += h * middle;
    v += h * slow(middle);
  }
  return x;
}

TEST(Grain, StopsAcrossItByAllOfFrictionAndAlongItByAShare) {
  for (const double share : {0.05, 0.25, 1.0}) {
    const double v = 3;
    Slider along(grained(share), {v, 0, 0}), across(grained(share), {0, 0, v});
    along.run(14);
    across.run(14);
    EXPECT_NEAR(along.place().x() * 2 * share * kMu * kGravity / (v * v), 1, 2e-3) << share;
    EXPECT_NEAR(across.place().z() * 2 * kMu * kGravity / (v * v), 1, 2e-3) << share;
    EXPECT_LT(std::abs(along.place().z()) + std::abs(across.place().x()), 1e-4) << share;
  }
}

TEST(Grain, ObliqueSlipFollowsTheEllipse) {
  for (const double share : {0.1, 0.3, 0.7})
    for (const double degrees : {10.0, 45.0, 80.0}) {
      const double angle = degrees * kPi / 180, seconds = 0.5;
      const Eigen::Vector2d v(4 * std::cos(angle), 4 * std::sin(angle));
      Slider slider(grained(share), {v.x(), 0, v.y()});
      slider.run(seconds);
      const Eigen::Vector2d expected = path_on_ellipse(share, v, seconds);
      const Eigen::Vector2d found(slider.place().x(), slider.place().z());
      EXPECT_LT((found - expected).norm(), 4e-3 * expected.norm())
          << share << " at " << degrees << ": " << found.transpose() << " for "
          << expected.transpose();
    }
}

TEST(Grain, TurnsWithItsCollider) {
  const Quat heading = turn(kPi / 6, Eigen::Vector3d::UnitY());
  const Eigen::Vector3d ahead = heading.cast<double>() * Eigen::Vector3d::UnitX();
  Slider skate(grained(0.01), 3 * ahead, heading);
  skate.run(1);
  EXPECT_GT(skate.velocity().dot(ahead), 2.9);
  EXPECT_LT((skate.place() - skate.place().dot(ahead) * ahead - Eigen::Vector3d(0, 0.5, 0)).norm(),
            2e-3);
}

TEST(Grain, WithoutFrictionAlongItSlidesForEver) {
  Slider rail(grained(0), {2, 0, 0.5});
  rail.run(5);
  EXPECT_NEAR(rail.velocity().x(), 2, 1e-4);
  EXPECT_NEAR(rail.velocity().z(), 0, 1e-4);
}

// Held across the grain on a slope steeper than the friction along it, but not along it.
TEST(Grain, HoldsOnASlopeOneWayOnly) {
  for (const bool downhill : {true, false}) {
    const double slope = std::atan(0.3);
    WorldSettings settings = no_sleep();
    settings.gravity = vec(kGravity * std::sin(slope), -kGravity * std::cos(slope), 0);
    PhysicsWorld world(settings);
    add_floor(world, material(kMu));
    const Material surface = grained(
        0.4, downhill ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : Eigen::Vector3d::UnitZ());
    const BodyId box = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5), surface));
    for (int i = 0; i < 120; ++i) world.step(kDt);
    const double v = static_cast<double>(world.linear_velocity(box).x());
    const double expected = 2 * kGravity * (std::sin(slope) - 0.4 * kMu * std::cos(slope));
    if (downhill)
      EXPECT_NEAR(v / expected, 1, 5e-3);
    else
      EXPECT_NEAR(v, 0, 1e-4);
  }
}

// A ball that does not spin up bounces obliquely: mu (1 + e) v_n is taken from the slip.
TEST(Grain, ActsInABounce) {
  for (const bool along : {true, false}) {
    PhysicsWorld world(no_gravity());
    add_floor(world, material(0.2, 1));
    RigidBody body = moving(at(0, 2, 0), vec(along ? 10 : 0, -3, along ? 0 : 10));
    body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
    Material surface = grained(0.25);
    surface.friction = Real(0.2);
    surface.restitution = Real(1);
    const BodyId ball = add(world, body, with(sphere(0.5), surface));
    for (int i = 0; i < 60; ++i) world.step(kDt);
    const Vec3 v = world.linear_velocity(ball);
    EXPECT_NEAR(static_cast<double>(v.y()), 3, 1e-3);
    const double lost = 0.2 * 2 * 3 * (along ? 0.25 : 1);
    EXPECT_NEAR(static_cast<double>(along ? v.x() : v.z()), 10 - lost, 1e-3);
  }
}

TEST(Grain, OfTheSmallerShareCounts) {
  PhysicsWorld world(no_sleep());
  add_floor(world, grained(0.5, Eigen::Vector3d::UnitZ()));
  RigidBody body = moving(at(0, 0.5, 0), vec(3, 0, 0));
  const BodyId box = add(world, body, with(cube(0.5), grained(0.2)));
  for (int i = 0; i < 60; ++i) world.step(kDt);
  EXPECT_NEAR(static_cast<double>(world.linear_velocity(box).x()), 3 - 0.2 * kMu * kGravity, 2e-2);
}

TEST(Grain, ThatStandsOnTheSurfaceOrIsNoGrainChangesNoBit) {
  const auto hash_of = [](const Material& surface) {
    Slider slider(surface, {3, 0, 1});
    slider.run(1);
    return slider.place();
  };
  const Eigen::Vector3d plain = hash_of(material(kMu));
  EXPECT_EQ(hash_of(grained(1)), plain);
  EXPECT_EQ(hash_of(grained(0.1, Eigen::Vector3d::Zero())), plain);
  EXPECT_LT((hash_of(grained(0.1, Eigen::Vector3d::UnitY())) - plain).norm(), 1e-5);
}

TEST(Grain, HasTheSameBitsWithThreadsAndAfterARestore) {
  const auto jobs = make_thread_pool(3);
  const auto build = [](PhysicsWorld& world) {
    add_floor(world, grained(0.3, Eigen::Vector3d(1, 0, 1)));
    for (int i = 0; i < 40; ++i)
      add(world, moving(at(1.2 * (i % 8), 0.6 + i / 8, 0.1 * (i % 3)), vec(2, 0, 1)),
          with(cube(0.5), grained(0.1 + 0.02 * i)));
  };
  PhysicsWorld one(no_sleep()), three(no_sleep()), restored(no_sleep());
  three.set_job_system(jobs.get());
  build(one);
  build(three);
  for (int i = 0; i < 60; ++i) {
    one.step(kDt);
    three.step(kDt);
  }
  must(restored.restore(one.save()));
  for (int i = 0; i < 60; ++i) {
    one.step(kDt);
    three.step(kDt);
    restored.step(kDt);
  }
  EXPECT_EQ(one.state_hash(), three.state_hash());
  EXPECT_EQ(one.state_hash(), restored.state_hash());
}

TEST(Grain, BadValuesAreRefused) {
  PhysicsWorld world;
  const BodyId body = must(world.create_body(RigidBody{}));
  for (const double share : {-0.1, 1.1, std::nan("")})
    EXPECT_EQ(world.create_collider(body, with(cube(1), grained(share))).status.code,
              StatusCode::OutOfRange)
        << share;
  EXPECT_EQ(
      world.create_collider(body, with(cube(1), grained(0.5, {1, std::nan(""), 0}))).status.code,
      StatusCode::NotFinite);
  EXPECT_FALSE(world.plan().active(PlanItem::AnisotropicFriction));
  must(world.create_collider(body, with(cube(1), grained(0.5))).status);
  EXPECT_TRUE(world.plan().active(PlanItem::AnisotropicFriction));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
