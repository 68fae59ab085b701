// Invariant: what the engine knows about a single cylinder, cone or rounded shape is exact: its
// mass, centre and inertia against sums over its volume and against one another, its bounds and
// farthest points against the definition, and rays that hit its surface and nothing before it.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "plumb/mass_properties.h"
#include "support/curved_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::as_vec;
using oracle::Body;
using oracle::Random;
using oracle::V;

constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
constexpr Transform kHere{{0, 0, 0}, {0, 0, 0, 1}};

Real real(double x) { return static_cast<Real>(x); }

std::vector<Shape> some_shapes() {
  Random random(3);
  const auto hull = oracle::random_hull(random, 9, 1);
  return {Cylinder{real(0.7), real(0.4)},
          Cylinder{real(0.1), real(1)},
          Cylinder{real(0.7), real(0.4), real(0.25)},
          Cone{real(0.7), real(0.4)},
          Cone{real(0.2), real(1)},
          Cone{real(0.7), real(0.4), real(0.25)},
          Cone{real(0.2), real(1), real(0.5)},
          Box{Vec3(real(0.3), real(0.5), real(0.9)), real(0.2)},
          ConvexHull{hull, real(0.3)},
          ConvexHull{oracle::prism(7, 1, 0.5), real(0.1)}};
}

// Volume, first and second moments by rays from an inner point: along a direction u the body
// reaches to R(u), found from the distance function alone; integral r^2 dr gives R^3 / 3 and so on.
MassProperties summed(const Shape& shape, const V& inner, int directions) {
  const CollisionShape s = make_collision_shape(shape);
  const Body body(s, kHere);
  const double far = 2 * static_cast<double>(bounding_radius(s)), pi = std::acos(-1.0);
  double volume = 0;
  V first = V::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const double weight = 4 * pi / directions;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / directions, turn = pi * (1 + std::sqrt(5.0)) * i;
    const double r = std::sqrt(1 - z * z);
    const V u(r * std::cos(turn), r * std::sin(turn), z);
    double low = 0, high = far;
    for (int k = 0; k < 40; ++k) {
      const double middle = (low + high) / 2;
      (body.distance(V(inner + middle * u)) < 0 ? low : high) = middle;
    }
    volume += weight * low * low * low / 3;
    first += weight * std::pow(low, 4) / 4 * u;
    second += weight * std::pow(low, 5) / 5 * u * u.transpose();
  }
  MassProperties sum;
  sum.mass = volume;
  sum.center = inner + first / volume;
  second -= first * first.transpose() / volume;
  sum.I_Bcm_B = second.trace() * Eigen::Matrix3d::Identity() - second;
  return sum;
}

TEST(RoundShapeProperties, MassIsThatOfTheSumOverTheVolume) {
  for (const Shape& shape : some_shapes()) {
    const ShapeMass known = mass_of(shape, 1);
    ASSERT_TRUE(known.status.ok()) << known.status.message;
    const MassProperties sum = summed(shape, known.properties.center, 5000);
    const double size = static_cast<double>(bounding_radius(make_collision_shape(shape)));
    // 5000 directions: the sum itself is good to some 1e-3, for flat shapes to 5e-3; whether the
    // closed forms are exact is asked below.
    EXPECT_NEAR(known.properties.mass, sum.mass, 2e-3 * sum.mass) << shape.index();
    EXPECT_LE((known.properties.center - sum.center).norm(), 2e-3 * size) << shape.index();
    EXPECT_LE((known.properties.I_Bcm_B - sum.I_Bcm_B).norm(), 8e-3 * sum.I_Bcm_B.norm())
        << shape.index();
  }
}

// Closed forms met on two ways: a box and the hull with its corners, a cylinder and a prism of many
// sides, both rounded.
TEST(RoundShapeProperties, RoundedFormsAgreeWithOneAnother) {
  const Real q = real(0.25);
  const Vec3 half(real(0.5), real(0.25), real(0.75));
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                         (i & 4) != 0 ? half.z() : -half.z());
  const std::vector<std::uint32_t> sizes(6, 4),
      loops = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  const auto made = HullGeometry::create(corners, sizes, loops);
  ASSERT_TRUE(made.status.ok()) << made.status.message;
  const MassProperties box = mass_of(Box{half, q}, 1000).properties;
  const MassProperties hull = mass_of(ConvexHull{made.hull, q}, 1000).properties;
  EXPECT_NEAR(hull.mass, box.mass, 1e-12 * box.mass);
  EXPECT_LE(hull.center.norm(), 1e-12);
  EXPECT_LE((hull.I_Bcm_B - box.I_Bcm_B).norm(), 1e-12 * box.I_Bcm_B.norm());

  const MassProperties round = mass_of(Cylinder{q, q, q}, 1000).properties;
  const MassProperties prism =
      mass_of(ConvexHull{oracle::prism(64, 0.25, 0.25), q}, 1000).properties;
  // Of 64 corners the area misses 2 pi^2 / (3 n^2) = 1.6e-3 of the core, less of what is around it.
  EXPECT_NEAR(prism.mass, round.mass, 1.6e-3 * round.mass);
  EXPECT_LE((prism.I_Bcm_B - round.I_Bcm_B).norm(), 3.2e-3 * round.I_Bcm_B.norm());

  // A core of 2e-5 m leaves the ball of 0.25 m, to 3 / 2 (for the volume) of their ratio times pi
  // / 2.
  const double r = static_cast<double>(q), ball = 4 * std::acos(-1.0) / 3 * r * r * r;
  for (const Shape& shape :
       {Shape(Cylinder{real(2e-5), real(2e-5), q}), Shape(Cone{real(2e-5), real(2e-5), q})}) {
    const MassProperties m = mass_of(shape, 1).properties;
    EXPECT_NEAR(m.mass, ball, 5e-4 * ball);
    EXPECT_NEAR(m.I_Bcm_B(0, 0), 0.4 * ball * r * r, 5e-4 * ball * r * r);
  }
}

