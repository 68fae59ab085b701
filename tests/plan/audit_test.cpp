// Invariant: the plan chooses rightly. In scenes drawn by lot, forcing off what it did not choose
// changes nothing beyond the tolerance (missed 0), and of what it chose at most one in a hundred
// changes nothing when forced off (needless), each item by itself.
#include "audit/audit.h"

#include <gtest/gtest.h>

#include "plan/judge_audit.h"

namespace plumb::inline PLUMB_ABI {
namespace {

constexpr double kDt = 1.0 / 60;       // [s]
constexpr std::uint32_t kScenes = 27;  // each part comes first three times

// Torques and inertias that show in a substep, and come to nothing over the step; in double, where
// the tolerance is finer, what is missed as well.
const std::vector<KnownToErr> kKnown = {{PlanItem::RollingFriction, 32, 3, 0},
                                        {PlanItem::FastTurns, 32, 2, 0},
                                        {PlanItem::FastTurns, 64, 1, 0},
                                        {PlanItem::LookAhead, 64, 0, 2},
                                        {PlanItem::RollingFriction, 64, 0, 10}};

TEST(PlanAudit, MissesNothingAndChoosesNothingNeedless) {
  audit::Counts counts{};
  for (std::uint32_t seed = 0; seed < kScenes; ++seed) {
    PhysicsWorld world;
    audit::build_drawn_scene(world, seed);
    audit::audit(world, kDt, {.steps = 120, .every = 4}, counts);
  }
  expect_right_choices(counts, kKnown);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const PlanItem item = static_cast<PlanItem>(k);
    if (!audit::is_audited(item)) continue;
    EXPECT_GT(counts[k].chosen, 0u) << name_of(item) << " was never looked at";
    // What roundings change as much is no more than a remainder.
    EXPECT_LE(50 * counts[k].by_chance, counts[k].steps) << name_of(item);
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
