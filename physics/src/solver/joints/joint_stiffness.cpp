// Taut lines of joined bodies that touch something.
//
// A body pulled by a force f at the end of an arm r turns back like a pendulum: the geometric
// stiffness f |r| across the arm [Tournier et al. 2015]. Groups that touch nothing follow this
// vibration with substeps of their own (joint_flight.cpp). Contacts cannot; there the stiffness is
// taken in implicitly: for one step rows see the inertia
//     I + h^2 sum over joints of f |r| (1 - r r^T / r^2)
// which no tension can make unstable. It is added only where an explicit step would be at its
// limit, so that all else moves as before.
#include "math/symmetric_inverse.h"
#include "solver/joints/joint_levers.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_stages.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Calls task(body, arm, pull [N], stiffness [rad^2/s^2]) for both ends of every joint of a piece.
template <class Task>
void for_ends(const WorldState& world, const JointPiece& piece, Task&& task) {
  const std::vector<JointBlock>& blocks = world.joints.scratch->blocks;
  for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
    const JointBlock& block = blocks[i];
    if (block.pairs != 1) continue;
    const Real f = pull_of(block, world.h);
    if (!(f > Real(0))) continue;
    const int a = block.place[0], b = block.place[1];
    const Vec arm_a = block.pair[0].arm_a, arm_b = block.pair[0].arm_b;
    const Lever at_a = lever_of(block, a, arm_a), at_b = lever_of(block, b, arm_b);
    if (block.moves[a]) task(block.body[a], arm_a, f, stiffness(f, at_a, at_b));
    if (block.moves[b]) task(block.body[b], arm_b, f, stiffness(f, at_b, at_a));
  }
}

bool stiffen(WorldState& world, const JointPiece& piece) {
  for_bodies(*world.joints.scratch, piece,
             [&](std::uint32_t i) { world.substep[i].stiffness = Real(0); });
  Real vibration = 0;
  for_ends(world, piece, [&](std::uint32_t i, Vec, Real, Real own) {
    vibration = std::max(vibration, world.substep[i].stiffness += own);
  });
  const Real limit = joint_tolerance::kVibrationPerCycle / world.h;
  if (!(vibration > limit * limit)) return false;
  JointScratch& scratch = *world.joints.scratch;
  scratch.stiffness.assign(world.bodies.awake_end, Symmetric3<Real>{});
  for_ends(world, piece, [&](std::uint32_t i, Vec arm, Real f, Real) {
    const Real r = length(arm);
    if (!(r > Real(0))) return;
    const Vec n = (Real(1) / r) * arm;
    const Real k = world.h * world.h * f * r;
    Symmetric3<Real>& K = scratch.stiffness[i];
    K.xx += k * (Real(1) - n.x * n.x);
    K.yy += k * (Real(1) - n.y * n.y);
    K.zz += k * (Real(1) - n.z * n.z);
    K.xy -= k * n.x * n.y;
    K.xz -= k * n.x * n.z;
    K.yz -= k * n.y * n.z;
  });
  for_bodies(scratch, piece, [&](std::uint32_t i) {
    SubstepBody& s = world.substep[i];
    if (world.bodies.mass[i].angular_locks != 0) return;  // the locks leave it one axis at most
    const Symmetric3<Real>& K = scratch.stiffness[i];
    const Symmetric3<Real> I{s.I.xx + K.xx, s.I.yy + K.yy, s.I.zz + K.zz,
                             s.I.xy + K.xy, s.I.xz + K.xz, s.I.yz + K.yz};
    Symmetric3<Real> inverse{};
    if (invert(I, joint_tolerance::kRegular, inverse)) s.I_inverse = inverse;
  });
  return true;
}

}  // namespace

void stiffen_taut_joints(WorldState& world) {
  JointScratch& scratch = *world.joints.scratch;
  for (const JointPiece& piece : scratch.system.pieces) {
    if (piece.split || !stiffen(world, piece)) continue;
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) prepare_joint(world, scratch.blocks[i]);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
