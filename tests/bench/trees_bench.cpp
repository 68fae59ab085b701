// What bodies that do nothing cost those that move: a hundred balls fly through a grid of static or
// sleeping boxes that they do not meet. Beside the time stands its ratio to the row where
// they fly alone: an infinitely good broadphase has 1 everywhere.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using Eigen::Vector3d;

enum Others { kStatic, kAsleep };

// The boxes lie in a flat grid of 3 m; the balls fly over it, a metre above their tops.
void build(PhysicsWorld& world, std::int64_t count, Others others) {
  const auto side = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  if (others == kAsleep) add_floor(world);
  for (std::int64_t i = 0; i < count; ++i) {
    const double x = 3.0 * static_cast<double>(i % side - side / 2);
    const double z = 3.0 * static_cast<double>(i / side - side / 2);
    add(world, body_at(at(x, 0.5, z), others == kStatic ? MotionType::Static : MotionType::Dynamic),
        with(cube(0.5)));
  }
  for (int i = 0; i < 100; ++i) {
    RigidBody ball = body_at(at(3.0 * (i % 10 - 5), 2.5, 3.0 * (i / 10 - 5)));
    ball.gravity_scale = 0;
    ball.linear_velocity = vec(0.5, 0, 0.3);
    ball.can_sleep = false;
    add(world, ball, with(sphere(0.25)));
  }
}

double alone[2] = {};  // [s] a step of the balls without the boxes

void step(benchmark::State& state) {
  PhysicsWorld world;
  build(world, state.range(0), static_cast<Others>(state.range(1)));
  for (int i = 0; i < 90; ++i) world.step(1.0 / 60);  // what may sleep falls asleep
  const auto begin = std::chrono::steady_clock::now();
  std::int64_t steps = 0;
  for (auto _ : state) {
    world.step(1.0 / 60);
    ++steps;
  }
  const double each =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
      static_cast<double>(steps);
  double& reference = alone[state.range(1)];
  if (state.range(0) == 0) reference = each;
  if (reference > 0) state.counters["ratio"] = each / reference;
  state.counters["awake"] = world.last_report().awake_bodies;
}
BENCHMARK(step)
    ->Name("hundred_among")
    ->ArgNames({"others", "asleep"})
    ->Args({0, 0})
    ->Args({1'000, 0})
    ->Args({100'000, 0})
    ->Args({1'000'000, 0})
    ->Args({0, 1})
    ->Args({1'000, 1})
    ->Args({100'000, 1})
    ->Iterations(600)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
