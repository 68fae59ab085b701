#include "scene/read_parts.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
// A quaternion typed with three decimals is that near to length one; farther off is a slip.
constexpr double kUnitTolerance = 2e-3;
constexpr int kMostSubsteps = 64, kMostIterations = 64;
// Steps shorter or longer than these, and longer runs, are slips of a unit.
constexpr Range kStepRange{1e-9, 1e3, false};       // [s]
constexpr Range kRateRange{1e-3, 1e9, false};       // [1/s]
constexpr Range kGravityRange{-1e15, 1e15, false};  // [m/s^2]
constexpr Range kDurationRange{0, 1e9, false};      // [s]

Eigen::Quaterniond about(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kRadiansPerDegree, axis));
}

}  // namespace

void read_step(const JsonNode& node, SceneStep& step, Problems& problems) {
  const ObjectReader in(node, "step", keys::kStep, problems);
  if (!in.is_object()) return;
  if (in.has("dt") && in.has("rate")) {
    problems.add(in.line_of("rate"), "step has both 'dt' and 'rate'", "keep one of them");
  }
  double rate = 0;
  in.number("dt", step.dt, kStepRange);
  if (in.number("rate", rate, kRateRange)) step.dt = 1 / rate;
  in.number("duration", step.duration, kDurationRange);
}

namespace {

// What the plan may force of an item: off for all of these, on for some.
void read_forced(const JsonNode& node, PlanChoices& forced, Problems& problems) {
  const ObjectReader in(node, "forced", keys::kForced, problems);
  if (!in.is_object()) return;
  for (const std::string_view key : keys::kForced) {
    std::size_t place = 0;
    const std::optional<PlanItem> item = plan_item_of(key);
    if (!item || !in.choice(key, kForcedChoices, place)) continue;
    const Choice choice = static_cast<Choice>(place);
    if (may_force(*item, choice)) {
      forced.set(*item, choice);
    } else {
      problems.add(in.line_of(key), "'" + std::string(key) + "' cannot be forced on",
                   "the scene itself has to ask for it");
    }
  }
}

}  // namespace

void read_settings(const JsonNode& node, WorldSettings& settings, Problems& problems) {
  const ObjectReader in(node, "settings", keys::kSettings, problems);
  if (!in.is_object()) return;
  in.vector("gravity", settings.gravity, kGravityRange);
  in.integer("substeps", settings.substeps, 1, kMostSubsteps);
  in.number("step_tolerance", settings.step_tolerance, kNotNegative);
  in.number("contact_frequency", settings.contact_frequency, kPositive);
  in.number("contact_damping_ratio", settings.contact_damping_ratio, kNotNegative);
  in.choice("rotation", kRotationMethods, settings.rotation);
  in.choice("contact_solver", kContactSolvers, settings.contact_solver);
  in.integer("velocity_iterations", settings.velocity_iterations, 1, kMostIterations);
  in.choice("friction_cone", kFrictionCones, settings.friction_cone);
  in.integer("joint_order", settings.joint_order, 2, 4);
  in.flag("warm_starting", settings.warm_starting);
  in.flag("sleeping", settings.sleeping);
  in.number("time_to_sleep", settings.time_to_sleep, kNotNegative);
  if (const JsonNode* forced = in.find("forced")) read_forced(*forced, settings.forced, problems);
  const Status status = check(settings);
  if (!status.ok() && problems.empty()) {
    problems.add(node.line, std::string("settings: ") + status.message, "");
  }
}

void read_material(const JsonNode& node, const std::string& what, Material& material,
                   Problems& problems) {
  const ObjectReader in(node, what, keys::kMaterial, problems);
  if (!in.is_object()) return;
  in.number("friction", material.friction, kNotNegative);
  in.number("restitution", material.restitution, {0, 1, false});
  in.choice("friction_rule", kCombineRules, material.friction_rule);
  in.choice("restitution_rule", kCombineRules, material.restitution_rule);
  in.number("rolling_friction", material.rolling_friction, kNotNegative);
  in.number("torsional_friction", material.torsional_friction, kNotNegative);
  in.integer("kind", material.kind, 0u, kLastKind);
  in.vector("grain", material.grain);
  in.number("grain_friction", material.grain_friction, {0, 1, false});
  in.number("adhesion", material.adhesion, kNotNegative);
}

