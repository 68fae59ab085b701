// Invariant: cylinders and cones, sharp and rounded, are truly round on triangles. Apart, their
// deepest contact is as far from the surface as the closest point of every triangle; overlapping,
// the mesh of a convex solid is as deep as the solid; a plane of triangles is a half-space; over a
// ridge the normal turns steadily from one side to the other, at the rate at which the shape goes.
#include <gtest/gtest.h>

#include "support/curved_oracle.h"
#include "support/surface_checks.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace surface_oracle;
using oracle::as_vec;

constexpr int kKinds = 4;  // cylinder, cone, and both rounded

CollisionShape random_round(Random& random, int kind, double size) {
  // One in six is a sliver.
  const double thin = random.below(6) == 0 ? 0.05 : 1;
  const Real a = static_cast<Real>(size * random.uniform(0.3, 1));
  const Real b = static_cast<Real>(thin * size * random.uniform(0.3, 1));
  const Real rounding = kind > 1 ? static_cast<Real>(size * random.uniform(0.02, 0.4)) : Real(0);
  const bool flat = random.below(2) == 0;
  const Real half = flat ? b : a, radius = flat ? a : b;
  return kind % 2 == 0 ? make_collision_shape(Cylinder{half, radius, rounding})
                       : make_collision_shape(Cone{half, radius, rounding});
}

// The smallest value in [0, 1] of a function without a second valley.
template <class F>
double smallest(const F& f) {
  constexpr int kSteps = 36;  // each keeps 0.62 of the range: 3e-8 of it stays
  const double g = (std::sqrt(5.0) - 1) / 2;
  double low = 0, high = 1, x = 1 - g, y = g, fx = f(x), fy = f(y);
  double best = std::min({f(low), f(high), fx, fy});
  for (int i = 0; i < kSteps; ++i) {
    if (fx < fy) {
      high = y, y = x, fy = fx, x = high - g * (high - low), fx = f(x);
    } else {
      low = x, x = y, fx = fy, y = low + g * (high - low), fy = f(y);
    }
    best = std::min({best, fx, fy});
  }
  return best;
}

// Distance of a convex body from a triangle; 0 or less where they meet.
double distance_from(const Triangle& t, const oracle::Body& body) {
  return smallest([&](double s) {
    return smallest([&](double u) {
      return body.distance(V(t.corner[0] + s * (t.corner[1] - t.corner[0]) +
                             (1 - s) * u * (t.corner[2] - t.corner[0])));
    });
  });
}

// How a shape lies against a ground: its distance, and whether it is in front of what is nearest.
struct Apart {
  double distance = 1e300;
  bool in_front = true;
};
Apart apart_from(const Ground& ground, const oracle::Body& body, const V& at, double reach) {
  Apart out;
  std::vector<std::pair<double, const Triangle*>> all;
  for (const Triangle& t : ground.triangles) {
    if (point_triangle(at, t) - reach > std::min(out.distance, ground.size)) continue;
    all.emplace_back(distance_from(t, body), &t);
    out.distance = std::min(out.distance, all.back().first);
  }
  for (const auto& [d, t] : all)
    if (d < out.distance + 1e-6 * ground.size &&
        t->normal.dot(at - t->corner[0]) <= 1e-3 * ground.size)
      out.in_front = false;
  return out;
}

TEST(RoundOnSurfaceOracle, TheNearestContactIsAsFarAsEveryTriangleSays) {
  Random random(41);
  int near = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial << " kind " << trial % kKinds);
    const double size = random.below(3) == 0 ? random.scale(1e-3, 1e4) : 1.0;
    const Ground ground = random_ground(random, size);
    const CollisionShape shape = random_round(random, trial % kKinds, 0.6 * size);
    const double reach = static_cast<double>(bounding_radius(shape));
    const Transform placed = above(random, ground, 0.3 * reach, 1.2 * reach);
    const oracle::Body body(shape, placed);
    const Apart truth = apart_from(ground, body, oracle::vec(placed.p), reach);
    if (!(truth.distance > 0) || !truth.in_front) continue;
    const double margin = 0.2 * size;
    PartManifolds all;
    const bool hit =
        collide_parts(ground.shape, ground.placed, shape, placed, static_cast<Real>(margin), all);
    const double rounding = 64 * kEpsilon * 8 * size;
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    if (truth.distance > margin + rounding) {
      EXPECT_FALSE(hit) << "distance " << truth.distance / size;
      continue;
    }
    if (truth.distance > margin - rounding) continue;
    ++near;
    ASSERT_TRUE(hit) << "distance " << truth.distance / size;
    // Coplanar triangles share a normal: 2e-4 over the reach of the shape, and a preference of
    // 1e-3 of the half thickness for faces.
    EXPECT_NEAR(deepest_of(all), truth.distance, 1.2e-3 * half + 4e-4 * reach + rounding)
        << "size " << size;
    for (const PartManifold& part : all.parts) {
      expect_points_on_ground(ground, part.manifold, 2e-3 * half + rounding);
      const V n = oracle::vec(part.manifold.normal);
      for (int i = 0; i < part.manifold.count; ++i) {
        const ManifoldPoint& point = part.manifold.points[i];
        const double s = static_cast<double>(point.separation);
        const V above = oracle::vec(point.position) + 0.5 * s * n;
        // A rounded one keeps the deepest point of each triangle, though it bulges beyond it.
        if (trial % kKinds > 1 && s > deepest_of(all)) continue;
        EXPECT_NEAR(body.distance(above), 0, 2e-3 * half + rounding) << "separation " << s / size;
      }
    }
    ASSERT_NO_FATAL_FAILURE(
        expect_same_swapped(ground, shape, placed, static_cast<Real>(margin), all));
  }
  std::printf("[ figures  ] %d near\n", near);
  EXPECT_GT(near, 500);
}

