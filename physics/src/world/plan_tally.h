// What the plan looks at: one pass over the bodies, one over the awake pairs.
#pragma once

#include <cstdint>

#include "solver/newton/choose.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// The worst body of some count, with a number that says how bad it is.
struct Worst {
  std::uint32_t body = kNone;  // slot
  Real value = 0;
  void note(std::uint32_t slot, Real x) {
    if (!(x > value)) return;
    body = slot;
    value = x;
  }
};

struct BodyTally {
  std::uint32_t dynamic = 0, kinematic = 0, awake = 0, weightless = 0;
  std::uint32_t forced = 0, damped = 0, locked = 0;
  std::uint32_t coarse = 0;  // want fewer substeps than the world's
  int halvings = 0;          // ... the most of them
  std::uint32_t isotropic = 0, unturnable = 0, steady = 0, tumbling = 0;
  std::uint32_t far = 0;   // move by more than a fraction of their thickness in a step
  std::uint32_t fast = 0;  // touch something, and turn by more than kFastTurn in a step
  Worst tilt;              // [rad/s] |w x L| / |L| of what tumbles
  Worst path;              // [m] in a step
  Worst turn;              // [rad] in a step, of what touches something
  Worst thickness;         // [m]
};

struct PairTally {
  std::uint32_t pairs = 0, touching = 0;
  std::uint32_t swept = 0;  // move by more than a fraction of their thickness, seen from each other
  // Of those that press on each other (adhesive, bouncing: touch).
  std::uint32_t frictional = 0, bouncing = 0, turning = 0, driven = 0, grained = 0, adhesive = 0;
  std::uint32_t deep = 0;  // contacts
  double push = 0;         // [N] the greatest normal force of a pair in the last step
  Real friction = 0;       // [N] the greatest friction that a pair may have had
  Real resistance = 0;     // [N m] ... resistance to rolling and turning
  Real adhesion = 0;       // [N]
  Real restitution = 0;    // [-] the greatest
  Real approach = 0;       // [m/s] the greatest speed of two surfaces, seen from each other
};

struct JointTally {
  std::uint32_t joints = 0;   // that hold something awake
  std::uint32_t grouped = 0;  // ... and share a body with another one
  std::uint32_t wanted = 0;   // substeps of their own that groups asked for in the last step
  std::uint32_t most = 1;     // ... the most, within one of the world's
};

struct PlanTally {
  Real dt = 0;  // [s] the step that is planned for
  BodyTally body;
  PairTally pair;
  JointTally joint;
  newton::Calls calls;        // ContactSolver::Auto
  std::uint32_t staying = 0;  // bodies with the accurate solver
  std::uint32_t refused = 0;  // bodies whose calls for it are not heard
  std::uint32_t effects[kEffectKindCount] = {}, reached[kEffectKindCount] = {};
};

PlanTally tally_plan(const WorldState& world);
// Items that the scene calls for, bit by bit_of(), before what is forced.
std::uint64_t called_items(const WorldState& world, const PlanTally& tally);
// What the plan is, with what is forced.
std::uint64_t decided_items(const WorldSettings& settings, std::uint64_t called);

}  // namespace plumb::inline PLUMB_ABI::detail
