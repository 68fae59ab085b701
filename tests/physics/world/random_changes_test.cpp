// Invariant: whatever is done to a world between its steps, by living and by stale handles, what it
// refuses changes nothing, it stays finite, and a world restored from its snapshot goes the same
// way bit for bit, with any number of threads.
#include "support/random_changes.h"

#include <gtest/gtest.h>

#include "plumb/job_system.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

class RandomWorlds : public testing::TestWithParam<std::uint32_t> {};

void expect_finite(const PhysicsWorld& world, int step) {
  std::vector<BodyState> bodies;
  world.copy_body_states(bodies);
  for (const BodyState& body : bodies) {
    ASSERT_TRUE(body.pose.position.allFinite()) << step;
    ASSERT_TRUE(body.pose.orientation.coeffs().allFinite()) << step;
    ASSERT_TRUE(body.linear_velocity.allFinite()) << step;
    ASSERT_TRUE(body.angular_velocity.allFinite()) << step;
  }
  ASSERT_TRUE(std::isfinite(world.energy().total())) << step;
  ASSERT_TRUE(world.last_report().status.ok()) << step;
}

TEST_P(RandomWorlds, StaySoundAndGoOnAlikeAfterARestore) {
  constexpr int kSteps = 300, kSavedAt = 150, kThingsAStep = 2;
  const auto jobs = make_thread_pool(3);
  PhysicsWorld world, restored;
  restored.set_job_system(jobs.get());
  add_floor(world);
  RandomChanges changes(world, GetParam()), changes_of_restored(changes);
  const double dt = GetParam() % 2 == 0 ? 1.0 / 60 : 1.0 / 30;
  for (int step = 0; step < kSteps; ++step) {
    if (step == kSavedAt) {
      ASSERT_TRUE(restored.restore(world.save()).ok());
      changes_of_restored = changes;
      changes_of_restored.move_to(restored);
    }
    for (int k = 0; k < kThingsAStep; ++k) {
      const std::string wrong = changes.act();
      ASSERT_EQ(wrong, "") << step;
      if (step < kSavedAt) continue;
      ASSERT_EQ(changes_of_restored.act(), wrong) << step;
    }
    world.step(dt);
    ASSERT_NO_FATAL_FAILURE(expect_finite(world, step));
    if (step < kSavedAt) continue;
    restored.step(dt);
    ASSERT_EQ(restored.state_hash(), world.state_hash()) << step;
  }
  EXPECT_GT(world.body_count(), 20u);
}

INSTANTIATE_TEST_SUITE_P(, RandomWorlds, testing::Range(1u, 13u));

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
