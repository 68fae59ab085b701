// Which joints hang together, and in which order they are solved.
#pragma once

#include "solver/joints/joint_scratch.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

// The bodies of a joint by slot: two, or the four of the joints that it couples.
struct JointBodies {
  std::uint32_t slot[kMaxJointBodies];
  int count;
};
JointBodies bodies_of(const WorldState& world, std::uint32_t joint);
bool is_dynamic_awake(const WorldState& world, std::uint32_t slot);
// 0 for what does not move in this step.
std::uint32_t dense_of(const WorldState& world, std::uint32_t slot);

// From the joints that are alive to `active`, groups, order, pieces, pattern and colours.
void group_joints(WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
