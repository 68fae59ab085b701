// What the joints of a world need while it steps.
#pragma once

#include <vector>

#include "solver/joints/joint_system.h"

namespace plumb::inline PLUMB_ABI::detail {

// The dynamic bodies of a joint, by dense index.
struct JointMembers {
  std::uint32_t body[kMaxJointBodies];
  int count = 0;
  bool anchored = false;  // it also holds on to something that does not move
};

struct JointScratch {
  // Joints that hold something awake: slots, ascending, and what they hold.
  std::vector<std::uint32_t> active;
  std::vector<JointMembers> members;
  std::vector<std::uint32_t> order;  // active joints piece by piece, in the order of elimination
  std::vector<JointBlock> blocks;    // likewise
  JointSystem system;
  // Ranges of pieces. Those of one colour share no dynamic body.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> colors;
  std::vector<std::uint8_t> group_anchored;  // per group: it hangs on something, or has axes locked
  std::vector<std::uint32_t> first_joint;    // per dense index: the first block at it
  std::vector<Symmetric3<Real>> stiffness;   // per dense index [kg m^2], of taut bodies in contact
  bool has_parts = false;                    // some pieces are not whole groups
  std::vector<std::uint32_t> group;          // per dense index: smallest one connected over joints
  std::vector<std::uint8_t> group_touches;   // per group: some body of it touches something
  std::vector<std::uint8_t> group_loops;     // per group: joints may hold what others hold already
  // Substeps of their own that groups asked for in the last step, and the most at once.
  std::uint32_t own_substeps_wanted = 0, most_cycles_wanted = 1;
};

// Calls task(dense index) for every dynamic body of a piece, once.
template <class Task>
void for_bodies(const JointScratch& scratch, const JointPiece& piece, Task&& task) {
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
    const JointMembers& members = scratch.members[scratch.order[i]];
    for (int k = 0; k < members.count; ++k)
      if (scratch.first_joint[members.body[k]] == i) task(members.body[k]);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
