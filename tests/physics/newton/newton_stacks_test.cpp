// Proves that the accurate contact solver holds what the fast one cannot: columns whatever their
// masses and heights, with contact forces that are weights, within a few iterations.
#include <gtest/gtest.h>

#include <tuple>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

WorldSettings newton(int substeps = WorldSettings{}.substeps) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::Newton;
  settings.substeps = substeps;
  return settings;
}

struct Verdict {
  double top = 0;    // [m] way of the top box
  double sink = 0;   // [m] of any box
  double drift = 0;  // [m] sideways
  std::uint32_t fallbacks = 0;
};
Verdict stand(const Column& column, double seconds, int substeps) {
  PhysicsWorld world(newton(substeps));
  const Built built = build_column(world, column);
  std::vector<Vector3d> start;
  for (const BodyId body : built.bodies) start.push_back(position(world, body));
  Verdict v;
  run(world, seconds, kDt, [&] { v.fallbacks += world.last_report().newton_fallbacks; });
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Vector3d way = position(world, built.bodies[i]) - start[i];
    v.sink = std::max(v.sink, std::abs(way.y()));
    v.drift = std::max(v.drift, std::hypot(way.x(), way.z()));
    if (i + 1 == start.size()) v.top = way.norm();
  }
  return v;
}

// Scene S7: ten boxes, each four times as heavy as the one below, 1 : 262144 in all.
class MassRatio : public ::testing::TestWithParam<std::tuple<Column, int>> {};

TEST_P(MassRatio, StandsForTenSeconds) {
  const auto& [column, substeps] = GetParam();
  const Verdict v = stand(column, 10, substeps);
  EXPECT_LE(v.top, 0.05);
  EXPECT_LE(v.drift, column.tilt > 0 ? 0.05 : 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    S7, MassRatio,
    ::testing::Combine(::testing::Values(Column{10, 4}, Column{10, 4, 0.01},
                                         Column{.count = 10, .growth = 4, .tilt = 1e-3},
                                         Column{.count = 10, .growth = 4, .tilt = 1e-2}),
                       ::testing::Values(1, 4)));

// Scene S8: fifty equal boxes, one on the other and shifted to and fro by a centimetre.
TEST(NewtonStacks, S8_FiftyBoxesSinkAndDriftByLessThanAMillimetre) {
  for (const double shift : {0.0, 0.01}) {
    const Verdict v = stand({50, 1, shift}, 10, 1);
    EXPECT_LE(v.sink, 1e-3) << shift;
    EXPECT_LE(v.drift, 1e-3) << shift;
    EXPECT_EQ(v.fallbacks, 0u) << shift;
  }
}

// Reference case C18: the k-th contact carries (n - k) m g, to 0.1 % after a second.
TEST(NewtonStacks, C18_ColumnForcesAreWeights) {
  const int n = 100;
  PhysicsWorld world(newton());
  const Built built = build_column(world, {n});
  run(world, 1);
  const double weight = 1000 * kGravity * kDt;  // [N s]
  for (int k = 0; k < n; ++k) {
    const BodyId below = k == 0 ? built.ground : built.bodies[static_cast<std::size_t>(k - 1)];
    EXPECT_NEAR(normal_impulse(world, below, built.bodies[static_cast<std::size_t>(k)]),
                (n - k) * weight, 1e-3 * (n - k) * weight)
        << k;
  }
}

// Cold, the forces are right to 1 % after at most ten factorizations, warm after at most two,
// whatever one box carries; sequential impulses take 4.6 sweeps a unit of the ratio.
TEST(NewtonStacks, ForcesTakeFewIterationsWhateverTheRatio) {
  for (const double ratio : {1.0, 1e2, 1e3, 1e4, 1e5}) {
    PhysicsWorld world(newton(1));
    const Built built = build_column(world, {2, ratio});
    for (const std::uint32_t most : {10u, 2u}) {
      EXPECT_LE(world.step(kDt).newton_factorizations, most) << ratio;
      const double load = (1 + ratio) * 1000 * kGravity * kDt;
      EXPECT_NEAR(normal_impulse(world, built.ground, built.bodies[0]), load, 0.01 * load) << ratio;
    }
  }
}

// Nothing else is asked of a rest than to see that it is one.
TEST(NewtonStacks, WhatRestsIsNotFactored) {
  PhysicsWorld world(newton(1));
  build_column(world, {10, 4});
  run(world, 1);
  // In single precision the remembered impulses are off by more than what is asked: one.
  EXPECT_LE(world.step(kDt).newton_factorizations, kDouble ? 0u : 1u);
  EXPECT_EQ(world.last_report().newton_islands, 1u);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