// The part along whose normal a convex surface and a body have the most room: the way out.
struct WayOut {
  V normal = V::Zero();
  double room = -1e300;   // [m] by the shapes themselves
  double found = -1e300;  // [m] by the deepest point
};
WayOut way_out(const std::vector<V>& corners, const oracle::Body& body, const PartManifolds& all) {
  WayOut best;
  for (const PartManifold& part : all.parts) {
    const V n = oracle::vec(part.manifold.normal).normalized();
    double top = -1e300, deepest = 1e300;
    for (const V& corner : corners) top = std::max(top, n.dot(corner));
    for (int i = 0; i < part.manifold.count; ++i)
      deepest = std::min(deepest, static_cast<double>(part.manifold.points[i].separation));
    const double room = -body.reach(-n) - top;
    if (room > best.room) best = {n, room, deepest};
  }
  return best;
}

// The faces of a hull or box as a mesh, corners shared.
Shape mesh_of(const CollisionShape& solid) {
  const oracle::Solid s = oracle::solid_of(solid, {{0, 0, 0}, {0, 0, 0, 1}});
  Soup soup;
  for (const V& v : s.vertices) soup.add(v);
  for (const std::vector<int>& face : s.faces)
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
      soup.triangle(static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[k]),
                    static_cast<std::uint32_t>(face[k + 1]));
  return SurfaceMesh{surfaces::made(soup)};
}

TEST(RoundOnSurfaceOracle, TheMeshOfASolidIsAsDeepAsTheSolid) {
  Random random(43);
  int touched = 0;
  double worst = 0;
  for (int trial = 0; trial < 2500; ++trial) {
    const CollisionShape shape = random_round(random, trial % kKinds, 0.6);
    const CollisionShape solid =
        random.below(2) == 0
            ? make_collision_shape(Box{Vec3(2, 1, Real(1.5))})
            : make_collision_shape(ConvexHull{oracle::random_hull(random, 5 + random.below(6), 2)});
    const CollisionShape mesh = make_collision_shape(mesh_of(solid));
    const Transform fixed{{0, 0, 0}, random.rotation()};
    Transform placed{{0, 0, 0}, random.below(3) == 0 ? fixed.q : random.rotation()};
    // Pushed out along a direction to a shallow overlap: the way out may be another one, so twice.
    const V away = random.direction();
    const oracle::Body ground(solid, fixed);
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    const double wanted = random.uniform(-0.05, 0.25) * half;  // [m] of overlap
    double room = oracle::room_along(ground, oracle::Body(shape, placed), away), along = 0;
    for (int i = 0; i < 3; ++i) {
      along -= room + wanted;
      placed.p = as_vec(V(along * away));
      room = oracle::Search(ground, oracle::Body(shape, placed)).most_room(150, 30);
    }
    const oracle::Body body(shape, placed);
    const double truth = oracle::Search(ground, body).most_room(600, 90);
    PartManifolds all;
    const bool hit = collide_parts(mesh, fixed, shape, placed, Real(0), all);
    if (truth > 1e-4) {
      EXPECT_FALSE(hit) << "trial " << trial << " kind " << trial % kKinds << " truth " << truth
                        << " deep " << deepest_of(all) << " " << all.parts.size();
    }
    const bool grown = trial % kKinds > 1;
    if (truth > -2e-3 * half || truth < -0.2 * half) continue;
    if (grown && truth < -static_cast<double>(shape.radius)) continue;  // the sharp ones' business
    ++touched;
    EXPECT_TRUE(hit) << "trial " << trial << " kind " << trial % kKinds << " depth "
                     << truth / half;
    if (!hit) continue;
    const WayOut out = way_out(oracle::solid_of(solid, fixed).vertices, body, all);
    worst =
        std::max({worst, std::abs(out.room - truth) / half, std::abs(out.found - truth) / half});
    EXPECT_NEAR(out.room, truth, 2.2e-3 * half + 64 * kEpsilon) << "trial " << trial;
    EXPECT_NEAR(out.found, truth, 2.2e-3 * half + 64 * kEpsilon)
        << "trial " << trial << " kind " << trial % kKinds << " parts " << all.parts.size();
  }
  std::printf("[ figures  ] %d touched, worst %.2g of the half thickness\n", touched, worst);
  EXPECT_GT(touched, 1000);
}

