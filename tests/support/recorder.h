// Observers that keep what a test wants to look at afterwards.
#pragma once

#include <cstdint>
#include <vector>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

// Everything needed to do a run again: inputs and step length before each step, hash after it.
class InputRecorder : public StepObserver {
 public:
  struct Frame {
    std::vector<InputRecord> inputs;
    double dt = 0;  // [s]
    std::uint64_t hash = 0;
  };
  void on_step(const StepView& view) override {
    frames.push_back(
        {{view.inputs.begin(), view.inputs.end()}, view.report.dt, view.world.state_hash()});
  }
  std::vector<Frame> frames;
};

// All events of a run, in the order in which they came.
class EventRecorder : public StepObserver {
 public:
  void on_step(const StepView& view) override {
    const auto keep = [](auto& list, const auto& span) {
      list.insert(list.end(), span.begin(), span.end());
    };
    keep(contacts, view.events.contacts);
    keep(hits, view.events.hits);
    keep(sensors, view.events.sensors);
    keep(sleep, view.events.sleep);
    keep(quarantined, view.events.quarantined);
  }
  std::vector<ContactEvent> contacts;
  std::vector<HitEvent> hits;
  std::vector<SensorEvent> sensors;
  std::vector<SleepEvent> sleep;
  std::vector<QuarantineEvent> quarantined;
};

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
