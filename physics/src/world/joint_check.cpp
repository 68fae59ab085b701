// Checks of the joints that users hand in.
#include <cmath>

#include "world/joint_world.h"
#include "world/validate.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Real kPi = Real(3.14159265358979323846);

Status bad(const char* message) { return {StatusCode::OutOfRange, message}; }
bool at_least_zero(Real a) { return a >= Real(0); }  // false for NaN
bool finite_at_least_zero(Real a) { return at_least_zero(a) && std::isfinite(a); }

Status check_spring(const JointSpring& spring) {
  if (!std::isfinite(spring.rest))
    return {StatusCode::NotFinite, "the spring's rest is not finite"};
  if (!finite_at_least_zero(spring.stiffness) || !finite_at_least_zero(spring.damping))
    return bad("a spring's stiffness and damping must be finite and not negative");
  return {};
}

Status check_axis(const JointAxis& axis) {
  if (axis.limit.has_value())
    if (const Status status = check_limit(*axis.limit); !status) return status;
  if (axis.motor.has_value())
    if (const Status status = check_motor(*axis.motor); !status) return status;
  if (axis.spring.has_value())
    if (const Status status = check_spring(*axis.spring); !status) return status;
  if (!finite_at_least_zero(axis.friction))
    return bad("joint friction must be finite and not negative [N] or [N m]");
  return {};
}

Status check_frame(const LocalPose& frame) {
  if (!all_finite(frame.position))
    return {StatusCode::NotFinite, "the position of a joint frame is not finite [m]"};
  return check_orientation(frame.orientation);
}

struct KindCheck {
  Status operator()(const BallJoint& joint) const {
    if (!finite_at_least_zero(joint.friction))
      return bad("joint friction must be finite and not negative [N m]");
    return {};
  }
  Status operator()(const HingeJoint& joint) const { return check_axis(joint.axis); }
  Status operator()(const SliderJoint& joint) const { return check_axis(joint.axis); }
  Status operator()(const FixedJoint&) const { return {}; }
  Status operator()(const DistanceJoint& joint) const {
    if (!(joint.length > Real(0)) || !std::isfinite(joint.length))
      return bad(
          "a rod's length must be finite and above 0 [m]; a ball joint holds points together");
    return {};
  }
  Status operator()(const RopeJoint& joint) const {
    if (!(joint.max_length > Real(0)) || !std::isfinite(joint.max_length))
      return bad("a rope's length must be finite and above 0 [m]");
    return {};
  }
  Status operator()(const SpringJoint& joint) const {
    if (!finite_at_least_zero(joint.rest_length))
      return bad("a spring's rest length must be finite and not negative [m]");
    return check_spring({joint.rest_length, joint.stiffness, joint.damping});
  }
  Status operator()(const ConeTwistJoint& joint) const {
    if (!(joint.cone >= Real(0) && joint.cone <= kPi))
      return bad("the cone's half angle must lie in 0..pi [rad]");
    if (!(joint.twist_lower >= -kPi && joint.twist_upper <= kPi))
      return bad("the twist must lie in -pi..pi [rad]");
    if (!finite_at_least_zero(joint.friction))
      return bad("joint friction must be finite and not negative [N m]");
    return check_limit({joint.twist_lower, joint.twist_upper, joint.softness});
  }
  Status operator()(const SixDofJoint& joint) const {
    for (const SixDofJoint::Coordinate& c : joint.coordinates) {
      if (c.freedom > SixDofJoint::Freedom::Free)
        return bad("a coordinate is Locked, Limited or Free");
      if (c.freedom == SixDofJoint::Freedom::Limited && !c.axis.limit.has_value())
        return bad("a coordinate is Limited but has no limit");
      if (const Status status = check_axis(c.axis); !status) return status;
    }
    return {};
  }
  Status operator()(const GearJoint& joint) const {
    if (!std::isfinite(joint.ratio) || joint.ratio == Real(0))
      return bad("a gear's ratio must be finite and not 0");
    return {};
  }
  Status operator()(const RackPinionJoint& joint) const {
    if (!std::isfinite(joint.radius) || joint.radius == Real(0))
      return bad("a pinion's radius must be finite and not 0 [m]");
    return {};
  }
  Status operator()(const PulleyJoint& joint) const {
    if (!all_finite(joint.over_a) || !all_finite(joint.over_b))
      return {StatusCode::NotFinite, "the points of a pulley are not finite [m]"};
    if (!(joint.ratio > Real(0)) || !std::isfinite(joint.ratio))
      return bad("a pulley's ratio must be finite and above 0");
    if (!finite_at_least_zero(joint.length))
      return bad("a pulley's length must be finite and not negative [m]; 0: as it is");
    return {};
  }
  Status operator()(const MotorJoint& joint) const {
    if (!all_finite(joint.linear) || !all_finite(joint.angular))
      return {StatusCode::NotFinite, "the motor's target is not finite"};
    if (joint.mode > JointMotor::Mode::Position) return bad("a motor's mode is none of its values");
    if (!at_least_zero(joint.max_force) || !at_least_zero(joint.max_torque))
      return bad("a motor's largest effort must not be negative");
    return check_softness(joint.softness);
  }
};

}  // namespace

