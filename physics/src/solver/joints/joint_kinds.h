// Questions about kinds of joints that do not need their rows.
#pragma once

#include "solver/joints/joint_block.h"

namespace plumb::inline PLUMB_ABI::detail {

// Whether it couples two other joints, and which.
inline bool coupled_joints(const JointKind& kind, JointId& first, JointId& second) {
  if (const auto* gear = std::get_if<GearJoint>(&kind)) {
    first = gear->first;
    second = gear->second;
    return true;
  }
  if (const auto* rack = std::get_if<RackPinionJoint>(&kind)) {
    first = rack->pinion;
    second = rack->rack;
    return true;
  }
  return false;
}
// first + ratio * second is what it holds.
inline Real coupling_ratio(const JointKind& kind) {
  if (const auto* gear = std::get_if<GearJoint>(&kind)) return gear->ratio;
  if (const auto* rack = std::get_if<RackPinionJoint>(&kind)) return Real(-1) / rack->radius;
  return Real(1);
}
// The joint's own coordinate.
inline Coordinate measured_by(const JointKind& kind) {
  if (std::holds_alternative<HingeJoint>(kind) || std::holds_alternative<ConeTwistJoint>(kind) ||
      std::holds_alternative<SixDofJoint>(kind))
    return Coordinate::Twist;
  if (std::holds_alternative<DistanceJoint>(kind) || std::holds_alternative<RopeJoint>(kind) ||
      std::holds_alternative<SpringJoint>(kind))
    return Coordinate::Distance;
  return Coordinate::LinearX;
}

}  // namespace plumb::inline PLUMB_ABI::detail
