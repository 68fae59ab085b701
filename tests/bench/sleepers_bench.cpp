// What is there and does nothing must cost nothing: a step of a world in which all sleeps, and a
// frame of an engine most of whose entities have no physics. Beside the time stands its ratio to
// the row with none of them: free is 1 everywhere.
#include <benchmark/benchmark.h>

#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "plumb/integration/pose_sync.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

// Takes the processor time of `work` and tells its ratio to the row of the same name whose argument
// is 0, which runs first.
template <class Work>
void against_none(benchmark::State& state, const std::string& name, Work&& work) {
  static std::map<std::string, double> none;  // [s]
  const std::clock_t begin = std::clock();
  std::int64_t runs = 0;
  for (auto _ : state) {
    work();
    ++runs;
  }
  const double each =
      static_cast<double>(std::clock() - begin) / (CLOCKS_PER_SEC * static_cast<double>(runs));
  if (state.range(0) == 0) none[name] = each;
  if (none[name] > 0) state.counters["ratio"] = each / none[name];
}

void sleepers(benchmark::State& state) {
  WorldSettings settings;
  settings.time_to_sleep = 0;
  PhysicsWorld world(settings);
  scenes::build_spread(world, static_cast<int>(state.range(0)));
  for (int i = 0; i < 10; ++i) world.step(1.0 / 60);  // all fall asleep in the first of them
  against_none(state, "sleepers", [&] { world.step(1.0 / 60); });
  state.counters["awake"] = world.last_report().awake_bodies;
}
BENCHMARK(sleepers)
    ->ArgName("asleep")
    ->Arg(0)
    ->Arg(1'000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Iterations(20'000)
    ->Unit(benchmark::kNanosecond);

// A hundred of the entities have a body that flies; the transforms of the others are never touched.
void entities_without_physics(benchmark::State& state) {
  constexpr std::int64_t kBodies = 100;
  const std::int64_t entities = kBodies + state.range(0), apart = entities / kBodies;
  std::vector<Pose> transforms(static_cast<std::size_t>(entities));
  PhysicsWorld world(no_gravity());
  integration::FixedStepLoop loop(world);
  integration::PoseSync sync(loop);
  for (std::int64_t i = 0; i < kBodies; ++i) {
    RigidBody body = moving(at(3.0 * static_cast<double>(i), 0, 0), vec(0, 1, 0), vec(1, 2, 3));
    body.user_data = static_cast<std::uint64_t>(i * apart);
    add(world, body, with(box(0.2, 0.4, 0.6)));
  }
  std::size_t written = 0;
  against_none(state, "entities", [&] {
    loop.tick(1.0 / 60);
    written = sync.write(world, loop.alpha(), [&](const integration::SyncedPose& p) {
      transforms[static_cast<std::size_t>(p.entity)] = p.pose;
    });
  });
  state.counters["written"] = static_cast<double>(written);
}
BENCHMARK(entities_without_physics)
    ->ArgName("others")
    ->Arg(0)
    ->Arg(10'000)
    ->Arg(1'000'000)
    ->Iterations(2'000)
    ->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
