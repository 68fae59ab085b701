// Proves that the known faults of the classic teaching engines are absent: each test names what
// such an engine does and asserts what must hold instead. [Millington 2010] is the engine meant.
// Numbers are those of the catalogue of faults; 1, 4 and 7 (tree, box tensor, contact basis) are
// tested beside the code they concern, 15 (springs, buoyancy) with those effects.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/recorder.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// There: |dL|/|L| reaches 0.756 in 10 s while the energy looks constant (no w x I w term).
TEST(BookFaults, F02_AngularMomentumOfATumblingBodyIsConstant) {
  PhysicsWorld world(no_gravity());
  RigidBody top = free_body(1, {1, 2, 3});
  top.angular_velocity = vec(1, 1, 1);
  const BodyId body = must(world.create_body(top));
  const Vector3d L0 = wide(world.angular_momentum(body));
  const double E0 = world.energy().kinetic_angular;
  run(world, 10, kDt, [&] {
    const Vector3d L = wide(world.angular_momentum(body));
    // The same through what is seen from outside: w and the attitude.
    const Eigen::Matrix3d R = orientation(world, body).toRotationMatrix();
    const Vector3d seen = R * Vector3d(1, 2, 3).asDiagonal() * R.transpose() * spin(world, body);
    ASSERT_LE((L - L0).norm(), 1e-12 * L0.norm());  // the stored state: not even round-off
    ASSERT_LE((seen - L0).norm(), bar(1e-12, 1e-5) * L0.norm());
  });
  // 600 steps of about 1e-7 rad of attitude round-off each in single precision.
  EXPECT_NEAR(world.energy().kinetic_angular, E0, bar(1e-12, 1e-4) * E0);
}

// There: -2 % at 30 rad/s, -16.6 % at 100 rad/s (first-order quaternion at 60 Hz).
TEST(BookFaults, F03_FastSpinTurnsByTheRightAngle) {
  for (double rate : {30.0, 100.0}) {
    PhysicsWorld world(no_gravity());
    RigidBody ball = free_body(1, {0.4, 0.4, 0.4});
    const Vector3d axis = Vector3d(1, 2, 2) / 3;
    ball.angular_velocity = vec(rate * axis);
    const BodyId body = must(world.create_body(ball));
    run(world, 1);
    const Quaterniond exact(Eigen::AngleAxisd(rate, axis));
    // The rate itself is rounded to eps, and 240 rotations are.
    EXPECT_LE(angle_between(orientation(world, body), exact), (rate + 240) * kEps) << rate;
  }
}

// There: 1.2 from A (the middle of the centres) instead of 1.95.
TEST(BookFaults, F05_SphereContactsAreGeometricallyRight) {
  const double tiny = 1e-6;  // [s] a step that moves nothing visibly
  const auto touch = [&](const Collider& ca, const Vector3d& pb, const Collider& cb) {
    PhysicsWorld world(no_gravity());
    const BodyId a = add(world, body_at(at(0, 0, 0)), ca);
    const BodyId b = add(world, body_at(at(pb, Quat::Identity())), cb);
    world.step(tiny);
    const std::vector<ContactState> all = contacts(world);
    const ContactState* found = find_contact(all, a, b);
    EXPECT_TRUE(all_finite(world));
    return found != nullptr ? *found : ContactState{};
  };
  const ContactState unequal = touch(with(sphere(2)), {2.4, 0, 0}, with(sphere(0.5)));
  ASSERT_EQ(unequal.point_count, 1);
  EXPECT_LE((wide(unequal.points[0].position) - Vector3d(1.95, 0, 0)).norm(), 1e-4);

  const ContactState concentric = touch(with(sphere(1)), {0, 0, 0}, with(sphere(0.5)));
  ASSERT_EQ(concentric.point_count, 1);
  EXPECT_NEAR(wide(concentric.normal).norm(), 1, 4 * kEps);
  EXPECT_NEAR(static_cast<double>(concentric.points[0].separation), -1.5, 1e-4);

  // Centre of the ball inside the box, 0.2 below the top face: out through the top.
  const ContactState inside = touch(with(cube(1)), {0.1, 0.8, -0.3}, with(sphere(0.25)));
  ASSERT_EQ(inside.point_count, 1);
  EXPECT_NEAR(std::abs(wide(inside.normal).y()), 1, 4 * kEps);
  EXPECT_NEAR(static_cast<double>(inside.points[0].separation), -(0.2 + 0.25), 1e-4);
}

