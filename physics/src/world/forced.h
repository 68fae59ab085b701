// What the user has forced on or off (WorldSettings::forced), in the terms of the stages that ask.
#pragma once

#include <limits>

#include "motion/body_motion.h"
#include "plumb/settings.h"
#include "world/pair_store.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// A pair by the numbers that its materials give it, whatever is forced off (pair_rules.cpp).
Pair without_forcing(const WorldState& world, const Pair& pair);

// A threshold above which something is done: never reached where the item is forced off, always
// where it is forced on.
inline Real threshold(const WorldSettings& settings, PlanItem item, Real automatic,
                      Real always = Real(0)) {
  switch (settings.forced.of(item)) {
    case Choice::Off:
      return std::numeric_limits<Real>::max();
    case Choice::On:
      return always;
    case Choice::Automatic:
      break;
  }
  return automatic;
}

inline bool may_sleep(const WorldSettings& settings) {
  const Choice choice = settings.forced.of(PlanItem::Sleeping);
  return choice == Choice::Automatic ? settings.sleeping : choice == Choice::On;
}

inline ContactSolver solver_of(const WorldSettings& settings) {
  switch (settings.forced.of(PlanItem::AccurateContacts)) {
    case Choice::Off:
      return ContactSolver::SoftStep;
    case Choice::On:
      return ContactSolver::Newton;
    case Choice::Automatic:
      break;
  }
  return settings.contact_solver;
}

inline bool has_gyroscopic_term(const WorldSettings& settings) {
  const Choice choice = settings.forced.of(PlanItem::Gyroscopic);
  return choice == Choice::Automatic ? settings.rotation != RotationMethod::Book
                                     : choice == Choice::On;
}

// How bodies turn: by the settings' method, which Book leaves for Exact where the gyroscopic term
// is forced on.
inline RotationMethod rotation_of(const WorldSettings& settings) {
  return settings.rotation == RotationMethod::Book && has_gyroscopic_term(settings)
             ? RotationMethod::Exact
             : settings.rotation;
}
// Whether a body has a gyroscopic term that is forced off.
inline bool lacks_gyroscopic_term(const WorldSettings& settings, const BodyMass& mass) {
  return settings.forced.off(PlanItem::Gyroscopic) &&
         classify_inertia(mass.moments) != RotationKind::Isotropic;
}
// Whether turning leaves the angular momentum as it is.
inline bool turning_keeps_momentum(const WorldSettings& settings, const BodyMass& mass) {
  return !lacks_gyroscopic_term(settings, mass) && keeps_momentum(rotation_of(settings));
}
// Turns a body that nothing acts on for a time h [s].
inline void turn(const WorldSettings& settings, const BodyMass& mass, Rotation& q, Vec& L, Real h) {
  if (lacks_gyroscopic_term(settings, mass)) {
    turn_steadily(mass, q, L, h);
  } else {
    turn_freely(rotation_of(settings), mass, q, L, h);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
