// Proves that the same inputs give the same bits: run to run, for any number of threads, after
// saving and restoring in the middle, and when recorded inputs are played back into an empty world.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/measure.h"
#include "support/replay_checks.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr int kSteps = 120;

// A pile with all shapes, bounces, friction, a sensor, a kinematic sweeper and a flying top.
Built build_mixture(PhysicsWorld& world) {
  Built built = build_pile(world, {.side = 5});
  Collider sensor = with(box(3, 0.5, 3));
  sensor.is_sensor = true;
  add(world, body_at(at(0, 2, 0), MotionType::Static), sensor);
  RigidBody sweeper = body_at(at(-3, 0.5, 0), MotionType::Kinematic);
  sweeper.linear_velocity = vec(1, 0, 0);
  sweeper.angular_velocity = vec(0, 1, 0);
  built.bodies.push_back(add(world, sweeper, with(box(0.3, 0.4, 2))));
  built.bodies.push_back(add(world, moving(at(0, 12, 0), vec(0, 0, 0), vec(0.1, 10, 0)),
                             with(box(0.2, 0.4, 0.6), material(0.5, 0.8))));
  return built;
}
// What a game would do between steps; the same for the same step.
void disturb(PhysicsWorld& world, const Built& built, int step) {
  const BodyId body = built.bodies[static_cast<std::size_t>(step * 7) % 125];
  if (!world.is_valid(body)) return;
  switch (step % 10) {
    case 1:
      must(world.apply_force_at_body_point(body, vec(2000, 500, 0), vec(0.1, 0.2, 0)));
      break;
    case 3:
      must(world.apply_impulse(body, vec(0, 300, 100)));
      break;
    case 5:
      must(world.apply_torque(body, vec(10, 200, 0)));
      break;
    case 7:
      must(world.set_linear_velocity(body, vec(0, 2, 0)));
      break;
    case 9:
      if (step == 59) must(world.destroy_body(body));
      break;
    default:
      break;
  }
}
constexpr DisturbedRun<Built> kRun{build_mixture, disturb, kSteps, kDt};

std::vector<std::uint64_t> hashes(JobSystem* jobs) { return hashes_of(kRun, jobs); }

TEST(Determinism, RunToRun) {
  const std::vector<std::uint64_t> first = hashes(nullptr);
  EXPECT_EQ(first, hashes(nullptr));
  // The hash does look at the state.
  EXPECT_NE(first[0], first[1]);
  EXPECT_NE(first[kSteps - 2], first[kSteps - 1]);
}

TEST(Determinism, AnyNumberOfThreads) {
  const std::vector<std::uint64_t> serial = hashes(nullptr);
  for (int threads : {1, 2, 4}) {
    const std::unique_ptr<JobSystem> pool = make_thread_pool(threads);
    EXPECT_EQ(pool->worker_count(), threads);
    EXPECT_EQ(serial, hashes(pool.get())) << threads << " threads";
  }
}

// A scheduler may run the chunks of a loop in any order.
TEST(Determinism, AnyOrderOfChunks) {
  struct Shuffler : JobSystem {
    std::mt19937 random{7};
    [[nodiscard]] int worker_count() const override { return 3; }
    void parallel_for(std::uint32_t count, std::uint32_t grain, const RangeTask& task) override {
      std::vector<std::uint32_t> starts;
      for (std::uint32_t begin = 0; begin < count; begin += grain) starts.push_back(begin);
      std::shuffle(starts.begin(), starts.end(), random);
      for (std::uint32_t begin : starts) task(begin, std::min(count, begin + grain));
    }
  } shuffler;
  EXPECT_EQ(hashes(nullptr), hashes(&shuffler));
}

TEST(Determinism, ChangingTheNumberOfThreadsMidway) {
  PhysicsWorld plain, changing;
  const Built a = build_mixture(plain), b = build_mixture(changing);
  const std::unique_ptr<JobSystem> two = make_thread_pool(2), four = make_thread_pool(4);
  for (int i = 0; i < kSteps; ++i) {
    JobSystem* choices[] = {nullptr, two.get(), four.get()};
    changing.set_job_system(choices[i % 3]);
    disturb(plain, a, i);
    disturb(changing, b, i);
    plain.step(kDt);
    changing.step(kDt);
    ASSERT_EQ(plain.state_hash(), changing.state_hash()) << "step " << i;
  }
}

TEST(Determinism, SaveAndRestoreInTheMiddle) {
  expect_same_after_restore(kRun, [](int step, bool disturbed) {
    return !disturbed && (step == 0 || step == 1 || step == 30 || step == 60 || step == 90);
  });
}

