// Blocks of the joints that are awake.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "collision/collision_shape.h"
#include "math/eigen_bridge.h"
#include "solver/joints/joint_groups.h"
#include "solver/joints/joint_kinds.h"
#include "solver/joints/joint_poses.h"
#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_stages.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

int place_of(JointBlock& block, const WorldState& world, std::uint32_t slot) {
  const std::uint32_t dense = dense_of(world, slot);
  for (int k = 0; k < block.bodies; ++k)
    if (block.body[k] == dense) return k;
  const int k = block.bodies++;
  block.body[k] = dense;
  block.moves[k] = is_dynamic_awake(world, slot);
  block.inverse_mass[k] = block.moves[k] ? world.bodies.mass[dense].inverse_mass : Vec{0, 0, 0};
  return k;
}

// A frame of a body in world axes at the step's start: from its centre of mass.
void place_frame(const WorldState& world, std::uint32_t slot, const LocalPose& frame, Vec& arm,
                 Rotation& axes, PosVec& center) {
  const Vec p = to_inner(frame.position);
  const Rotation q = to_inner(frame.orientation);
  if (slot == kWorldBody) {
    center = cast<PosReal>(p);  // no body: the origin of the frame itself
    arm = {0, 0, 0};
    axes = q;
    return;
  }
  const BodyInfo& info = world.bodies.info[slot];
  const BodyPose& pose = world.bodies.pose[info.dense];
  const Rotation R_WB = pose.q * conjugate(info.R_BP);
  center = pose.x;
  arm = rotate(R_WB, p - info.center_B);
  axes = R_WB * q;
}

void place_joint(const WorldState& world, JointBlock& block, int p, const JointInfo& joint,
                 PosVec& center_a, PosVec& center_b) {
  FramePair& pair = block.pair[p];
  place_frame(world, joint.body_a, joint.component.frame_a, pair.arm_a, pair.frame_a, center_a);
  place_frame(world, joint.body_b, joint.component.frame_b, pair.arm_b, pair.frame_b, center_b);
  pair.between = cast<Real>(center_b - center_a);
  block.place[2 * p] = place_of(block, world, joint.body_a);
  block.place[2 * p + 1] = place_of(block, world, joint.body_b);
  pair.angle = joint.memory.angle;
  pair.measured = measured_by(joint.component.kind);
}

// The longest arm, or the size of the bodies.
void measure(const WorldState& world, const JointInfo& joint, JointBlock& block) {
  Real size = std::max(length(block.pair[0].arm_a), length(block.pair[0].arm_b));
  for (const std::uint32_t slot : {joint.body_a, joint.body_b})
    if (slot != kWorldBody && world.bodies.extent[slot].radius < kUnbounded)
      size = std::max(size, world.bodies.extent[slot].radius);
  block.size = size > Real(0) ? size : Real(1);
}

// Remembered impulses belong to a substep of the last length, and to one of the two schemes.
void recall_impulses(const WorldState& world, const JointMemory& memory, JointBlock& block) {
  const Real warm =
      world.settings.warm_starting && world.last_h > Real(0) ? world.h / world.last_h : Real(0);
  for (int i = 0; i < block.rows; ++i) {
    RowImpulses& row = block.row[i].impulses;
    row = memory.rows[i];
    for (int p = 0; p < kRowParts; ++p) {
      if (memory.split && !block.split) {
        row.first[p] += row.second[p];
        row.second[p] = Real(0);
      } else if (!memory.split && block.split) {
        row.first[p] *= Real(0.5);
        row.second[p] = row.first[p];
      }
      row.first[p] *= warm;
      row.second[p] *= warm;
    }
  }
}

