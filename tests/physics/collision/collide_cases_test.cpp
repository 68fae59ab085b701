// Invariant: the cases in which simple narrowphases fail have the right answer here: unequal radii,
// coincident centres, a centre inside a box, flat faces, full buffers, identical poses, 1 mm on 10
// km.
#include <gtest/gtest.h>

#include "collision/collide.h"
#include "collision/collision_tolerances.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::V;

constexpr Real kEps = std::numeric_limits<Real>::epsilon();
constexpr Rotation kUpright{0, 0, 0, 1};

CollisionShape sphere(Real r) { return make_collision_shape(Sphere{r}); }
CollisionShape box(Real x, Real y, Real z) { return make_collision_shape(Box{Vec3(x, y, z)}); }
CollisionShape capsule(Real h, Real r) { return make_collision_shape(Capsule{h, r}); }
CollisionShape ground() { return make_collision_shape(HalfSpace{}); }
CollisionShape hull(std::shared_ptr<const HullGeometry> g) {
  return make_collision_shape(ConvexHull{std::move(g)});
}
Rotation turned(Vec v) { return from_rotation_vector(v); }

TEST(CollideCases, UnequalSpheresTouchHalfwayBetweenTheirSurfaces) {
  Manifold m;
  ASSERT_TRUE(collide(sphere(2), {{0, 0, 0}, kUpright}, sphere(Real(0.5)),
                      {{Real(2.4), 0, 0}, kUpright}, 0, m));
  ASSERT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].position.x, Real(1.95),
              4 * kEps);  // between 2.0 and 1.9; rounding at 2.4
  EXPECT_NEAR(m.points[0].separation, Real(-0.1), 4 * kEps);
  EXPECT_EQ(m.normal.x, Real(1));
}

TEST(CollideCases, ConcentricSpheresCollideWithAUnitNormalAndFullDepth) {
  for (const Real offset : {Real(0), std::numeric_limits<Real>::denorm_min(), Real(1e-30)}) {
    Manifold m;
    ASSERT_TRUE(
        collide(sphere(1), {{0, 0, 0}, kUpright}, sphere(3), {{offset, 0, 0}, kUpright}, 0, m));
    EXPECT_NEAR(length(m.normal), Real(1), 2 * kEps);
    EXPECT_EQ(m.points[0].separation, Real(-4));
  }
}

TEST(CollideCases, SphereCentreInsideABoxIsPushedOutOfTheNearestFace) {
  Manifold m;
  ASSERT_TRUE(collide(box(1, 2, 3), {{0, 0, 0}, kUpright}, sphere(Real(0.25)),
                      {{Real(0.5), 0, Real(-1)}, kUpright}, 0, m));
  EXPECT_EQ(m.normal.x, Real(1));
  EXPECT_NEAR(m.points[0].separation, Real(-0.75), 4 * kEps);
  ASSERT_TRUE(collide(box(1, 2, 3), {{0, 0, 0}, kUpright}, sphere(Real(0.25)),
                      {{0, 0, 0}, kUpright}, 0, m));
  EXPECT_NEAR(length(m.normal), Real(1), 2 * kEps);
  EXPECT_NEAR(m.points[0].separation, Real(-1.25), 4 * kEps);
}

TEST(CollideCases, FlatBoxOnBoxHasFourPointsAtTheCornersHoweverItIsTurned) {
  for (int step = 0; step < 16; ++step) {
    const Real angle = Real(0.1) * static_cast<Real>(step);
    Manifold m;
    ASSERT_TRUE(collide(box(1, 1, 1), {{0, 0, 0}, kUpright}, box(Real(0.5), Real(0.5), Real(0.5)),
                        {{0, Real(1.5), 0}, turned({0, angle, 0})}, 0, m));
    EXPECT_EQ(m.count, 4);
    EXPECT_EQ(m.normal.y, Real(1));
    for (const ManifoldPoint& p : m.points) {
      EXPECT_NEAR(p.separation, Real(0), 8 * kEps);
      EXPECT_NEAR(std::sqrt(p.position.x * p.position.x + p.position.z * p.position.z),
                  std::sqrt(Real(0.5)), 8 * kEps);
    }
  }
  // Same size, turned by 45 degrees: an octagon, of which four far corners are kept.
  Manifold m;
  ASSERT_TRUE(collide(box(1, 1, 1), {{0, 0, 0}, kUpright}, box(1, 1, 1),
                      {{0, 2, 0}, turned({0, Real(0.785398163), 0})}, 0, m));
  ASSERT_EQ(m.count, 4);
  V sum = V::Zero();
  for (const ManifoldPoint& p : m.points) sum += oracle::vec(p.position);
  EXPECT_LT(V(sum.x(), 0, sum.z()).norm() / 4,
            0.42);  // none on one side: an octagon corner is 1.08 out
}

