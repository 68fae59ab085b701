// A point that goes with a body, or stays in the world.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "plumb/world.h"
#include "record/frame.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

inline constexpr std::size_t kNoSlot = std::numeric_limits<std::size_t>::max();

// Where each body stands in Frame::bodies, by its index.
inline std::vector<std::size_t> slots_of(const Frame& frame) {
  std::vector<std::size_t> slots;
  for (std::size_t slot = 0; slot < frame.bodies.size(); ++slot) {
    const std::size_t index = frame.bodies[slot].id.index;
    if (slots.size() <= index) slots.resize(index + 1, kNoSlot);
    slots[index] = slot;
  }
  return slots;
}

struct Anchor {
  std::size_t slot = kNoSlot;  // of the body in Frame::bodies; kNoSlot: the world
  LocalPose frame{};           // in the body frame, or in the world

  Anchor() = default;
  Anchor(BodyId body, const LocalPose& at, std::span<const std::size_t> slots) : frame(at) {
    if (!body.is_null() && body.index < slots.size()) slot = slots[body.index];
  }

  [[nodiscard]] Eigen::Vector3d position(const Frame& now) const {
    const Eigen::Vector3d local = frame.position.template cast<double>();
    if (slot == kNoSlot) return local;
    const Pose& X_WB = now.bodies[slot].pose;
    return X_WB.position.template cast<double>() +
           (X_WB.orientation * frame.position).template cast<double>();
  }
  // The x axis of the frame.
  [[nodiscard]] Eigen::Vector3d axis(const Frame& now) const {
    const Vec3 local = frame.orientation * Vec3::UnitX();
    if (slot == kNoSlot) return local.template cast<double>();
    return (now.bodies[slot].pose.orientation * local).template cast<double>();
  }
};

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
