// Invariant: a restored world goes on with the same bits as the one that was saved, although its
// bodies lie in memory in another order: that of their slots, where the other has swapped them as
// some were destroyed and made anew.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

constexpr double kDt = 1.0 / 60;  // [s]

void expect_same_bits_after_restore(ContactSolver solver, bool with_drag, int steps) {
  WorldSettings settings;
  settings.contact_solver = solver;
  PhysicsWorld world(settings);
  Built pile = build_pile(world, {.side = 3});
  if (with_drag) must(world.create_effect({.kind = Drag{.linear = 2, .quadratic = real(0.3)}}));
  run(world, 1);
  for (std::size_t i = 2; i < pile.bodies.size(); i += 3) {
    must(world.destroy_body(pile.bodies[i]));
    const double side = 0.3 * static_cast<double>(i % 5);
    pile.bodies[i] =
        add(world, body_at(at(side, 4 + 0.5 * static_cast<double>(i), 0)), with(cube(0.3)));
  }
  run(world, 0.5);
  PhysicsWorld restored;
  must(restored.restore(world.save()));
  ASSERT_EQ(restored.state_hash(), world.state_hash());
  for (int step = 0; step < steps; ++step) {
    world.step(kDt);
    restored.step(kDt);
    ASSERT_EQ(restored.state_hash(), world.state_hash()) << "step " << step;
  }
}

TEST(RestoredOrder, FastSolver) {
  expect_same_bits_after_restore(ContactSolver::SoftStep, false, 120);
}
TEST(RestoredOrder, FastSolverUnderDrag) {
  expect_same_bits_after_restore(ContactSolver::SoftStep, true, 120);
}
TEST(RestoredOrder, AccurateSolver) {
  expect_same_bits_after_restore(ContactSolver::Newton, false, 15);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
