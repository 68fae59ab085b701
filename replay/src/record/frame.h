// One moment of the world, copied, so that it can be encoded while the world goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/effects.h"
#include "plumb/events.h"
#include "plumb/inputs.h"
#include "plumb/plan.h"
#include "plumb/report.h"
#include "plumb/rigid_body.h"
#include "plumb/snapshot.h"
#include "plumb/world_image.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

struct Frame {
  std::uint64_t number = 0;              // of the last step
  double time = 0;                       // [s] after it
  WorldImage image;                      // after it; the next four are read from it
  std::vector<BodyState> bodies;         // all, in order of their index
  std::vector<ContactPoint> contacts;    // of touching pairs
  EnergyReport energy;                   //
  std::uint64_t state_hash = 0;          //
  std::vector<InputRecord> inputs;       // given before the step
  std::vector<HitEvent> hits;            // what happened in it
  std::vector<ContactEvent> touches;     //
  std::vector<SensorEvent> sensors;      //
  std::vector<SleepEvent> sleep;         //
  std::vector<QuarantineEvent> refused;  //
  std::vector<JointBreakEvent> broken;   //
  std::vector<Effect> effects;           // that are drawn, if they changed
  bool effects_changed = false;          // else they are as they were
  std::vector<PlanDecision> plan;        // what of the plan went on or off after the step
  StepReport report;
  bool profiled = false;      // the report has the stages' times
  bool ledger = false;        // ... and says where energy and momentum went
  bool moved = false;         // false: the step was refused, or of no length
  bool has_snapshot = false;  // else what is in it is an older one
  Snapshot snapshot;          // after the step

  [[nodiscard]] Events events() const {
    return {touches, hits, sensors, {}, sleep, refused, broken};
  }
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
