// Invariant: a small motion makes a small change. Within a feature the normal turns and the
// separation moves by no more than the motion allows; points keep their names while bodies creep or
// rock.
#include <gtest/gtest.h>

#include <set>

#include "collision/collide.h"
#include "collision/collision_tolerances.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;

constexpr Real kEps = std::numeric_limits<Real>::epsilon();
constexpr Rotation kUpright{0, 0, 0, 1};

std::set<std::uint32_t> names_of(const Manifold& m) {
  std::set<std::uint32_t> names;
  for (int i = 0; i < m.count; ++i) names.insert(m.points[i].feature);
  return names;
}

struct Creep {
  Vec shift, turn;  // [m], [rad]
};
// Relative motion of 1e-4 of the half thickness, in any direction.
Creep creep(Random& random, double half) {
  const V d = 1e-4 * half * random.direction(), w = 1e-4 * random.direction();
  return {{static_cast<Real>(d.x()), static_cast<Real>(d.y()), static_cast<Real>(d.z())},
          {static_cast<Real>(w.x()), static_cast<Real>(w.y()), static_cast<Real>(w.z())}};
}

// Flush faces are the hard case: each corner of one lies on a corner or a side of the other.
TEST(CollideCoherence, PointsOfRestingShapesKeepTheirNamesWhileTheyCreep) {
  Random random(5);
  for (const double size : {1e-3, 1.0, 1e4}) {
    const Real h = static_cast<Real>(size);
    const CollisionShape cube = make_collision_shape(Box{Vec3(h, h, h)});
    const CollisionShape plank = make_collision_shape(Box{Vec3(3 * h, h, h)});
    const CollisionShape hexagon = make_collision_shape(ConvexHull{oracle::prism(6, size, size)});
    struct Rest {
      const CollisionShape *below, *above;
      Real angle;
    };
    for (const Rest& rest :
         {Rest{&cube, &cube, 0}, Rest{&cube, &plank, 0}, Rest{&plank, &cube, Real(0.3)},
          Rest{&hexagon, &hexagon, 0}, Rest{&cube, &hexagon, Real(0.1)},
          Rest{&cube, &cube, Real(0.785398163)}}) {
      const Transform below{{0, 0, 0}, kUpright};
      const Rotation turn = from_rotation_vector(Vec{0, rest.angle, 0});
      const Transform above{{0, Real(1.999) * h, 0}, turn};
      Manifold first;
      ASSERT_TRUE(collide(*rest.below, below, *rest.above, above, Real(0.01) * h, first));
      ASSERT_EQ(first.count, 4);
      ASSERT_EQ(names_of(first).size(), 4U);
      for (int i = 0; i < 200; ++i) {
        // Less at the corners than the band that keeps names: turn * 2 h + shift.
        const Creep c = creep(random, 0.5 * size);
        const Transform moved{above.p + c.shift, from_rotation_vector(Real(0.2) * c.turn) * turn};
        Manifold m;
        ASSERT_TRUE(collide(*rest.below, below, *rest.above, moved, Real(0.01) * h, m));
        EXPECT_EQ(names_of(m), names_of(first))
            << "size " << size << " angle " << rest.angle << " count " << m.count;
        EXPECT_LT(length(m.normal - first.normal), Real(1e-4));  // not more than it was turned
      }
    }
  }
}

// A box that rocks over its edges on a larger one: the ground's normal is kept, nothing alternates.
TEST(CollideCoherence, TheLargerShapeGivesTheNormalOfARockingOne) {
  const CollisionShape floor = make_collision_shape(Box{Vec3(10, 1, 10)});
  const CollisionShape cube = make_collision_shape(Box{Vec3(1, 1, 1)});
  for (int i = -50; i <= 50; ++i) {
    const Rotation tilt = from_rotation_vector(
        Vec{Real(2e-3) * static_cast<Real>(i), 0, Real(1e-3) * static_cast<Real>(i)});
    Manifold m;
    ASSERT_TRUE(collide(floor, {{0, 0, 0}, kUpright}, cube, {{0, 2, 0}, tilt}, Real(0.5), m));
    EXPECT_EQ(m.normal.y, Real(1));
    EXPECT_EQ(m.count, 4);
  }
}

