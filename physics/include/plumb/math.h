// Vector types of the public interface. Eigen stops at this door: inside, the engine computes with
// its own small types (src/math), because the same bits must come out under every compiler and
// vector width.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Pos3 = Eigen::Matrix<PosReal, 3, 1>;  // world positions [m]
using Mat3 = Eigen::Matrix<Real, 3, 3>;
// Unit quaternion R_WB: rotates body axes into world axes, v_W = q * v_B.
using Quat = Eigen::Quaternion<Real, Eigen::DontAlign>;

// A body's placement in the world.
struct Pose {
  Pos3 position = Pos3::Zero();         // [m] world
  Quat orientation = Quat::Identity();  // R_WB, unit
};

// A placement relative to a body.
struct LocalPose {
  Vec3 position = Vec3::Zero();         // [m] body frame
  Quat orientation = Quat::Identity();  // R_BC, unit
};

// Axis-aligned box in world axes.
struct Bounds {
  Pos3 lower = Pos3::Zero();  // [m]
  Pos3 upper = Pos3::Zero();  // [m]
};

}  // namespace plumb::inline PLUMB_ABI
