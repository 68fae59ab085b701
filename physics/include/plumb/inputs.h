// Everything that a user does to a world between two steps, as data: what is recorded, and what a
// replay does again.
#pragma once

#include <cstdint>
#include <vector>

#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

// One per mutating call of PhysicsWorld. The numbers of each kind stand in inputs.cpp beside the
// code that writes and reads them. Values are never reused; new ones are added at the end.
enum class InputKind : std::uint32_t {
  CreateBody = 1,
  DestroyBody,
  CreateCollider,
  DestroyCollider,
  SetPose,
  SetLinearVelocity,
  SetAngularVelocity,
  SetMass,
  ApplyForce,
  ApplyForceAt,
  ApplyForceAtBodyPoint,
  ApplyTorque,
  ApplyImpulse,
  ApplyImpulseAt,
  ApplyImpulseAtBodyPoint,
  ApplyAngularImpulse,
  SetAwake,
  SetSettings,
  CreateJoint,
  DestroyJoint,
  SetJointMotor,
  SetJointLimit,
  SetSurfaceVelocity,
  SetFilter,
  SetMaterialPair,
  ExcludeBodyPair,
  ExcludeColliderPair,
  DeriveMass,
  SetMotionType,
  SetLocks,
  SetDamping,
  SetGravityScale,
  SetCanSleep,
  SetContinuous,
  SetBodyUserData,
  SetShape,
  SetLocalPose,
  SetMaterial,
  SetDensity,
  SetSensor,
  SetOneWay,
  SetColliderUserData,
  CreateEffect,
  SetEffect,
  DestroyEffect,
};
const char* name_of(InputKind kind);

struct InputRecord {
  InputKind kind = InputKind::ApplyForce;
  std::uint64_t target = 0;     // Id::value() of the body or collider; 0 where there is none
  std::vector<double> numbers;  // exact: float and 32-bit integers pass through double unchanged
  friend bool operator==(const InputRecord&, const InputRecord&) = default;
};

}  // namespace plumb::inline PLUMB_ABI
