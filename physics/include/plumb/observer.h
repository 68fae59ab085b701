// Read-only view of every step, for recorders and debuggers. Observers cannot change the world.
#pragma once

#include <span>

#include "plumb/events.h"
#include "plumb/inputs.h"
#include "plumb/report.h"

namespace plumb::inline PLUMB_ABI {

class PhysicsWorld;

// Valid during the call only.
struct StepView {
  const PhysicsWorld& world;  // after the step; copy_body_states(), copy_contacts(), ...
  const StepReport& report;
  const Events& events;
  std::span<const InputRecord> inputs;  // given since the previous step, in order, before this one
};

class StepObserver {
 public:
  virtual ~StepObserver() = default;
  // When it is attached: the world as it stands, before any further input.
  virtual void on_attach(const PhysicsWorld& world) { (void)world; }
  // After every step, on the thread that called step().
  virtual void on_step(const StepView& view) = 0;
};

}  // namespace plumb::inline PLUMB_ABI
