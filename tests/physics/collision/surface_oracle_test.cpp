// Invariant: against meshes and heightfields of any size and place, in random and degenerate poses,
// the deepest contact of every convex shape is as far from the surface as trying every feature of
// every triangle says; every normal is one along which the surface around the point lies downhill;
// every point lies on the surface; a closed mesh is as deep as the solid it bounds; swapping the
// shapes changes nothing but signs.
#include <gtest/gtest.h>

#include "support/surface_checks.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace surface_oracle;

// Whether an edge of either passes through the other: the cores of the shapes meet.
bool passes_through(const V& a, const V& b, const Triangle& t) {
  const double ha = t.normal.dot(a - t.corner[0]), hb = t.normal.dot(b - t.corner[0]);
  if (ha * hb >= 0) return false;
  const V p = a + ha / (ha - hb) * (b - a);
  for (int k = 0; k < 3; ++k)
    if ((t.corner[(k + 1) % 3] - t.corner[k]).cross(p - t.corner[k]).dot(t.normal) < 0)
      return false;
  return true;
}

// Whether a triangle's edge passes through the core of a shape with faces.
bool is_pierced(const oracle::Solid& s, const V& a, const V& b) {
  double from = 0, to = 1;
  for (std::size_t k = 0; k < s.faces.size() && from <= to; ++k) {
    const V& on = s.vertices[static_cast<std::size_t>(s.faces[k][0])];
    const double ha = s.normals[k].dot(a - on), hb = s.normals[k].dot(b - on);
    if (ha > 0 && hb > 0) return false;
    if (ha > 0) from = std::max(from, ha / (ha - hb));
    if (hb > 0) to = std::min(to, ha / (ha - hb));
  }
  return from <= to && !s.faces.empty();
}

// Distance of a convex shape's surface from all triangles; 0 or less where they meet.
double distance_from(const Ground& g, const oracle::Solid& s) {
  double best = 1e300;
  for (const Triangle& t : g.triangles) {
    for (const auto& [a, b] : s.edges)
      if (passes_through(s.vertices[static_cast<std::size_t>(a)],
                         s.vertices[static_cast<std::size_t>(b)], t))
        return -s.radius;
    for (int k = 0; k < 3; ++k)
      if (is_pierced(s, t.corner[k], t.corner[(k + 1) % 3])) return -s.radius;
    best = std::min(best, oracle::feature_distance(s, solid_of_triangle(t)));
  }
  return best - s.radius;
}

constexpr int kKinds = 6;  // sphere, capsule, box, hull, and the last two rounded

CollisionShape random_convex(Random& random, int kind, double size) {
  if (kind > 3) {
    const auto side = [&] { return static_cast<Real>(size * random.uniform(0.3, 1)); };
    const Real rounding = static_cast<Real>(size * random.uniform(0.02, 0.4));
    if (kind == 4) return make_collision_shape(Box{Vec3(side(), side(), side()), rounding});
    return make_collision_shape(
        ConvexHull{oracle::random_hull(random, 6 + random.below(6), size), rounding});
  }
  const int hull_corners = kind == 3 ? 6 + random.below(6) : 0;
  return make_collision_shape(oracle::random_shape(random, kind, size, 0.3, hull_corners));
}

TEST(SurfaceOracle, TheNearestContactIsAsFarAsEveryFeatureSays) {
  Random random(17);
  int near = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial << " kind " << trial % kKinds);
    const double size = random.below(3) == 0 ? random.scale(1e-3, 1e4) : 1.0;
    const Ground ground = random_ground(random, size);
    const CollisionShape shape = random_convex(random, trial % kKinds, 0.6 * size);
    const double reach = static_cast<double>(bounding_radius(shape));
    const Transform placed = above(random, ground, 0.3 * reach, 1.3 * reach);
    const V at = oracle::vec(placed.p);
    const oracle::Solid solid = oracle::solid_of(shape, placed);
    const double distance = distance_from(ground, solid);
    if (!(distance > 0)) continue;
    bool in_front = true;  // of each triangle that is as near: else the surface shows its back
    for (const Triangle& t : ground.triangles) {
      const double d = oracle::feature_distance(solid, solid_of_triangle(t)) - solid.radius;
      if (d < distance + 1e-6 * size && t.normal.dot(at - t.corner[0]) <= 1e-3 * size)
        in_front = false;
    }
    if (!in_front) continue;
    const double margin = 0.2 * size;
    PartManifolds all;
    const bool hit =
        collide_parts(ground.shape, ground.placed, shape, placed, static_cast<Real>(margin), all);
    const double rounding = 64 * kEpsilon * 8 * size;
    if (distance > margin + rounding) {
      EXPECT_FALSE(hit) << "distance " << distance / size;
      continue;
    }
    if (distance > margin - rounding) continue;
    ++near;
    ASSERT_TRUE(hit) << "distance " << distance / size;
    // Coplanar triangles share a normal: 2e-4 over the reach of the shape, and a preference of
    // 1e-3 of the half thickness for faces.
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    EXPECT_NEAR(deepest_of(all), distance, 1.2e-3 * half + 4e-4 * reach + rounding)
        << "size " << size;
    for (const PartManifold& part : all.parts)
      expect_points_on_ground(ground, part.manifold, 2e-3 * half + rounding);
    ASSERT_NO_FATAL_FAILURE(
        expect_same_swapped(ground, shape, placed, static_cast<Real>(margin), all));
  }
  EXPECT_GT(near, 700);
}

