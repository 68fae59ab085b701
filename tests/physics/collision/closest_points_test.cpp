// Invariant: closest_points gives the true distance of any two shapes, points that are that far
// apart and on both surfaces, and a unit normal also where the shapes touch or overlap.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "collision/collision_tolerances.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());

CollisionShape shape_of(Random& random, int kind, double size) {
  return make_collision_shape(oracle::random_shape(random, kind, size, 0.05));
}

TEST(ClosestPoints, DistanceAndPointsAreThoseOfEveryFeatureAgainstEveryFeature) {
  Random random(31);
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 6000; ++i) {
    const double size = random.scale(1e-3, 1e4);
    const CollisionShape a = shape_of(random, random.below(4), size),
                         b = shape_of(random, random.below(4), size * random.scale(0.1, 10));
    const double sum = static_cast<double>(bounding_radius(a) + bounding_radius(b));
    const V p = random.uniform(0.1, 3) * sum * random.direction();
    const bool aligned = random.below(4) == 0;
    const Transform xa{{0, 0, 0}, aligned ? Rotation{0, 0, 0, 1} : random.rotation()};
    const Transform xb{
        {static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())},
        aligned ? Rotation{0, 0, 0, 1} : random.rotation()};
    const oracle::Solid solid_a = oracle::solid_of(a, xa), solid_b = oracle::solid_of(b, xb);
    const double truth = signed_distance(solid_a, solid_b);
    const Proximity c = closest_points(a, xa, b, xb);
    const double tolerance = 8 * kEps * 4 * sum;  // roundings of coordinates up to 4 sum
    SCOPED_TRACE(testing::Message() << "pose " << i << " size " << size << " distance " << truth);
    EXPECT_NEAR(static_cast<double>(c.distance), std::max(truth, 0.0), tolerance);
    const V n = oracle::vec(c.normal), on_a = oracle::vec(c.on_a), on_b = oracle::vec(c.on_b);
    EXPECT_NEAR(n.norm(), 1, 2 * kEps);
    if (truth > tolerance) {
      ++apart;
      EXPECT_NEAR((on_b - on_a).norm(), truth, tolerance);
      EXPECT_NEAR(std::abs(signed_distance(on_a, solid_a)), 0, tolerance);
      EXPECT_NEAR(std::abs(signed_distance(on_b, solid_b)), 0, tolerance);
      EXPECT_NEAR(room_along(solid_a, solid_b, n), truth,
                  tolerance * (1 + 16 * kNumEpsilon / kEps * sum / truth));
    } else {
      ++overlapping;
      EXPECT_EQ(on_a, on_b);
    }
  }
  EXPECT_GT(apart, 3000);
  EXPECT_GT(overlapping, 500);
}

TEST(ClosestPoints, AHalfSpaceIsMeasuredAlongItsNormal) {
  const CollisionShape ground = make_collision_shape(HalfSpace{Vec3(0, 2, 0), Real(0.5)});
  const CollisionShape ball = make_collision_shape(Sphere{1});
  const Proximity c =
      closest_points(ground, {{0, 0, 0}, {0, 0, 0, 1}}, ball, {{3, 4, 5}, {0, 0, 0, 1}});
  EXPECT_EQ(c.distance, Real(2.5));
  EXPECT_EQ(c.normal.y, Real(1));
  EXPECT_EQ(c.on_a.y, Real(0.5));
  EXPECT_EQ(c.on_b.y, Real(3));
  const Proximity swapped =
      closest_points(ball, {{3, 4, 5}, {0, 0, 0, 1}}, ground, {{0, 0, 0}, {0, 0, 0, 1}});
  EXPECT_EQ(swapped.normal.y, Real(-1));
  EXPECT_EQ(swapped.on_a.y, Real(3));
  EXPECT_EQ(
      closest_points(ground, {{0, 0, 0}, {0, 0, 0, 1}}, ball, {{0, 0, 0}, {0, 0, 0, 1}}).distance,
      Real(0));
}

// Simplices that are flat to round-off: slabs, needles, stacked coplanar corners, exact touch.
TEST(ClosestPoints, DegenerateSimplicesEndWithTheRightDistance) {
  const CollisionShape slab = make_collision_shape(Box{Vec3(10, Real(1e-4), 10)});
  const CollisionShape needle = make_collision_shape(Box{Vec3(Real(1e-4), 10, Real(1e-4))});
  const CollisionShape disc = make_collision_shape(ConvexHull{oracle::prism(64, 10, 1e-2)});
  Random random(8);
  for (const CollisionShape* a : {&slab, &needle, &disc}) {
    for (const CollisionShape* b : {&slab, &needle, &disc}) {
      for (int i = 0; i < 300; ++i) {
        const bool aligned = i % 3 == 0;
        const V p =
            random.uniform(0, 25) * (aligned ? V::Unit(random.below(3)) : random.direction());
        const Transform xa{{0, 0, 0}, aligned ? Rotation{0, 0, 0, 1} : random.rotation()};
        const Transform xb{
            {static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())},
            aligned ? Rotation{0, 0, 0, 1} : random.rotation()};
        const Proximity c = closest_points(*a, xa, *b, xb);
        // Two discs of 64 corners would take the slow method minutes: they only have to end.
        const double truth = a == &disc && b == &disc
                                 ? -1
                                 : std::max(0.0, signed_distance(oracle::solid_of(*a, xa),
                                                                 oracle::solid_of(*b, xb)));
        if (truth >= 0) {
          EXPECT_NEAR(static_cast<double>(c.distance), truth, 64 * kEps * 10);
        }
        EXPECT_NEAR(oracle::vec(c.normal).norm(), 1, 2 * kEps);
      }
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
