// Invariant: a step looks at what is awake and at nothing else. However many bodies sleep beside
// it, the same pairs, contacts, islands and colours are counted, the same bodies are told to have
// moved, and they move to the same bits.
#include <gtest/gtest.h>

#include <vector>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

constexpr double kDt = 1.0 / 60;  // [s]

// Balls that bounce for ever, made first, and boxes asleep on the ground far from them.
struct Beside {
  PhysicsWorld world;
  explicit Beside(int sleepers) {
    build_bouncing(world, 4);
    for (int i = 0; i < sleepers; ++i)
      add(world, body_at(at(100 + 2.0 * (i % 50), 0.5, 2.0 * (i / 50))), with(cube(0.5)));
    for (int i = 0; i < 60; ++i) world.step(kDt);
  }
};

TEST(Sleepers, AreInNoStagesCounts) {
  Beside none(0), few(10), many(1000);
  PhysicsWorld* const beside[] = {&few.world, &many.world};
  for (int step = 0; step < 60; ++step) {
    const StepReport alone = none.world.step(kDt);
    ASSERT_EQ(alone.awake_bodies, 16u);
    std::vector<BodyState> moved_alone;
    none.world.copy_moved_body_states(moved_alone);
    for (PhysicsWorld* world : beside) {
      const StepReport& report = world->step(kDt);
      EXPECT_EQ(report.awake_bodies, alone.awake_bodies);
      EXPECT_EQ(report.candidate_pairs, alone.candidate_pairs);
      EXPECT_EQ(report.touching_pairs, alone.touching_pairs);
      EXPECT_EQ(report.contact_points, alone.contact_points);
      EXPECT_EQ(report.islands, alone.islands);
      EXPECT_EQ(report.colors, alone.colors);
      EXPECT_EQ(report.impacts, alone.impacts);
      EXPECT_EQ(report.looked_ahead, alone.looked_ahead);
      std::vector<BodyState> moved;
      world->copy_moved_body_states(moved);
      ASSERT_EQ(moved.size(), moved_alone.size());
      for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_EQ(moved[i].pose.position, moved_alone[i].pose.position);
        EXPECT_EQ(moved[i].linear_velocity, moved_alone[i].linear_velocity);
      }
    }
  }
}

// What sleeps is not among what moved, and its bits stay.
TEST(Sleepers, StayAsTheyAre) {
  Beside beside(100);
  const std::vector<BodyState> before = states(beside.world);
  for (int step = 0; step < 60; ++step) beside.world.step(kDt);
  const std::vector<BodyState> after = states(beside.world);
  int asleep = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (after[i].type != MotionType::Dynamic || after[i].awake) continue;
    ++asleep;
    EXPECT_EQ(after[i].pose.position, before[i].pose.position);
    EXPECT_EQ(after[i].pose.orientation.coeffs(), before[i].pose.orientation.coeffs());
  }
  EXPECT_EQ(asleep, 100);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
