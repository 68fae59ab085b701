// The kinds of joints, each with its own keys.
#include <algorithm>
#include <numbers>
#include <string>
#include <variant>

#include "scene/nearest.h"
#include "scene/read_joint.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

void need(const ObjectReader& in, std::string_view key, const char* remedy) {
  if (!in.has(key)) in.missing(key, remedy);
}

// A key that belongs to another kind is a slip that would go unseen.
void refuse_foreign_keys(const ObjectReader& in, const JointKeys& own) {
  const auto refuse = [&](std::string_view key) {
    std::vector<std::string_view> allowed;
    std::copy_if(own.keys.begin(), own.keys.end(), std::back_inserter(allowed),
                 [](std::string_view k) { return !k.empty(); });
    in.problems().add(in.line_of(key),
                      in.what() + " is of the kind " + std::string(own.kind) + ", which has no '" +
                          std::string(key) + "'",
                      allowed.empty() ? "remove it" : "the kind's own keys are " + joined(allowed));
  };
  std::vector<std::string_view> seen;
  for (const JointKeys& other : kJointKeys) {
    for (const std::string_view key : other.keys) {
      if (key.empty() || !in.has(key)) continue;
      if (std::find(own.keys.begin(), own.keys.end(), key) != own.keys.end()) continue;
      if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
      seen.push_back(key);
      refuse(key);
    }
  }
  if (own.kind != "gear" && own.kind != "rack_pinion") return;
  for (const std::string_view key : kPlacementKeys)
    if (in.has(key)) refuse(key);
}

void read_cone_twist(const ObjectReader& in, ConeTwistJoint& joint) {
  constexpr double kPi = std::numbers::pi;
  if (!in.has("cone") && !in.has("cone_degrees"))
    in.missing("cone", "give the half angle of the cone, for example \"cone_degrees\": 30");
  double cone = 0;
  if (read_measure(in, "cone", Measure::Angle, cone)) {
    joint.cone = static_cast<Real>(cone);
    if (!(cone >= 0 && cone <= kPi)) {
      in.problems().add(in.line(), "the cone of " + in.what() + " is no half angle",
                        "write an angle from 0 to 180 degrees");
    }
  }
  if (read_range(in, "twist", Measure::Angle, joint.twist_lower, joint.twist_upper) &&
      !(joint.twist_lower >= static_cast<Real>(-kPi) &&
        joint.twist_upper <= static_cast<Real>(kPi))) {
    in.problems().add(in.line(), "the twist of " + in.what() + " goes beyond half a turn",
                      "write angles from -180 to 180 degrees");
  }
  read_softness(in, "limit_softness", joint.softness);
  in.number("friction", joint.friction, kNotNegative);
}

void read_six_dof(const ObjectReader& in, SixDofJoint& joint) {
  const JsonNode* node = in.find("coordinates");
  if (!node) return;
  const std::string what = "coordinates of " + in.what();
  const ObjectReader all(*node, what, keys::kCoordinates, in.problems());
  if (!all.is_object()) return;
  constexpr std::size_t kPaths = 3;  // the first three are paths, the others angles
  for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
    const JsonNode* own = all.find(keys::kCoordinates[k]);
    if (!own) continue;
    const ObjectReader axis(*own, std::string(keys::kCoordinates[k]) + " of " + in.what(),
                            keys::kJointAxis, in.problems());
    SixDofJoint::Coordinate& coordinate = joint.coordinates[k];
    read_axis(axis, k < kPaths ? Measure::Path : Measure::Angle, coordinate.axis);
    coordinate.freedom =
        coordinate.axis.limit ? SixDofJoint::Freedom::Limited : SixDofJoint::Freedom::Free;
  }
}

void not_zero(const ObjectReader& in, std::string_view key, Real& out) {
  double value = 0;
  if (!in.number(key, value)) return;
  if (value == 0) {
    in.problems().add(in.line_of(key), "'" + std::string(key) + "' of " + in.what() + " is 0",
                      "write another number; below 0 turns the other way");
    return;
  }
  out = static_cast<Real>(value);
}