TEST(RoundShapeProperties, BoundsAreTight) {
  Random random(5);
  for (const Shape& shape : some_shapes()) {
    const CollisionShape s = make_collision_shape(shape);
    for (int i = 0; i < 200; ++i) {
      const Transform x{as_vec(V(3 * random.direction())),
                        i == 0 ? Rotation{0, 0, 0, 1} : random.rotation()};
      const Body body(s, x);
      const Aabb box = bounds_of(s, x);
      const V low = oracle::vec(box.lower), high = oracle::vec(box.upper);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(high[k], body.reach(V::Unit(k)), 64 * kEpsilon);
        EXPECT_NEAR(low[k], -body.reach(-V::Unit(k)), 64 * kEpsilon);
      }
      const V n = random.direction();
      const Body here(s, kHere);
      const V far = oracle::vec(support(s, as_vec(n)));
      EXPECT_NEAR(n.dot(far) + static_cast<double>(s.radius), here.reach(n), 32 * kEpsilon);
      EXPECT_LE(here.reach(n), static_cast<double>(bounding_radius(s)) + 32 * kEpsilon);
      EXPECT_GE(here.reach(n) + here.reach(-n),
                static_cast<double>(smallest_thickness(s)) - 32 * kEpsilon);
    }
  }
}

TEST(RoundShapeProperties, RaysMeetTheSurfaceFirst) {
  Random random(7);
  for (const Shape& shape : some_shapes()) {
    const CollisionShape s = make_collision_shape(shape);
    const double size = static_cast<double>(bounding_radius(s));
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const Transform x{as_vec(V(2 * random.direction())), random.rotation()};
      const Body body(s, x);
      const Vec from = as_vec(V(oracle::vec(x.p) + 3 * size * random.direction()));
      const V at = oracle::vec(x.p) + 1.2 * size * random.uniform(0, 1) * random.direction();
      const Vec way = as_vec(V(2 * (at - oracle::vec(from))));
      RayHit hit{};
      const bool met = cast_ray(s, x, from, way, 1, hit);
      const V o = oracle::vec(from), d = oracle::vec(way);
      if (!met) {
        for (int k = 0; k <= 200; ++k)
          ASSERT_GT(body.distance(V(o + (k / 200.0) * d)), -64 * kEpsilon * size) << i;
        continue;
      }
      ++hits;
      const double t = static_cast<double>(hit.fraction);
      // The ray is twelve sizes long at most; its end is good to a rounding of that, and a grazing
      // one slides along the surface by the root of it without leaving it by more.
      EXPECT_NEAR(body.distance(V(o + t * d)), 0, 64 * kEpsilon * size)
          << shape.index() << " " << i;
      for (int k = 0; k < 20; ++k)
        EXPECT_GT(body.distance(V(o + (t * k / 20) * d)), -64 * kEpsilon * size);
      const V n = oracle::vec(hit.normal);
      EXPECT_NEAR(n.norm(), 1, 4 * kEpsilon);
      // Outward: the body lies behind the plane through the point.
      EXPECT_LE(body.reach(n) - n.dot(o + t * d), 2e3 * kEpsilon * size) << shape.index();
    }
    EXPECT_GT(hits, 500);
  }
}

TEST(RoundShapeProperties, ImpossibleSizesAreRefused) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (const Shape& bad :
       {Shape(Cylinder{0, 1}), Shape(Cylinder{1, -1}), Shape(Cylinder{1, 1, -1}),
        Shape(Cylinder{1, nan}), Shape(Cylinder{1, 1, nan}), Shape(Cone{0, 1}), Shape(Cone{1, 0}),
        Shape(Cone{1, 1, real(-0.1)}), Shape(Cone{real(1e7), 1}),
        Shape(Box{Vec3(1, 1, 1), real(-1)}), Shape(Box{Vec3(1, 1, 1), nan}),
        Shape(ConvexHull{oracle::prism(5, 1, 1), real(-1)})}) {
    EXPECT_FALSE(check_shape(bad).ok()) << bad.index();
    EXPECT_FALSE(mass_of(bad, 1).status.ok()) << bad.index();
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
