// What a level of detail in time saves: a field of small islands, most of them at rest, with the
// same number of substeps for all and with a step tolerance. `ratio` is the time of a step over
// that with the finest steps for all, in the same run; `coarse` the share of the bodies with fewer.
#include <benchmark/benchmark.h>

#include <chrono>

#include "support/field.h"

namespace plumb::inline PLUMB_ABI {
namespace {

constexpr int kSteps = 180;

WorldSettings settings_with(int substeps, double tolerance) {
  WorldSettings settings;
  settings.sleeping = false;
  settings.substeps = substeps;
  settings.step_tolerance = testing_support::real(tolerance);
  return settings;
}
// [s] for all steps.
double run(const WorldSettings& settings, double& coarse) {
  PhysicsWorld world(settings);
  scenes::build_field(world, 1000);
  double coarse_bodies = 0, bodies = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kSteps; ++i) {
    const StepReport& report = world.step(1.0 / 60);
    coarse_bodies += report.coarse_bodies;
    bodies += report.awake_bodies;
  }
  coarse = coarse_bodies / bodies;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void field(benchmark::State& state) {
  const int substeps = static_cast<int>(state.range(0));
  const double tolerance = 1e-6 * static_cast<double>(state.range(1));
  double coarse = 0;
  for (auto _ : state) {
    const double fine = run(settings_with(substeps, 0), coarse);
    const double levels = run(settings_with(substeps, tolerance), coarse);
    state.SetIterationTime(levels);
    state.counters["ratio"] = levels / fine;
  }
  state.counters["coarse"] = coarse;
}
BENCHMARK(field)
    ->Name("step_levels")
    ->ArgNames({"substeps", "tolerance_um"})
    ->ArgsProduct({{16, 32, 64}, {100, 1000}})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