// Reads the keys of one kind into the joint.
struct KindReader {
  const ObjectReader& in;
  SceneJoint& scene_joint;

  void operator()(BallJoint& joint) const { in.number("friction", joint.friction, kNotNegative); }
  void operator()(HingeJoint& joint) const { read_axis(in, Measure::Angle, joint.axis); }
  void operator()(SliderJoint& joint) const { read_axis(in, Measure::Path, joint.axis); }
  void operator()(FixedJoint&) const {}
  void operator()(DistanceJoint& joint) const {
    scene_joint.length_as_placed = !in.has("length");
    in.number("length", joint.length, kPositive);
  }
  void operator()(RopeJoint& joint) const {
    scene_joint.length_as_placed = !in.has("max_length");
    in.number("max_length", joint.max_length, kPositive);
  }
  void operator()(SpringJoint& joint) const {
    scene_joint.length_as_placed = !in.has("rest_length");
    need(in, "stiffness", "give the force for each metre in N/m");
    in.number("rest_length", joint.rest_length, kNotNegative);
    in.number("stiffness", joint.stiffness, kNotNegative);
    in.number("damping", joint.damping, kNotNegative);
    in.flag("pulls_only", joint.pulls_only);
  }
  void operator()(ConeTwistJoint& joint) const { read_cone_twist(in, joint); }
  void operator()(SixDofJoint& joint) const { read_six_dof(in, joint); }
  void operator()(GearJoint& joint) const {
    need(in, "first", "name a hinge that stands before this joint");
    need(in, "second", "name a hinge that stands before this joint");
    in.text("first", scene_joint.first);
    in.text("second", scene_joint.second);
    not_zero(in, "ratio", joint.ratio);
  }
  void operator()(RackPinionJoint& joint) const {
    need(in, "pinion", "name a hinge that stands before this joint");
    need(in, "rack", "name a slider that stands before this joint");
    need(in, "radius", "give the radius of the pinion in metres");
    in.text("pinion", scene_joint.first);
    in.text("rack", scene_joint.second);
    not_zero(in, "radius", joint.radius);
  }
  void operator()(PulleyJoint& joint) const {
    need(in, "over_a", "give the place in the world where the rope of body_a leaves the wheel");
    need(in, "over_b", "give the place in the world where the rope of body_b leaves the wheel");
    in.vector("over_a", joint.over_a);
    in.vector("over_b", joint.over_b);
    in.number("ratio", joint.ratio, kPositive);
    in.number("length", joint.length, kNotNegative);
    in.flag("stiff", joint.stiff);
  }
  void operator()(MotorJoint& joint) const {
    in.choice("mode", kMotorModes, joint.mode);
    in.vector("linear", joint.linear);
    read_measured_vector(in, "angular", joint.angular);
    in.number("max_force", joint.max_force, kNotNegative);
    in.number("max_torque", joint.max_torque, kNotNegative);
    read_softness(in, "softness", joint.softness);
  }
};

template <std::size_t... K>
JointKind kind_at(std::size_t which, std::index_sequence<K...>) {
  JointKind kind;
  ((which == K ? static_cast<void>(kind.emplace<K>()) : static_cast<void>(0)), ...);
  return kind;
}

}  // namespace

bool read_joint_kind(const ObjectReader& in, SceneJoint& joint) {
  std::array<std::string_view, kJointKeys.size()> words;
  static_assert(kJointKeys.size() == std::variant_size_v<JointKind>);
  std::transform(kJointKeys.begin(), kJointKeys.end(), words.begin(),
                 [](const JointKeys& keys) { return keys.kind; });
  std::size_t which = 0;
  if (!in.has("kind")) in.missing("kind", "use one of " + joined(words));
  if (!in.choice("kind", words, which)) return false;
  refuse_foreign_keys(in, kJointKeys[which]);
  joint.joint.kind = kind_at(which, std::make_index_sequence<kJointKeys.size()>{});
  std::visit(KindReader{in, joint}, joint.joint.kind);
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
