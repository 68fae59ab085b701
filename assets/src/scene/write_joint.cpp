#include "scene/write_joint.h"

#include <cmath>
#include <utility>
#include <variant>

#include "scene/keys.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

// JSON has no infinity: what is unlimited is left out, an end that is open is null.
void write_bounded(const char* key, Real value, Json& out) {
  if (std::isfinite(value)) out[key] = tidy(value);
}
Json end_of(Real value) { return std::isfinite(value) ? Json(tidy(value)) : Json(nullptr); }
Json range(Real lower, Real upper) { return Json::array({end_of(lower), end_of(upper)}); }

Json json_of(const JointSoftness& softness) {
  return {{"frequency", tidy(softness.frequency)}, {"damping_ratio", tidy(softness.damping_ratio)}};
}

void write_axis(const JointAxis& axis, Json& out) {
  if (axis.limit) {
    out["limit"] = {{"range", range(axis.limit->lower, axis.limit->upper)},
                    {"softness", json_of(axis.limit->softness)},
                    {"restitution", tidy(axis.limit->restitution)}};
  }
  if (axis.motor) {
    Json motor = {{"mode", word(kMotorModes, axis.motor->mode)},
                  {"target", tidy(axis.motor->target)}};
    write_bounded("max_effort", axis.motor->max_effort, motor);
    motor["softness"] = json_of(axis.motor->softness);
    out["motor"] = std::move(motor);
  }
  if (axis.spring) {
    out["spring"] = {{"rest", tidy(axis.spring->rest)},
                     {"stiffness", tidy(axis.spring->stiffness)},
                     {"damping", tidy(axis.spring->damping)}};
  }
  out["friction"] = tidy(axis.friction);
}

struct KindWriter {
  const SceneJoint& joint;
  Json& out;

  void operator()(const BallJoint& kind) const { out["friction"] = tidy(kind.friction); }
  void operator()(const HingeJoint& kind) const { write_axis(kind.axis, out); }
  void operator()(const SliderJoint& kind) const { write_axis(kind.axis, out); }
  void operator()(const FixedJoint&) const {}
  void operator()(const DistanceJoint& kind) const { write_length("length", kind.length); }
  void operator()(const RopeJoint& kind) const { write_length("max_length", kind.max_length); }
  void operator()(const SpringJoint& kind) const {
    write_length("rest_length", kind.rest_length);
    out["stiffness"] = tidy(kind.stiffness);
    out["damping"] = tidy(kind.damping);
    out["pulls_only"] = kind.pulls_only;
  }
  void operator()(const ConeTwistJoint& kind) const {
    out["cone"] = tidy(kind.cone);
    out["twist"] = range(kind.twist_lower, kind.twist_upper);
    out["limit_softness"] = json_of(kind.softness);
    out["friction"] = tidy(kind.friction);
  }
  void operator()(const SixDofJoint& kind) const {
    Json coordinates = Json::object();
    for (std::size_t k = 0; k < kind.coordinates.size(); ++k) {
      SixDofJoint::Coordinate coordinate = kind.coordinates[k];
      if (coordinate.freedom == SixDofJoint::Freedom::Locked) continue;
      if (coordinate.freedom == SixDofJoint::Freedom::Free) coordinate.axis.limit.reset();
      Json axis = Json::object();
      write_axis(coordinate.axis, axis);
      coordinates[std::string(keys::kCoordinates[k])] = std::move(axis);
    }
    out["coordinates"] = std::move(coordinates);
  }
  void operator()(const GearJoint& kind) const {
    out["first"] = joint.first;
    out["second"] = joint.second;
    out["ratio"] = tidy(kind.ratio);
  }
  void operator()(const RackPinionJoint& kind) const {
    out["pinion"] = joint.first;
    out["rack"] = joint.second;
    out["radius"] = tidy(kind.radius);
  }
  void operator()(const PulleyJoint& kind) const {
    out["over_a"] = list(kind.over_a);
    out["over_b"] = list(kind.over_b);
    out["ratio"] = tidy(kind.ratio);
    out["length"] = tidy(kind.length);
    out["stiff"] = kind.stiff;
  }
  void operator()(const MotorJoint& kind) const {
    out["mode"] = word(kMotorModes, kind.mode);
    out["linear"] = list(kind.linear);
    out["angular"] = list(kind.angular);
    write_bounded("max_force", kind.max_force, out);
    write_bounded("max_torque", kind.max_torque, out);
    out["softness"] = json_of(kind.softness);
  }

 private:
  void write_length(const char* key, Real length) const {
    if (!joint.length_as_placed) out[key] = tidy(length);
  }
};

void write_side(const SceneJointSide& side, char letter, Json& out) {
  const std::string end(1, letter);
  out["body_" + end] = side.body.empty() ? std::string(kWorldName) : side.body;
  if (side.frame) {
    out["frame_" + end] = {{"position", list(side.frame->position)},
                           {"orientation", orientation(side.frame->orientation)}};
  } else {
    out["anchor_" + end] = list(side.anchor);
  }
}

}  // namespace

Json json_of_joint(const SceneJoint& joint) {
  Json out;
  out["name"] = joint.name;
  out["kind"] = std::string(kJointKeys[joint.joint.kind.index()].kind);
  const bool couples = std::holds_alternative<GearJoint>(joint.joint.kind) ||
                       std::holds_alternative<RackPinionJoint>(joint.joint.kind);
  if (!couples) {
    write_side(joint.a, 'a', out);
    write_side(joint.b, 'b', out);
    if (!joint.a.frame || !joint.b.frame) out["orientation"] = orientation(joint.orientation);
    out["collide_connected"] = joint.joint.collide_connected;
  }
  if (!std::holds_alternative<MotorJoint>(joint.joint.kind))
    out["softness"] = json_of(joint.joint.softness);
  write_bounded("break_force", joint.joint.break_force, out);
  write_bounded("break_torque", joint.joint.break_torque, out);
  KindWriter writer{joint, out};
  std::visit(writer, joint.joint.kind);
  return out;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
