// What the user has forced on or off (WorldSettings::forced), in the terms of the stages that ask.
#pragma once

#include <cmath>
#include <limits>

#include "motion/body_motion.h"
#include "plumb/settings.h"
#include "world/pair_store.h"
#include "world/visible.h"

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

// [m] What islands may err by for fewer substeps; 0: they take all of them.
inline Real step_tolerance_of(const WorldSettings& settings) {
  return settings.forced.off(PlanItem::StepLevels) ? Real(0) : settings.step_tolerance;
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
// Moments that differ by less than this [-] do so by rounding: w x I w is then nothing.
inline constexpr Real kSameMoments = Real(64) * std::numeric_limits<Real>::epsilon();
inline bool is_round(const BodyMass& mass) {
  const Vec m = mass.moments;
  const Real most = larger_of(m.x, larger_of(m.y, m.z));
  return size_of(m.x - m.y) <= kSameMoments * most && size_of(m.y - m.z) <= kSameMoments * most;
}
// Whether a body has a gyroscopic term that is forced off. Locked axes leave none.
inline bool lacks_gyroscopic_term(const WorldSettings& settings, const BodyMass& mass) {
  return settings.forced.off(PlanItem::Gyroscopic) && mass.angular_locks == 0 && !is_round(mass);
}
// The gyroscopic term is negligible where it turns a body's momentum, seen from the body, by less
// than this in a step [-], which is little more than rounding does in single precision. What a
// contact or a joint holds has the momentum that its weight brings about in a step for company.
inline constexpr Real kSteadyTurn = Real(1e-6);
// Whether w x I w is much less than that within a substep h [s]: the body turns about a principal
// axis, or hardly. With nothing to leave out, not a bit changes when the term is forced off.
inline bool turns_steadily(const WorldSettings& settings, const BodyMass& mass, Rotation q, Vec L,
                           Real h) {
  constexpr Real kShare = Real(1.0 / 16) * kSteadyTurn;
  const Vec w = angular_velocity_of(mass, q, L);
  const Real time = std::abs(h);
  const Real g = static_cast<Real>(settings.gravity.norm());
  const Real company = mass.mass * g * gyration_of(mass) * time;
  return length(cross(w, L)) * time <= kShare * (length(L) + company);
}
// Turns a body that nothing acts on for a time h [s].
inline void turn(const WorldSettings& settings, const BodyMass& mass, Rotation& q, Vec& L, Real h) {
  if (lacks_gyroscopic_term(settings, mass) && !turns_steadily(settings, mass, q, L, h)) {
    turn_steadily(mass, q, L, h);
  } else {
    turn_freely(rotation_of(settings), mass, q, L, h);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
