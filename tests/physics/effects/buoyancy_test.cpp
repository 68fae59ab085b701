// Proves that buoyancy is that of the real shape: displaced volumes and centres against closed
// forms and against counting points, draught by Archimedes, righting torque, stability of corks.
#include <gtest/gtest.h>

#include "effects/displacement.h"
#include "support/measure.h"
#include "support/random.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using detail::NumVec;
using Eigen::Vector3d;

detail::Displacement displaced(const Shape& shape, NumVec normal, double level) {
  PhysicsWorld world;
  detail::BodySurface surface;
  detail::make_surface(shape, {0, 0, 0}, {0, 0, 0, 1}, surface);
  return detail::displaced_below(surface, normal, level);
}

TEST(Displacement, BallIsASphericalCap) {
  const double r = 0.7;
  for (const double level : {-0.6, -0.2, 0.0, 0.3, 0.69, 2.0}) {
    const double t = std::min(r + level, 2 * r);
    const auto d = displaced(sphere(r), {0, 1, 0}, level);
    EXPECT_NEAR(d.volume, kPi * t * t * (3 * r - t) / 3, 1e-7);
  }
}

TEST(Displacement, UprightBoxIsItsSubmergedPart) {
  const auto d = displaced(box(1, 2, 0.5), {0, 1, 0}, 0.5);
  EXPECT_NEAR(d.volume, 2 * 2.5 * 1, 1e-12);
  EXPECT_NEAR(d.first.y / d.volume, -0.75, 1e-12);
  EXPECT_NEAR(d.area, 2, 1e-12);
  EXPECT_NEAR(d.line_second.xx, 2.0 * 2 * 2 / 12, 1e-12);
}

// Half a body is half of it, whatever its attitude: all shapes that are symmetric about a point.
TEST(Displacement, HalfOfASymmetricShapeInAnyDirection) {
  Random random(3);
  const Shape shapes[] = {sphere(0.4),
                          box(0.3, 0.5, 0.9),
                          capsule(0.6, 0.2),
                          cylinder(0.5, 0.3),
                          cylinder(0.2, 0.6),
                          cylinder(0.3, 0.2, 0.1),
                          rounded_box(0.3, 0.2, 0.4, 0.1)};
  for (const Shape& shape : shapes) {
    const double whole = mass_of(shape, 1).properties.mass;
    for (int i = 0; i < 50; ++i) {
      const Vector3d n =
          Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))
              .normalized();
      const auto half = displaced(shape, {n.x(), n.y(), n.z()}, 0);
      EXPECT_NEAR(half.volume, 0.5 * whole, 2e-6 * whole) << shape.index();
      const auto all = displaced(shape, {n.x(), n.y(), n.z()}, 10);
      EXPECT_NEAR(all.volume, whole, 2e-6 * whole) << shape.index();
      EXPECT_NEAR(all.area, 0, 1e-9);
    }
  }
}

