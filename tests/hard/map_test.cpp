// Proves that the automatic choice of the solver is made in time: wherever soft steps let a column
// fall or tremble, Auto holds it. Prints the map from which its thresholds were read.
#include "hard_cell.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace hard;

struct Figures {
  double top, speed;  // [m] way of the top box, [m/s] at the end
};
Figures stand(ContactSolver solver, const Column& column) {
  PhysicsWorld world(settings_of({solver, 1.0 / 60}));
  const Built built = build_column(world, column);
  const Vector3d start = position(world, built.bodies.back());
  run(world, 10);
  return {(position(world, built.bodies.back()) - start).norm(), max_speed(world)};
}

TEST(SolverMap, AutoStandsWhereSoftStepsDoNot) {
  std::printf(
      "| boxes | each over the one below | soft: top moved [m] | speed [m/s] | auto: top moved "
      "|\n");
  for (const Column& column :
       {Column{5}, Column{10}, Column{15}, Column{20}, Column{30}, Column{50}, Column{2, 2},
        Column{2, 5}, Column{2, 10}, Column{2, 50}, Column{2, 100}, Column{2, 1e4}, Column{10, 1.5},
        Column{10, 2}, Column{10, 4}}) {
    const Figures soft = stand(ContactSolver::SoftStep, column);
    const Figures chosen = stand(ContactSolver::Auto, column);
    std::printf("| %d | %g | %.2g | %.1g | %.2g |\n", column.count, column.growth, soft.top,
                soft.speed, chosen.top);
    EXPECT_LE(chosen.top, 0.05) << column.count << " x " << column.growth;
    EXPECT_LE(chosen.speed, bar(1e-3, 5e-3)) << column.count << " x " << column.growth;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
