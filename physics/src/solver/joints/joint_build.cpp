// Blocks of the joints that are awake, in colour order: no two of a colour share a dynamic body.
//
// A joint is "split" where none of the bodies that it is connected with, over any number of joints,
// touches anything. Forces then act half before and half after the drift, and so do the joints'
// impulses: a symmetric scheme, second order in the substep, that keeps energy over long times
// [Andersen 1983]. Where there are contacts, forces act before the drift, as contacts need it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "collision/collision_shape.h"
#include "math/eigen_bridge.h"
#include "solver/joints/joint_kinds.h"
#include "solver/joints/joint_poses.h"
#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_solver.h"
#include "solver/joints/joint_stages.h"
#include "solver/joints/joint_tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr int kJointColors = 64;  // bits of a mask; the last one is the overflow

// The slots of all bodies that a joint acts on: two, or the four of the joints that it couples.
struct JointBodies {
  std::uint32_t slot[kMaxJointBodies];
  int count;
};
JointBodies bodies_of(const JointStore& joints, const JointInfo& joint) {
  JointId first, second;
  if (!coupled_joints(joint.component.kind, first, second))
    return {{joint.body_a, joint.body_b}, 2};
  const JointInfo& p = joints.info[first.index];
  const JointInfo& q = joints.info[second.index];
  return {{p.body_a, p.body_b, q.body_a, q.body_b}, 4};
}

bool is_dynamic_awake(const WorldState& world, std::uint32_t slot) {
  return slot != kWorldBody && world.bodies.is_awake(slot) &&
         world.bodies.mass[world.bodies.info[slot].dense].mass > Real(0);
}
std::uint32_t dense_of(const WorldState& world, std::uint32_t slot) {
  if (slot == kWorldBody) return 0;
  const std::uint32_t dense = world.bodies.info[slot].dense;
  return dense < world.bodies.awake_end ? dense : 0;
}

