// What happened during a step, as ordered lists: the same order for any number of threads. Valid
// until the next step.
#pragma once

#include <cstdint>
#include <span>

#include "plumb/ids.h"
#include "plumb/joint.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI {

struct ContactEvent {
  enum class Kind : std::uint8_t { Begin, End } kind = Kind::Begin;
  ColliderId a, b;
  BodyId body_a, body_b;
};

// A contact that began with an approach faster than the pair's bounce threshold, or any bounce.
struct HitEvent {
  ColliderId a, b;
  BodyId body_a, body_b;
  Pos3 point = Pos3::Zero();    // [m] world
  Vec3 normal = Vec3::UnitY();  // from A to B
  Real approach_speed = 0;      // [m/s] > 0
  Real impulse = 0;             // [N s]
};

struct SensorEvent {
  enum class Kind : std::uint8_t { Enter, Exit } kind = Kind::Enter;
  ColliderId sensor, other;
};

// A collider that a sensor sees.
struct SensorOverlap {
  ColliderId sensor, other;
  friend bool operator==(const SensorOverlap&, const SensorOverlap&) = default;
  friend auto operator<=>(const SensorOverlap&, const SensorOverlap&) = default;
};

struct SleepEvent {
  BodyId body;
  bool fell_asleep = true;  // false: woke up
};

struct QuarantineEvent {
  BodyId body;
};

struct Events {
  std::span<const ContactEvent> contacts;
  std::span<const HitEvent> hits;
  std::span<const SensorEvent> sensors;
  // Everything that sensors see after the step, asleep or awake, by sensor and then by the other:
  // what has entered and not left. Kept up by the events alone.
  std::span<const SensorOverlap> overlaps;
  std::span<const SleepEvent> sleep;
  std::span<const QuarantineEvent> quarantined;
  std::span<const JointBreakEvent> broken_joints;  // by index
};

// A touching pair as it stands after the step.
struct ContactState {
  struct Point {
    Pos3 position = Pos3::Zero();          // [m] world
    Real separation = 0;                   // [m] negative: overlap
    Real normal_impulse = 0;               // [N s] over the whole step, >= 0
    Vec3 friction_impulse = Vec3::Zero();  // [N s] on B, over the whole step, world axes
  };
  ColliderId a, b;
  BodyId body_a, body_b;
  bool began = false;           // in the last step; else it persists
  Vec3 normal = Vec3::UnitY();  // from A to B
  int point_count = 0;
  Point points[4];
};

// Where a walk over the touching pairs stands (PhysicsWorld::next_contact()).
struct ContactCursor {
  std::uint32_t island = 0;   // 0: the awake pairs, k: those of sleeping island k - 1
  std::uint32_t pair = 0;     // within it
  std::uint32_t contact = 0;  // of that pair
};

// One point of a touching pair, for whoever draws or counts them.
struct ContactPoint {
  Pos3 position = Pos3::Zero();  // [m] world
  Vec3 normal = Vec3::UnitY();   // from A to B
  Real normal_impulse = 0;       // [N s] over the whole step, >= 0
};

}  // namespace plumb::inline PLUMB_ABI