TEST(SurfaceOracle, EveryNormalLiesInTheConeOfItsPlace) {
  Random random(23);
  EXPECT_GT(expect_normals_in_their_cones(random, kKinds, random_convex), 3000);
}

// The mesh of a box is the box, and that of a plane is the half-space, while the overlap is small.
TEST(SurfaceOracle, AClosedMeshIsAsDeepAsItsSolid) {
  Random random(29);
  const CollisionShape mesh =
      make_collision_shape(SurfaceMesh{surfaces::made(surfaces::box_soup(2, 1, 1.5))});
  const CollisionShape box = make_collision_shape(Box{Vec3(2, 1, Real(1.5))});
  int touched = 0;
  for (int trial = 0; trial < 8000; ++trial) {
    const CollisionShape shape = random_convex(random, trial % kKinds, 0.6);
    const Transform fixed{{0, 0, 0}, random.rotation()};
    const V at = random.uniform(1, 3) * random.direction();
    const Transform placed{oracle::as_vec(at), random.below(3) == 0 ? fixed.q : random.rotation()};
    const double truth =
        oracle::signed_distance(oracle::solid_of(box, fixed), oracle::solid_of(shape, placed));
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    PartManifolds all;
    const bool hit = collide_parts(mesh, fixed, shape, placed, Real(0), all);
    if (truth > 1e-4) {
      EXPECT_FALSE(hit) << "trial " << trial << " kind " << trial % kKinds << " truth " << truth
                        << " deep " << deepest_of(all) << " " << all.parts.size();
    }
    // Deep capsules and edges among themselves have other ways out: a fifth of the half thickness.
    const bool grown = trial % kKinds > 3;
    if (truth > -2e-3 * half || truth < -0.2 * half) continue;
    if (grown && truth < -static_cast<double>(shape.radius)) continue;  // the sharp ones' business
    ++touched;
    ASSERT_TRUE(hit) << "trial " << trial << " kind " << trial % kKinds << " depth " << truth;
    double least = 0;  // the shallowest part is the way out
    for (const PartManifold& part : all.parts) {
      const double deepest = std::min(0.0, deepest_of(part.manifold));
      least = least == 0 ? deepest : std::max(least, deepest);
    }
    // Of cores that are still apart every point is as deep as it is near.
    EXPECT_NEAR(grown ? deepest_of(all) : least, truth, 2.2e-3 * half + 64 * kEpsilon)
        << "trial " << trial << " kind " << trial % kKinds << " parts " << all.parts.size();
  }
  EXPECT_GT(touched, 150);
}

// However a plane is cut into triangles, what lies on it has the contacts it has with a half-space.
TEST(SurfaceOracle, APlaneOfTrianglesIsAHalfSpace) {
  Random random(31);
  const std::vector<CutPlane> cuts = cut_planes();
  for (int trial = 0; trial < 1500; ++trial) {
    const CollisionShape shape = random_convex(random, trial % kKinds, 0.5);
    // Lying flat in a third of all.
    const Rotation q =
        random.below(3) == 0
            ? from_rotation_vector(Vec{0, static_cast<Real>(random.uniform(0, 3)), 0})
            : random.rotation();
    Transform placed{
        {static_cast<Real>(random.uniform(-1, 1)), 0, static_cast<Real>(random.uniform(-1, 1))}, q};
    const Aabb box = bounds_of(shape, placed);
    placed.p.y = -box.lower.y + static_cast<Real>(random.uniform(-0.02, 0.02));
    SCOPED_TRACE(testing::Message() << "trial " << trial << " kind " << trial % kKinds);
    // Points of two triangles that coincide to a thousandth of the half thickness are one, as deep
    // as the deeper of them to a millionth.
    const double tolerance = 1e-6 * 0.5 + 64 * kEpsilon;
    ASSERT_NO_FATAL_FAILURE(expect_a_half_space(
        cuts, shape, placed, tolerance, [&](const Manifold& m, const Manifold& truth) {
          EXPECT_GE(m.count, truth.count > 2 && trial % kKinds > 1 ? 3 : 1);
          // The same support: each point of one has one of the other at its side.
          if (trial % kKinds != 2 || truth.count != m.count) return;
          for (int i = 0; i < m.count; ++i) {
            double nearest = 1;
            for (int k = 0; k < truth.count; ++k)
              nearest = std::min(nearest, static_cast<double>(length(m.points[i].position -
                                                                     truth.points[k].position)));
            EXPECT_LT(nearest, 2e-3);
          }
        }));
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
