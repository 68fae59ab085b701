// What a user may choose for a world. Everything has a unit, a default and a reason; tolerances
// that nobody should have to choose live in src/world/tolerances.h.
#pragma once

#include <cstdint>

#include "plumb/math.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

enum class RotationMethod : std::uint8_t {
  Exact,         // torque-free flow, exact to round-off (src/motion/rotation_flow.h); the default
  ImplicitGyro,  // one Newton step of the implicit gyroscopic term: damps tumbling [Catto 2015]
  Book,          // first-order quaternion update, no gyroscopic term [Millington 2010]
};

// How contacts and joints that touch something are solved.
enum class ContactSolver : std::uint8_t {
  SoftStep,  // fast: one soft pass and one relaxing pass a substep (src/solver); the default
  // Accurate: each island to the exact laws in every substep, whatever its masses and its height,
  // in double (src/solver/newton). Costs more where many contacts open and close.
  Newton,
  // Newton for the islands that call for it, soft steps for the others: where heavy bodies lie on
  // light ones or many on one another (world.plan() tells; physics/README.md has the map).
  Auto,
};

struct WorldSettings {
  Vec3 gravity = Vec3(0, Real(-9.81), 0);  // [m/s^2] finite

  // Solver steps within one step [-] 1..64. Contacts and joints stiffen and errors shrink with
  // their number; cost grows with it. 4: stacks of ten stand at 60 Hz.
  int substeps = 4;
  // How fast overlap is worked off: the natural frequency [Hz] > 0 and damping ratio [-] >= 0 of a
  // contact seen as a spring. Limited to a quarter of the substep rate. [Catto 2024]
  Real contact_frequency = Real(30);
  Real contact_damping_ratio = Real(10);

  RotationMethod rotation = RotationMethod::Exact;
  ContactSolver contact_solver = ContactSolver::SoftStep;

  bool warm_starting = true;  // begin from the last step's impulses; off only to show what it buys
  bool sleeping = true;       // islands at rest stop costing anything
  Real time_to_sleep = Real(0.5);  // [s] >= 0 that every body of an island must have been at rest
  bool profiling = false;          // fill StepReport::stage_seconds
};

// Whether every number is finite and in its range.
Status check(const WorldSettings& settings);

}  // namespace plumb::inline PLUMB_ABI
