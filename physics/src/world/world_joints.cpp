// Joints: building, changing, reading, and what ends them.
#include <algorithm>
#include <cmath>

#include "math/eigen_bridge.h"
#include "solver/joints/coordinates.h"
#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_scratch.h"
#include "world/inputs.h"
#include "world/joint_inputs.h"
#include "world/joint_world.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {
namespace {

Status stale_joint() {
  return {StatusCode::StaleHandle,
          "no such joint: the handle is null, or the joint was destroyed or broke"};
}

std::uint32_t slot_of(BodyId body) { return body.is_null() ? kWorldBody : body.index; }
BodyId id_of(const WorldState& world, std::uint32_t slot) {
  if (slot == kWorldBody) return {};
  return {slot, world.bodies.info[slot].generation};
}

// The frame pair of a joint as its bodies stand now.
PlacedPair placed_now(const WorldState& world, const JointInfo& joint, PosVec* origin_b = nullptr) {
  PlacedPair at{};
  PosVec origin[2];
  const std::uint32_t slots[2] = {joint.body_a, joint.body_b};
  const LocalPose* frames[2] = {&joint.component.frame_a, &joint.component.frame_b};
  for (int k = 0; k < 2; ++k) {
    const Vec p = to_inner(frames[k]->position);
    const Rotation q = to_inner(frames[k]->orientation);
    Vec& arm = k == 0 ? at.arm_a : at.arm_b;
    Rotation& axes = k == 0 ? at.frame_a : at.frame_b;
    arm = {0, 0, 0};
    axes = q;
    origin[k] = cast<PosReal>(p);
    if (slots[k] == kWorldBody) continue;
    const BodyInfo& info = world.bodies.info[slots[k]];
    const BodyPose& pose = world.bodies.pose[info.dense];
    const Rotation R_WB = pose.q * conjugate(info.R_BP);
    arm = rotate(R_WB, p - info.center_B);
    axes = R_WB * q;
    origin[k] = pose.x + cast<PosReal>(arm);
  }
  at.d = cast<Real>(origin[1] - origin[0]);
  if (origin_b != nullptr) *origin_b = origin[1];
  return at;
}

Real measured_now(const WorldState& world, const JointInfo& joint) {
  return coordinate_of(measured_by(joint.component.kind), placed_now(world, joint),
                       joint.memory.angle);
}

Real rate_now(const WorldState& world, const JointInfo& joint) {
  const PlacedPair at = placed_now(world, joint);
  BodyJacobian J[2];
  gradient_of(measured_by(joint.component.kind), at, J[0], J[1]);
  const std::uint32_t slots[2] = {joint.body_a, joint.body_b};
  Real sum = 0;
  for (int k = 0; k < 2; ++k) {
    if (slots[k] == kWorldBody) continue;
    const BodyVelocity& velocity = world.bodies.velocity[world.bodies.info[slots[k]].dense];
    sum += dot(J[k].linear, velocity.v) + dot(J[k].angular, velocity.w);
  }
  return sum;
}

Real length_to(const WorldState& world, std::uint32_t slot, const LocalPose& frame,
               const Pos3& over) {
  PosVec origin = cast<PosReal>(to_inner(frame.position));
  if (slot != kWorldBody) {
    const BodyInfo& info = world.bodies.info[slot];
    const BodyPose& pose = world.bodies.pose[info.dense];
    origin = pose.x + cast<PosReal>(rotate(pose.q * conjugate(info.R_BP),
                                           to_inner(frame.position) - info.center_B));
  }
  return length(cast<Real>(origin - to_inner_position(over)));
}

// What the joint holds constant beyond its own numbers.
Real constant_of(const WorldState& world, const JointInfo& joint) {
  JointId first, second;
  if (coupled_joints(joint.component.kind, first, second))
    return measured_now(world, world.joints.info[first.index]) +
           coupling_ratio(joint.component.kind) *
               measured_now(world, world.joints.info[second.index]);
  if (const auto* pulley = std::get_if<PulleyJoint>(&joint.component.kind)) {
    if (pulley->length > Real(0)) return pulley->length;
    return length_to(world, joint.body_a, joint.component.frame_a, pulley->over_a) +
           pulley->ratio * length_to(world, joint.body_b, joint.component.frame_b, pulley->over_b);
  }
  return Real(0);
}

void wake_bodies_of(WorldState& world, const JointInfo& joint) {
  JointId first, second;
  if (coupled_joints(joint.component.kind, first, second)) {
    wake_bodies_of(world, world.joints.info[first.index]);
    wake_bodies_of(world, world.joints.info[second.index]);
    return;
  }
  for (const std::uint32_t body : {joint.body_a, joint.body_b})
    if (body != kWorldBody && world.bodies.info[body].type == MotionType::Dynamic)
      wake_body(world, body);
}

// Bodies that may collide from now on must seek each other; those that may not forget each other.
void change_collision(WorldState& world, const JointInfo& joint, bool may_collide) {
  if (joint.component.collide_connected || joint.body_a == kWorldBody || joint.body_b == kWorldBody)
    return;
  if (!may_collide) {
    world.pairs.remove_if([&](const Pair& pair) {
      if (!((pair.body_a == joint.body_a && pair.body_b == joint.body_b) ||
            (pair.body_a == joint.body_b && pair.body_b == joint.body_a)) ||
          pair.sensor)
        return false;
      note_pair_end(world, pair);
      return true;
    });
    return;
  }
  for (const std::uint32_t body : {joint.body_a, joint.body_b}) {
    for (const std::uint32_t slot : world.bodies.info[body].colliders) {
      ColliderInfo& collider = world.colliders.info[slot];
      if (collider.query_pairs) continue;
      collider.query_pairs = true;
      world.query_list.push_back(slot);
    }
  }
}

// The axis of a joint by number, or null: 0 of hinge and slider; 0 to 5 of six-dof.
JointAxis* axis_of(JointKind& kind, int axis) {
  if (auto* hinge = std::get_if<HingeJoint>(&kind)) return axis == 0 ? &hinge->axis : nullptr;
  if (auto* slider = std::get_if<SliderJoint>(&kind)) return axis == 0 ? &slider->axis : nullptr;
  if (auto* six = std::get_if<SixDofJoint>(&kind)) {
    if (axis < 0 || axis > 5) return nullptr;
    auto& coordinate = six->coordinates[static_cast<std::size_t>(axis)];
    return coordinate.freedom == SixDofJoint::Freedom::Locked ? nullptr : &coordinate.axis;
  }
  return nullptr;
}
Status no_axis() {
  return {StatusCode::OutOfRange,
          "the joint has no such free axis: 0 of a hinge or slider, 0 to 5 of a six-dof joint"};
}

// A part that is gone or another leaves no impulse behind.
void forget_impulses(JointMemory& memory) {
  for (RowImpulses& row : memory.rows) {
    for (const RowPart part : {kSpring, kMotor, kFriction, kLower, kUpper})
      row.first[part] = row.second[part] = Real(0);
  }
}

}  // namespace