// Sums over slices against points counted on a fine grid.
TEST(Displacement, RoundShapesAgainstCountedPoints) {
  const auto inside = [](const Shape& shape, const Vector3d& p) {
    const double across = std::hypot(p.x(), p.z());
    if (const auto* c = std::get_if<Capsule>(&shape)) {
      const double h = c->half_length, y = std::clamp(p.y(), -h, h);
      return std::hypot(across, p.y() - y) <= static_cast<double>(c->radius);
    }
    if (const auto* c = std::get_if<Cone>(&shape)) {
      const double h = c->half_length;
      return std::abs(p.y()) <= h &&
             across <= static_cast<double>(c->radius) * (h - p.y()) / (2 * h);
    }
    const auto& c = std::get<Cylinder>(shape);
    return std::abs(p.y()) <= static_cast<double>(c.half_length) &&
           across <= static_cast<double>(c.radius);
  };
  const Shape shapes[] = {capsule(0.4, 0.3), cylinder(0.3, 0.5), cone(0.5, 0.5)};
  const Vector3d normals[] = {Vector3d(0.3, 0.8, -0.2).normalized(), Vector3d(1, 0, 0),
                              Vector3d(-0.7, -0.6, 0.1).normalized(), Vector3d(0, 1, 0)};
  for (const Shape& shape : shapes) {
    for (const Vector3d& n : normals) {
      for (const double level : {-0.25, 0.1, 0.3}) {
        constexpr int kGrid = 120;
        const double cell = 2.0 / kGrid;
        double volume = 0;
        Vector3d first = Vector3d::Zero();
        for (int i = 0; i < kGrid; ++i)
          for (int j = 0; j < kGrid; ++j)
            for (int k = 0; k < kGrid; ++k) {
              const Vector3d p(-1 + cell * (i + 0.5), -1 + cell * (j + 0.5), -1 + cell * (k + 0.5));
              if (n.dot(p) <= level && inside(shape, p)) {
                volume += cell * cell * cell;
                first += cell * cell * cell * p;
              }
            }
        const auto d = displaced(shape, {n.x(), n.y(), n.z()}, level);
        EXPECT_NEAR(d.volume, volume, 3e-3)
            << shape.index() << " " << n.transpose() << " " << level;
        EXPECT_NEAR(d.first.x, first.x(), 2e-3);
        EXPECT_NEAR(d.first.y, first.y(), 2e-3);
        EXPECT_NEAR(d.first.z, first.z(), 2e-3);
      }
    }
  }
}

// The waterline area is the derivative of the volume.
TEST(Displacement, WaterlineIsHowTheVolumeGrows) {
  const Shape shapes[] = {sphere(0.5), box(0.3, 0.5, 0.9), capsule(0.4, 0.3), cylinder(0.3, 0.5),
                          cone(0.5, 0.5)};
  const NumVec n = detail::normalized_or(NumVec{0.3, 0.8, -0.4}, NumVec{0, 1, 0});
  for (const Shape& shape : shapes) {
    const double step = 1e-4;
    const double slope =
        (displaced(shape, n, 0.1 + step).volume - displaced(shape, n, 0.1 - step).volume) /
        (2 * step);
    const auto d = displaced(shape, n, 0.1);
    EXPECT_NEAR(d.area, slope, 1e-3 * slope) << shape.index();
    EXPECT_NEAR(n.x * d.line.x + n.y * d.line.y + n.z * d.line.z, 0.1 * d.area, 1e-3 * d.area);
  }
}

BodyId float_in_lake(PhysicsWorld& world, const Shape& shape, double density, double y,
                     const Quat& q = Quat::Identity()) {
  must(world.create_effect({{}, Buoyancy{}, 0}));
  return add(world, body_at(at(Vector3d(0, y, 0), q)), with(shape, {}, density));
}

// Archimedes: the draught of a box is its height times the ratio of densities; a ball's follows
// from the cap.
TEST(Buoyancy, FloatsAtTheDraughtOfArchimedes) {
  for (const double density : {50.0, 300.0, 500.0, 900.0}) {
    PhysicsWorld world(no_sleep());
    const BodyId raft = float_in_lake(world, box(1, 0.25, 1), density, 0.3);
    run(world, 60);
    EXPECT_NEAR(position(world, raft).y(), 0.25 - 0.5 * density / 1000, 1e-3) << density;
    EXPECT_LT(velocity(world, raft).norm(), 1e-3);
  }
  PhysicsWorld world(no_sleep());
  const BodyId ball = float_in_lake(world, sphere(0.5), 500, 0.3);
  run(world, 60);
  EXPECT_NEAR(position(world, ball).y(), 0, 1e-3);  // half under
}

// REFERENCE_CASES 9.15: never a push downwards; what is heavier than water sinks at g (1 - rw/rb).
TEST(Buoyancy, DeepBodiesFeelTheirWholeVolume) {
  for (const double density : {500.0, 2000.0}) {
    PhysicsWorld world;
    Buoyancy lake;
    lake.linear_drag = lake.quadratic_drag = lake.angular_drag = Real(0);
    must(world.create_effect({{}, lake, 0}));
    const BodyId body = add(world, body_at(at(0, -100, 0)), with(capsule(0.5, 0.3), {}, density));
    run(world, 1);
    EXPECT_NEAR(velocity(world, body).y(), kGravity * (1000 / density - 1), 1e-3);
  }
}