bool read_orientation(const ObjectReader& parent, Eigen::Quaterniond& orientation) {
  const JsonNode* node = parent.find("orientation");
  if (!node) return false;
  const std::string what = "orientation of " + parent.what();
  const ObjectReader in(*node, what, keys::kOrientation, parent.problems());
  if (!in.is_object()) return false;
  const int given = (in.has("quaternion") ? 1 : 0) + (in.has("euler_degrees") ? 1 : 0) +
                    (in.has("axis_angle") ? 1 : 0);
  if (given != 1) {
    parent.problems().add(
        node->line, what + (given ? " is given in several ways" : " is empty"),
        "give one of quaternion [x, y, z, w], euler_degrees [x, y, z] or axis_angle "
        "[x, y, z, degrees]");
    return false;
  }
  double v[4];
  if (in.numbers("quaternion", v, 4)) {
    const Eigen::Quaterniond q(v[3], v[0], v[1], v[2]);
    if (!(std::abs(q.norm() - 1) <= kUnitTolerance)) {
      parent.problems().add(in.line_of("quaternion"),
                            "the quaternion of " + what + " has length " + std::to_string(q.norm()),
                            "write a unit quaternion [x, y, z, w]; no rotation is [0, 0, 0, 1]");
      return false;
    }
    // Kept as it is if it is as near to unit length as the rounding of its four numbers lets it be,
    // so that a quaternion that was written out comes back with the same bits.
    constexpr double kRounding = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    orientation = std::abs(q.squaredNorm() - 1) <= kRounding ? q : q.normalized();
    return true;
  }
  if (in.numbers("euler_degrees", v, 3)) {
    // About the world's x, then y, then z axis.
    orientation = about(Eigen::Vector3d::UnitZ(), v[2]) * about(Eigen::Vector3d::UnitY(), v[1]) *
                  about(Eigen::Vector3d::UnitX(), v[0]);
    return true;
  }
  if (in.numbers("axis_angle", v, 4)) {
    const Eigen::Vector3d axis(v[0], v[1], v[2]);
    if (!(axis.norm() > 0)) {
      parent.problems().add(in.line_of("axis_angle"), "the axis of " + what + " has no length",
                            "write [x, y, z, degrees] with an axis of any length but zero");
      return false;
    }
    orientation = about(axis.normalized(), v[3]);
    return true;
  }
  return false;
}

void read_pose(const ObjectReader& in, LocalPose& pose) {
  in.vector("position", pose.position);
  Eigen::Quaterniond orientation;
  if (read_orientation(in, orientation)) pose.orientation = orientation.cast<Real>();
}

void read_repeat(const JsonNode& node, const std::string& what, SceneRepeat& repeat,
                 Problems& problems) {
  const ObjectReader in(node, "repeat of " + what, keys::kRepeat, problems);
  if (!in.is_object()) return;
  double count[3] = {1, 1, 1};
  if (!in.has("count")) in.missing("count", "give the copies along x, y and z: [4, 1, 4]");
  if (in.numbers("count", count, 3)) {
    bool good = true;
    for (std::size_t k = 0; k < 3; ++k) {
      good = good && count[k] >= 1 && count[k] <= static_cast<double>(kMostBodies) &&
             count[k] == std::floor(count[k]);
      if (good) repeat.count[k] = static_cast<int>(count[k]);
    }
    if (!good) {
      problems.add(in.line_of("count"), "'count' of " + in.what() + " must be whole numbers >= 1",
                   "write the copies along x, y and z: [4, 1, 4]");
      repeat.count = {1, 1, 1};
    }
  }
  in.vector("spacing", repeat.spacing);
  in.vector("jitter", repeat.jitter, kNotNegative);
  in.flag("random_orientation", repeat.random_orientation);
  if (const JsonNode* seed = in.find("seed")) {
    if (seed->is_unsigned) {
      repeat.seed = seed->integer;
    } else {
      problems.add(seed->line, "'seed' of " + in.what() + " must be a whole number >= 0",
                   "write any such number, for example 1");
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