// Which bodies hang together over joints, and whether any of a group touches something.
class Groups {
 public:
  explicit Groups(std::vector<std::uint32_t>& parents) : parents_(parents) {}
  std::uint32_t root(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void link(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t>& parents_;
};

void find_groups(WorldState& world, const std::vector<std::uint32_t>& active) {
  JointStore& joints = world.joints;
  JointScratch& scratch = *joints.scratch;
  std::vector<std::uint32_t>& parents = scratch.group;
  parents.resize(world.bodies.awake_end);
  std::iota(parents.begin(), parents.end(), 0u);
  Groups groups(parents);
  for (const std::uint32_t slot : active) {
    const JointBodies bodies = bodies_of(joints, joints.info[slot]);
    std::uint32_t first = 0;
    for (int k = 0; k < bodies.count; ++k) {
      if (!is_dynamic_awake(world, bodies.slot[k])) continue;
      const std::uint32_t dense = dense_of(world, bodies.slot[k]);
      if (first != 0) groups.link(first, dense);
      first = dense;
    }
  }
  scratch.group_touches.assign(world.bodies.awake_end, 0);
  for (std::uint32_t i = world.bodies.awake_begin; i < world.bodies.awake_end; ++i)
    if (world.substep[i].constrained) scratch.group_touches[groups.root(i)] = 1;
  for (std::uint32_t i = world.bodies.awake_begin; i < world.bodies.awake_end; ++i)
    parents[i] = groups.root(i);
}

// Greedy, in the order of slots, as for contacts.
void color_joints(WorldState& world, const std::vector<std::uint32_t>& active) {
  JointStore& joints = world.joints;
  JointScratch& scratch = *joints.scratch;
  std::vector<std::uint64_t>& mask = scratch.color_mask;
  mask.assign(world.bodies.awake_end, 0);
  std::vector<std::uint32_t> counts(kJointColors + 1, 0);
  std::vector<std::uint8_t> color_of(active.size());
  for (std::size_t i = 0; i < active.size(); ++i) {
    const JointBodies bodies = bodies_of(joints, joints.info[active[i]]);
    std::uint64_t used = 0;
    for (int k = 0; k < bodies.count; ++k)
      if (is_dynamic_awake(world, bodies.slot[k])) used |= mask[dense_of(world, bodies.slot[k])];
    const int color = std::min(std::countr_one(used), kJointColors - 1);
    if (color < kJointColors - 1)
      for (int k = 0; k < bodies.count; ++k)
        if (is_dynamic_awake(world, bodies.slot[k]))
          mask[dense_of(world, bodies.slot[k])] |= std::uint64_t{1} << color;
    color_of[i] = static_cast<std::uint8_t>(color);
    ++counts[static_cast<std::size_t>(color) + 1];
  }
  scratch.colors.clear();
  for (std::size_t c = 0; c < kJointColors; ++c) {
    const std::uint32_t begin = counts[c], size = counts[c + 1];
    counts[c + 1] += begin;
    if (size == 0) continue;
    if (c + 1 < kJointColors) {
      scratch.colors.emplace_back(begin, begin + size);
    } else {  // beyond the last colour: one after the other
      for (std::uint32_t i = 0; i < size; ++i)
        scratch.colors.emplace_back(begin + i, begin + i + 1);
    }
  }
  scratch.order.resize(active.size());
  for (std::size_t i = 0; i < active.size(); ++i) scratch.order[counts[color_of[i]]++] = active[i];
}

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

// Lengths by which corrections are bounded: the longest arm, or the size of the bodies.
void bound_corrections(const WorldState& world, const JointInfo& joint, JointBlock& block) {
  Real size = std::max(length(block.pair[0].arm_a), length(block.pair[0].arm_b));
  for (const std::uint32_t slot : {joint.body_a, joint.body_b})
    if (slot != kWorldBody && world.bodies.info[slot].radius < kUnbounded)
      size = std::max(size, world.bodies.info[slot].radius);
  block.push_linear = size > Real(0) ? joint_tolerance::kPushSizesPerSecond * size : kUnlimited;
  block.push_angular = joint_tolerance::kPushTurn;
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

void build_block(const WorldState& world, JointBlock& block, std::uint32_t slot) {
  const JointStore& joints = world.joints;
  const JointScratch& scratch = *joints.scratch;
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
  bound_corrections(world, joint, block);
  RowBuilder rows(block, joint.component.softness);
  std::visit([&](const auto& kind) { make_rows(kind, rows); }, joint.component.kind);
  for (int k = 0; k < block.bodies; ++k)
    if (block.moves[k])
      block.split = world.joints.scratch->group_touches[scratch.group[block.body[k]]] == 0;
  for (int k = 0; k < block.bodies; ++k)
    if (block.moves[k] && std::popcount(scratch.color_mask[block.body[k]]) > 1)
      block.correction = joint_tolerance::kSharedCorrection;
  recall_impulses(world, joint.memory, block);
  prepare_joint(world, block);
  note_rates(block, world);
}

}  // namespace

void build_joints(WorldState& world) {
  JointStore& joints = world.joints;
  if (joints.scratch == nullptr) joints.scratch = std::make_shared<JointScratch>();
  JointScratch& scratch = *joints.scratch;
  std::vector<std::uint32_t>& active = scratch.active;
  active.clear();
  for (std::uint32_t slot = 0; slot < joints.info.size(); ++slot) {
    if (!joints.info[slot].alive) continue;
    const JointBodies bodies = bodies_of(joints, joints.info[slot]);
    bool moves = false;
    for (int k = 0; k < bodies.count; ++k) moves = moves || is_dynamic_awake(world, bodies.slot[k]);
    if (moves) active.push_back(slot);
  }
  find_groups(world, active);
  color_joints(world, active);
  const std::uint32_t count = static_cast<std::uint32_t>(scratch.order.size());
  for (const std::uint32_t slot : active) {
    const JointBodies bodies = bodies_of(joints, joints.info[slot]);
    for (int k = 0; k < bodies.count; ++k) {
      if (!is_dynamic_awake(world, bodies.slot[k])) continue;
      const std::uint32_t dense = dense_of(world, bodies.slot[k]);
      world.substep[dense].constrained = true;
      world.substep[dense].jointed = true;
      world.substep[dense].split = scratch.group_touches[scratch.group[dense]] == 0;
    }
  }
  scratch.blocks.resize(count);
  parallel_for(world, count, joint_tolerance::kJointGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i)
                   build_block(world, scratch.blocks[i], scratch.order[i]);
               });
}

}  // namespace plumb::inline PLUMB_ABI::detail
