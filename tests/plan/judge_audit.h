// What an audit of the plan must show, item by item.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "audit/audit.h"

namespace plumb::inline PLUMB_ABI {

// A frontier, not a goal: an item that does not keep to the bar yet, with its figure. It may only
// become smaller.
struct KnownToErr {
  PlanItem item;
  std::size_t bits;  // of Real
  std::uint32_t needless, missed;
};

// Missed: none. Needless: at most one in a hundred, of each item by itself.
inline void expect_right_choices(const audit::Counts& counts,
                                 const std::vector<KnownToErr>& known = {}) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const PlanItem item = static_cast<PlanItem>(k);
    const audit::Count& count = counts[k];
    std::uint32_t needless = count.chosen / 100, missed = 0;
    for (const KnownToErr& one : known)
      if (one.item == item && one.bits == 8 * sizeof(Real)) {
        needless = std::max(needless, one.needless);
        missed = one.missed;
      }
    EXPECT_LE(count.missed, missed) << name_of(item) << " changed by " << count.off_change;
    EXPECT_LE(count.needless, needless) << name_of(item) << " of " << count.chosen;
  }
}

}  // namespace plumb::inline PLUMB_ABI
