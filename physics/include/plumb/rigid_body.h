// The component that makes an entity a body.
#pragma once

#include <cstdint>
#include <optional>

#include "plumb/ids.h"
#include "plumb/mass_properties.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI {

enum class MotionType : std::uint8_t {
  Static,     // never moves; infinite mass
  Kinematic,  // moves by its own velocity; pushes, is never pushed
  Dynamic,    // moves by forces, impulses and contacts
};

// World axes along or about which a dynamic body must not move.
struct MotionLocks {
  bool linear_x = false, linear_y = false, linear_z = false;
  bool angular_x = false, angular_y = false, angular_z = false;

  // Motion in the world x-y plane only.
  static constexpr MotionLocks planar() { return {false, false, true, true, true, false}; }
};

struct RigidBody {
  MotionType type = MotionType::Dynamic;
  Pose pose{};                           // of the body frame B in the world
  Vec3 linear_velocity = Vec3::Zero();   // [m/s] of the centre of mass, world axes
  Vec3 angular_velocity = Vec3::Zero();  // [rad/s] world axes
  // Left empty, mass comes from the colliders' densities. A dynamic body without colliders and
  // without this has 1 kg at its origin and does not rotate (a point mass).
  std::optional<MassProperties> mass{};
  MotionLocks locks{};
  Real linear_damping = Real(0);   // [1/s] >= 0: v' = -c v, exact at any time step
  Real angular_damping = Real(0);  // [1/s] >= 0: L' = -c L
  Real gravity_scale = Real(1);    // [-] finite
  // A body that moves far in a step, compared with its thickness, is stopped where it meets static
  // and kinematic ones. With this it is stopped by dynamic ones too.
  bool continuous = false;
  bool can_sleep = true;
  bool starts_awake = true;
  std::uint64_t user_data = 0;  // the engine's own (an entity), never looked at
};

// What a body is doing now, read in bulk.
struct BodyState {
  BodyId id;
  MotionType type = MotionType::Dynamic;
  bool awake = true;
  Pose pose{};                           // of the body frame B
  Vec3 linear_velocity = Vec3::Zero();   // [m/s] of the centre of mass
  Vec3 angular_velocity = Vec3::Zero();  // [rad/s] world axes
  std::uint64_t user_data = 0;
};

}  // namespace plumb::inline PLUMB_ABI