bool joined_without_contact(const WorldState& world, std::uint32_t body_a, std::uint32_t body_b) {
  for (const std::uint32_t slot : world.joints.at_body(body_a)) {
    const JointInfo& joint = world.joints.info[slot];
    if ((joint.body_a == body_b || joint.body_b == body_b) && !joint.component.collide_connected)
      return true;
  }
  return false;
}

void wake_joined(WorldState& world, std::uint32_t body) {
  const std::vector<std::uint32_t> slots = world.joints.at_body(body);
  for (const std::uint32_t slot : slots) {
    const JointInfo& joint = world.joints.info[slot];
    const std::uint32_t other = joint.body_a == body ? joint.body_b : joint.body_a;
    if (other != kWorldBody && world.bodies.info[other].island != kNone) wake_body(world, other);
  }
}

void remove_joint(WorldState& world, std::uint32_t slot) {
  // Couplings of this joint go first.
  const JointId id = world.joints.id(slot);
  for (std::uint32_t other = 0; other < world.joints.info.size(); ++other) {
    JointId first, second;
    if (world.joints.info[other].alive && other != slot &&
        coupled_joints(world.joints.info[other].component.kind, first, second) &&
        (first == id || second == id))
      remove_joint(world, other);
  }
  wake_bodies_of(world, world.joints.info[slot]);
  const JointInfo gone = world.joints.info[slot];
  world.joints.destroy(slot);
  if (gone.body_a != kWorldBody && gone.body_b != kWorldBody &&
      !joined_without_contact(world, gone.body_a, gone.body_b))
    change_collision(world, gone, true);
}

void remove_joints_of(WorldState& world, std::uint32_t body) {
  while (!world.joints.at_body(body).empty()) remove_joint(world, world.joints.at_body(body)[0]);
}

