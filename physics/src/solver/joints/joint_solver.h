// What a pass does with one joint: prepare at a pose, warm start, solve, relax.
//
// The equations of the held rows, with the coordinate C predicted at the end of the substep from
// the velocities that are being solved for (turned arms and gyroscopic terms included):
//   solve   (C_end - C)/h + clamp(b C/h) + e K l = 0   l: the whole impulse; e: the small leak;
//           b = 1, or 0.2 where joints share a body (kSharedCorrection)
//   relax   J V = 0 where the drift has ended
// so that the position error is removed to second order in every substep: this is RATTLE
// [Andersen 1983] with one Newton step a pass, and what is left over is removed in the next one.
//
// Free rows are solved one after the other in the space in which the held ones hold (S, see
// joint_block.h), a few sweeps, each part clamped:
//   spring      l = -T (k ((C + C_end)/2 - rest) + c u): the implicit midpoint rule, which keeps a
//               spring's energy at any step and is second order (k at C_end where impulses are not
//               split: implicit Euler)
//   motor       u = speed, |l| <= T max; servo: a spring whose k = w^2 / S, c = 2 z w / S, clamped
//   friction    u = 0, |l| <= T friction [Coulomb, constant]
//   limit       C_end >= lower, l >= 0; likewise upper; soft ones are one-sided springs
// T is the time for which the pass acts: h/2 where the impulses are split, else h.
#pragma once

#include "solver/joints/joint_block.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

enum class JointPass : std::uint8_t { Solve, Relax };

void prepare_joint(const WorldState& world, JointBlock& block);
void warm_start_joint(WorldState& world, JointBlock& block, JointPass pass);
void solve_joint(WorldState& world, JointBlock& block, JointPass pass);
// Adds the impulses just found to what is reported for the step.
void sum_joint(JointBlock& block, const WorldState& world, JointPass pass);

// The free rows' rates as they stand.
void note_rates(JointBlock& block, const WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
