// A recording alone suffices to do the run again, bit by bit; and a recording that is not true to
// its run is caught at the step where it begins to lie.
#include "recorded_run.h"

namespace plumb {
namespace {

using namespace replay_test;
namespace schema = rrd::schema;

constexpr int kSteps = 150;

TEST(Verify, ARunWithInputsIsReproducedBitByBit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  record_run(path, kSteps, {.scene = "{\"name\": \"stack\"}", .snapshot_every = 40});
  const auto result = replay::verify(path);
  EXPECT_TRUE(result.identical()) << result.outcome.error
                                  << (result.difference ? result.difference->text() : "");
  EXPECT_TRUE(result.finished);
  EXPECT_EQ(result.steps, static_cast<std::uint64_t>(kSteps));

  const auto info = replay::info(path);
  EXPECT_TRUE(info.outcome.ok()) << info.outcome.error;
  EXPECT_EQ(info.scene, "{\"name\": \"stack\"}");
  EXPECT_EQ(info.precision, kPrecisionName);
  EXPECT_EQ(info.steps, static_cast<std::uint64_t>(kSteps));
  EXPECT_EQ(info.snapshots, 1u + kSteps / 40);
  // An impulse, a body, its collider, a destruction, and a force in every ninth step.
  EXPECT_EQ(info.inputs, 4u + (kSteps + 4) / 9);
  EXPECT_EQ(info.bodies, 5u);
  EXPECT_NEAR(info.seconds, kSteps * kDt, 1e-9);  // a sum of 150 rounded steps
  EXPECT_EQ(info.file_bytes, size_of(path));
}

TEST(Verify, NothingToLookAtIsNeeded) {
  const TemporaryFolder folder;
  const std::string path = folder.file("bare.rrd");
  record_run(path, kSteps,
             {.visuals = false,
              .contacts = false,
              .body_states = false,
              .plots = false,
              .text_log = false});
  EXPECT_TRUE(replay::verify(path).identical());
}

// One changed number of one input changes the run from that step on, and no earlier.
TEST(Verify, AChangedInputIsCaughtAtItsFrameWithBodyAndQuantity) {
  const TemporaryFolder folder;
  record_run(folder.file("run.rrd"), kSteps);
  rewrite(folder.file("run.rrd"), folder.file("forged.rrd"), [](EditableCell& cell) {
    // Before step 8: an impulse of (40, 5, 0) N s.
    if (cell.component == schema::input::kNumbers && cell.frame == 8u) {
      EXPECT_EQ(cell.number<double>(0), 40.0);
      cell.set(0, 40.5);
    }
    return true;
  });
  const auto result = replay::verify(folder.file("forged.rrd"));
  ASSERT_TRUE(result.outcome.ok()) << result.outcome.error;
  ASSERT_TRUE(result.difference.has_value());
  EXPECT_EQ(result.difference->frame, 8u);
  ASSERT_TRUE(result.difference->body.has_value());
  EXPECT_EQ(result.difference->quantity.substr(0, 8), "position");
  EXPECT_GT(result.difference->ulps, 0);
  EXPECT_NE(result.difference->text().find("frame 8"), std::string::npos);
}

TEST(Verify, AChangedHashIsCaughtAtItsFrameThoughNoBodyDiffers) {
  const TemporaryFolder folder;
  record_run(folder.file("run.rrd"), kSteps);
  rewrite(folder.file("run.rrd"), folder.file("forged.rrd"), [](EditableCell& cell) {
    if (cell.component == schema::step::kStateHash && cell.frame == 91u)
      cell.set(0, cell.number<std::uint64_t>(0) ^ 1u);
    return true;
  });
  const auto result = replay::verify(folder.file("forged.rrd"));
  ASSERT_TRUE(result.difference.has_value()) << result.outcome.error;
  EXPECT_EQ(result.difference->frame, 91u);
  EXPECT_EQ(result.difference->recorded_hash ^ result.difference->computed_hash, 1u);
  EXPECT_EQ(result.difference->bodies, 0u);
  EXPECT_EQ(result.steps, 91u);
}

// Two runs that differ by one input are told apart without simulating, in the same words.
TEST(Diff, NamesTheFirstFrameBodyAndQuantity) {
  const TemporaryFolder folder;
  record_run(folder.file("a.rrd"), 30);
  record_run(folder.file("b.rrd"), 30);
  EXPECT_TRUE(replay::diff(folder.file("a.rrd"), folder.file("b.rrd")).identical());

  PhysicsWorld world;
  std::vector<BodyId> bodies = scenes::build_stack(world, {.count = 5, .shift = 0.1}).bodies;
  replay::Recorder recorder;
  ASSERT_TRUE(recorder.open({.path = folder.file("c.rrd")}).ok());
  world.attach(&recorder);
  for (int step = 0; step < 30; ++step) {
    act_between_steps(world, bodies, step);
    if (step == 11) {
      ASSERT_TRUE(world.set_linear_velocity(bodies[4], Vec3(0, 1, 0)).ok());
    }
    ASSERT_TRUE(world.step(kDt).status.ok());
  }
  world.detach(&recorder);
  ASSERT_TRUE(recorder.close().ok());
  const auto result = replay::diff(folder.file("a.rrd"), folder.file("c.rrd"));
  ASSERT_TRUE(result.difference.has_value()) << result.outcome.error;
  EXPECT_EQ(result.difference->frame, 12u);
  EXPECT_EQ(result.difference->body, bodies[4]);
  EXPECT_EQ(result.difference->quantity, "position.y");
}

// A world taken from the middle of a recording goes on as the recorded one did.
TEST(Resume, GoesOnBitByBitFromAnyFrame) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.rrd");
  record_run(path, kSteps, {.snapshot_every = 25});
  auto whole = replay::resume(path, kSteps);
  ASSERT_TRUE(whole.outcome.ok()) << whole.outcome.error;
  for (const std::uint64_t frame : {0u, 1u, 49u, 50u, 51u, 149u}) {
    auto part = replay::resume(path, frame);
    ASSERT_TRUE(part.outcome.ok()) << part.outcome.error;
    EXPECT_EQ(part.world->step_count(), frame);
  }
  // From frame 140 on nothing is done but in step 148 (the force of every ninth step).
  auto part = replay::resume(path, 149);
  ASSERT_TRUE(part.outcome.ok()) << part.outcome.error;
  part.world->step(kDt);
  EXPECT_EQ(part.world->state_hash(), whole.world->state_hash());
  EXPECT_FALSE(replay::resume(path, kSteps + 1).outcome.ok());
}

// A recorder may join late, and a second world goes into a file of its own.
TEST(Verify, ARecordingMayBeginAtAnyStep) {
  const TemporaryFolder folder;
  PhysicsWorld world;
  const auto stack = scenes::build_stack(world, {.count = 4, .shift = 0.05});
  for (int step = 0; step < 20; ++step) world.step(kDt);
  replay::Recorder recorder;
  ASSERT_TRUE(recorder.open({.path = folder.file("late.rrd")}).ok());
  world.attach(&recorder);
  for (int step = 0; step < 20; ++step) world.step(kDt);
  world.detach(&recorder);
  ASSERT_TRUE(recorder.close().ok()) << recorder.status().error;
  const auto info = replay::info(folder.file("late.rrd"));
  EXPECT_EQ(info.first_frame, 20u);
  EXPECT_EQ(info.last_frame, 40u);
  EXPECT_TRUE(replay::verify(folder.file("late.rrd")).identical());

  PhysicsWorld other;
  other.attach(&recorder);
  EXPECT_FALSE(recorder.status().ok());
}

// Recording looks only: the recorded run has the bits of the one that nobody looked at.
TEST(Recorder, ChangesNothing) {
  const TemporaryFolder folder;
  const auto run = [&](bool recorded) {
    PhysicsWorld world;
    std::vector<BodyId> bodies = scenes::build_stack(world, {.count = 5, .shift = 0.1}).bodies;
    replay::Recorder recorder;
    if (recorded) {
      EXPECT_TRUE(recorder.open({.path = folder.file("run.rrd")}).ok());
      world.attach(&recorder);
    }
    for (int step = 0; step < 60; ++step) {
      act_between_steps(world, bodies, step);
      world.step(kDt);
    }
    return world.state_hash();
  };
  EXPECT_EQ(run(true), run(false));
}

// The cost is measured over exactly the steps that were recorded.
TEST(Recorder, CountsWhatItCosts) {
  const TemporaryFolder folder;
  PhysicsWorld world;
  scenes::build_stack(world, {.count = 5});
  replay::Recorder recorder;
  ASSERT_TRUE(recorder.open({.path = folder.file("run.rrd")}).ok());
  world.attach(&recorder);
  for (int step = 0; step < 10; ++step) world.step(kDt);
  EXPECT_EQ(recorder.cost().steps, 10u);
  EXPECT_EQ(recorder.cost().body_steps, 60u);  // five cubes and the ground
  EXPECT_GT(recorder.cost().seconds, 0);
}

}  // namespace
}  // namespace plumb
