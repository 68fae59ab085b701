// Joints as numbers. Layouts (x3: three numbers; u64: low and high 32 bits; ?: 0 or 1 first, the
// rest only after 1):
//
//   softness   frequency, damping ratio
//   limit ?    lower, upper, softness, restitution
//   motor ?    mode, target, largest effort, softness
//   spring ?   rest, stiffness, damping
//   axis       limit, motor, spring, friction
//   joint      bodies u64 x2, frames (position x3, orientation xyzw) x2, softness, collide
//              connected, break force, break torque, user data u64, kind, numbers of the kind
//   kinds      0 ball: friction | 1 hinge: axis | 2 slider: axis | 3 fixed | 4 distance: length
//              5 rope: length | 6 spring: rest, stiffness, damping, pulls only
//              7 cone-twist: cone, lower, upper, softness, friction
//              8 six-dof: (freedom, axis) x6 | 9 gear: joints u64 x2, ratio
//              10 rack and pinion: joints u64 x2, radius
//              11 pulley: points x3 x2, ratio, length, stiff
//              12 motor: mode, linear x3, angular x3, force, torque, softness
#include "world/joint_inputs.h"

#include "world/number_visitors.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

template <class To>
void visit(To& t, JointSoftness& s) {
  t(s.frequency);
  t(s.damping_ratio);
}
template <class To>
void visit(To& t, std::optional<JointLimit>& limit) {
  if (!t.presence(limit)) return;
  t(limit->lower);
  t(limit->upper);
  visit(t, limit->softness);
  t(limit->restitution);
}
template <class To>
void visit(To& t, std::optional<JointMotor>& motor) {
  if (!t.presence(motor)) return;
  t.choice(motor->mode, 2);
  t(motor->target);
  t(motor->max_effort);
  visit(t, motor->softness);
}
template <class To>
void visit(To& t, std::optional<JointSpring>& spring) {
  if (!t.presence(spring)) return;
  t(spring->rest);
  t(spring->stiffness);
  t(spring->damping);
}
template <class To>
void visit(To& t, JointAxis& axis) {
  visit(t, axis.limit);
  visit(t, axis.motor);
  visit(t, axis.spring);
  t(axis.friction);
}
template <class To>
struct KindVisitor {
  To& t;
  void operator()(BallJoint& j) { t(j.friction); }
  void operator()(HingeJoint& j) { visit(t, j.axis); }
  void operator()(SliderJoint& j) { visit(t, j.axis); }
  void operator()(FixedJoint&) {}
  void operator()(DistanceJoint& j) { t(j.length); }
  void operator()(RopeJoint& j) { t(j.max_length); }
  void operator()(SpringJoint& j) {
    t(j.rest_length);
    t(j.stiffness);
    t(j.damping);
    t(j.pulls_only);
  }
  void operator()(ConeTwistJoint& j) {
    t(j.cone);
    t(j.twist_lower);
    t(j.twist_upper);
    visit(t, j.softness);
    t(j.friction);
  }
  void operator()(SixDofJoint& j) {
    for (SixDofJoint::Coordinate& c : j.coordinates) {
      t.choice(c.freedom, 3);
      visit(t, c.axis);
    }
  }
  void operator()(GearJoint& j) {
    t(j.first);
    t(j.second);
    t(j.ratio);
  }
  void operator()(RackPinionJoint& j) {
    t(j.pinion);
    t(j.rack);
    t(j.radius);
  }
  void operator()(PulleyJoint& j) {
    t.position(j.over_a);
    t.position(j.over_b);
    t(j.ratio);
    t(j.length);
    t(j.stiff);
  }
  void operator()(MotorJoint& j) {
    t.choice(j.mode, 2);
    t(j.linear);
    t(j.angular);
    t(j.max_force);
    t(j.max_torque);
    visit(t, j.softness);
  }
};

template <class To>
void visit(To& t, Joint& joint) {
  t(joint.body_a);
  t(joint.body_b);
  for (LocalPose* frame : {&joint.frame_a, &joint.frame_b}) {
    t(frame->position);
    t.unit(frame->orientation);
  }
  visit(t, joint.softness);
  t(joint.collide_connected);
  t(joint.break_force);
  t(joint.break_torque);
  t(joint.user_data);
  visit_index(t, joint.kind);
  std::visit(KindVisitor<To>{t}, joint.kind);
}

}  // namespace

// The visitors serve both directions; writing changes nothing.
void append(std::vector<double>& out, const std::optional<JointMotor>& motor) {
  std::optional<JointMotor> copy = motor;
  NumberWriter writer(out);
  visit(writer, copy);
}
void append(std::vector<double>& out, const std::optional<JointLimit>& limit) {
  std::optional<JointLimit> copy = limit;
  NumberWriter writer(out);
  visit(writer, copy);
}
void append(std::vector<double>& out, const Joint& joint) {
  Joint copy = joint;
  NumberWriter writer(out);
  visit(writer, copy);
}

std::optional<JointMotor> read_motor(NumberReader& in, bool& ok) {
  std::optional<JointMotor> motor;
  NumberFiller reader(in, ok);
  visit(reader, motor);
  return motor;
}
std::optional<JointLimit> read_limit(NumberReader& in, bool& ok) {
  std::optional<JointLimit> limit;
  NumberFiller reader(in, ok);
  visit(reader, limit);
  return limit;
}
Joint read_joint(NumberReader& in, bool& ok) {
  Joint joint;
  NumberFiller reader(in, ok);
  visit(reader, joint);
  return joint;
}

}  // namespace plumb::inline PLUMB_ABI::detail
