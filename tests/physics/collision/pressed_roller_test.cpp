// Invariant: what is pressed a little into a surface gets on: the continuous stage, which stops
// what would pass through, does not hold it up at the next triangle, ridge or dip.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using namespace surfaces;

constexpr double kDt = 1.0 / 60;  // [s]

// Facets of a round hill: ridges that a body goes over, and flat seams along the way.
double hill(double x, double) { return -0.01 * x * x; }

// Without friction a body that starts 2 % of its thickness deep slides on at its speed, and is
// pushed out. The continuous stage, which follows what moves that fast, may take a ridge that it
// grazes for a wall now and then: not in one step of a hundred.
TEST(PressedRoller, SlidesOverRidgesWithoutLosingSteps) {
  const std::vector<std::pair<const char*, Shape>> shapes = {
      {"box", box(0.4, 0.4, 0.4)},
      {"rounded box", rounded_box(0.3, 0.3, 0.3, 0.1)},
      {"cylinder", cylinder(0.4, 0.4)},
      {"cone", cone(0.4, 0.4)}};
  const double deep = 0.016;
  int steps = 0, cut = 0;
  double travelled = 0;  // over what the speeds promised
  for (const auto& [name, shape] : shapes)
    for (int start = 0; start < 12; ++start) {
      PhysicsWorld world(no_sleep());
      add(world, body_at(at(0, 0, 0), MotionType::Static),
          with(SurfaceMesh{made(grid(-10, 30, -5, 5, 57, 13, hill))}, material(0)));
      const BodyId id =
          add(world, moving(at(0.01 * start, 0.4 - deep, 0.1), vec(12, 0, 0), vec(0, 9, 0)),
              with(shape, material(0)));
      for (int i = 0; i < 40; ++i) {
        const double before = position(world, id).x();
        world.step(kDt);
        const double way = (position(world, id).x() - before) / (kDt * velocity(world, id).x());
        travelled += way;
        cut += way < 0.9 ? 1 : 0;
        ++steps;
      }
      EXPECT_GT(velocity(world, id).x(), 11) << name << ' ' << start;
      EXPECT_LT(deepest(world), 0.01) << name << ' ' << start;
    }
  EXPECT_LT(cut, 0.01 * steps);
  EXPECT_GT(travelled, 0.995 * steps);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
