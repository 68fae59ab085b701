// What acts along a coordinate that a joint leaves free: limit, motor, spring, friction, softness.
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "scene/read_joint.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Says so if both spellings of a key are there, or if degrees are given for a path.
bool spelled_well(const ObjectReader& in, const std::string& key, Measure measure) {
  const std::string degrees = key + "_degrees";
  if (!in.has(degrees)) return true;
  if (measure == Measure::Path) {
    in.problems().add(in.line_of(degrees), in.what() + " is along a path, which has no degrees",
                      "write '" + key + "' in metres");
    return false;
  }
  if (!in.has(key)) return true;
  in.problems().add(in.line_of(degrees),
                    in.what() + " has both '" + key + "' and '" + degrees + "'",
                    "keep one of them");
  return false;
}

// A list of two numbers, or null for an end that is open.
bool read_ends(const ObjectReader& in, std::string_view key, double (&ends)[2]) {
  const JsonNode* node = in.find(key);
  if (!node) return false;
  bool good = node->kind == JsonNode::Kind::Array && node->items.size() == 2;
  for (std::size_t k = 0; good && k < 2; ++k) {
    const JsonNode& end = node->items[k];
    const double open =
        (k == 0 ? -1 : 1) * std::numeric_limits<double>::infinity();  // nothing ends there
    good = end.kind == JsonNode::Kind::Number || end.kind == JsonNode::Kind::Null;
    ends[k] = end.kind == JsonNode::Kind::Null ? open : end.number;
  }
  if (!good || !(ends[0] <= ends[1])) {
    in.problems().add(node->line, "'" + std::string(key) + "' of " + in.what() + " is not a range",
                      "write [lower, upper] with lower <= upper, null where there is no end");
    return false;
  }
  return true;
}

}  // namespace

bool read_measure(const ObjectReader& in, const std::string& key, Measure measure, double& out) {
  if (!spelled_well(in, key, measure)) return false;
  if (measure == Measure::Angle && in.number(key + "_degrees", out)) {
    out *= kRadiansPerDegree;
    return true;
  }
  return in.number(key, out);
}

bool read_measured_vector(const ObjectReader& in, const std::string& key, Vec3& out) {
  if (!spelled_well(in, key, Measure::Angle)) return false;
  Eigen::Vector3d wide;
  if (in.vector(key + "_degrees", wide)) {
    out = (wide * kRadiansPerDegree).cast<Real>();
    return true;
  }
  return in.vector(key, out);
}

bool read_range(const ObjectReader& in, const std::string& key, Measure measure, Real& lower,
                Real& upper) {
  if (!spelled_well(in, key, measure)) return false;
  double ends[2] = {0, 0};
  if (measure == Measure::Angle && read_ends(in, key + "_degrees", ends)) {
    for (double& end : ends) end *= kRadiansPerDegree;
  } else if (!read_ends(in, key, ends)) {
    return false;
  }
  lower = static_cast<Real>(ends[0]);
  upper = static_cast<Real>(ends[1]);
  return true;
}

void read_softness(const ObjectReader& parent, std::string_view key, JointSoftness& softness) {
  const JsonNode* node = parent.find(key);
  if (!node) return;
  const ObjectReader in(*node, std::string(key) + " of " + parent.what(), keys::kJointSoftness,
                        parent.problems());
  if (!in.is_object()) return;
  in.number("frequency", softness.frequency, kNotNegative);
  in.number("damping_ratio", softness.damping_ratio, kNotNegative);
}

void read_axis(const ObjectReader& parent, Measure measure, JointAxis& axis) {
  const auto part_of = [&](const char* key) { return std::string(key) + " of " + parent.what(); };
  parent.number("friction", axis.friction, kNotNegative);
  if (const JsonNode* node = parent.find("limit")) {
    const ObjectReader in(*node, part_of("limit"), keys::kJointLimit, parent.problems());
    JointLimit& limit = axis.limit.emplace();
    if (in.is_object() && !in.has("range") && !in.has("range_degrees"))
      in.missing("range", "write [lower, upper]");
    read_range(in, "range", measure, limit.lower, limit.upper);
    read_softness(in, "softness", limit.softness);
    in.number("restitution", limit.restitution, {0, 1, false});
  }
  if (const JsonNode* node = parent.find("motor")) {
    const ObjectReader in(*node, part_of("motor"), keys::kJointMotor, parent.problems());
    JointMotor& motor = axis.motor.emplace();
    in.choice("mode", kMotorModes, motor.mode);
    double target = 0;
    if (read_measure(in, "target", measure, target)) motor.target = static_cast<Real>(target);
    in.number("max_effort", motor.max_effort, kNotNegative);
    read_softness(in, "softness", motor.softness);
  }
  if (const JsonNode* node = parent.find("spring")) {
    const ObjectReader in(*node, part_of("spring"), keys::kJointSpring, parent.problems());
    JointSpring& spring = axis.spring.emplace();
    double rest = 0;
    if (read_measure(in, "rest", measure, rest)) spring.rest = static_cast<Real>(rest);
    in.number("stiffness", spring.stiffness, kNotNegative);
    in.number("damping", spring.damping, kNotNegative);
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