// Heave of a floating upright box: w^2 = density_water g A / m, undamped for many periods.
TEST(Buoyancy, BobsWithItsFrequencyAndKeepsItsEnergy) {
  PhysicsWorld world(no_sleep());
  Buoyancy lake;
  lake.linear_drag = lake.quadratic_drag = lake.angular_drag = Real(0);
  must(world.create_effect({{}, lake, 0}));
  RigidBody body = body_at(at(0, 0.05, 0));
  body.locks.angular_x = body.locks.angular_z = true;
  const BodyId raft = add(world, body, with(box(1, 0.5, 1), {}, 500));
  const double w = std::sqrt(1000 * kGravity * 4 / 2000.0), start = world.energy().total();
  double t = 0, worst = 0, energy = 0;
  run(world, 10, 1.0 / 60, [&] {
    t += 1.0 / 60;
    worst = std::max(worst, std::abs(position(world, raft).y() - 0.05 * std::cos(w * t)));
    energy = std::max(energy, std::abs(world.energy().total() - start));
  });
  EXPECT_LT(worst, 2e-4);
  const double swing = 0.5 * 2000 * w * w * 0.05 * 0.05;
  EXPECT_LT(energy, bar(1e-6, 5e-2) * swing);
}

// A wide raft rights itself, a tall one falls over: metacentre above or below the centre of mass.
TEST(Buoyancy, RightsWhatIsWideAndOverturnsWhatIsTall) {
  const auto tilt_after = [](const Shape& shape) {
    PhysicsWorld world(no_sleep());
    const BodyId body = float_in_lake(world, shape, 500, 0, turn(0.1, Vector3d::UnitZ()));
    run(world, 40);
    const Vector3d up = orientation(world, body) * Vector3d::UnitY();
    return std::acos(std::clamp(std::abs(up.y()), 0.0, 1.0));
  };
  EXPECT_LT(tilt_after(box(1, 0.25, 1)), 1e-2);
  EXPECT_GT(tilt_after(box(0.3, 1, 0.3)), 1.0);
}

// Sheets of foam: natural frequencies far above what the substeps could follow.
TEST(Buoyancy, CorksAreStableAtAnyStep) {
  for (const double dt : {1.0 / 15, 1.0 / 60}) {
    for (const double density : {0.5, 5.0, 50.0}) {
      PhysicsWorld world(no_sleep());
      const BodyId sheet =
          float_in_lake(world, box(0.5, 0.01, 0.5), density, 0.05, turn(0.2, Vector3d(1, 0, 2)));
      double fastest = 0;
      run(world, 20, dt, [&] { fastest = std::max(fastest, max_speed(world)); });
      EXPECT_TRUE(all_finite(world));
      EXPECT_LT(fastest, 6) << dt << " " << density;
      EXPECT_LT(velocity(world, sheet).norm(), 0.02) << dt << " " << density;
      EXPECT_LT(std::abs(position(world, sheet).y()), 0.02);
    }
  }
}

// What floats and has come to rest sleeps, and wakes with the tide.
TEST(Buoyancy, SleepsWhenItRestsAndWakesWithTheTide) {
  PhysicsWorld world;
  Buoyancy lake;
  lake.linear_drag = lake.angular_drag = Real(3);
  const EffectId id = must(world.create_effect({{}, lake, 0}));
  const BodyId raft = add(world, body_at(at(0, 0.1, 0)), with(box(1, 0.25, 1), {}, 500));
  run(world, 60);
  EXPECT_FALSE(world.is_awake(raft));
  lake.level = Real(1);
  must(world.set_effect(id, Effect{{}, lake, 0}));
  EXPECT_TRUE(world.is_awake(raft));
  run(world, 60);
  EXPECT_NEAR(position(world, raft).y(), 1, 5e-3);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
