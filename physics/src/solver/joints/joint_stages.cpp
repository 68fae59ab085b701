// The joints' part in the substeps, and what is read out of it.
#include "solver/joints/joint_stages.h"

#include <algorithm>

#include "math/eigen_bridge.h"
#include "solver/joints/joint_flight.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Pieces of one colour share no dynamic body; the joints of a piece come one after the other.
// Groups that fly by themselves take no part.
template <class Task>
void for_pieces(WorldState& world, Task&& task) {
  JointScratch& joints = *world.joints.scratch;
  for (const auto& [first, last] : joints.colors) {
    const std::uint32_t offset = first;
    parallel_for(world, last - first, joint_tolerance::kPieceGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t i = begin; i < end; ++i)
                     if (const JointPiece& piece = joints.system.pieces[offset + i];
                         !piece.split && !piece.newton)
                       task(piece);
                 });
  }
}
template <class Task>
void for_blocks(WorldState& world, Task&& task) {
  std::vector<JointBlock>& blocks = world.joints.scratch->blocks;
  for_pieces(world, [&](const JointPiece& piece) {
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) task(blocks[i]);
  });
}

void pass_over(WorldState& world, JointPass pass) {
  const int passes = world.joints.scratch->has_parts ? joint_tolerance::kChainPasses : 1;
  for (int i = 0; i < passes; ++i)
    for_pieces(world, [&](const JointPiece& piece) {
      if (i == 0 || !piece.whole) solve_joints_of(world, piece, pass);
    });
  for_blocks(world, [&](JointBlock& block) { sum_joint(block, world, pass); });
}

}  // namespace

void fly_joint_groups(WorldState& world) {
  std::vector<JointPiece>& pieces = world.joints.scratch->system.pieces;
  parallel_for(world, static_cast<std::uint32_t>(pieces.size()), joint_tolerance::kPieceGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i)
                   if (pieces[i].split) fly_joint_group(world, pieces[i]);
               });
}

void warm_start_joints(WorldState& world) {
  for_blocks(world, [&](JointBlock& block) { warm_start_joint(world, block, JointPass::Solve); });
}

void solve_joints(WorldState& world) { pass_over(world, JointPass::Solve); }

void relax_joints(WorldState& world) {
  for_blocks(world, [&](JointBlock& block) { prepare_joint(world, block); });
  for_pieces(world, [&](const JointPiece& piece) { close_joints_of(world, piece); });
  pass_over(world, JointPass::Relax);
  for_blocks(world, [&](JointBlock& block) { note_rates(block, world); });
}

namespace {

// The remembered impulses belong to a substep of the world's.
void store_joint(WorldState& world, const JointBlock& block, Real per_substep) {
  const Real per_time = Real(1) / world.dt;
  JointMemory& memory = world.joints.info[block.joint].memory;
  memory.split = block.split;
  memory.force = per_time * block.force_sum;
  memory.torque = per_time * block.torque_sum;
  memory.effort = Real(0);
  memory.at_lower = memory.at_upper = false;
  for (int i = 0; i < block.rows; ++i) {
    RowImpulses& kept = memory.rows[i];
    kept = block.row[i].impulses;
    for (int p = 0; p < kRowParts; ++p) {
      kept.first[p] *= per_substep;
      kept.second[p] *= per_substep;
    }
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

}  // namespace

void store_joints(WorldState& world) {
  JointScratch& scratch = *world.joints.scratch;
  scratch.own_substeps_wanted = 0;
  scratch.most_cycles_wanted = 1;
  for (const JointPiece& piece : scratch.system.pieces) {
    for (std::uint32_t i = piece.begin; i < piece.end; ++i)
      store_joint(world, scratch.blocks[i], world.h / piece.h);
    scratch.own_substeps_wanted += piece.wanted_substeps;
    scratch.most_cycles_wanted = std::max(scratch.most_cycles_wanted, piece.most_wanted);
    world.report.joint_substeps += piece.own_substeps;
    if (piece.whole && piece.end - piece.begin > 1)
      world.report.direct_joints += piece.end - piece.begin;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
