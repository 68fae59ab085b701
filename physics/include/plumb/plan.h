// Which effects and stages a step needs, derived from the scene, each with the reason.
#pragma once

#include <string>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

enum class PlanItem : unsigned char {
  Gravity,
  Forces,
  Damping,
  Gyroscopic,
  MotionLocks,
  Contacts,
  Friction,
  Restitution,
  Continuous,
  Sensors,
  Sleeping,
  DoublePositions,
  Joints,
  RollingFriction,
  SurfaceVelocity,
  OneWay,
  AnisotropicFriction,
  Adhesion,
  AccurateContacts,  // ContactSolver::Newton for some islands
  // Effects, in the order of EffectKind (plumb/effects.h).
  PointGravity,
  ForceField,
  Thrust,
  Explosion,
  Drag,
  Magnus,
  Attractor,
  Wind,
  AeroSurface,
  Buoyancy,
  Spring,
  Count,
};
const char* name_of(PlanItem item);

struct PlanDecision {
  PlanItem item;
  bool active;
  std::string reason;  // who called for it, or why nothing does
};

struct StepPlan {
  std::vector<PlanDecision> decisions;  // in the order of PlanItem

  [[nodiscard]] bool active(PlanItem item) const {
    return decisions[static_cast<std::size_t>(item)].active;
  }
};

}  // namespace plumb::inline PLUMB_ABI
