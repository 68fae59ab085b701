// What proves that something belongs to the state of a world: the same bits after restoring in the
// middle and when recorded inputs are played back; and the hashes to compare runs by.
#pragma once

#include <algorithm>
#include <set>

#include "support/measure.h"
#include "support/recorder.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

// A scene that is built once and then disturbed before each of its steps; the same every time.
template <class Scene>
struct DisturbedRun {
  Scene (*build)(PhysicsWorld&);
  void (*disturb)(PhysicsWorld&, const Scene&, int step);
  int steps;
  double dt = 1.0 / 60;  // [s]
};

// Does the whole run; the hash after each step.
template <class Scene>
std::vector<std::uint64_t> hashes_of(const DisturbedRun<Scene>& run, JobSystem* jobs) {
  PhysicsWorld world;
  world.set_job_system(jobs);
  const Scene scene = run.build(world);
  std::vector<std::uint64_t> out;
  for (int i = 0; i < run.steps; ++i) {
    run.disturb(world, scene, i);
    world.step(run.dt);
    out.push_back(world.state_hash());
  }
  EXPECT_TRUE(all_finite(world));
  return out;
}

template <class Scene>
void expect_same_with_threads(const DisturbedRun<Scene>& run) {
  const std::vector<std::uint64_t> serial = hashes_of(run, nullptr);
  for (const int threads : {2, 4}) {
    const std::unique_ptr<JobSystem> pool = make_thread_pool(threads);
    EXPECT_EQ(serial, hashes_of(run, pool.get())) << threads << " threads";
  }
}

// Saves where it is told to, before the disturbance of a step or between that and the step, and
// goes on from every save in another world.
template <class Scene, class Saves>  // (step, whether it is disturbed already) -> bool
void expect_same_after_restore(const DisturbedRun<Scene>& run, const Saves& saves) {
  struct Saved {
    int step;
    bool disturbed;
    Snapshot snapshot;
  };
  PhysicsWorld world;
  const Scene scene = run.build(world);
  std::vector<Saved> saved;
  std::vector<std::uint64_t> after;
  std::vector<std::vector<SensorOverlap>> seen;
  for (int i = 0; i < run.steps; ++i) {
    if (saves(i, false)) saved.push_back({i, false, world.save()});
    run.disturb(world, scene, i);
    if (saves(i, true)) saved.push_back({i, true, world.save()});
    world.step(run.dt);
    after.push_back(world.state_hash());
    seen.emplace_back(world.events().overlaps.begin(), world.events().overlaps.end());
  }
  EXPECT_FALSE(saved.empty());
  for (const Saved& from : saved) {
    SCOPED_TRACE(testing::Message() << "saved at " << from.step);
    PhysicsWorld resumed;
    must(resumed.restore(from.snapshot));
    EXPECT_TRUE(resumed.save() == from.snapshot);
    for (int i = from.step; i < run.steps; ++i) {
      if (i > from.step || !from.disturbed) run.disturb(resumed, scene, i);
      resumed.step(run.dt);
      const std::size_t k = static_cast<std::size_t>(i);
      ASSERT_EQ(resumed.state_hash(), after[k]) << "step " << i;
      ASSERT_TRUE(std::ranges::equal(seen[k], resumed.events().overlaps)) << "step " << i;
    }
  }
}

// Plays a recording back into a world, compares it after every step and notes what was played.
inline void replay_into(PhysicsWorld& replay, const InputRecorder& recorder,
                        std::set<InputKind>& kinds) {
  for (std::size_t i = 0; i < recorder.frames.size(); ++i) {
    for (const InputRecord& input : recorder.frames[i].inputs) {
      kinds.insert(input.kind);
      ASSERT_TRUE(replay.apply_input(input).ok()) << name_of(input.kind) << " at step " << i;
    }
    replay.step(recorder.frames[i].dt);
    ASSERT_EQ(replay.state_hash(), recorder.frames[i].hash) << "step " << i;
  }
}

// Records a run, plays it back into an empty world. Returns the kinds of input that it took.
template <class Scene>
std::set<InputKind> expect_same_in_replay(const DisturbedRun<Scene>& run) {
  InputRecorder recorder;
  PhysicsWorld world;
  world.attach(&recorder);
  const Scene scene = run.build(world);
  for (int i = 0; i < run.steps; ++i) {
    run.disturb(world, scene, i);
    world.step(run.dt);
  }
  EXPECT_EQ(recorder.frames.size(), static_cast<std::size_t>(run.steps));
  PhysicsWorld replay;
  std::set<InputKind> kinds;
  replay_into(replay, recorder, kinds);
  EXPECT_TRUE(replay.save() == world.save());
  return kinds;
}

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
