// Proves that a bounce that sets a thin body spinning makes no energy: the contacts that follow in
// the same step meet it with the inertia of its new attitude.
#include <gtest/gtest.h>

#include <random>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

// The highest energy, over that of the start, of a thin body that falls into a steep groove.
double highest_energy(const Shape& shape, unsigned seed, ContactSolver solver) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = solver;
  PhysicsWorld world(settings);
  const Material surface = material(0.4, 0.3);
  for (const double side : {-1.0, 1.0}) add_floor(world, surface, Vector3d(side * 0.9, 0.44, 0));
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  const Quat attitude = turn(3 * number(), Vector3d(number(), number(), 1.01 + number()));
  add(world, body_at(at(Vector3d(0.1 * number(), 1.5, 0), attitude)), with(shape, surface));
  const double start = world.energy().total();
  double highest = start;
  for (int i = 0; i < 120; ++i) {
    world.step(1.0 / 60);
    if (world.last_report().quarantined > 0) return 1e30;
    highest = std::max(highest, world.energy().total());
  }
  return highest / start;
}

TEST(SpunBounce, ThinBodiesInAGrooveGainNoEnergy) {
  const Shape shapes[] = {cone(0.06, 0.0117), capsule(0.05, 0.005), box(0.06, 0.004, 0.01),
                          cylinder(0.07, 0.006)};
  for (const ContactSolver solver : {ContactSolver::SoftStep, ContactSolver::Newton})
    for (std::size_t k = 0; k < std::size(shapes); ++k)
      for (unsigned seed = 0; seed < 8; ++seed)
        EXPECT_LT(highest_energy(shapes[k], seed, solver), 1.05)
            << "shape " << k << " seed " << seed << " solver " << static_cast<int>(solver);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
