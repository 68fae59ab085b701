// Proves that what is stopped again and again on its own floor does not sink into it: small round
// things that spin by a good part of a turn in a step come back up as fast as contacts push.
#include <gtest/gtest.h>

#include <random>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

// The depth of the deepest contact [m], two seconds and more after the shape was thrown.
double depth_later(const Shape& shape, unsigned seed) {
  PhysicsWorld world(no_sleep());
  const Material surface = material(0.4);
  add_floor(world, surface);
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  const Quat attitude = turn(3 * number(), Vector3d(number(), number(), 1.01 + number()));
  RigidBody thrown = moving(at(Vector3d(0, 1.5, 0), attitude), vec(6 * number(), 0, 6 * number()),
                            vec(20 * number(), 20 * number(), 20 * number()));
  add(world, thrown, with(shape, surface));
  double deepest = 0;
  for (int i = 0; i < 480; ++i) {
    world.step(1.0 / 60);
    if (i < 120) continue;
    deepest = std::max(deepest, static_cast<double>(world.last_report().largest_penetration));
  }
  return deepest;
}

TEST(ContinuousSinking, SmallSpinningThingsStayAboveTheFloor) {
  struct Case {
    Shape shape;
    double thickness;  // [m]
  };
  const Case cases[] = {{cone(0.0085, 0.0085), 0.017},
                        {cone(0.0127, 0.0141), 0.025},
                        {cylinder(0.005, 0.072, 0.001), 0.012},
                        {cone(0.0017, 0.0103, 0.0012), 0.006}};
  for (std::size_t k = 0; k < std::size(cases); ++k)
    for (unsigned seed = 0; seed < 12; ++seed)
      EXPECT_LT(depth_later(cases[k].shape, seed), 0.25 * cases[k].thickness)
          << "shape " << k << " seed " << seed;
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
