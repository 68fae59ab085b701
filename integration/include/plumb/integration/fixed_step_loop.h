// Turns the irregular ticks of an engine into physics steps of one fixed length.
//
//   FixedStepLoop loop(world);
//   each frame:  loop.tick(seconds_since_last_frame);
//
// No time gets lost on the way: time fed = steps * dt + remainder (+ what was dropped, which is
// reported), with the sum kept in twice the digits of a double, however many ticks there were.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::integration {

struct LoopSettings {
  double dt = 1.0 / 60;  // [s] 1e-9..1e3: length of a step
  // A tick never runs more steps than this [-] >= 1; what lies beyond is dropped and reported. A
  // game that cannot keep up then runs slower instead of freezing.
  int max_steps_per_tick = 8;
  double time_scale = 1;  // [-] >= 0, finite: 0.5 is slow motion, 0 stands still
};

struct TickReport {
  Status status;       // not ok: the tick was refused, or a step was
  int steps = 0;       // done in this tick
  double dropped = 0;  // [s] simulated time given up in this tick: the cap was reached
  double alpha = 0;    // [-] 0..1, 1 excluded: how far the next step is on its way
};

class FixedStepLoop {
 public:
  // Called around every step, in the order in which they were added. A hook must not add hooks.
  using StepHook = std::function<void(PhysicsWorld& world, double dt)>;

  // The world is not owned and must outlive the loop. Settings out of range are replaced by the
  // defaults; see set_settings().
  explicit FixedStepLoop(PhysicsWorld& world, const LoopSettings& settings = {});

  Status set_settings(const LoopSettings& settings);  // of dt: what is left of the old step is kept
  [[nodiscard]] const LoopSettings& settings() const { return settings_; }

  void before_step(StepHook hook) { before_.push_back(std::move(hook)); }
  void after_step(StepHook hook) { after_.push_back(std::move(hook)); }

  // elapsed: [s] real time since the last tick, >= 0; NaN, infinite and negative times are refused
  // and leave everything as it is. Hooks may pause the loop; it then stops after that step.
  TickReport tick(double elapsed);

  // While paused, ticks do nothing and their time does not count, except for steps asked for.
  void set_paused(bool paused) { paused_ = paused; }
  [[nodiscard]] bool paused() const { return paused_; }
  // The next ticks of a paused loop do this many steps, one a tick.
  void request_steps(int count = 1) { requested_ += count > 0 ? count : 0; }

  [[nodiscard]] double alpha() const;
  [[nodiscard]] double remainder() const { return high_ + low_; }  // [s] fed, not yet stepped, < dt
  [[nodiscard]] double dropped_total() const { return dropped_total_; }  // [s] given up so far
  [[nodiscard]] std::uint64_t step_total() const { return step_total_; }

 private:
  void feed(double time);
  double take_whole_steps();  // removes them from the remainder and returns their number
  Status do_step();

  PhysicsWorld& world_;
  LoopSettings settings_;
  std::vector<StepHook> before_, after_;
  // The remainder as a sum of two doubles that do not overlap.
  double high_ = 0;           // [s]
  double low_ = 0;            // [s]
  double dropped_total_ = 0;  // [s]
  std::uint64_t step_total_ = 0;
  int requested_ = 0;
  bool paused_ = false;
};

}  // namespace plumb::inline PLUMB_ABI::integration
