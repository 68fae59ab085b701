// Invariant: friction stays within the chosen cone and takes most energy within it. On polygons
// that means closed forms that differ from the circle's by what the polygon is larger, and depend
// on the heading; nothing else changes, and the accurate solver keeps the circle.
#include <gtest/gtest.h>

#include "solver/facet_cone.h"
#include "support/measure.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr FrictionCone kPolygons[] = {FrictionCone::FourFacets, FrictionCone::EightFacets};

WorldSettings with_cone(FrictionCone cone) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::SoftStep;
  settings.friction_cone = cone;
  return settings;
}

// The facets' unit normals: the polygon is where no one of them sees more than the limit.
std::vector<Vector2d> facets_of(FrictionCone cone) {
  const int count = cone == FrictionCone::FourFacets ? 4 : 8;
  std::vector<Vector2d> out;
  for (int i = 0; i < count; ++i)
    out.emplace_back(std::cos(2 * kPi * i / count), std::sin(2 * kPi * i / count));
  return out;
}

TEST(FacetCone, SizesAndPullsInAsThePolygonDoes) {
  Random random(11);
  for (const FrictionCone kind : kPolygons) {
    const detail::FacetCone cone(kind);
    const std::vector<Vector2d> facets = facets_of(kind);
    for (int trial = 0; trial < 2000; ++trial) {
      const Vector2d f(random.uniform(-3, 3), random.uniform(-3, 3));
      const double limit = random.uniform(0.2, 2);
      double size = 0;
      for (const Vector2d& n : facets) size = std::max(size, n.dot(f));
      Real x = real(f.x()), y = real(f.y());
      EXPECT_NEAR(cone.size_of(x, y), size, 8 * kEps);
      EXPECT_NEAR(cone.pull_in(x, y, real(limit)), size, 8 * kEps);
      const Vector2d g(static_cast<double>(x), static_cast<double>(y));
      if (size <= limit - 8 * kEps) {
        EXPECT_LE((g - f).norm(), kEps);
      }
      double out_of = 0;
      for (const Vector2d& n : facets) out_of = std::max(out_of, n.dot(g));
      EXPECT_LE(out_of, limit + 16 * kEps);
      // The nearest point of a convex set: nothing in it lies farther along the way back.
      const std::size_t count = facets.size();
      for (std::size_t i = 0; i < count; ++i) {
        const Vector2d middle = facets[i] + facets[(i + 1) % count];
        const Vector2d corner = limit / facets[i].dot(middle) * middle;
        EXPECT_LE((f - g).dot(corner - g), 64 * kEps) << f.transpose() << ", limit " << limit;
      }
    }
  }
}

// Where a block at v0 [m/s] along a heading [rad] stops.
Vector2d stopping_place(FrictionCone cone, double heading, double mu, double v0) {
  PhysicsWorld world(with_cone(cone));
  add_floor(world, material(mu));
  RigidBody body = moving(at(0, 0.5, 0), vec(v0 * std::cos(heading), 0, v0 * std::sin(heading)));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  const BodyId ball = add(world, body, with(sphere(0.5), material(mu)));
  run(world, 3);
  return {position(world, ball).x(), position(world, ball).z()};
}

// Reference case C2 with pyramids. Four facets are two laws, one an axis, each with all of mu N: a
// body stops along each axis by itself, v^2/(2 mu g) for that axis' speed, and so has gone astray.
TEST(FrictionCone, FourFacetsBrakeAlongEachAxisByItself) {
  const double mu = 0.6, v0 = 10, d = v0 * v0 / (2 * mu * kGravity);
  for (int i = 0; i < 48; ++i) {
    const double heading = i * 7.5 * kPi / 180, c = std::cos(heading), s = std::sin(heading);
    const Vector2d wanted(d * c * std::abs(c), d * s * std::abs(s));
    const Vector2d place = stopping_place(FrictionCone::FourFacets, heading, mu, v0);
    EXPECT_LE((place - wanted).norm(), bar(1e-3, 2e-3) * d) << heading;
  }
}

// The ways from the shortest to the longest in 48 headings, as shares of v^2/(2 mu g): the circle
// has none; a polygon lets go as far as its corners reach beyond it, 1/cos(pi/n).
TEST(FrictionCone, SpreadOverHeadingsIsThatOfTheCorners) {
  const double mu = 0.6, v0 = 10, d = v0 * v0 / (2 * mu * kGravity);
  const auto spread = [&](FrictionCone cone) {
    double shortest = 1e9, longest = 0;
    for (int i = 0; i < 48; ++i) {
      const double way = stopping_place(cone, i * 7.5 * kPi / 180, mu, v0).norm();
      shortest = std::min(shortest, way);
      longest = std::max(longest, way);
    }
    return Vector2d(shortest / d, longest / d);
  };
  const Vector2d circle = spread(FrictionCone::Exact), four = spread(FrictionCone::FourFacets),
                 eight = spread(FrictionCone::EightFacets);
  EXPECT_LE(circle.y() - circle.x(), bar(1e-6, 1e-4));
  EXPECT_NEAR(four.x(), std::cos(kPi / 4), 2e-3);
  EXPECT_NEAR(four.y(), 1, 2e-3);
  EXPECT_NEAR(eight.x(), std::cos(kPi / 8), 2e-3);
  EXPECT_NEAR(eight.y(), 1, 2e-3);
}