// There: a full buffer drops contacts silently; a box falls through the plane.
TEST(BookFaults, F06_NoContactIsEverDropped) {
  PhysicsWorld world;
  const int count = 1000;
  const Built scene = build_spread(world, count);
  run(world, 0.5);
  const StepReport& report = world.last_report();
  if (report.awake_bodies > 0) {
    EXPECT_EQ(report.touching_pairs, static_cast<std::uint32_t>(count));
    EXPECT_EQ(report.contact_points, static_cast<std::uint32_t>(4 * count));
  }
  EXPECT_EQ(contacts(world).size(), static_cast<std::size_t>(count));
  for (BodyId b : scene.bodies) ASSERT_NEAR(position(world, b).y(), 0.5, 0.01);
}

// There: an infinite mass gets NaN from gravity (inf * 0).
TEST(BookFaults, F08_ImmovableBodiesFeelNoGravity) {
  PhysicsWorld world;
  const BodyId wall = add(world, body_at(at(1, 2, 3), MotionType::Static), with(cube(1)));
  const BodyId lift = add(world, body_at(at(9, 2, 3), MotionType::Kinematic), with(cube(1)));
  const BodyId ball = add(world, body_at(at(20, 2, 3)), with(sphere(1)));
  run(world, 1);
  EXPECT_EQ((position(world, wall) - Vector3d(1, 2, 3)).norm(), 0);
  EXPECT_EQ((position(world, lift) - Vector3d(9, 2, 3)).norm(), 0);
  EXPECT_TRUE(all_finite(world));
  EXPECT_LT(position(world, ball).y(), -2);
}

// There: three boxes collapse in 1.9 s. Ten boxes for 60 s, and their sleep: stacking_test.cpp.
TEST(BookFaults, F09_ThreeBoxesStand) {
  PhysicsWorld world(no_sleep());
  const Built stack = build_stack(world, {.count = 3});
  run(world, 10);
  for (std::size_t i = 0; i < 3; ++i) {
    // Upright, in place, and resting on each other.
    const Vector3d p = position(world, stack.bodies[i]);
    EXPECT_LE(Vector3d(p.x(), 0, p.z()).norm(), 1e-3);
    EXPECT_NEAR(p.y(), 0.5 + static_cast<double>(i), 0.01);
  }
}

// There: 17 % too fast. The closed form reaches 4.80 m/s at t = 2.037 s.
TEST(BookFaults, F10_SlidingDownASlope) {
  PhysicsWorld world;
  const OnSlope slide = build_slope(world, {.angle = kPi / 6, .friction = 0.3});
  const double t = 122 * kDt;
  run(world, t);
  const double a = kGravity * (std::sin(kPi / 6) - 0.3 * std::cos(kPi / 6));
  EXPECT_NEAR(a * t, 4.80, 0.01);
  EXPECT_NEAR(velocity(world, slide.body).dot(slide.down), a * t, 0.02 * a * t);
}

// There: 0.903 m.
TEST(BookFaults, F11_ElasticBallReturnsToItsHeight) {
  PhysicsWorld world;
  add_floor(world, material(0, 1));
  const BodyId ball = add(world, body_at(at(0, 1.5, 0)), with(sphere(0.5), material(0, 1)));
  double apex = 0, last_v = 0;
  int apexes = 0;
  run(world, 5, kDt, [&] {
    const double v = velocity(world, ball).y(), y = position(world, ball).y();
    if (last_v > 0 && v <= 0) {
      apex = y + v * v / (2 * kGravity) - 0.5;  // of the parabola through this state
      EXPECT_NEAR(apex, 1, 1e-3);
      ++apexes;
    }
    last_v = v;
  });
  EXPECT_EQ(apexes, 5);  // every 0.903 s
}

// There: missed in 39 of 60 phases of the step.
TEST(BookFaults, F12_AFastBallNeverPassesAThinWall) {
  int passed = 0;
  for (int phase = 0; phase < 60; ++phase) {
    PhysicsWorld world(no_gravity());
    add(world, body_at(at(10, 0, 0), MotionType::Static), with(box(0.1, 5, 5)));
    const double speed = 100;
    const double start = speed * kDt * phase / 60;
    const BodyId ball = add(world, moving(at(start, 0, 0), vec(speed, 0, 0)), with(sphere(0.1)));
    run(world, 0.5);
    if (position(world, ball).x() > 10) ++passed;
  }
  EXPECT_EQ(passed, 0);
}

