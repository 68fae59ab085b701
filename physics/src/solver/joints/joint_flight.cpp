// A group that touches nothing goes through the substep by itself:
//
//   h/2 of the forces | warm start, solve | drift | h/2 of the forces | close, relax
//
// This is symmetric, second order in h, and keeps energy over long times [Andersen 1983]. As
// nothing else is waiting for it, the group may take substeps of its own: where a light chain
// carries a heavy load the fastest vibration of what is stretched is out of reach of the world's,
// and a whip turns faster than they can follow.
#include "solver/joints/joint_flight.h"

#include <cmath>

#include "solver/body_substep.h"
#include "solver/joints/joint_levers.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// The group's own substeps within one of the world's.
int cycles_of(WorldState& world, const JointPiece& piece) {
  const JointScratch& scratch = *world.joints.scratch;
  for_bodies(scratch, piece, [&](std::uint32_t i) { world.substep[i].stiffness = Real(0); });
  Real turn = 0, vibration = 0;  // [rad^2/s^2]
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
    const JointBlock& block = scratch.blocks[i];
    if (block.pairs != 1) continue;  // couplings pass on torques
    const Real f = pull_of(block, piece.h);
    const int a = block.place[0], b = block.place[1];
    const Vec arm_a = rotate(world.delta[block.body[a]].dq, block.pair[0].arm_a);
    const Vec arm_b = rotate(world.delta[block.body[b]].dq, block.pair[0].arm_b);
    const Lever at_a = lever_of(block, a, arm_a), at_b = lever_of(block, b, arm_b);
    for (const bool first : {true, false}) {
      const int k = first ? a : b;
      if (!block.moves[k]) continue;
      SubstepBody& s = world.substep[block.body[k]];
      s.stiffness += first ? stiffness(f, at_a, at_b) : stiffness(f, at_b, at_a);
      vibration = std::max(vibration, s.stiffness);
      const Vec arm = first ? arm_a : arm_b;
      const Vec across = cross(world.bodies.velocity[block.body[k]].w, arm);
      const Real r2 = length_squared(arm);
      if (r2 > Real(0)) turn = std::max(turn, length_squared(across) / r2);
    }
  }
  const Real wanted =
      world.h * std::max(std::sqrt(turn) / joint_tolerance::kTurnPerCycle,
                         std::sqrt(vibration) / joint_tolerance::kVibrationPerCycle);
  if (!(wanted > Real(1))) return 1;
  return wanted < Real(joint_tolerance::kMostCycles) ? static_cast<int>(std::ceil(wanted))
                                                     : joint_tolerance::kMostCycles;
}

// Impulses belong to a substep of the length in which they were found.
void rescale_impulses(JointScratch& scratch, const JointPiece& piece, Real by) {
  if (by == Real(1)) return;
  for (std::uint32_t i = piece.begin; i < piece.end; ++i)
    for (int k = 0; k < scratch.blocks[i].rows; ++k)
      for (int p = 0; p < kRowParts; ++p) {
        scratch.blocks[i].row[k].impulses.first[p] *= by;
        scratch.blocks[i].row[k].impulses.second[p] *= by;
      }
}

}  // namespace

void fly_joint_group(WorldState& world, JointPiece& piece) {
  JointScratch& scratch = *world.joints.scratch;
  const auto for_blocks = [&](auto&& task) {
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) task(scratch.blocks[i]);
  };
  const auto for_all = [&](auto&& task) { for_bodies(scratch, piece, task); };
  const int cycles = cycles_of(world, piece);
  const Real h = world.h / static_cast<Real>(cycles);
  rescale_impulses(scratch, piece, h / piece.h);
  piece.h = h;
  for_blocks([&](JointBlock& block) { block.h = h; });
  for (int cycle = 0; cycle < cycles; ++cycle) {
    for_all([&](std::uint32_t i) { kick(world, i, Real(0.5) * h); });
    for_blocks([&](JointBlock& block) { warm_start_joint(world, block, JointPass::Solve); });
    solve_joints_of(world, piece, JointPass::Solve);
    for_blocks([&](JointBlock& block) { sum_joint(block, world, JointPass::Solve); });
    for_all([&](std::uint32_t i) {
      drift(world, i, h);
      turn_inertia(world, i);
      kick(world, i, Real(0.5) * h);
    });
    for_blocks([&](JointBlock& block) {
      block.elapsed = static_cast<Real>(cycle + 1) * h;
      prepare_joint(world, block);
    });
    close_joints_of(world, piece);
    for_blocks([&](JointBlock& block) { warm_start_joint(world, block, JointPass::Relax); });
    solve_joints_of(world, piece, JointPass::Relax);
    for_blocks([&](JointBlock& block) {
      sum_joint(block, world, JointPass::Relax);
      note_rates(block, world);
    });
    for_all([&](std::uint32_t i) {
      collect_momentum(world, i);
      world.substep[i].w_in = world.bodies.velocity[i].w;
    });
  }
  for_blocks([](JointBlock& block) { block.elapsed = Real(0); });
}

}  // namespace plumb::inline PLUMB_ABI::detail