Status check_softness(const JointSoftness& softness) {
  if (!finite_at_least_zero(softness.frequency) || !finite_at_least_zero(softness.damping_ratio))
    return bad("frequency [Hz] and damping ratio must be finite and not negative");
  return {};
}

Status check_limit(const JointLimit& limit) {
  if (std::isnan(limit.lower) || std::isnan(limit.upper))
    return {StatusCode::NotFinite, "a joint limit is not a number"};
  if (!(limit.lower <= limit.upper)) return bad("a joint's lower limit lies above its upper one");
  if (limit.lower == kUnlimited || limit.upper == -kUnlimited)
    return bad("a joint limit that nothing can satisfy");
  if (!(limit.restitution >= Real(0) && limit.restitution <= Real(1)))
    return bad("the restitution of a joint limit must lie in 0..1");
  return check_softness(limit.softness);
}

Status check_motor(const JointMotor& motor) {
  if (motor.mode > JointMotor::Mode::Position) return bad("a motor's mode is none of its values");
  if (!std::isfinite(motor.target))
    return {StatusCode::NotFinite, "the motor's target is not finite"};
  if (!at_least_zero(motor.max_effort)) return bad("a motor's largest effort must not be negative");
  return check_softness(motor.softness);
}

Status check_joint(const WorldState& world, const Joint& joint) {
  if (const Status status = check_frame(joint.frame_a); !status) return status;
  if (const Status status = check_frame(joint.frame_b); !status) return status;
  if (const Status status = check_softness(joint.softness); !status) return status;
  if (!(joint.break_force > Real(0)) || !(joint.break_torque > Real(0)))
    return bad("break force [N] and torque [N m] must be above 0");
  if (const Status status = std::visit(KindCheck{}, joint.kind); !status) return status;
  JointId first, second;
  if (coupled_joints(joint.kind, first, second)) {
    if (!world.joints.is_valid(first) || !world.joints.is_valid(second))
      return {StatusCode::StaleHandle, "a coupling needs two joints that exist"};
    if (first == second) return bad("a joint cannot be coupled with itself");
    const JointKind& p = world.joints.info[first.index].component.kind;
    const JointKind& q = world.joints.info[second.index].component.kind;
    const bool rack = std::holds_alternative<RackPinionJoint>(joint.kind);
    if (!std::holds_alternative<HingeJoint>(p) ||
        (rack ? !std::holds_alternative<SliderJoint>(q) : !std::holds_alternative<HingeJoint>(q)))
      return {StatusCode::WrongMotionType, rack ? "a rack and pinion couples a hinge with a slider"
                                                : "a gear couples two hinges"};
    return {};
  }
  const auto known = [&](BodyId body) {
    return body.is_null() ||
           (body.index < world.bodies.info.size() && world.bodies.info[body.index].alive &&
            world.bodies.info[body.index].generation == body.generation);
  };
  if (!known(joint.body_a) || !known(joint.body_b)) return stale_body();
  if (joint.body_a == joint.body_b) return bad("a joint needs two different bodies");
  return {};
}

Status check_joint_moves(const WorldState& world, const Joint& joint) {
  JointId first, second;
  if (coupled_joints(joint.kind, first, second)) return {};
  const auto dynamic = [&](BodyId body) {
    return !body.is_null() && world.bodies.info[body.index].type == MotionType::Dynamic;
  };
  if (!dynamic(joint.body_a) && !dynamic(joint.body_b))
    return {StatusCode::WrongMotionType, "a joint needs at least one dynamic body"};
  return {};
}

}  // namespace plumb::inline PLUMB_ABI::detail
