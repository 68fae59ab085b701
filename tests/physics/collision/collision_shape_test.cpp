// Invariant: bounds are tight and hold the shape, supports are farthest points, and a shape that is
// not finite, has no volume or is out of range is refused before it gets anywhere.
#include "collision/collision_shape.h"

#include <gtest/gtest.h>

#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());

std::vector<CollisionShape> shapes_of_size(double size) {
  const Real s = static_cast<Real>(size);
  return {make_collision_shape(Sphere{s}), make_collision_shape(Capsule{s, s / 2}),
          make_collision_shape(Box{Vec3(s, s / 2, s / 3)}),
          make_collision_shape(ConvexHull{oracle::prism(7, size, size / 2)})};
}

TEST(CollisionShape, BoundsAreTheExtremesOfTheShape) {
  Random random(3);
  for (const double size : {1e-3, 1.0, 1e4}) {
    for (const CollisionShape& shape : shapes_of_size(size)) {
      for (int i = 0; i < 200; ++i) {
        const V p = 3 * size * random.direction();
        const Transform x{
            {static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())},
            random.rotation()};
        const oracle::Solid solid = oracle::solid_of(shape, x);
        const Aabb box = bounds_of(shape, x);
        const V lower = oracle::vec(box.lower), upper = oracle::vec(box.upper);
        for (int axis = 0; axis < 3; ++axis) {
          double low = std::numeric_limits<double>::infinity(), high = -low;
          for (const V& v : solid.vertices)
            low = std::min(low, v[axis]), high = std::max(high, v[axis]);
          // A dozen roundings of numbers up to 4 size.
          EXPECT_NEAR(lower[axis], low - solid.radius, 24 * kEps * size);
          EXPECT_NEAR(upper[axis], high + solid.radius, 24 * kEps * size);
        }
        for (const V& v : solid.vertices) {
          EXPECT_LE((v - p).norm() + solid.radius,
                    static_cast<double>(bounding_radius(shape)) + 24 * kEps * size);
        }
      }
    }
  }
}

TEST(CollisionShape, SupportIsAFarthestPointOfTheCore) {
  Random random(4);
  const Transform origin{{0, 0, 0}, {0, 0, 0, 1}};
  for (const CollisionShape& shape : shapes_of_size(2)) {
    const oracle::Solid solid = oracle::solid_of(shape, origin);
    for (int i = 0; i < 500; ++i) {
      const V d = random.direction();
      double farthest = -std::numeric_limits<double>::infinity();
      for (const V& v : solid.vertices) farthest = std::max(farthest, d.dot(v));
      const Vec s = support(
          shape, {static_cast<Real>(d.x()), static_cast<Real>(d.y()), static_cast<Real>(d.z())});
      EXPECT_NEAR(d.dot(oracle::vec(s)), farthest, 16 * kEps);
    }
  }
}

TEST(CollisionShape, AHalfSpaceEndsOnlyAlongAnAxisOfItsNormal) {
  const CollisionShape up = make_collision_shape(HalfSpace{Vec3(0, 3, 0), Real(2)});
  EXPECT_EQ(up.normal.y, Real(1));
  Aabb box = bounds_of(up, {{5, 1, 0}, {0, 0, 0, 1}});
  EXPECT_EQ(box.upper.y, Real(3));
  EXPECT_EQ(box.lower.y, -kUnbounded);
  EXPECT_EQ(box.upper.x, kUnbounded);
  EXPECT_EQ(box.lower.z, -kUnbounded);
  box = bounds_of(make_collision_shape(HalfSpace{Vec3(0, 0, -1), Real(2)}),
                  {{0, 0, 0}, {0, 0, 0, 1}});
  EXPECT_EQ(box.lower.z, Real(-2));
  EXPECT_EQ(box.upper.z, kUnbounded);
  box =
      bounds_of(make_collision_shape(HalfSpace{Vec3(1, 1, 0), Real(2)}), {{0, 0, 0}, {0, 0, 0, 1}});
  EXPECT_EQ(box.upper.x, kUnbounded);
  EXPECT_EQ(box.upper.y, kUnbounded);
}

TEST(CollisionShape, BadSizesAreRefusedWithTheRightCode) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN(),
             inf = std::numeric_limits<Real>::infinity();
  const auto code = [](const Shape& s) { return check_shape(s).code; };
  EXPECT_EQ(code(Sphere{1}), StatusCode::Ok);
  EXPECT_EQ(code(Sphere{0}), StatusCode::BadShape);
  EXPECT_EQ(code(Sphere{-1}), StatusCode::BadShape);
  EXPECT_EQ(code(Sphere{nan}), StatusCode::NotFinite);
  EXPECT_EQ(code(Sphere{inf}), StatusCode::NotFinite);
  EXPECT_EQ(code(Sphere{Real(1e-30)}), StatusCode::OutOfRange);
  EXPECT_EQ(code(Sphere{Real(1e9)}), StatusCode::OutOfRange);
  EXPECT_EQ(code(Sphere{Real(1e-5)}), StatusCode::Ok);
  EXPECT_EQ(code(Sphere{Real(1e6)}), StatusCode::Ok);
  EXPECT_EQ(code(Box{Vec3(1, 0, 1)}), StatusCode::BadShape);
  EXPECT_EQ(code(Box{Vec3(1, nan, 1)}), StatusCode::NotFinite);
  EXPECT_EQ(code(Box{Vec3(1000, Real(1e-3), 1)}), StatusCode::OutOfRange);
  EXPECT_EQ(code(Box{Vec3(10, Real(1e-4), 10)}), StatusCode::Ok);
  EXPECT_EQ(code(Capsule{1, 0}), StatusCode::BadShape);
  EXPECT_EQ(code(Capsule{0, 1}), StatusCode::BadShape);
  EXPECT_EQ(code(ConvexHull{}), StatusCode::BadShape);
  EXPECT_EQ(code(ConvexHull{oracle::prism(5, 1, 1)}), StatusCode::Ok);
  EXPECT_EQ(code(HalfSpace{Vec3::Zero(), 0}), StatusCode::BadShape);
  EXPECT_EQ(code(HalfSpace{Vec3(0, nan, 0), 0}), StatusCode::NotFinite);
  EXPECT_EQ(code(HalfSpace{Vec3::UnitX(), inf}), StatusCode::NotFinite);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
