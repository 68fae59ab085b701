// Invariant: remembering which face kept two polyhedra apart changes no bit of what is found. Pairs
// drift past one another; at every pose the answer with memory equals the answer without, and most
// of the poses in which they are apart are told from the memory.
#include "collision/separating_face.h"

#include <gtest/gtest.h>

#include "collision/collide.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::V;

constexpr int kPairs = 60, kSteps = 200;

Vec to_vec(const V& v) {
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

CollisionShape random_polyhedron(Random& random, double size) {
  switch (random.below(4)) {
    case 0:
      return make_collision_shape(Box{Vec3::Constant(static_cast<Real>(size))});
    case 1:
      return make_collision_shape(
          Box{Vec3::Constant(static_cast<Real>(size)), static_cast<Real>(0.1 * size)});
    case 2:
      return make_collision_shape(ConvexHull{oracle::prism(7, size, 0.4 * size)});
    default:
      return make_collision_shape(ConvexHull{oracle::random_hull(random, 14, size)});
  }
}

// A relative motion at constant velocity that leads from one side past the other.
struct Flyby {
  V start, path;
  Rotation attitude;
  Vec turn;  // [rad] in all
  explicit Flyby(Random& random, double size)
      : start(2.5 * size * random.direction()),
        path(-2 * start + 1.5 * size * random.direction()),
        attitude(random.rotation()),
        turn(to_vec(random.uniform(0, 2) * random.direction())) {}
  [[nodiscard]] Transform at(double t) const {
    return {to_vec(start + t * path),
            normalized(from_rotation_vector(static_cast<Real>(t) * turn) * attitude)};
  }
};

bool same(const Manifold& a, const Manifold& b) {
  if (a.count != b.count) return false;
  if (a.count == 0) return true;
  bool equal = a.normal.x == b.normal.x && a.normal.y == b.normal.y && a.normal.z == b.normal.z;
  for (int i = 0; i < a.count; ++i) {
    const ManifoldPoint &p = a.points[i], &q = b.points[i];
    equal = equal && p.position.x == q.position.x && p.position.y == q.position.y &&
            p.position.z == q.position.z && p.separation == q.separation && p.feature == q.feature;
  }
  return equal;
}

TEST(SeparatingFace, MemoryChangesNoBitOfAManifold) {
  Random random(11);
  int apart = 0, from_memory = 0;
  for (int k = 0; k < kPairs; ++k) {
    const double size = random.scale(1e-3, 1e3);
    const CollisionShape a = random_polyhedron(random, size), b = random_polyhedron(random, size);
    const Transform xa{to_vec(V(0.1 * size, 0, 0)), random.rotation()};
    const Flyby flyby(random, size);
    const Real margin = static_cast<Real>(random.uniform(0, 0.05) * size);
    PairMemory memory;
    for (int i = 0; i <= kSteps; ++i) {
      const Transform xb = flyby.at(static_cast<double>(i) / kSteps);
      Manifold with, without;
      const bool known = memory.axis.is_face();
      const bool touching = collide(a, xa, b, xb, margin, with, &memory);
      EXPECT_EQ(touching, collide(a, xa, b, xb, margin, without));
      ASSERT_TRUE(same(with, without)) << "pair " << k << ", pose " << i;
      EXPECT_FALSE(touching && memory.axis.is_face());
      apart += touching ? 0 : 1;
      from_memory += !touching && known && memory.axis.is_face() ? 1 : 0;
    }
  }
  std::printf("[ figures  ] %d of %d poses apart, %d with a face remembered\n", apart,
              kPairs * (kSteps + 1), from_memory);
  EXPECT_GT(from_memory, apart / 5);
}

// What was remembered may be of a shape that is gone: any face number is safe, and a face that does
// not keep the shapes apart says nothing.
TEST(SeparatingFace, AStaleMemoryIsHarmless) {
  const CollisionShape a = make_collision_shape(Box{Vec3(1, 1, 1)});
  const CollisionShape b = make_collision_shape(ConvexHull{oracle::prism(5, 1, 1)});
  const Transform xa{{0, 0, 0}, {0, 0, 0, 1}}, xb{{0, Real(1.5), 0}, {0, 0, 0, 1}};
  for (const bool of_second : {false, true}) {
    for (int face = 0; face < 300; ++face) {
      PairMemory memory{AxisHint::of_face(face, of_second)};
      Manifold manifold;
      EXPECT_TRUE(collide(a, xa, b, xb, Real(0), manifold, &memory));
      EXPECT_EQ(manifold.count, 4);
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
