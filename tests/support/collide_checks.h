// What must hold of the manifold of any two shapes, asked for either way round: checks that the
// tests of different shapes share.
#pragma once

#include <gtest/gtest.h>

#include "collision/collide.h"
#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI::oracle {

// Two shapes in place, sought within a margin [m].
struct Scene {
  detail::CollisionShape a, b;
  detail::Transform xa, xb;
  Real margin;
};

// What collide says about a scene, and about it with the shapes swapped.
struct Answers {
  bool hit = false;
  detail::Manifold m, swapped;
};

// Asks. A hit beyond a distance or none within another [m] is wrong, and so is a normal whose
// length is not 1.
inline void ask_both_ways(const Scene& s, double truth, double beyond, double within,
                          Answers& answers) {
  auto& [hit, m, swapped] = answers;
  hit = detail::collide(s.a, s.xa, s.b, s.xb, s.margin, m);
  ASSERT_EQ(detail::collide(s.b, s.xb, s.a, s.xa, s.margin, swapped), hit);
  if (truth > beyond) {
    ASSERT_FALSE(hit) << "distance " << truth << " margin " << s.margin;
  }
  if (truth < within) {
    ASSERT_TRUE(hit) << "distance " << truth << " margin " << s.margin;
  }
  if (!hit) return;
  ASSERT_GE(m.count, 1);
  ASSERT_LE(m.count, detail::Manifold::kMaxPoints);
  constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());
  ASSERT_LE(std::abs(vec(m.normal).norm() - 1), 2 * kEpsilon);
}

// Swapped, the points are the same and the normal is turned, unless the two are one and the same.
inline void expect_swapped(const Scene& s, const Answers& answers) {
  const auto& [hit, m, swapped] = answers;
  ASSERT_EQ(swapped.count, m.count);
  for (int i = 0; i < m.count; ++i) {
    EXPECT_EQ(m.points[i].position.x, swapped.points[i].position.x);
    EXPECT_EQ(m.points[i].separation, swapped.points[i].separation);
  }
  if (s.a.type == s.b.type && s.xa.p.x == s.xb.p.x && s.xa.q.x == s.xb.q.x) return;
  EXPECT_EQ(swapped.normal.x, -m.normal.x);
  EXPECT_EQ(swapped.normal.y, -m.normal.y);
  EXPECT_EQ(swapped.normal.z, -m.normal.z);
}

}  // namespace plumb::inline PLUMB_ABI::oracle
