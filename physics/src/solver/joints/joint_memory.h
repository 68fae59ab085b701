// What a joint remembers from step to step.
#pragma once

#include <cstdint>
#include <limits>

#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail {

inline constexpr std::uint32_t kWorldBody = std::numeric_limits<std::uint32_t>::max();

inline constexpr int kMaxJointRows = 8;
inline constexpr int kMaxHeld = 6, kMaxFree = 8;
inline constexpr int kMaxJointBodies = 4;
inline constexpr int kMaxJacobians = 16;  // rows times bodies

// What acts along a free row. The impulses are remembered in this order.
enum RowPart : std::uint8_t { kHold, kSpring, kMotor, kFriction, kLower, kUpper, kRowParts };

// Impulses of one row, as remembered between steps. A joint whose bodies touch nothing gets its
// impulses in two halves, before and after the drift (see joints.cpp); otherwise only the first is
// used.
struct RowImpulses {
  Real first[kRowParts] = {};  // [N s] or [N m s]
  Real second[kRowParts] = {};
};

// A joint from step to step.
struct JointMemory {
  RowImpulses rows[kMaxJointRows];
  bool split = false;   // which of the two schemes the impulses belong to
  Real angle = 0;       // [rad] of the last step, whole turns counted
  Real zero = 0;        // couplings: the constant; pulley: length of the rope
  Vec force{0, 0, 0};   // [N] on B, mean over the last step
  Vec torque{0, 0, 0};  // [N m]
  Real effort = 0;      // [N] or [N m]
  bool at_lower = false, at_upper = false;
};

}  // namespace plumb::inline PLUMB_ABI::detail
