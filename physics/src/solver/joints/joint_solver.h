// What a pass does with the joints: prepare at a pose, warm start, solve, relax.
//
// All joints of a connected group are solved together (joint_system.h), held rows and whatever acts
// along the free ones:
//   held    solve  (C_end - C)/h + e K l = 0    C_end: the coordinate at the end of the substep,
//   from
//                  the velocities that are being solved for (turned arms and gyroscopic terms
//                  included); l: the whole impulse; e: a small compliance
//           close  what is left of C where the drift has ended, in positions (joint_close.cpp)
//           relax  J V = 0 there
//   free    the laws of joint_laws.h
// This is RATTLE [Andersen 1983], of second order, and nothing that corrects positions gains
// energy. Newton's method: the first step of a pass takes C_end to first order, the second where
// the drift would end. A step that leaves more of the error than it found is taken back: bodies
// that turn by more than a radian in a substep are out of its reach. Which laws act (a limit that
// is touched, a motor below its largest effort) is guessed from the last substep's impulses; a law
// that hits its bound leaves the system, one that wants back enters it, and the system is solved
// again: a primal-dual active set, a semismooth Newton method [Hintermueller, Ito, Kunisch 2002].
//
// Groups too wide to factor are solved joint by joint, kChainPasses times (b = kSharedCorrection).
#pragma once

#include "solver/joints/joint_system.h"

namespace plumb::inline PLUMB_ABI::detail {

struct WorldState;

enum class JointPass : std::uint8_t { Solve, Relax };

// How far off held coordinates may be, in body sizes or radians [-].
Real closed_enough(const WorldState& world);

void prepare_joint(const WorldState& world, JointBlock& block);
// How fast the forces drive limits that could bounce.
void note_approaches(JointBlock& block, const WorldState& world);
void warm_start_joint(WorldState& world, JointBlock& block, JointPass pass);
void solve_joints_of(WorldState& world, const JointPiece& piece, JointPass pass);
// Where the drift has ended: takes away the errors of held rows, in positions alone.
void close_joints_of(WorldState& world, const JointPiece& piece);
// Adds the impulses just found to what is reported for the step.
void sum_joint(JointBlock& block, const WorldState& world, JointPass pass);

// The free rows' rates as they stand.
void note_rates(JointBlock& block, const WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
