// A piece of a body to be drawn: whose it is, where on the body, and in which colour.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/math.h"
#include "plumb/rigid_body.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// 0xRRGGBBAA
inline constexpr std::array<std::uint32_t, 8> kBodyColors{
    0x4e9fe6ff, 0xf2a541ff, 0x5fbf7fff, 0xe0666aff, 0xa487d8ff, 0x4fc1c0ff, 0xd9c14aff, 0xdd86b8ff};
inline constexpr std::uint32_t kAsleepColor = 0x8a8f98ff;
inline constexpr std::uint32_t kStaticColor = 0x59616dff;
inline constexpr std::uint32_t kSensorColor = 0x7fd4a0ff;

struct PlacedPart {
  std::size_t slot = 0;       // of the body in Frame::bodies
  LocalPose pose;             // of what is drawn, in the body frame
  bool at_body_frame = true;  // pose is the identity
  std::uint32_t color = kStaticColor;

  // Writes the world pose as single-precision position and x y z w.
  void write_pose(std::span<const BodyState> bodies, float* position, float* quaternion) const {
    const Pose& X_WB = bodies[slot].pose;
    Pos3 p_W = X_WB.position;
    Quat R_W = X_WB.orientation;
    if (!at_body_frame) {
      p_W += (R_W * pose.position).template cast<PosReal>();
      R_W = R_W * pose.orientation;
    }
    for (Eigen::Index i = 0; i < 3; ++i) position[i] = static_cast<float>(p_W[i]);
    for (Eigen::Index i = 0; i < 4; ++i) quaternion[i] = static_cast<float>(R_W.coeffs()[i]);
  }
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