TEST(Determinism, ASnapshotRoundTripsExactly) {
  PhysicsWorld world;
  const Built built = build_mixture(world);
  for (int i = 0; i < 40; ++i) {
    disturb(world, built, i);
    world.step(kDt);
  }
  const Snapshot saved = world.save();
  EXPECT_EQ(saved.precision, kPrecisionName);
  EXPECT_EQ(saved.schema_version, Snapshot::kSchemaVersion);
  PhysicsWorld other;
  build_stack(other);  // what stood there before is replaced
  run(other, 0.3);
  must(other.restore(saved));
  EXPECT_TRUE(other.save() == saved);
  EXPECT_EQ(other.state_hash(), world.state_hash());
  EXPECT_EQ(other.time(), world.time());
  EXPECT_EQ(other.step_count(), world.step_count());
  EXPECT_EQ(other.body_count(), world.body_count());
  for (BodyId b : built.bodies) {
    ASSERT_EQ(other.is_valid(b), world.is_valid(b));
    ASSERT_EQ(other.pose(b).position, world.pose(b).position);
    ASSERT_EQ(other.colliders_of(b).size(), world.colliders_of(b).size());
  }
}

TEST(Determinism, SavingChangesNothing) {
  PhysicsWorld world;
  build_mixture(world);
  run(world, 0.5);
  const std::uint64_t hash = world.state_hash();
  const Snapshot once = world.save(), twice = world.save();
  EXPECT_TRUE(once == twice);
  EXPECT_EQ(world.state_hash(), hash);
}

// A sleeping world wakes from a snapshot as it would have.
TEST(Determinism, SaveAndRestoreASleepingWorld) {
  PhysicsWorld world;
  const Built stack = build_stack(world, {.count = 3});
  run(world, 5);
  ASSERT_EQ(world.last_report().awake_bodies, 0u);
  PhysicsWorld other;
  must(other.restore(world.save()));
  for (int i = 0; i < 120; ++i) {
    if (i == 30)
      for (PhysicsWorld* w : {&world, &other})
        must(w->apply_impulse(stack.bodies[1], vec(500, 0, 0)));
    world.step(kDt);
    other.step(kDt);
    ASSERT_EQ(world.state_hash(), other.state_hash()) << "step " << i;
  }
}

TEST(Determinism, RecordedInputsReplayIntoAnEmptyWorld) {
  InputRecorder recorder;
  PhysicsWorld world;
  world.attach(&recorder);
  const Built built = build_mixture(world);
  for (int i = 0; i < kSteps; ++i) {
    disturb(world, built, i);
    if (i == 20) {
      Pose pose = world.pose(built.bodies[3]);
      pose.position.y() += static_cast<PosReal>(2);
      must(world.set_pose(built.bodies[3], pose));
      must(world.set_angular_velocity(built.bodies[3], vec(1, 2, 3)));
    }
    if (i == 40) {
      must(world.set_mass(built.bodies[4], inertia_of::solid_sphere(50, 0.5)));
      must(world.set_awake(built.bodies[5], false));
      must(world.destroy_collider(world.colliders_of(built.bodies[6])[0]));
    }
    if (i == 60) {
      WorldSettings settings = world.settings();
      settings.gravity = vec(0, -5, 1);
      must(world.set_settings(settings));
      EXPECT_FALSE(world.apply_force(BodyId{}, vec(1, 0, 0)).ok());  // refused: not an input
    }
    world.step(i % 3 == 0 ? kDt : kDt / 2);
  }
  world.detach(&recorder);
  ASSERT_EQ(recorder.frames.size(), static_cast<std::size_t>(kSteps));
  EXPECT_GT(recorder.frames[0].inputs.size(), 250u);  // the building of the scene

  PhysicsWorld replay;
  std::set<InputKind> kinds;
  ASSERT_NO_FATAL_FAILURE(replay_into(replay, recorder, kinds));
}

TEST(Determinism, ReplayedInputsAreThemselvesRecorded) {
  InputRecorder first, second;
  PhysicsWorld world, replay;
  world.attach(&first);
  replay.attach(&second);
  build_stack(world, {.count = 2});
  world.step(kDt);
  for (const InputRecord& input : first.frames[0].inputs) must(replay.apply_input(input));
  replay.step(kDt);
  EXPECT_EQ(first.frames[0].inputs, second.frames[0].inputs);
  EXPECT_EQ(first.frames[0].hash, second.frames[0].hash);
}

// Looking at a world in every way there is does not change it.
TEST(Determinism, ReadingChangesNothing) {
  PhysicsWorld looked_at, twin;
  const Built a = build_mixture(looked_at);
  build_mixture(twin);
  for (int i = 0; i < 30; ++i) {
    std::vector<ColliderId> found;
    looked_at.overlap_bounds({pos(-1, 0, -1), pos(1, 3, 1)}, found);
    EXPECT_FALSE(found.empty());
    EXPECT_TRUE(looked_at.cast_ray(pos(0, 30, 0), vec(0, -40, 0)).has_value());
    EXPECT_LE(contacts(looked_at).size(), 10000u);
    EXPECT_GT(looked_at.energy().total(), 0);
    EXPECT_FALSE(looked_at.plan().decisions.empty());
    EXPECT_FALSE(looked_at.save().columns.empty());
    EXPECT_EQ(looked_at.body(a.bodies[0]).type, MotionType::Dynamic);
    looked_at.step(kDt);
    twin.step(kDt);
    ASSERT_EQ(looked_at.state_hash(), twin.state_hash());
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
