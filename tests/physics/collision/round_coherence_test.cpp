// Invariant: a small motion makes a small change, also for cylinders, cones, rounded shapes,
// compounds, meshes and heightfields: the least separation moves no farther than the shapes do, and
// what lies at rest keeps the names of its contacts while it creeps.
#include <gtest/gtest.h>

#include <set>

#include "collision/collide_parts.h"
#include "collision/collision_tolerances.h"
#include "support/collision_oracle.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using namespace testing_support;
using oracle::as_vec;
using oracle::Random;
using oracle::V;

constexpr double kEps = std::numeric_limits<Real>::epsilon();

struct Named {
  const char* name;
  CollisionShape shape;
};

std::vector<Named> movers() {
  const Shape dumbbell = surfaces::compound(
      {surfaces::child(box(0.5, 0.1, 0.1), {0, 0, 0}), surfaces::child(sphere(0.3), {0.5, 0, 0})});
  return {{"cylinder", make_collision_shape(cylinder(0.4, 0.5))},
          {"cone", make_collision_shape(cone(0.5, 0.4))},
          {"rounded box", make_collision_shape(rounded_box(0.3, 0.4, 0.2, 0.1))},
          {"rounded cylinder", make_collision_shape(cylinder(0.3, 0.4, 0.1))},
          {"rounded cone", make_collision_shape(cone(0.4, 0.3, 0.1))},
          {"rounded hull", make_collision_shape(ConvexHull{oracle::prism(5, 0.4, 0.3), Real(0.1)})},
          {"compound", make_collision_shape(dumbbell)},
          {"box", make_collision_shape(box(0.4, 0.3, 0.5))}};
}

double bumps(double x, double z) { return 0.25 * std::sin(1.3 * x) * std::cos(0.9 * z); }

std::vector<Named> standers() {
  std::vector<Named> all = movers();
  all.push_back({"mesh", make_collision_shape(SurfaceMesh{
                             surfaces::made(surfaces::grid(-4, 4, -4, 4, 9, 9, bumps, true))})});
  all.push_back(
      {"heightfield", make_collision_shape(Heightfield{surfaces::field(
                          11, 11, 0.8, [](int i, int k) { return bumps(i, 0.7 * k); })})});
  return all;
}

double least(const Manifold& m) {
  double deepest = 1;
  for (int i = 0; i < m.count; ++i)
    deepest = std::min(deepest, static_cast<double>(m.points[i].separation));
  return deepest;
}

// Shallow contacts, where there is one way out: within a twentieth of the half thickness.
TEST(RoundCoherence, SeparationMovesNoFartherThanTheShapes) {
  Random random(29);
  int compared = 0;
  for (const Named& below : standers()) {
    const bool ground = is_surface(below.shape.type);
    for (const Named& above : movers()) {
      for (int i = 0; i < 150; ++i) {
        const Transform fixed{
            {ground && below.shape.type == ShapeType::Heightfield ? Real(-4) : 0, 0,
             ground && below.shape.type == ShapeType::Heightfield ? Real(-4) : 0},
            ground ? Rotation{0, 0, 0, 1} : random.rotation()};
        V along = ground ? V(0, 1, 0) : random.direction();
        Transform moving{
            as_vec(2.5 * along +
                   (ground ? V(random.uniform(-1, 1), 0, random.uniform(-1, 1)) : V(0, 0, 0))),
            random.rotation()};
        // Down until they all but touch.
        Manifold m;
        for (int k = 0; k < 60; ++k) {
          const Proximity now = closest_points(below.shape, fixed, above.shape, moving);
          if (!(now.distance > Real(1e-3))) break;
          moving.p -= (Real(0.9) * now.distance) * as_vec(along);
        }
        const double half = 0.5 * static_cast<double>(smallest_thickness(above.shape));
        moving.p += static_cast<Real>(random.uniform(-0.05, 0.1) * half) * as_vec(along);
        if (!collide(below.shape, fixed, above.shape, moving, Real(0.2), m)) continue;
        const double before = least(m);
        if (before < -0.05 * half || before > 0.1) continue;
        const V step = 1e-4 * random.direction();
        moving.p += as_vec(step);
        if (!collide(below.shape, fixed, above.shape, moving, Real(0.2), m)) {
          ADD_FAILURE() << above.name << " on " << below.name << " was at " << before;
          continue;
        }
        ++compared;
        const double chosen = (kFacePreference + kDepthGap + 2 * kDeepestTie) * half;
        EXPECT_LE(std::abs(least(m) - before), 1.001e-4 + 2 * chosen + 64 * kEps)
            << above.name << " on " << below.name << " pose " << i << " before " << before;
      }
    }
  }
  EXPECT_GT(compared, 6000);
}

std::set<std::pair<std::uint32_t, std::uint32_t>> names_of(const PartManifolds& all) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> names;
  for (const PartManifold& part : all.parts)
    for (int i = 0; i < part.manifold.count; ++i)
      names.emplace(part.part, part.manifold.points[i].feature);
  return names;
}

// Lying on flat ground: a solid, triangles and a heightfield.
TEST(RoundCoherence, WhatLiesAtRestKeepsItsNamesWhileItCreeps) {
  struct Rest {
    Named above;
    double height;  // [m] of the middle over the ground
    std::size_t points;
  };
  const std::vector<Rest> rests = {
      {{"cylinder", make_collision_shape(cylinder(0.4, 0.5))}, 0.4, 4},
      {{"cone", make_collision_shape(cone(0.5, 0.4))}, 0.5, 4},
      {{"rounded box", make_collision_shape(rounded_box(0.3, 0.4, 0.2, 0.1))}, 0.5, 4},
      {{"rounded cylinder", make_collision_shape(cylinder(0.3, 0.4, 0.1))}, 0.4, 4},
      {{"rounded hull", make_collision_shape(ConvexHull{oracle::prism(4, 0.4, 0.3), Real(0.1)})},
       0.4,
       4}};
  const auto even = [](int, int) { return 0.0; };
  const std::vector<std::pair<Named, Transform>> grounds = {
      {{"slab", make_collision_shape(box(5, 1, 5))}, {{0, -1, 0}, {0, 0, 0, 1}}},
      {{"mesh", make_collision_shape(SurfaceMesh{
                    surfaces::made(surfaces::grid(-4, 4, -4, 4, 3, 3, surfaces::level))})},
       {{Real(0.1), 0, Real(0.2)}, {0, 0, 0, 1}}},
      {{"heightfield", make_collision_shape(Heightfield{surfaces::field(5, 5, 2, even)})},
       {{Real(-4.1), 0, Real(-4.3)}, {0, 0, 0, 1}}}};
  for (const auto& [ground, fixed] : grounds) {
    for (const Rest& rest : rests) {
      Random random(5);
      const auto look = [&](const Transform& x) {
        PartManifolds all;
        collide_parts(ground.shape, fixed, rest.above.shape, x, Real(0.01), all);
        return names_of(all);
      };
      const Transform still{{0, static_cast<Real>(rest.height - 1e-3), 0},
                            from_rotation_vector(Vec{0, Real(0.3), 0})};
      const auto first = look(still);
      EXPECT_EQ(first.size(), rest.points) << rest.above.name << " on " << ground.name;
      for (int i = 0; i < 200; ++i) {
        const V shift = 1e-5 * random.direction(), spin = 1e-5 * random.direction();
        const Transform moved{still.p + as_vec(shift),
                              from_rotation_vector(as_vec(spin)) * still.q};
        ASSERT_EQ(look(moved), first) << rest.above.name << " on " << ground.name << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