void build_block(const WorldState& world, JointBlock& block, std::uint32_t slot,
                 const JointPiece& piece) {
  const JointStore& joints = world.joints;
  const JointInfo& joint = joints.info[slot];
  block = JointBlock{};
  block.joint = slot;
  PosVec center_a, center_b;
  JointId first, second;
  if (coupled_joints(joint.component.kind, first, second)) {
    block.pairs = 2;
    place_joint(world, block, 0, joints.info[first.index], center_a, center_b);
    place_joint(world, block, 1, joints.info[second.index], center_a, center_b);
    block.ratio = coupling_ratio(joint.component.kind);
  } else {
    place_joint(world, block, 0, joint, center_a, center_b);
    if (const auto* pulley = std::get_if<PulleyJoint>(&joint.component.kind)) {
      block.ratio = pulley->ratio;
      block.over_a = cast<Real>(to_inner_position(pulley->over_a) - center_a);
      block.over_b = cast<Real>(to_inner_position(pulley->over_b) - center_b);
    }
  }
  block.zero = joint.memory.zero;
  for (int p = 0; p < block.pairs; ++p)
    block.pair[p].counts_turns = block.pair[p].measured == Coordinate::Twist;
  measure(world, joint, block);
  RowBuilder rows(block, joint.component.softness);
  std::visit([&](const auto& kind) { make_rows(kind, rows); }, joint.component.kind);
  block.split = piece.split;
  block.h = piece.h;
  if (!piece.whole) block.correction = joint_tolerance::kSharedCorrection;
  block.needs_inverse_mass = block.friction_group >= 0 || block.motor_groups > 0;
  for (int f = 0; f < block.rows - block.held; ++f)
    block.needs_inverse_mass = block.needs_inverse_mass || block.free[f].spring ||
                               block.free[f].servo_frequency > Real(0) ||
                               block.free[f].limit_frequency > Real(0);
  recall_impulses(world, joint.memory, block);
  prepare_joint(world, block);
  note_rates(block, world);
}

// Whether a motor carries its joint on: what it moves does not rest, however slow it is. One that
// is stalled, or a servo that has arrived, does not.
bool is_driving(const JointBlock& block) {
  for (int i = block.held; i < block.rows; ++i) {
    const FreeRow& free = block.free[i - block.held];
    const JointRow& row = block.row[i];
    const Real size = is_linear(row.coordinate) ? block.size : Real(1);
    if (free.motor && free.speed != Real(0)) {
      const Real along = free.speed < Real(0) ? -row.rate : row.rate;
      if (along >= std::min(joint_tolerance::kDrivenShare * std::abs(free.speed),
                            joint_tolerance::kDrivenSizesPerSecond * size))
        return true;
    }
    if (free.servo) {
      const Real left = free.servo_target - row.value;
      const Real along = left < Real(0) ? -row.rate : row.rate;
      if (std::abs(left) > joint_tolerance::kArrived * size &&
          along >= joint_tolerance::kDrivenShare * std::abs(left))
        return true;
    }
  }
  return false;
}

void keep_driven_awake(WorldState& world, const std::vector<JointBlock>& blocks) {
  for (const JointBlock& block : blocks) {
    if (!is_driving(block)) continue;
    for (int k = 0; k < block.bodies; ++k)
      if (block.moves[k]) world.substep[block.body[k]].driven = true;
  }
}

}  // namespace

void build_joints(WorldState& world) {
  JointStore& joints = world.joints;
  if (joints.scratch == nullptr) joints.scratch = std::make_shared<JointScratch>();
  JointScratch& scratch = *joints.scratch;
  group_joints(world);
  JointSystem& system = scratch.system;
  scratch.first_joint.assign(world.bodies.awake_end, kNone);
  for (const JointPiece& piece : system.pieces) {
    for (std::uint32_t p = piece.begin; p < piece.end; ++p) {
      const JointMembers& members = scratch.members[scratch.order[p]];
      for (int k = 0; k < members.count; ++k) {
        SubstepBody& s = world.substep[members.body[k]];
        s.constrained = true;
        s.jointed = true;
        s.split = piece.split;
        scratch.first_joint[members.body[k]] = std::min(scratch.first_joint[members.body[k]], p);
      }
    }
  }
  scratch.blocks.resize(scratch.order.size());
  system.diagonal.resize(scratch.order.size());
  system.rows.resize(std::size_t{kMaxJointRows} * scratch.order.size());
  system.entry.resize(system.entry_row.size());
  system.work.resize(system.entry_row.size());
  parallel_for(world, static_cast<std::uint32_t>(system.pieces.size()),
               joint_tolerance::kPieceGrain, [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i)
                   for (std::uint32_t p = system.pieces[i].begin; p < system.pieces[i].end; ++p)
                     build_block(world, scratch.blocks[p], scratch.active[scratch.order[p]],
                                 system.pieces[i]);
               });
  keep_driven_awake(world, scratch.blocks);
  stiffen_taut_joints(world);
}

}  // namespace plumb::inline PLUMB_ABI::detail
