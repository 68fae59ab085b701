#include "scene/joint_notes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <variant>

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

// Between bodies without a size, sides closer than this lie at one place [m].
constexpr double kSamePlace = 1e-3;
constexpr double kWholeTurn = 2 * std::numbers::pi;  // [rad]

std::string text_of(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

// The longest side of the uniform box that has this distribution of mass [m]; 0 without one.
double size_of(const PhysicsWorld& world, BodyId body) {
  const MassProperties mass = world.mass_properties(body);
  if (!(mass.mass > 0)) return 0;
  // Of a box: integral of x^2 dm = mass side^2 / 12, and that is half the trace minus I_xx.
  const double half_trace = 0.5 * mass.I_Bcm_B.trace();
  const double largest =
      half_trace - Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mass.I_Bcm_B).eigenvalues()[0];
  return std::sqrt(12 * std::max(0.0, largest) / mass.mass);
}

// Angles are in radians, where those beyond a turn come as multiples of pi; degrees come as whole
// or half numbers.
bool reads_like_degrees(double angle) {
  return std::isfinite(angle) && std::abs(angle) > kWholeTurn && 2 * angle == std::round(2 * angle);
}

// The first angle of an axis that reads like degrees, and what it is; 0: none does.
struct Doubtful {
  double angle = 0;  // [rad]
  const char* what = "";
};

Doubtful doubtful_angle(const JointAxis& axis) {
  if (axis.limit) {
    for (const Real end : {axis.limit->lower, axis.limit->upper})
      if (reads_like_degrees(static_cast<double>(end))) return {static_cast<double>(end), "limit"};
  }
  if (axis.motor && axis.motor->mode == JointMotor::Mode::Position) {
    const auto target = static_cast<double>(axis.motor->target);
    if (reads_like_degrees(target)) return {target, "motor's target"};
  }
  if (axis.spring) {
    const auto rest = static_cast<double>(axis.spring->rest);
    if (reads_like_degrees(rest)) return {rest, "spring's rest"};
  }
  return {};
}

Doubtful doubtful_angle(const JointKind& kind) {
  if (const auto* hinge = std::get_if<HingeJoint>(&kind)) return doubtful_angle(hinge->axis);
  const auto* six = std::get_if<SixDofJoint>(&kind);
  if (six == nullptr) return {};
  constexpr std::size_t kFirstAngle = 3;
  for (std::size_t k = kFirstAngle; k < six->coordinates.size(); ++k) {
    const Doubtful found = doubtful_angle(six->coordinates[k].axis);
    if (found.angle != 0) return found;
  }
  return {};
}

}  // namespace

void note_slips_of(const std::string& name, JointId id, const PhysicsWorld& world,
                   std::vector<std::string>& notes) {
  const Joint joint = world.joint(id);
  const auto apart = static_cast<double>(world.joint_state(id).linear_error);
  const double size = std::max(size_of(world, joint.body_a), size_of(world, joint.body_b));
  if (apart > std::max(size, kSamePlace)) {
    notes.push_back("joint '" + name + "' has to pull its sides together over " + text_of(apart) +
                    " m as the scene begins, which is more than its bodies are long (" +
                    text_of(size) + " m); check its anchors or frames");
  }
  const Doubtful doubtful = doubtful_angle(joint.kind);
  if (doubtful.angle != 0) {
    notes.push_back("joint '" + name + "': its " + doubtful.what + " of " +
                    text_of(doubtful.angle) + " rad is " +
                    text_of(std::abs(doubtful.angle) / kWholeTurn) +
                    " turns; if degrees are meant, write the key that ends in _degrees");
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