// A block is pushed with 1.2 mu m g at 45 degrees to the tangents: the circle lets it slide, four
// facets hold it, and along a tangent none does.
TEST(FrictionCone, HoldsMoreInTheCornersOfAPolygon) {
  const double mu = 0.5;
  const auto moved = [&](FrictionCone cone, const Vector3d& direction) {
    PhysicsWorld world(with_cone(cone));
    add_floor(world, material(mu));
    const BodyId block = add(world, body_at(at(0, 0.1, 0)), with(box(0.5, 0.1, 0.5), material(mu)));
    const double force = 1.2 * mu * world.mass_properties(block).mass * kGravity;
    for (int i = 0; i < 60; ++i) {
      must(world.apply_force(block, vec(force * direction.normalized())));
      world.step(kDt);
    }
    return Vector2d(position(world, block).x(), position(world, block).z()).norm();
  };
  const double free = 0.5 * 0.2 * mu * kGravity;  // [m] in a second
  EXPECT_NEAR(moved(FrictionCone::Exact, {1, 0, 1}), free, 0.02);
  EXPECT_LE(moved(FrictionCone::FourFacets, {1, 0, 1}), 1e-3);
  EXPECT_NEAR(moved(FrictionCone::EightFacets, {1, 0, 1}), free, 0.02);
  for (const FrictionCone cone : kPolygons) EXPECT_NEAR(moved(cone, {1, 0, 0}), free, 0.02);
}

// Half of the friction along the grain: twice the way.
TEST(FrictionCone, GoesWithAGrain) {
  PhysicsWorld world(with_cone(FrictionCone::FourFacets));
  add_floor(world, material(0.5));
  Material grained = material(0.5);
  grained.grain = vec(1, 0, 0);
  grained.grain_friction = real(0.5);
  RigidBody body = moving(at(0, 0.5, 0), vec(3, 0, 0));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  const BodyId ball = add(world, body, with(sphere(0.5), grained));
  run(world, 3);
  const double way = 9 / (2 * 0.25 * kGravity);
  EXPECT_NEAR(position(world, ball).x(), way, 0.01 * way);
  EXPECT_LE(velocity(world, ball).norm(), 1e-3);
}

// Polygons of a pile are the same bits with threads and after a restore; the accurate solver has
// the circle whatever is asked for.
TEST(FrictionCone, IsKeptByTheWorldAndIgnoredByTheAccurateSolver) {
  const auto hash_of = [](WorldSettings settings, int threads) {
    const std::unique_ptr<JobSystem> pool = threads > 1 ? make_thread_pool(threads) : nullptr;
    PhysicsWorld world(settings);
    world.set_job_system(pool.get());
    build_pile(world, {.side = 3});
    run(world, 1);
    PhysicsWorld restored;
    must(restored.restore(world.save()));
    EXPECT_EQ(restored.settings().friction_cone, settings.friction_cone);
    world.step(kDt);
    restored.step(kDt);
    EXPECT_EQ(world.state_hash(), restored.state_hash());
    return world.state_hash();
  };
  std::set<std::uint64_t> different;
  for (const FrictionCone cone :
       {FrictionCone::Exact, FrictionCone::FourFacets, FrictionCone::EightFacets}) {
    const std::uint64_t hash = hash_of(with_cone(cone), 1);
    EXPECT_EQ(hash, hash_of(with_cone(cone), 4));
    different.insert(hash);
  }
  EXPECT_EQ(different.size(), 3u);
  std::set<std::uint64_t> accurate;
  for (const FrictionCone cone : {FrictionCone::Exact, FrictionCone::FourFacets}) {
    WorldSettings settings = with_cone(cone);
    settings.contact_solver = ContactSolver::Newton;
    accurate.insert(hash_of(settings, 1));
  }
  EXPECT_EQ(accurate.size(), 1u);
}

TEST(FrictionCone, IsOneOfThree) {
  PhysicsWorld world;
  EXPECT_EQ(world.set_settings(with_cone(static_cast<FrictionCone>(3))).code,
            StatusCode::OutOfRange);
  EXPECT_EQ(world.settings().friction_cone, FrictionCone::Exact);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