// There: it hovers, or creeps at 0.16 m/s.
TEST(BookFaults, F13_ASleepingBodyFallsWhenItsSupportIsRemoved) {
  PhysicsWorld world;
  const BodyId floor = add_floor(world);
  const BodyId table = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  const BodyId vase = add(world, body_at(at(0, 1.5, 0)), with(cube(0.5)));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(vase));
  must(world.destroy_body(table));
  EXPECT_TRUE(world.is_awake(vase));
  const double fall = 0.25;  // [s]
  const double y0 = position(world, vase).y();
  run(world, fall);
  EXPECT_NEAR(position(world, vase).y() - y0, -kGravity * fall * fall / 2,
              bar(1e-9, 1e-5) + sum_error(60, 1.5, kPosEps));
  run(world, 3);
  EXPECT_NEAR(position(world, vase).y(), 0.5, 0.01);
  EXPECT_TRUE(world.is_valid(floor));
}

// There: put to sleep in flight.
TEST(BookFaults, F14_AFreeSlowBodyIsNeverPutToSleep) {
  for (const bool gravity : {false, true}) {
    PhysicsWorld world(gravity ? WorldSettings{} : no_gravity());
    const BodyId drifting = add(world, moving(at(0, 0, 0), vec(0.5, 0, 0)), with(sphere(0.5)));
    run(world, 10, kDt, [&] { ASSERT_TRUE(world.is_awake(drifting)); });
    EXPECT_NEAR(position(world, drifting).x(), 5, sum_error(2400, 5, bar(kEps, kEps)));
  }
}

// There: the factor is applied per step, so the result depends on the frame rate.
TEST(BookFaults, F16_DampingIsPerSecond) {
  for (double dt : {1.0 / 15, 1.0 / 60, 1.0 / 1000}) {
    PhysicsWorld world(no_gravity());
    RigidBody spec = free_body(1, {1, 1, 1});
    spec.linear_velocity = vec(3, 0, 0);
    spec.angular_velocity = vec(0, 5, 0);
    spec.linear_damping = real(0.7);
    spec.angular_damping = real(1.1);
    const BodyId body = must(world.create_body(spec));
    run(world, 1, dt);
    const double round_off = sum_error(4 / dt, 5);
    EXPECT_NEAR(velocity(world, body).x(), 3 * std::exp(-0.7), round_off) << "dt " << dt;
    EXPECT_NEAR(spin(world, body).y(), 5 * std::exp(-1.1), round_off) << "dt " << dt;
  }
}

// There: 0, 0, 2 (energy doubled).
TEST(BookFaults, F17_ThreeBallCradle) {
  for (double gap : {0.0, 1e-4}) {
    PhysicsWorld world(no_gravity());
    const std::vector<BodyId> balls =
        build_cradle(world, {.count = 3, .moving = 1, .speed = 1, .gap = gap});
    run(world, 1);
    const double expected[] = {0, 0, 1};
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(velocity(world, balls[i]).x(), expected[i], 0.01)
          << "ball " << i << " gap " << gap;
  }
}

// There: the point is taken to be in body axes.
TEST(BookFaults, F18_AForcePointInWorldCoordinates) {
  PhysicsWorld world(no_gravity());
  RigidBody spec = free_body(1, {1, 1, 1});
  spec.pose = at({5, 0, 0}, turn(kPi / 2, Vector3d::UnitZ()));
  const BodyId by_world = must(world.create_body(spec));
  const BodyId by_body = must(world.create_body(spec));
  const Vector3d force(0, 0, 1);
  // World point (6,0,0) is 1 m along world x from the centre: body point (0,-1,0).
  must(world.apply_force_at(by_world, vec(force), pos(6, 0, 0)));
  must(world.apply_force_at_body_point(by_body, vec(force), vec(0, -1, 0)));
  world.step(kDt);
  const Vector3d expected = Vector3d(1, 0, 0).cross(force) * kDt;
  for (BodyId body : {by_world, by_body})
    EXPECT_LE((wide(world.angular_momentum(body)) - expected).norm(), 16 * kEps * expected.norm());
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
