// What a step may consist of, item by item, and what the user forces on or off of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

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
  LookAhead,   // contacts of fast pairs, made where they will first touch
  Continuous,  // bodies that move far, followed along their path after the step
  Sensors,
  Sleeping,
  DoublePositions,
  Joints,
  RollingFriction,  // and torsional friction
  SurfaceVelocity,
  OneWay,
  AnisotropicFriction,
  Adhesion,
  AccurateContacts,  // ContactSolver::Newton for some islands
  FastTurns,         // contacts of bodies that turn far in a step, told anew within it
  DeepOverlap,       // contacts of bodies that overlap deeply, relaxed more often
  KeptManifolds,     // of pairs that hardly moved, taken over from an earlier step
  DirectJoints,      // groups of joints, solved at once; else joint by joint, again and again
  JointSubsteps,     // substeps of their own for groups of joints that turn or swing fast
  StepLevels,        // fewer substeps for islands that err by less than step_tolerance with them
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
inline constexpr std::size_t kPlanItemCount = static_cast<std::size_t>(PlanItem::Count);
static_assert(kPlanItemCount <= 64, "a set of items is one bit each of a word");
const char* name_of(PlanItem item);
// By its name, with any of ' ', '-' and '_' between its words.
std::optional<PlanItem> plan_item_of(std::string_view name);

constexpr std::uint64_t bit_of(PlanItem item) {
  return std::uint64_t{1} << static_cast<unsigned>(item);
}

// Automatic: where the scene calls for it, by the test that world.plan() tells. Off: never. On:
// everywhere, whatever the test says.
enum class Choice : std::uint8_t { Automatic, Off, On };

// Which choices an item has besides Automatic. What the engine chooses by itself may be forced both
// ways; what the scene asks for by numbers of its own (effects, friction and the like) may be
// forced off; what a scene is made of (gravity, joints, contacts ...) is changed there.
bool may_force(PlanItem item, Choice choice);

// The choices of a user, item by item; Automatic at first.
class PlanChoices {
 public:
  PlanChoices() = default;
  PlanChoices(std::uint64_t items_off, std::uint64_t items_on) : off_(items_off), on_(items_on) {}

  void set(PlanItem item, Choice choice) {
    off_ = choice == Choice::Off ? off_ | bit_of(item) : off_ & ~bit_of(item);
    on_ = choice == Choice::On ? on_ | bit_of(item) : on_ & ~bit_of(item);
  }
  [[nodiscard]] Choice of(PlanItem item) const {
    return off(item) ? Choice::Off : on(item) ? Choice::On : Choice::Automatic;
  }
  [[nodiscard]] bool off(PlanItem item) const { return (off_ & bit_of(item)) != 0; }
  [[nodiscard]] bool on(PlanItem item) const { return (on_ & bit_of(item)) != 0; }
  // Sets of items, bit by bit_of().
  [[nodiscard]] std::uint64_t items_off() const { return off_; }
  [[nodiscard]] std::uint64_t items_on() const { return on_; }
  bool operator==(const PlanChoices&) const = default;

 private:
  std::uint64_t off_ = 0, on_ = 0;
};

}  // namespace plumb::inline PLUMB_ABI
