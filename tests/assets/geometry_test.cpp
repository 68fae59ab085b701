// Invariant: the exact predicates give the sign of the exact determinant, and the self-crossing
// test built on them agrees with a test of all pairs.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "geometry/exact_predicates.h"
#include "geometry/triangle_bvh.h"
#include "geometry/triangle_pair.h"
#include "geometry/winding.h"
#include "sample_meshes.h"

namespace plumb::test {
namespace {

using namespace assets::detail;

// Integers below 2^17 in units of 2^-20 give determinants that 64-bit integers hold exactly.
TEST(ExactPredicates, AgreeWithIntegerArithmetic) {
  std::mt19937 random(4);
  std::uniform_int_distribution<std::int64_t> any(-40000, 40000), few(-2, 2);
  const double unit = 0x1p-20;
  int zeros = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    auto& pick = trial % 2 == 0 ? any : few;  // small ones are often on one plane
    std::int64_t p[4][3];
    Vector3d v[4];
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) {
        p[i][k] = pick(random);
        // Shifted far off: the differences stay exact, the products do not.
        v[i][k] = static_cast<double>(p[i][k] + (std::int64_t{1} << 40)) * unit;
      }
    }
    std::int64_t m[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) m[i][k] = p[i + 1][k] - p[0][k];
    }
    const std::int64_t determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                     m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                     m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const int wanted = determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
    zeros += wanted == 0 ? 1 : 0;
    ASSERT_EQ(orientation_3d(v[0], v[1], v[2], v[3]), wanted);
    const std::int64_t flat = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    ASSERT_EQ(orientation_2d(v[0].head<2>(), v[1].head<2>(), v[2].head<2>()), flat > 0   ? 1
                                                                              : flat < 0 ? -1
                                                                                         : 0);
  }
  EXPECT_GT(zeros, 500);
}

// A point moved off a plane by one unit in the last place is seen on its side, where plain doubles
// fail.
TEST(ExactPredicates, SeeTheLastBit) {
  const Vector3d a(12, 12, 12), b(24, 24, 24.5), c(0.1, 0.7, 0.3);
  const Vector3d middle = 0.5 * a + 0.5 * b;  // exact
  EXPECT_EQ(orientation_3d(a, b, c, middle), 0);
  for (int k = 0; k < 3; ++k) {
    Vector3d above = middle, below = middle;
    above[k] = std::nextafter(middle[k], 1e9);
    below[k] = std::nextafter(middle[k], -1e9);
    EXPECT_NE(orientation_3d(a, b, c, above), 0);
    EXPECT_EQ(orientation_3d(a, b, c, above), -orientation_3d(a, b, c, below));
  }
}

PairRelation relation(const std::vector<Vector3d>& places, const Triangle& first,
                      const Triangle& second) {
  std::optional<Vector3d> contact;
  return relation_of(places, first, second, contact);
}

// Symmetric in its arguments, in the order of corners and under mirroring.
TEST(TrianglePair, RelationIsSymmetric) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> grid(0, 3);  // many degenerate cases
  int counts[3] = {0, 0, 0};
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<Vector3d> places;
    for (int i = 0; i < 6; ++i) places.emplace_back(grid(random), grid(random), grid(random));
    if (assets::bounds_of({places, {{0, 1, 2}, {3, 4, 5}}, "", 0}).diagonal() == 0) continue;
    const auto area = [&](int i, int j, int k) {
      return (places[static_cast<std::size_t>(j)] - places[static_cast<std::size_t>(i)])
          .cross(places[static_cast<std::size_t>(k)] - places[static_cast<std::size_t>(i)])
          .norm();
    };
    if (area(0, 1, 2) == 0 || area(3, 4, 5) == 0) continue;
    bool distinct = true;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < i; ++j) distinct = distinct && places[i] != places[j];
    }
    if (!distinct) continue;
    const PairRelation found = relation(places, {0, 1, 2}, {3, 4, 5});
    ++counts[static_cast<int>(found)];
    ASSERT_EQ(found, relation(places, {3, 4, 5}, {0, 1, 2}));
    ASSERT_EQ(found, relation(places, {1, 2, 0}, {5, 4, 3}));
    std::vector<Vector3d> mirrored = places;
    for (Vector3d& p : mirrored) p.x() = -p.x();
    ASSERT_EQ(found, relation(mirrored, {0, 1, 2}, {3, 4, 5}));
  }
  for (const int count : counts) EXPECT_GT(count, 100);  // all three kinds occurred
}

TEST(TriangleBvh, VisitsEveryOverlappingPairOnce) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(0, 1);
  TriangleMesh mesh;
  std::vector<std::uint32_t> all;
  for (std::uint32_t k = 0; k < 300; ++k) {
    const Vector3d at(any(random), any(random), any(random));
    for (int i = 0; i < 3; ++i)
      mesh.vertices.push_back(at + 0.1 * Vector3d(any(random), any(random), any(random)));
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    all.push_back(k);
  }
  const auto box = [&](std::uint32_t t) {
    Eigen::AlignedBox3d b;
    for (const std::uint32_t v : mesh.triangles[t]) b.extend(mesh.vertices[v]);
    return b;
  };
  std::vector<std::vector<int>> seen(300, std::vector<int>(300, 0));
  const TriangleBvh bvh(mesh.vertices, mesh.triangles, all);
  bvh.overlapping_pairs([&](std::uint32_t a, std::uint32_t b) {
    ++seen[std::min(a, b)][std::max(a, b)];
    return true;
  });
  for (std::uint32_t a = 0; a < 300; ++a) {
    for (std::uint32_t b = a + 1; b < 300; ++b)
      ASSERT_EQ(seen[a][b], box(a).intersects(box(b)) ? 1 : 0);
  }
}

// 1 inside, 0 outside, to the 0.02 promised for the grouped sum.
TEST(Winding, IsOneInsideAndZeroOutside) {
  const TriangleMesh mesh = torus_mesh(1, 0.3, 16);
  std::vector<std::uint32_t> all(mesh.triangles.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  const WindingField field(mesh.vertices, mesh.triangles, all);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.5, 1.5);
  int inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector3d p(any(random), 0.3 * any(random), any(random));
    const double to_ring = std::hypot(std::hypot(p.x(), p.z()) - 1, p.y());
    if (to_ring > 0.27 && to_ring < 0.32) continue;  // near the facets
    inside += to_ring < 0.3 ? 1 : 0;
    ASSERT_NEAR(field.at(p), to_ring < 0.3 ? 1 : 0, 0.02);
  }
  EXPECT_GT(inside, 100);
  for (std::uint32_t t = 0; t < all.size(); t += 7) {
    EXPECT_NEAR(field.beside(t).front, 0, 0.02);
    EXPECT_NEAR(field.beside(t).back, 1, 0.02);
  }
}

}  // namespace
}  // namespace plumb::test