void link_joined(WorldState& world) {
  const auto linkable = [&](std::uint32_t body) {
    return body != kWorldBody && world.bodies.info[body].type == MotionType::Dynamic &&
           world.bodies.is_awake(body);
  };
  for (const JointInfo& joint : world.joints.info) {
    if (!joint.alive) continue;
    JointId first, second;
    std::uint32_t slots[4] = {joint.body_a, joint.body_b, kWorldBody, kWorldBody};
    if (coupled_joints(joint.component.kind, first, second)) {
      slots[0] = world.joints.info[first.index].body_a;
      slots[1] = world.joints.info[first.index].body_b;
      slots[2] = world.joints.info[second.index].body_a;
      slots[3] = world.joints.info[second.index].body_b;
    }
    std::uint32_t last = kWorldBody;
    for (const std::uint32_t slot : slots) {
      if (!linkable(slot)) continue;
      if (last != kWorldBody) link_bodies(world, last, slot);
      last = slot;
    }
  }
}

void rest_idle_joints(WorldState& world) {
  const auto holds_a_dynamic = [&](const JointInfo& joint) {
    return (joint.body_a != kWorldBody &&
            world.bodies.info[joint.body_a].type == MotionType::Dynamic) ||
           (joint.body_b != kWorldBody &&
            world.bodies.info[joint.body_b].type == MotionType::Dynamic);
  };
  for (JointInfo& joint : world.joints.info) {
    if (!joint.alive) continue;
    JointId first, second;
    const bool coupling = coupled_joints(joint.component.kind, first, second);
    if (coupling ? holds_a_dynamic(world.joints.info[first.index]) ||
                       holds_a_dynamic(world.joints.info[second.index])
                 : holds_a_dynamic(joint))
      continue;
    JointMemory idle;
    idle.angle = joint.memory.angle;
    idle.zero = joint.memory.zero;
    joint.memory = idle;
  }
}

void break_joints(WorldState& world) {
  for (const std::uint32_t slot : world.joints.scratch->active) {
    const JointInfo& joint = world.joints.info[slot];
    if (!joint.alive) continue;  // a coupling that went with its joint
    const Real force = length(joint.memory.force), torque = length(joint.memory.torque);
    if (!(force > joint.component.break_force) && !(torque > joint.component.break_torque))
      continue;
    world.gathering.broken_joints.push_back({world.joints.id(slot), id_of(world, joint.body_a),
                                             id_of(world, joint.body_b), force, torque,
                                             joint.component.user_data});
    remove_joint(world, slot);
  }
}

}  // namespace detail

Created<JointId> PhysicsWorld::create_joint(const Joint& joint) {
  detail::WorldState& world = *state_;
  if (world.stepping) return {{}, detail::inside_step()};
  if (const Status status = detail::check_joint(world, joint); !status) return {{}, status};
  if (const Status status = detail::check_joint_moves(world, joint); !status) return {{}, status};
  detail::note_input(world, InputKind::CreateJoint, 0,
                     [&](auto& out) { detail::append(out, joint); });
  const std::uint32_t slot = world.joints.create();
  detail::JointInfo& info = world.joints.info[slot];
  info.component = joint;
  info.component.frame_a.orientation.normalize();
  info.component.frame_b.orientation.normalize();
  JointId first, second;
  if (!detail::coupled_joints(joint.kind, first, second)) {
    info.body_a = detail::slot_of(joint.body_a);
    info.body_b = detail::slot_of(joint.body_b);
  }
  info.memory.angle = detail::measured_by(joint.kind) == detail::Coordinate::Twist
                          ? detail::measured_now(world, info)
                          : Real(0);
  info.memory.zero = detail::constant_of(world, info);
  world.joints.link(slot);
  detail::wake_bodies_of(world, info);
  detail::change_collision(world, info, false);
  return {world.joints.id(slot), {}};
}

Status PhysicsWorld::destroy_joint(JointId joint) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(joint)) return detail::stale_joint();
  detail::note_input(world, InputKind::DestroyJoint, joint.value(), [](auto&) {});
  detail::remove_joint(world, joint.index);
  return {};
}

