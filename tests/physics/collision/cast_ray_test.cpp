// Invariant: the first hit of a ray lies on the surface, nothing of the ray before it is inside,
// the normal is that of the surface, and a ray that starts inside hits at once.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());
Vec inner(const V& v) {
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

TEST(CastRay, HitsLieOnTheSurfaceAndNothingBeforeThemIsInside) {
  Random random(41);
  int hits = 0, misses = 0, inside = 0;
  for (int i = 0; i < 8000; ++i) {
    const double size = random.scale(1e-3, 1e4);
    const Real s = static_cast<Real>(size);
    const Shape shapes[] = {Sphere{s}, Capsule{s, s / 2}, Box{Vec3(s, s / 2, s / 3)},
                            ConvexHull{oracle::prism(7, size, size / 2)}};
    const CollisionShape shape = make_collision_shape(shapes[random.below(4)]);
    const Transform x{inner(2 * size * random.direction()), random.rotation()};
    const oracle::Solid solid = oracle::solid_of(shape, x);
    const Vec origin = inner(oracle::vec(x.p) + random.uniform(0, 4) * size * random.direction());
    const Vec direction = inner(size * random.uniform(0.1, 8) * random.direction() +
                                (oracle::vec(x.p) - oracle::vec(origin)));
    const V o = oracle::vec(origin), d = oracle::vec(direction);
    const double tolerance =
        32 * kEps * size;  // of points up to 10 sizes out, planes of single precision
    SCOPED_TRACE(testing::Message() << "ray " << i << " size " << size);
    RayHit hit{};
    const bool is_hit = cast_ray(shape, x, origin, direction, 1, hit);
    const double start = signed_distance(o, solid);
    const double until = is_hit ? static_cast<double>(hit.fraction) : 1.0;
    for (int k = 0; k <= 64; ++k) {
      if (start < tolerance) break;
      EXPECT_GT(signed_distance(V(o + until * k / 64 * d), solid),
                -tolerance - 2 * kEps * d.norm());
    }
    if (!is_hit) {
      ++misses;
      EXPECT_GT(start, -tolerance);
      continue;
    }
    const V n = oracle::vec(hit.normal);
    EXPECT_NEAR(n.norm(), 1, 2 * kEps);
    if (start < -tolerance) {
      ++inside;
      EXPECT_EQ(hit.fraction, Real(0));
      EXPECT_LT((n + d.normalized()).norm(), 4 * kEps);
    } else if (start > tolerance) {
      ++hits;
      EXPECT_NEAR(signed_distance(V(o + until * d), solid), 0, tolerance + 2 * kEps * d.norm());
      EXPECT_LE(n.dot(d), 0);
      // One small step against the normal is inside by as much, one along it outside.
      const double step = 1e-2 * size;
      EXPECT_NEAR(signed_distance(V(o + until * d + step * n), solid), step,
                  2 * tolerance + 2 * kEps * d.norm());
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 500);
  EXPECT_GT(inside, 500);
}

TEST(CastRay, EndsAtTheLargestFractionAndTakesAxisParallelRays) {
  const CollisionShape box = make_collision_shape(Box{Vec3(1, 1, 1)});
  const Transform x{{0, 0, 0}, {0, 0, 0, 1}};
  RayHit hit{};
  EXPECT_TRUE(cast_ray(box, x, {-3, 0, 0}, {4, 0, 0}, 1, hit));
  EXPECT_EQ(hit.fraction, Real(0.5));
  EXPECT_EQ(hit.normal.x, Real(-1));
  EXPECT_FALSE(cast_ray(box, x, {-3, 0, 0}, {4, 0, 0}, Real(0.49), hit));
  EXPECT_FALSE(cast_ray(box, x, {-3, 0, 0}, {-4, 0, 0}, 10, hit));
  EXPECT_FALSE(cast_ray(box, x, {-3, Real(1.01), 0}, {4, 0, 0}, 1, hit));
  EXPECT_FALSE(cast_ray(box, x, {-3, 0, 0}, {0, 0, 0}, 1, hit));
  EXPECT_TRUE(cast_ray(box, x, {0, 0, 0}, {0, 0, 0}, 1, hit));
  EXPECT_EQ(length(hit.normal), Real(1));
  const CollisionShape ground = make_collision_shape(HalfSpace{Vec3::UnitY(), Real(1)});
  EXPECT_TRUE(cast_ray(ground, x, {0, 3, 0}, {0, -4, 0}, 1, hit));
  EXPECT_EQ(hit.fraction, Real(0.5));
  EXPECT_EQ(hit.normal.y, Real(1));
  EXPECT_FALSE(cast_ray(ground, x, {0, 3, 0}, {1, 0, 0}, 100, hit));
  EXPECT_TRUE(cast_ray(ground, x, {0, 0, 0}, {0, 1, 0}, 1, hit));
  EXPECT_EQ(hit.fraction, Real(0));
}

TEST(CastRay, AFarOriginCostsNoDigits) {
  const CollisionShape ball = make_collision_shape(Sphere{Real(1e-2)});
  RayHit hit{};
  ASSERT_TRUE(
      cast_ray(ball, {{0, 0, 0}, {0, 0, 0, 1}}, {1000, Real(5e-3), 0}, {-1000, 0, 0}, 2, hit));
  // The nearest point of the ray comes from coordinates of 1000 m in double, on a ball of 0.01 m.
  const double from_afar = 4 * std::numeric_limits<double>::epsilon() * 1000 / 1e-2;
  EXPECT_NEAR(static_cast<double>(hit.normal.y), 0.5, 4 * kEps + from_afar);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