TEST(CollideCases, EveryFlatBodyOnAPlaneKeepsItsFourPointsDeepOrShallow) {
  for (const Real depth : {Real(0), Real(0.01), Real(0.3)}) {
    Manifold m;
    ASSERT_TRUE(collide(ground(), {{0, 0, 0}, kUpright}, box(1, Real(0.5), 2),
                        {{5, Real(0.5) - depth, 7}, kUpright}, Real(0.01), m));
    EXPECT_EQ(m.count, 4);
    for (const ManifoldPoint& p : m.points) EXPECT_NEAR(p.separation, -depth, 8 * kEps);
    ASSERT_TRUE(collide(ground(), {{0, 0, 0}, kUpright}, hull(oracle::prism(12, 1, 0.5)),
                        {{0, Real(0.5) - depth, 0}, kUpright}, Real(0.01), m));
    EXPECT_EQ(m.count, 4);
    for (const ManifoldPoint& p : m.points) EXPECT_NEAR(p.separation, -depth, 8 * kEps);
    const Real h = std::sqrt(Real(0.5));
    ASSERT_TRUE(collide(ground(), {{0, 0, 0}, kUpright}, capsule(1, Real(0.25)),
                        {{0, Real(0.25) - depth, 0}, {0, 0, h, h}}, Real(0.01), m));
    EXPECT_EQ(m.count, 2);
  }
}

TEST(CollideCases, FacesOfSixtyFourCornersOverlayWithoutLosingTheOutermost) {
  const auto disc = oracle::prism(kMaxFaceVertices, 1, 0.1);
  Manifold m;
  // Turned by half a corner: all 128 corners of the overlay exist.
  ASSERT_TRUE(collide(hull(disc), {{0, 0, 0}, kUpright}, hull(disc),
                      {{0, Real(0.2), 0}, turned({0, Real(0.049), 0})}, Real(0.01), m));
  ASSERT_EQ(m.count, 4);
  V sum = V::Zero();
  for (const ManifoldPoint& p : m.points) {
    EXPECT_GT(V(static_cast<double>(p.position.x), 0, static_cast<double>(p.position.z)).norm(),
              0.99);
    sum += oracle::vec(p.position);
  }
  EXPECT_LT(V(sum.x(), 0, sum.z()).norm(), 0.5);  // spread all around
}

TEST(CollideCases, IdenticalPosesPartByTheThinnestWay) {
  const CollisionShape shapes[] = {sphere(1), capsule(1, Real(0.5)), box(1, 2, 3),
                                   hull(oracle::prism(5, 1, 2))};
  for (const CollisionShape& s : shapes) {
    const Transform x{{1, 2, 3}, turned({Real(0.3), Real(0.2), Real(-0.1)})};
    Manifold m;
    ASSERT_TRUE(collide(s, x, s, x, 0, m));
    EXPECT_NEAR(length(m.normal), Real(1), 2 * kEps);
    const double truth = signed_distance(oracle::solid_of(s, x), oracle::solid_of(s, x));
    double deepest = 0;
    for (int i = 0; i < m.count; ++i)
      deepest = std::min(deepest, static_cast<double>(m.points[i].separation));
    EXPECT_NEAR(deepest, truth, 16 * static_cast<double>(kEps));
  }
}

