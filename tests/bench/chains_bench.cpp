// What accuracy costs: a level chain let go for ten seconds, by links, weight of the end and
// substeps. Beside the time stands what it bought: the largest gap at a joint, and the energy lost
// and gained as parts of m g l. The table of physics/README.md is this one in double
// (PLUMB_PRECISION=f64).
#include <benchmark/benchmark.h>

#include "support/chain.h"

namespace plumb::inline PLUMB_ABI {
namespace {

void fall(benchmark::State& state) {
  testing_support::Chain::Worst worst;
  for (auto _ : state)
    worst = testing_support::Chain(static_cast<int>(state.range(0)),
                                   static_cast<double>(state.range(1)),
                                   static_cast<int>(state.range(2)))
                .fall(10, 1.0 / 60);
  state.counters["gap_m"] = worst.gap;
  state.counters["lost"] = -worst.left;
  state.counters["gained"] = std::max(worst.rise, 0.0);
}
BENCHMARK(fall)
    ->Name("chain")
    ->ArgNames({"links", "end", "substeps"})
    ->ArgsProduct({{10, 100}, {1, 10, 1000}, {1, 4}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
