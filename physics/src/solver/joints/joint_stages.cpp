// The joints' part in the substeps, and what is read out of it.
#include "solver/joints/joint_stages.h"

#include "math/eigen_bridge.h"
#include "solver/joints/joint_block.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

template <class Task>
void for_joints(WorldState& world, Task&& task) {
  JointScratch& joints = *world.joints.scratch;
  parallel_for(world, static_cast<std::uint32_t>(joints.blocks.size()),
               joint_tolerance::kJointGrain, [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) task(joints.blocks[i]);
               });
}
template <class Task>
void for_joints_by_color(WorldState& world, Task&& task) {
  JointScratch& joints = *world.joints.scratch;
  for (const auto& [first, last] : joints.colors) {
    const std::uint32_t offset = first;
    parallel_for(world, last - first, joint_tolerance::kJointGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t i = begin; i < end; ++i) task(joints.blocks[offset + i]);
                 });
  }
}

// A single colour is a set of joints apart: what one does, no other sees.
int passes_over(const WorldState& world) {
  return world.joints.scratch->colors.size() > 1 ? joint_tolerance::kChainPasses : 1;
}

void pass_over(WorldState& world, JointPass pass) {
  const int passes = passes_over(world);
  for (int i = 0; i < passes; ++i)
    for_joints_by_color(world, [&](JointBlock& block) { solve_joint(world, block, pass); });
  for_joints(world, [&](JointBlock& block) { sum_joint(block, world, pass); });
}

}  // namespace

void warm_start_joints(WorldState& world) {
  for_joints_by_color(world,
                      [&](JointBlock& block) { warm_start_joint(world, block, JointPass::Solve); });
}

void solve_joints(WorldState& world) { pass_over(world, JointPass::Solve); }

void relax_joints(WorldState& world) {
  for_joints(world, [&](JointBlock& block) { prepare_joint(world, block); });
  for_joints_by_color(world,
                      [&](JointBlock& block) { warm_start_joint(world, block, JointPass::Relax); });
  pass_over(world, JointPass::Relax);
  for_joints(world, [&](JointBlock& block) { note_rates(block, world); });
}

void store_joints(WorldState& world) {
  const Real per_time = Real(1) / world.dt;
  for (const JointBlock& block : world.joints.scratch->blocks) {
    JointMemory& memory = world.joints.info[block.joint].memory;
    memory.split = block.split;
    memory.force = per_time * block.force_sum;
    memory.torque = per_time * block.torque_sum;
    memory.effort = Real(0);
    memory.at_lower = memory.at_upper = false;
    for (int i = 0; i < block.rows; ++i) {
      memory.rows[i] = block.row[i].impulses;
      if (i < block.held) continue;
      const Real* sum = block.row[i].sum;
      memory.at_lower = memory.at_lower || sum[kLower] > Real(0);
      memory.at_upper = memory.at_upper || sum[kUpper] > Real(0);
      if (i == block.held)
        memory.effort =
            per_time * (sum[kSpring] + sum[kMotor] + sum[kFriction] + sum[kLower] - sum[kUpper]);
    }
    if (block.pairs == 1) memory.angle = block.pair[0].angle;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
