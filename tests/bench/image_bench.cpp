// What the stepping thread pays for a recording: an image of the world in every step, events, and
// now and then a snapshot. Nanoseconds per body, each taken right after a step, when most of the
// world has left the cache, and once more, when all of it is there. Beside them what a reader of
// the same facts would pay without an image.
#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

#include "plumb/world_image.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

constexpr double kStep = 1.0 / 60;  // [s]
constexpr int kSteps = 300;         // from the first touch until the pile has come to rest
constexpr int kFramesInUse = 4;     // so many does a recorder turn over while its encoder keeps up

// A pile of 216 boxes, spheres and capsules that collapses into its pit.
class FallingPile {
 public:
  FallingPile() { scenes::build_pile(world_, {.side = 6}); }

  // The seconds that `look()` takes, summed over the run's steps, in nanoseconds per body and step.
  template <class Look>
  double price(Look&& look) {
    using Clock = std::chrono::steady_clock;
    double seconds = 0;
    for (int i = 0; i < kSteps; ++i) {
      world_.step(kStep);
      const Clock::time_point begin = Clock::now();
      look(i);
      seconds += std::chrono::duration<double>(Clock::now() - begin).count();
      points_ += static_cast<double>(world_.last_report().contact_points);
    }
    return 1e9 * seconds / per_body();
  }
  [[nodiscard]] double points_per_body() const { return points_ / per_body(); }
  PhysicsWorld& world() { return world_; }

 private:
  [[nodiscard]] double per_body() const {
    return kSteps * static_cast<double>(world_.body_count());
  }
  PhysicsWorld world_;
  double points_ = 0;
};

template <class MakeLook>
void price(benchmark::State& state, MakeLook&& make_look) {
  for (auto _ : state) {
    FallingPile pile;
    state.counters["ns_per_body"] = pile.price(make_look(pile.world()));
    state.counters["points_per_body"] = pile.points_per_body();
  }
}

void image_after_a_step(benchmark::State& state) {
  std::vector<WorldImage> images(kFramesInUse);
  price(state, [&](const PhysicsWorld& world) {
    return [&](int i) { world.copy_image(images[static_cast<std::size_t>(i) % images.size()]); };
  });
}
BENCHMARK(image_after_a_step)->Iterations(3)->Unit(benchmark::kMillisecond);

void two_images_after_a_step(benchmark::State& state) {
  std::vector<WorldImage> images(kFramesInUse);
  price(state, [&](const PhysicsWorld& world) {
    return [&](int i) {
      WorldImage& image = images[static_cast<std::size_t>(i) % images.size()];
      world.copy_image(image);
      world.copy_image(image);
    };
  });
}
BENCHMARK(two_images_after_a_step)->Iterations(3)->Unit(benchmark::kMillisecond);

void states_and_points_after_a_step(benchmark::State& state) {
  std::vector<BodyState> bodies;
  std::vector<ContactPoint> points;
  price(state, [&](const PhysicsWorld& world) {
    return [&](int) {
      world.copy_body_states(bodies);
      world.copy_contact_points(points);
      benchmark::DoNotOptimize(world.energy());
      benchmark::DoNotOptimize(world.motion_hash());
    };
  });
}
BENCHMARK(states_and_points_after_a_step)->Iterations(3)->Unit(benchmark::kMillisecond);

void snapshot_after_a_step(benchmark::State& state) {
  Snapshot snapshot;
  price(state, [&](const PhysicsWorld& world) { return [&](int) { world.save(snapshot); }; });
}
BENCHMARK(snapshot_after_a_step)->Iterations(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
