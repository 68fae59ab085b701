// Invariant: cylinders and cones are at home on surfaces of triangles: on rough ground they come to
// rest and sleep; on the edge of a mesh they stand as long as their weight does and fall as they do
// from a box; what falls on a surface at any speed does not pass it.
#include <gtest/gtest.h>

#include "support/collision_oracle.h"
#include "support/fast_bodies.h"
#include "support/measure.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using namespace surfaces;

constexpr double kDt = 1.0 / 60;  // [s]

struct Round {
  const char* name;
  Shape shape;
  Quat attitude;
  double height;  // [m] of its origin over what it lies on
};
std::vector<Round> rounds() {
  const Quat upright = Quat::Identity(), lying = turn(kPi / 2, Vector3d::UnitX());
  // A cone on its side: its axis leans by its half angle.
  const double half_angle = std::atan2(0.25, 0.6);
  const Quat on_side = turn(kPi / 2 + half_angle, Vector3d::UnitX());
  return {{"standing cylinder", cylinder(0.3, 0.3), upright, 0.3},
          {"lying cylinder", cylinder(0.3, 0.2), lying, 0.2},
          {"coin", cylinder(0.03, 0.3), upright, 0.03},
          {"rounded cylinder", cylinder(0.25, 0.15, 0.05), lying, 0.2},
          {"standing cone", cone(0.3, 0.3), upright, 0.3},
          {"lying cone", cone(0.3, 0.25), on_side, 0.3 * std::sin(half_angle)}};
}

TEST(RoundOnSurfaces, TheyComeToRestOnRoughGround) {
  oracle::Random random(19);
  std::vector<double> heights;
  for (int i = 0; i < 41 * 41; ++i) heights.push_back(random.uniform(0, 0.03));
  const Heightfield rough{field(
      41, 41, 0.15, [&](int i, int k) { return heights[static_cast<std::size_t>(41 * k + i)]; })};
  for (const Round& round : rounds()) {
    PhysicsWorld world;
    add(world, body_at(at(-3, 0, -3), MotionType::Static), with(rough, material(0.7)));
    RigidBody body = body_at(at({0.1, round.height + 0.06, 0.2}, round.attitude));
    body.angular_damping = Real(0.5);  // what rolls to and fro in a hollow
    const BodyId id = add(world, body, with(round.shape, material(0.7)));
    double depth = 0, rest = 0;
    run(world, 30, kDt, [&] {
      depth = std::max(depth, deepest(world));
      if (world.is_awake(id)) rest = world.time();
    });
    std::printf("[ figures  ] %s: asleep after %.3g s, deepest %.2g\n", round.name, rest, depth);
    EXPECT_FALSE(world.is_awake(id)) << round.name;
    EXPECT_LT(depth, 0.01) << round.name;
    EXPECT_LT(std::abs(position(world, id).x()) + std::abs(position(world, id).z()), 2)
        << round.name;
  }
}

// On the edge of a box's mesh, with its middle 5 cm on this side or beyond.
TEST(RoundOnSurfaces, AnEdgeHoldsWhatStandsOnItAndDropsTheRest) {
  for (const Round& round : rounds())
    for (const double beyond : {-0.05, 0.05})
      for (const double askew : {0.0, 0.4}) {
        Vector3d end[2];
        for (const bool as_mesh : {false, true}) {
          PhysicsWorld world(no_sleep());
          const Shape block =
              as_mesh ? Shape{SurfaceMesh{made(box_soup(2, 0.5, 2))}} : Shape{box(2, 0.5, 2)};
          add(world, body_at(at(-2, -0.5, 0), MotionType::Static), with(block, material(0.6)));
          const BodyId id = add(world,
                                body_at(at({beyond, round.height, 0.1},
                                           turn(askew, Vector3d::UnitY()) * round.attitude)),
                                with(round.shape, material(0.6)));
          double depth = 0;
          run(world, 1, kDt, [&] { depth = std::max(depth, deepest(world)); });
          end[as_mesh] = position(world, id);
          EXPECT_LT(depth, 0.02) << round.name << ' ' << beyond << ' ' << askew << ' ' << as_mesh;
        }
        EXPECT_EQ(end[1].y() < -0.5, end[0].y() < -0.5)
            << round.name << ' ' << beyond << ' ' << askew;
        EXPECT_LT((end[1] - end[0]).norm(), 0.1) << round.name << ' ' << beyond << ' ' << askew;
      }
}

TEST(RoundOnSurfaces, NothingFastPasses) {
  expect_nothing_fast_passes(7, [](int trial) {
    return trial % 3 == 0   ? Shape{cylinder(0.03, 0.1)}
           : trial % 3 == 1 ? Shape{cone(0.1, 0.07)}
                            : Shape{cylinder(0.07, 0.04, 0.02)};
  });
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
