// The control of the audit: worlds that differ from the audited one by roundings. What they make of
// a step says what the step makes of roundings, and no choice of the plan can be blamed for that.
#pragma once

#include "audit/samples.h"
#include "plumb/snapshot.h"

namespace plumb::inline PLUMB_ABI::audit {

class Twins {
 public:
  // `before`: the bodies as the snapshot has them. `after`: a step dt [s] from there.
  Twins(const Snapshot& snapshot, const Sample& before, const Sample& after, double dt)
      : snapshot_(snapshot), before_(before), after_(after), dt_(dt) {}

  // Whether every body that differs between `after` and `other` by more than the tolerance differs
  // by no more than twice of what it does between `after` and some twin. The twins are stepped when
  // first asked for.
  [[nodiscard]] bool explain(PlanItem item, const Sample& other);

 private:
  void step_all();

  const Snapshot& snapshot_;
  const Sample &before_, &after_;
  double dt_;
  std::vector<Sample> twins_;
};

}  // namespace plumb::inline PLUMB_ABI::audit
