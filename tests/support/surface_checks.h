// What must hold of the contacts of any convex shape with a surface of triangles: checks that the
// tests of different shapes share.
#pragma once

#include <gtest/gtest.h>

#include "support/surface_oracle.h"

namespace plumb::inline PLUMB_ABI::surface_oracle {

inline constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

// The normal is of length one, and each point lies on the surface to a tolerance [m].
inline void expect_points_on_ground(const Ground& ground, const Manifold& m, double tolerance) {
  const V n = oracle::vec(m.normal);
  EXPECT_NEAR(n.norm(), 1, 8 * kEpsilon);
  for (int i = 0; i < m.count; ++i) {
    const double s = static_cast<double>(m.points[i].separation);
    const V below = oracle::vec(m.points[i].position) - 0.5 * s * n;
    double off = 1e300;
    for (const Triangle& t : ground.triangles) off = std::min(off, point_triangle(below, t));
    EXPECT_LE(off, tolerance);
  }
}

// Asked about the other way round the same parts come, by their numbers, with the normals turned.
inline void expect_same_swapped(const Ground& ground, const CollisionShape& shape,
                                const Transform& placed, Real margin, const PartManifolds& all) {
  PartManifolds back;
  ASSERT_TRUE(collide_parts(shape, placed, ground.shape, ground.placed, margin, back));
  ASSERT_EQ(back.parts.size(), all.parts.size());
  for (std::size_t k = 0; k < all.parts.size(); ++k) {
    EXPECT_EQ(back.parts[k].part, all.parts[k].part);
    EXPECT_EQ(length(back.parts[k].manifold.normal + all.parts[k].manifold.normal), Real(0));
    EXPECT_TRUE(k == 0 || all.parts[k - 1].part < all.parts[k].part);
  }
}

// Shapes of every kind over the middles of triangles of random grounds: at the point of the surface
// under each contact all triangles go downhill along the normal, or it is that of one of them.
// Returns how many parts were looked at.
template <class MakeShape>  // (random, kind, size)
int expect_normals_in_their_cones(Random& random, int kinds, const MakeShape& make_shape) {
  int parts = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Ground ground = random_ground(random, 1);
    const CollisionShape shape = make_shape(random, trial % kinds, 0.6);
    const Triangle& under = ground.triangles[static_cast<std::size_t>(
        random.below(static_cast<int>(ground.triangles.size())))];
    const V at =
        (under.corner[0] + under.corner[1] + under.corner[2]) / 3 +
        random.uniform(0.2, 1.0) * static_cast<double>(bounding_radius(shape)) * under.normal;
    const Transform placed{oracle::as_vec(at), random.rotation()};
    PartManifolds all;
    collide_parts(ground.shape, ground.placed, shape, placed, Real(0.1), all);
    const double half = 0.5 * static_cast<double>(smallest_thickness(shape));
    for (const PartManifold& part : all.parts) {
      ++parts;
      EXPECT_TRUE(is_real(ground, part.manifold, half))
          << "trial " << trial << " kind " << trial % kinds << " part " << part.part;
    }
  }
  return parts;
}

// The plane y = 0 about the origin, cut into triangles: meshes of few to many, and a heightfield.
struct CutPlane {
  CollisionShape shape;
  Transform placed;
};
inline std::vector<CutPlane> cut_planes() {
  std::vector<CutPlane> cuts;
  for (const auto& [nx, nz] : {std::pair{1, 1}, {7, 5}, {40, 1}, {1, 60}, {30, 30}})
    cuts.push_back({make_collision_shape(SurfaceMesh{surfaces::made(
                        surfaces::grid(-4, 4, -4, 4, nx, nz, surfaces::level, true))}),
                    {{0, 0, 0}, {0, 0, 0, 1}}});
  cuts.push_back({make_collision_shape(
                      Heightfield{surfaces::field(41, 41, 0.2, [](int, int) { return 0.0; })}),
                  {{-4, 0, -4}, {0, 0, 0, 1}}});
  return cuts;
}

// What a shape has with a half-space it has with each cut of the plane: one part, its normal up, as
// deep to a tolerance [m].
template <class Check>  // (part, that of the half-space): what else must hold
void expect_a_half_space(const std::vector<CutPlane>& cuts, const CollisionShape& shape,
                         const Transform& placed, double tolerance, const Check& check) {
  constexpr Real kMargin = Real(0.05);  // [m]
  const CollisionShape plane = make_collision_shape(HalfSpace{});
  Manifold truth;
  const bool touches = collide(plane, {{0, 0, 0}, {0, 0, 0, 1}}, shape, placed, kMargin, truth);
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    SCOPED_TRACE(testing::Message() << "cut " << c);
    PartManifolds all;
    ASSERT_EQ(collide_parts(cuts[c].shape, cuts[c].placed, shape, placed, kMargin, all), touches);
    if (!touches) continue;
    ASSERT_EQ(all.parts.size(), 1U);
    const Manifold& m = all.parts[0].manifold;
    EXPECT_EQ(m.normal.y, Real(1));
    EXPECT_NEAR(deepest_of(m), deepest_of(truth), tolerance);
    check(m, truth);
  }
}

}  // namespace plumb::inline PLUMB_ABI::surface_oracle
