// Joints of a scene file: their names, bodies and frames.
#include "scene/read_joint.h"

#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr const char* kAnchorRemedy =
    "write \"anchor\": [x, y, z] in world coordinates, or give each body its own by anchor_a and "
    "anchor_b, or frame_a and frame_b";

Eigen::Quaterniond x_along(const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), axis);
}

// Of the keys "axis" and "orientation": one of them, or none.
void read_attitude(const ObjectReader& in, Eigen::Quaterniond& orientation) {
  if (in.has("axis") && in.has("orientation")) {
    in.problems().add(in.line_of("axis"), in.what() + " has both 'axis' and 'orientation'",
                      "keep one of them");
    return;
  }
  if (read_orientation(in, orientation)) return;
  Eigen::Vector3d axis;
  if (!in.vector("axis", axis)) return;
  if (!(axis.norm() > 0)) {
    in.problems().add(in.line_of("axis"), "'axis' of " + in.what() + " has no length",
                      "write a direction, for example [0, 1, 0]");
    return;
  }
  orientation = x_along(axis.normalized());
}

LocalPose read_frame(const JsonNode& node, const std::string& what, Problems& problems) {
  LocalPose frame;
  const ObjectReader in(node, what, keys::kJointFrame, problems);
  if (!in.is_object()) return frame;
  in.vector("position", frame.position);
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  read_attitude(in, orientation);
  frame.orientation = orientation.cast<Real>();
  return frame;
}

}  // namespace

JointsReader::JointsReader(const Scene& scene, Problems& problems)
    : bodies_(scene), problems_(problems) {}

void JointsReader::read(const JsonNode& list, std::vector<SceneJoint>& joints) {
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    SceneJoint& joint = joints.emplace_back();
    joint.name = "joint " + std::to_string(k);
    read_one(list.items[k], joint);
    const std::string_view kind = kJointKeys[joint.joint.kind.index()].kind;
    if (!kinds_.emplace(joint.name, kind).second) {
      problems_.add(joint.line, "there is another joint named '" + joint.name + "'",
                    "give each joint a name of its own");
    }
  }
}

void JointsReader::read_one(const JsonNode& node, SceneJoint& joint) {
  if (const JsonMember* name = node.find("name")) joint.name = name->value.text;
  const ObjectReader in(node, "joint '" + joint.name + "'", keys::kJoint, problems_);
  joint.line = node.line;
  if (!in.is_object()) return;
  in.text("name", joint.name);
  if (joint.name.empty()) {
    problems_.add(in.line_of("name"), "a joint's name is empty", "name it or remove the key");
  }
  if (!read_joint_kind(in, joint)) return;

  in.number("break_force", joint.joint.break_force, kPositive);
  in.number("break_torque", joint.joint.break_torque, kPositive);
  // A motor joint holds nothing; the softness is that of its motor.
  const bool is_motor = std::holds_alternative<MotorJoint>(joint.joint.kind);
  if (!is_motor) read_softness(in, "softness", joint.joint.softness);
  if (std::holds_alternative<GearJoint>(joint.joint.kind)) {
    check_coupled(in, "first", "hinge");
    check_coupled(in, "second", "hinge");
    return;
  }
  if (std::holds_alternative<RackPinionJoint>(joint.joint.kind)) {
    check_coupled(in, "pinion", "hinge");
    check_coupled(in, "rack", "slider");
    return;
  }
  in.flag("collide_connected", joint.joint.collide_connected);
  bodies_.read(in, "body_a", BodyNames::World::Allowed, joint.a.body);
  bodies_.read(in, "body_b", BodyNames::World::Allowed, joint.b.body);
  if (joint.a.body == joint.b.body) {
    problems_.add(in.line(),
                  in.what() + (joint.a.body.empty() ? " names no body" : " names one body twice"),
                  "name two under body_a and body_b; one that is left out is the world");
  }
  read_place(in, joint);
}

void JointsReader::read_side(const ObjectReader& in, char letter, SceneJointSide& side) {
  const std::string anchor = std::string("anchor_") + letter;
  const std::string frame = std::string("frame_") + letter;
  const int given = (in.has("anchor") ? 1 : 0) + (in.has(anchor) ? 1 : 0) + (in.has(frame) ? 1 : 0);
  if (given != 1) {
    const std::string body = std::string("body_") + letter;
    problems_.add(in.line(),
                  in.what() + (given ? " is given several places on " : " has no place on ") + body,
                  given ? "keep one of anchor, " + anchor + " and " + frame : kAnchorRemedy);
    return;
  }
  in.vector("anchor", side.anchor);
  in.vector(anchor, side.anchor);
  if (const JsonNode* node = in.find(frame))
    side.frame = read_frame(*node, frame + " of " + in.what(), problems_);
}

void JointsReader::read_place(const ObjectReader& in, SceneJoint& joint) {
  read_side(in, 'a', joint.a);
  read_side(in, 'b', joint.b);
  if (in.has("frame_a") && in.has("frame_b")) {
    for (const std::string_view key : {"axis", "orientation"}) {
      if (!in.has(key)) continue;
      problems_.add(in.line_of(key),
                    "'" + std::string(key) + "' of " + in.what() + " has no meaning beside frames",
                    "write it inside frame_a and frame_b");
    }
    return;
  }
  read_attitude(in, joint.orientation);
}

void JointsReader::check_coupled(const ObjectReader& in, std::string_view key,
                                 const std::string& wanted) {
  std::string name;
  if (!in.has(key) || !in.text(key, name)) return;
  const auto found = kinds_.find(name);
  if (found == kinds_.end()) {
    problems_.add(in.line_of(key), "there is no joint '" + name + "' before " + in.what(),
                  "name a " + wanted + " that stands before it in the list");
  } else if (found->second != wanted) {
    problems_.add(in.line_of(key),
                  "joint '" + name + "' is of the kind " + std::string(found->second),
                  "'" + std::string(key) + "' of " + in.what() + " has to be a " + wanted);
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