Status PhysicsWorld::set_joint_motor(JointId joint, const std::optional<JointMotor>& motor,
                                     int axis) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(joint)) return detail::stale_joint();
  detail::JointInfo& info = world.joints.info[joint.index];
  JointAxis* changed = detail::axis_of(info.component.kind, axis);
  if (changed == nullptr) return detail::no_axis();
  if (motor.has_value())
    if (const Status status = detail::check_motor(*motor); !status) return status;
  detail::note_input(world, InputKind::SetJointMotor, joint.value(), [&](auto& out) {
    out.push_back(static_cast<double>(axis));
    detail::append(out, motor);
  });
  const bool same_parts = changed->motor.has_value() == motor.has_value() &&
                          (!motor.has_value() || motor->mode == changed->motor->mode);
  changed->motor = motor;
  if (!same_parts) detail::forget_impulses(info.memory);
  detail::wake_bodies_of(world, info);
  return {};
}

Status PhysicsWorld::set_joint_limit(JointId joint, const std::optional<JointLimit>& limit,
                                     int axis) {
  detail::WorldState& world = *state_;
  if (world.stepping) return detail::inside_step();
  if (!is_valid(joint)) return detail::stale_joint();
  detail::JointInfo& info = world.joints.info[joint.index];
  JointAxis* changed = detail::axis_of(info.component.kind, axis);
  if (changed == nullptr) return detail::no_axis();
  if (limit.has_value())
    if (const Status status = detail::check_limit(*limit); !status) return status;
  detail::note_input(world, InputKind::SetJointLimit, joint.value(), [&](auto& out) {
    out.push_back(static_cast<double>(axis));
    detail::append(out, limit);
  });
  if (changed->limit.has_value() != limit.has_value()) detail::forget_impulses(info.memory);
  changed->limit = limit;
  if (auto* six = std::get_if<SixDofJoint>(&info.component.kind))
    six->coordinates[static_cast<std::size_t>(axis)].freedom =
        limit.has_value() ? SixDofJoint::Freedom::Limited : SixDofJoint::Freedom::Free;
  detail::wake_bodies_of(world, info);
  return {};
}

bool PhysicsWorld::is_valid(JointId joint) const { return state_->joints.is_valid(joint); }

Joint PhysicsWorld::joint(JointId joint) const {
  return is_valid(joint) ? state_->joints.info[joint.index].component : Joint{};
}

std::vector<JointId> PhysicsWorld::joints_of(BodyId body) const {
  std::vector<JointId> out;
  if (!is_valid(body)) return out;
  for (const std::uint32_t slot : state_->joints.at_body(body.index))
    out.push_back(state_->joints.id(slot));
  return out;
}

std::size_t PhysicsWorld::joint_count() const { return state_->joints.alive_count; }

JointReaction PhysicsWorld::joint_reaction(JointId joint) const {
  if (!is_valid(joint)) return {};
  const detail::JointMemory& memory = state_->joints.info[joint.index].memory;
  return {detail::to_public(memory.force), detail::to_public(memory.torque), memory.effort};
}

JointState PhysicsWorld::joint_state(JointId joint) const {
  JointState out;
  if (!is_valid(joint)) return out;
  const detail::WorldState& world = *state_;
  const detail::JointInfo& info = world.joints.info[joint.index];
  out.at_lower = info.memory.at_lower;
  out.at_upper = info.memory.at_upper;
  detail::JointBlock block;
  JointId first, second;
  if (detail::coupled_joints(info.component.kind, first, second) ||
      std::holds_alternative<PulleyJoint>(info.component.kind)) {
    out.linear_error = detail::constant_of(world, info) - info.memory.zero;
    return out;
  }
  const detail::PlacedPair at = detail::placed_now(world, info);
  const detail::Coordinate own = detail::measured_by(info.component.kind);
  const Real value = detail::coordinate_of(own, at, info.memory.angle);
  if (own == detail::Coordinate::Twist) {
    out.angle = value;
    out.translation = detail::coordinate_of(detail::Coordinate::LinearX, at, Real(0));
  } else {
    out.translation = value;
  }
  out.speed = detail::rate_now(world, info);
  detail::RowBuilder rows(block, {});
  std::visit([&](const auto& kind) { detail::make_rows(kind, rows); }, info.component.kind);
  Real linear = 0, angular = 0;
  for (int i = 0; i < block.held; ++i) {
    const Real off =
        detail::coordinate_of(block.row[i].coordinate, at, Real(0)) - block.row[i].target;
    (detail::is_linear(block.row[i].coordinate) ? linear : angular) += off * off;
  }
  out.linear_error = std::sqrt(linear);
  out.angular_error = std::sqrt(angular);
  return out;
}

}  // namespace plumb::inline PLUMB_ABI