TEST(RoundOnSurfaceOracle, EveryNormalLiesInTheConeOfItsPlace) {
  Random random(47);
  EXPECT_GT(expect_normals_in_their_cones(random, kKinds, random_round), 3000);
}

// However a plane is cut into triangles, what lies on it has the contact that it has with a
// half-space, on as many points.
TEST(RoundOnSurfaceOracle, APlaneOfTrianglesIsAHalfSpace) {
  Random random(53);
  const std::vector<CutPlane> cuts = cut_planes();
  const Real h = std::sqrt(Real(0.5));
  for (int trial = 0; trial < 1500; ++trial) {
    const CollisionShape shape = random_round(random, trial % kKinds, 0.5);
    // Upright, lying, and any way.
    const Rotation ways[3] = {{0, 0, 0, 1}, {h, 0, 0, h}, random.rotation()};
    Transform placed{
        {static_cast<Real>(random.uniform(-1, 1)), 0, static_cast<Real>(random.uniform(-1, 1))},
        ways[random.below(3)]};
    const Aabb box = bounds_of(shape, placed);
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    placed.p.y = -box.lower.y + static_cast<Real>(random.uniform(-0.2, 0.2) * half);
    SCOPED_TRACE(testing::Message() << "trial " << trial << " kind " << trial % kKinds);
    // A disc that lies flat to kDeepestTie of the half thickness takes any points of its rim.
    const double tolerance = 1.1e-4 * half + 64 * kEpsilon;
    ASSERT_NO_FATAL_FAILURE(expect_a_half_space(
        cuts, shape, placed, tolerance, [&](const Manifold& m, const Manifold& truth) {
          // A rounded rim keeps the points that its rounding does not miss: the deepest at least.
          const int least = trial % kKinds > 1 ? 1 : std::min(truth.count, 2);
          EXPECT_GE(m.count, least);
        }));
  }
}

// The depth of a convex shape in a convex solid is a convex function of where it is. So on a
// straight way over a ridge the normal only ever turns on: back it would mean a flip. While the two
// are a distance d apart it turns by no more than the way over d, but for the preference for faces.
TEST(RoundOnSurfaceOracle, OverARidgeTheNormalTurnsOnAndOn) {
  Random random(59);
  double back = 0, jump = 0;
  int turned = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double left = random.uniform(0.02, 1.2), right = random.uniform(0.02, 1.2);
    const Soup roof = surfaces::grid(
        -2, 2, -3, 3, 2, 1, [&](double x, double) { return x < 0 ? left * x : -right * x; });
    const CollisionShape mesh = make_collision_shape(SurfaceMesh{surfaces::made(roof)});
    std::vector<V> corners;
    for (const Vec3& v : roof.vertices) corners.push_back(v.cast<double>());
    const CollisionShape shape = random_round(random, trial % kKinds, 0.6);
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    const Real h = std::sqrt(Real(0.5));
    // Standing, its axis along the ridge or nearly so, and any way.
    const Rotation near =
        from_rotation_vector(as_vec(V(random.scale(1e-5, 0.1) * random.direction())));
    const Rotation ways[4] = {
        {0, 0, 0, 1}, {h, 0, 0, h}, near * Rotation{h, 0, 0, h}, random.rotation()};
    Transform placed{{0, 0, 0}, ways[random.below(4)]};
    // Apart by 2 to 10 % of the half thickness over the ridge itself, or as deep.
    const bool apart = random.below(2) == 0;
    const double gap = random.uniform(0.02, 0.1) * half;
    placed.p.y = -bounds_of(shape, placed).lower.y + static_cast<Real>(apart ? gap : -gap);
    constexpr int kSteps = 400;
    const double from = -0.5 * half, step = half / kSteps;
    V last = V::Zero();
    for (int i = 0; i <= kSteps; ++i) {
      placed.p.x = static_cast<Real>(from + step * i);
      PartManifolds all;
      ASSERT_TRUE(collide_parts(mesh, {{0, 0, 0}, {0, 0, 0, 1}}, shape, placed, Real(1), all));
      const WayOut out = way_out(corners, oracle::Body(shape, placed), all);
      const V n = out.normal;
      if (i > 0) {
        turned += (n - last).norm() > 0 ? 1 : 0;
        back = std::max(back, last.x() - n.x());
        EXPECT_GE(n.x(), last.x() - 1e-6)
            << "trial " << trial << " step " << i << " apart " << apart;
        if (out.room > 0.02 * half) {
          jump = std::max(jump, (n - last).norm());
          EXPECT_LE((n - last).norm(), 0.15) << "trial " << trial << " step " << i;
        }
      }
      last = n;
    }
  }
  std::printf("[ figures  ] over a ridge: turned in %d steps, back by %.2g, at once by %.2g\n",
              turned, back, jump);
  EXPECT_GT(turned, 10000);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
