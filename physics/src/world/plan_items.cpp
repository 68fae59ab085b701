// Names of the plan's items, and what a user may force of them.
#include "plumb/plan_items.h"

#include <algorithm>

#include "plumb/effects.h"

namespace plumb::inline PLUMB_ABI {
namespace {

char plain(char c) { return c == ' ' || c == '-' ? '_' : c; }

bool same_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return plain(x) == plain(y); });
}

}  // namespace

const char* name_of(PlanItem item) {
  switch (item) {
    case PlanItem::Gravity:
      return "gravity";
    case PlanItem::Forces:
      return "forces";
    case PlanItem::Damping:
      return "damping";
    case PlanItem::Gyroscopic:
      return "gyroscopic";
    case PlanItem::MotionLocks:
      return "motion locks";
    case PlanItem::Contacts:
      return "contacts";
    case PlanItem::Friction:
      return "friction";
    case PlanItem::Restitution:
      return "restitution";
    case PlanItem::LookAhead:
      return "look-ahead";
    case PlanItem::Continuous:
      return "continuous";
    case PlanItem::Sensors:
      return "sensors";
    case PlanItem::Sleeping:
      return "sleeping";
    case PlanItem::DoublePositions:
      return "double positions";
    case PlanItem::Joints:
      return "joints";
    case PlanItem::RollingFriction:
      return "rolling friction";
    case PlanItem::SurfaceVelocity:
      return "surface velocity";
    case PlanItem::OneWay:
      return "one-way colliders";
    case PlanItem::AnisotropicFriction:
      return "anisotropic friction";
    case PlanItem::Adhesion:
      return "adhesion";
    case PlanItem::AccurateContacts:
      return "accurate contacts";
    case PlanItem::FastTurns:
      return "fast turns";
    case PlanItem::DeepOverlap:
      return "deep overlap";
    case PlanItem::KeptManifolds:
      return "kept manifolds";
    case PlanItem::DirectJoints:
      return "direct joints";
    case PlanItem::JointSubsteps:
      return "joint substeps";
    case PlanItem::StepLevels:
      return "step levels";
    default:
      break;
  }
  const std::size_t effect =
      static_cast<std::size_t>(item) - static_cast<std::size_t>(PlanItem::PointGravity);
  return name_of_effect(effect);  // empty for what is none
}

std::optional<PlanItem> plan_item_of(std::string_view name) {
  for (std::size_t k = 0; k < kPlanItemCount; ++k)
    if (same_words(name, name_of(static_cast<PlanItem>(k)))) return static_cast<PlanItem>(k);
  return std::nullopt;
}

bool may_force(PlanItem item, Choice choice) {
  switch (item) {
    case PlanItem::Gyroscopic:
    case PlanItem::LookAhead:
    case PlanItem::Continuous:
    case PlanItem::Sleeping:
    case PlanItem::AccurateContacts:
    case PlanItem::FastTurns:
    case PlanItem::DeepOverlap:
    case PlanItem::DirectJoints:
    case PlanItem::JointSubsteps:
      return true;
    case PlanItem::Friction:
    case PlanItem::Restitution:
    case PlanItem::RollingFriction:
    case PlanItem::SurfaceVelocity:
    case PlanItem::AnisotropicFriction:
    case PlanItem::Adhesion:
    case PlanItem::KeptManifolds:
    case PlanItem::StepLevels:
      return choice != Choice::On;
    case PlanItem::Gravity:
    case PlanItem::Forces:
    case PlanItem::Damping:
    case PlanItem::MotionLocks:
    case PlanItem::Contacts:
    case PlanItem::Sensors:
    case PlanItem::DoublePositions:
    case PlanItem::Joints:
    case PlanItem::OneWay:
    case PlanItem::Count:
      return choice == Choice::Automatic;
    default:
      return choice != Choice::On;  // effects
  }
}

}  // namespace plumb::inline PLUMB_ABI
