// Invariant: the plan chooses rightly. In scenes drawn by lot, forcing off what it did not choose
// changes nothing beyond the tolerance (missed 0), and of what it chose at most one in a hundred
// changes nothing when forced off (needless).
#include <gtest/gtest.h>

#include "audit/audit.h"

namespace plumb::inline PLUMB_ABI {
namespace {

TEST(PlanAudit, MissesNothingAndChoosesNothingNeedless) {
  constexpr double kDt = 1.0 / 60;  // [s]
  audit::Counts counts{};
  for (std::uint32_t seed = 0; seed < 9; ++seed) {
    PhysicsWorld world;
    audit::build_drawn_scene(world, seed);
    audit::audit(world, kDt, {.steps = 120, .every = 10}, counts);
  }
  std::uint32_t chosen = 0, needless = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const audit::Count& count = counts[k];
    EXPECT_EQ(count.missed, 0u) << name_of(static_cast<PlanItem>(k)) << " by " << count.off_change;
    chosen += count.chosen;
    needless += count.needless;
    if (audit::is_audited(static_cast<PlanItem>(k)) && count.steps > 0 &&
        static_cast<PlanItem>(k) < PlanItem::PointGravity) {
      EXPECT_GT(count.chosen, 0u) << name_of(static_cast<PlanItem>(k));
    }
  }
  EXPECT_LE(100 * needless, chosen);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