TEST(CollideCases, OneMillimetreOnTenKilometresIsSeenToAPartOfTheMillimetre) {
  // The large box's top lies at the reference point; a gap of 1 um is exact to single precision of
  // 1 mm.
  const Real half = Real(5e-4), gap = Real(1e-6);
  for (const Real turn : {Real(0), Real(0.4)}) {
    Manifold m;
    ASSERT_TRUE(collide(box(5000, 5000, 5000), {{0, -5000, 0}, kUpright}, box(half, half, half),
                        {{Real(0.01), half + gap, Real(-0.02)}, turned({0, turn, 0})}, Real(1e-4),
                        m));
    ASSERT_EQ(m.count, 4);
    for (const ManifoldPoint& p : m.points) {
      // In double the millimetre box's position itself is only known to the last digit of 5000 m.
      EXPECT_NEAR(p.separation, gap, 4 * kEps * half + static_cast<Real>(4 * kNumEpsilon * 5000));
    }
  }
}

TEST(CollideCases, ParallelCapsulesTouchInTwoPointsAndCrossedOnesInOne) {
  Manifold m;
  ASSERT_TRUE(collide(capsule(1, Real(0.25)), {{0, 0, 0}, kUpright}, capsule(2, Real(0.25)),
                      {{Real(0.45), Real(0.5), 0}, kUpright}, 0, m));
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(std::abs(m.points[0].position.y - m.points[1].position.y), Real(2), 8 * kEps);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(m.points[i].separation, Real(-0.05), 4 * kEps);
  ASSERT_TRUE(collide(capsule(1, Real(0.25)), {{0, 0, 0}, kUpright}, capsule(2, Real(0.25)),
                      {{Real(0.45), 0, 0}, turned({1, 0, 0})}, 0, m));
  EXPECT_EQ(m.count, 1);
  EXPECT_NEAR(m.points[0].separation, Real(-0.05), 4 * kEps);
}

TEST(CollideCases, CapsuleAcrossABoxTouchesAtBothEndsOfWhatLiesAboveIt) {
  Manifold m;
  const Real h = std::sqrt(Real(0.5));
  ASSERT_TRUE(collide(box(1, 1, 1), {{0, 0, 0}, kUpright}, capsule(3, Real(0.25)),
                      {{0, Real(1.24), 0}, {0, 0, h, h}}, 0, m));
  ASSERT_EQ(m.count, 2);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(std::abs(m.points[i].position.x), Real(1), static_cast<Real>(kAttained) + 8 * kEps);
    EXPECT_NEAR(m.points[i].separation, Real(-0.01), 8 * kEps);
  }
}

TEST(CollideCases, CornersAndCrossedEdgesApartAreSeenWithinTheMargin) {
  // Two cubes corner to corner along the diagonal: no face axis reaches the distance between them.
  const Real d = 1 + Real(0.01) / std::sqrt(Real(3));
  Manifold m;
  ASSERT_TRUE(collide(box(Real(0.5), Real(0.5), Real(0.5)), {{0, 0, 0}, kUpright},
                      box(Real(0.5), Real(0.5), Real(0.5)), {{d, d, d}, kUpright}, Real(0.02), m));
  EXPECT_NEAR(m.points[0].separation, Real(0.01), 8 * kEps);
  EXPECT_NEAR(m.normal.x, 1 / std::sqrt(Real(3)),
              Real(1e3) * kEps);  // rounding of d over the distance 0.01
  EXPECT_FALSE(collide(box(Real(0.5), Real(0.5), Real(0.5)), {{0, 0, 0}, kUpright},
                       box(Real(0.5), Real(0.5), Real(0.5)), {{d, d, d}, kUpright}, Real(0.009),
                       m));
  EXPECT_EQ(m.count, 0);
}

TEST(CollideCases, HalfSpacesNeverCollideAndNonFinitePlacesGiveNoPoints) {
  Manifold m;
  EXPECT_FALSE(collide(ground(), {{0, 0, 0}, kUpright}, ground(), {{0, 0, 0}, kUpright}, 1, m));
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  const CollisionShape shapes[] = {sphere(1), capsule(1, 1), box(1, 1, 1),
                                   hull(oracle::prism(5, 1, 1)), ground()};
  for (const CollisionShape& a : shapes) {
    for (const CollisionShape& b : shapes) {
      EXPECT_FALSE(collide(a, {{0, 0, 0}, kUpright}, b, {{nan, nan, nan}, kUpright}, 1, m));
      EXPECT_EQ(m.count, 0);
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