// Along a path in small steps the normal turns in small steps, for rounded shapes everywhere, also
// where the closest feature goes from a face to an edge to a corner.
TEST(CollideCoherence, NormalsOfRoundedShapesFollowTheMotionAroundEdgesAndCorners) {
  const CollisionShape shapes[] = {make_collision_shape(Box{Vec3(1, Real(0.7), Real(0.4))}),
                                   make_collision_shape(ConvexHull{oracle::prism(5, 1, 0.5)})};
  const CollisionShape others[] = {make_collision_shape(Sphere{Real(0.5)}),
                                   make_collision_shape(Capsule{Real(0.6), Real(0.5)})};
  for (const CollisionShape& shape : shapes) {
    for (const CollisionShape& other : others) {
      Random random(11);
      for (int path = 0; path < 50; ++path) {
        const V from = 1.6 * random.direction(), to = 1.6 * random.direction();
        const Transform fixed{{0, 0, 0}, random.rotation()};
        const Rotation q = random.rotation();
        Manifold last;
        bool had = false;
        constexpr int kSteps = 400;
        for (int i = 0; i <= kSteps; ++i) {
          const V p = from + (to - from) * (static_cast<double>(i) / kSteps);
          const Transform moving{
              {static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())}, q};
          Manifold m;
          const bool hit = collide(shape, fixed, other, moving, Real(0.3), m);
          double deepest = 1;
          for (int k = 0; k < m.count; ++k)
            deepest = std::min(deepest, static_cast<double>(m.points[k].separation));
          // While the cores are apart by 0.2 m the direction turns by at most step / distance.
          if (hit && had && deepest > -0.3) {
            const double step = (to - from).norm() / kSteps;
            EXPECT_LT(length(m.normal - last.normal), static_cast<Real>(step / 0.19) + 16 * kEps);
          }
          had = hit && deepest > -0.3;
          last = m;
        }
      }
    }
  }
}

// Whole manifolds: where the shapes meet in random poses, motion by d changes the least separation
// by at most d (and what the preference for faces allows).
TEST(CollideCoherence, SeparationMovesNoFartherThanTheShapes) {
  Random random(23);
  int compared = 0;
  for (int i = 0; i < 4000; ++i) {
    const bool hull = random.below(2) == 0;
    const CollisionShape a = make_collision_shape(Box{Vec3(1, 2, Real(1.5))});
    const CollisionShape b = hull ? make_collision_shape(ConvexHull{oracle::prism(5, 1, 1)})
                                  : make_collision_shape(Box{Vec3(1, 1, 1)});
    const V p = random.uniform(1, 3.5) * random.direction();
    const Transform xa{{0, 0, 0}, random.rotation()};
    Transform xb{{static_cast<Real>(p.x()), static_cast<Real>(p.y()), static_cast<Real>(p.z())},
                 random.rotation()};
    const auto least = [&](double& out) {
      Manifold m;
      if (!collide(a, xa, b, xb, Real(0.2), m)) return false;
      out = 1;
      for (int k = 0; k < m.count; ++k)
        out = std::min(out, static_cast<double>(m.points[k].separation));
      return true;
    };
    double before, after;
    if (!least(before)) continue;
    const Creep c = creep(random, 1);
    xb.p += c.shift;
    if (!least(after)) continue;
    ++compared;
    EXPECT_LE(std::abs(after - before),
              1.001e-4 + 2 * (kFacePreference + kDeepestTie) + 64 * static_cast<double>(kEps));
  }
  EXPECT_GT(compared, 1500);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
