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
// pushed out: no step may lose more than a tenth of its way.
TEST(PressedRoller, SlidesOverRidgesWithoutLosingSteps) {
  const std::vector<std::pair<const char*, Shape>> shapes = {
      {"box", box(0.4, 0.4, 0.4)},
      {"rounded box", rounded_box(0.3, 0.3, 0.3, 0.1)},
      {"cylinder", cylinder(0.4, 0.4)},
      {"cone", cone(0.4, 0.4)}};
  for (const auto& [name, shape] : shapes) {
    PhysicsWorld world(no_sleep());
    add(world, body_at(at(0, 0, 0), MotionType::Static),
        with(SurfaceMesh{made(grid(-10, 30, -5, 5, 57, 13, hill))}, material(0)));
    const double deep = 0.016;
    const BodyId id = add(world, moving(at(0, 0.4 - deep, 0.1), vec(12, 0, 0), vec(0, 9, 0)),
                          with(shape, material(0)));
    double shortest = 1;
    for (int i = 0; i < 40; ++i) {
      const double before = position(world, id).x();
      world.step(kDt);
      const double way = (position(world, id).x() - before) / (kDt * velocity(world, id).x());
      shortest = std::min(shortest, way);
    }
    EXPECT_GT(shortest, 0.9) << name;
    EXPECT_GT(velocity(world, id).x(), 11) << name;
    EXPECT_LT(deepest(world), 0.01) << name;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
