// Which effects and stages a step needs, derived from the scene, each with the reason.
#pragma once

#include <string>
#include <vector>

#include "plumb/plan_items.h"

namespace plumb::inline PLUMB_ABI {

struct PlanDecision {
  PlanItem item;
  bool active;
  std::string reason;  // who called for it, or why nothing does
  Choice choice = Choice::Automatic;
  // Where it is forced off: the bound on what is lost, by the numbers of this scene; empty where
  // nothing is.
  std::string loss{};
};

struct StepPlan {
  std::vector<PlanDecision> decisions;  // in the order of PlanItem

  [[nodiscard]] bool active(PlanItem item) const {
    return decisions[static_cast<std::size_t>(item)].active;
  }
};

}  // namespace plumb::inline PLUMB_ABI
