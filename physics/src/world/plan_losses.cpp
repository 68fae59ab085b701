#include "world/plan_losses.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "math/eigen_bridge.h"
#include "solver/joints/joint_tolerances.h"
#include "world/tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

std::string number(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, 3).ptr;
  return std::string(text, end);
}
[[maybe_unused]] std::string number(float x) { return number(static_cast<double>(x)); }
std::string name_of(const Worst& worst) { return "body " + std::to_string(worst.body); }

// Without the term L turns with the body instead of standing still in space: |d/dt L| = |w x L|,
// and that length stays, exactly, as long as nothing else acts.
std::string loss_of_gyroscopic(const PlanTally& t) {
  const Worst& worst = t.body.tilt;
  return "the angular momentum of " + name_of(worst) +
         " turns away from where it belongs by up to |w x L| dt / |L| = " +
         number(worst.value * t.dt) + " rad a step, " + number(worst.value) +
         " rad a second; that of all others by less";
}

std::string loss_of_look_ahead(const PlanTally& t) {
  return "surfaces may meet up to " + number(t.pair.approach * t.dt) +
         " m late, which is how far they approach in a step; what is thinner is left to the "
         "continuous stage";
}

std::string loss_of_continuous(const PlanTally& t) {
  return name_of(t.body.path) + " may end a step up to " + number(t.body.path.value) +
         " m inside or behind what it should have met, all others by less";
}

std::string loss_of_surface_velocity(const WorldState& world) {
  Real fastest = 0;  // [m/s]
  for (const ColliderInfo& collider : world.colliders.info) {
    if (!collider.alive) continue;
    const SurfaceVelocity& s = collider.component.surface_velocity;
    const Real turning = s.angular.norm();
    const Real by_turning = turning > Real(0) ? turning * bounding_radius(collider.shape) : Real(0);
    fastest = std::max(fastest, s.linear.norm() + by_turning);
  }
  return "what lies on a surface that runs is carried by up to " + number(fastest) +
         " m/s too slowly";
}

// Of the error of a chain of equal masses one pass over its n joints leaves cos^2(pi / (n + 1)).
std::string loss_of_direct_joints(const PlanTally& t) {
  constexpr double kPi = 3.14159265358979323846;
  const double n = static_cast<double>(t.joint.grouped);
  const double left = std::pow(std::cos(kPi / (n + 1)), 2 * joint_tolerance::kChainPasses);
  return std::to_string(joint_tolerance::kChainPasses) + " passes leave up to " + number(left) +
         " of a substep's error where all of these joints are one chain of equal masses; groups "
         "that touch nothing fall from second order to first";
}

// What swings by s rad a step of the leapfrog arrives with an error of s^2 / 24 of its swing.
std::string loss_of_joint_substeps(const PlanTally& t) {
  const double swing =
      static_cast<double>(joint_tolerance::kVibrationPerCycle) * static_cast<double>(t.joint.most);
  return "what swings fastest turns by up to " + number(swing) +
         " rad in a substep: its phase is off by up to " + number(swing * swing / 24) +
         " of that, and above 2 rad it gains energy";
}

}  // namespace

std::string loss_of(const WorldState& world, const PlanTally& t, PlanItem item) {
  switch (item) {
    case PlanItem::Gyroscopic:
      return loss_of_gyroscopic(t);
    case PlanItem::Friction:
      return "what slides is braked by up to " + number(t.pair.friction) +
             " N too little (coefficient times normal force of the last step)";
    case PlanItem::Restitution:
      return "surfaces part by up to " + number(t.pair.restitution * t.pair.approach) +
             " m/s too slowly (restitution times their present speed)";
    case PlanItem::LookAhead:
      return loss_of_look_ahead(t);
    case PlanItem::Continuous:
      return loss_of_continuous(t);
    case PlanItem::Sleeping:
      return "nothing but time: what rests is stepped like all else";
    case PlanItem::RollingFriction:
      return "what rolls or spins is braked by up to " + number(t.pair.resistance) +
             " N m too little (coefficient times normal force of the last step)";
    case PlanItem::SurfaceVelocity:
      return loss_of_surface_velocity(world);
    case PlanItem::AnisotropicFriction:
      return "along a grain friction is too great by up to " + number(t.pair.friction) + " N";
    case PlanItem::Adhesion:
      return "pairs hold together by up to " + number(t.pair.adhesion) + " N too little";
    case PlanItem::AccurateContacts:
      return "no bound: the error of soft steps grows with the ratio of the masses and with the "
             "height of what is stacked; the deepest overlap now is " +
             number(world.report.largest_penetration) + " m";
    case PlanItem::FastTurns:
      return "arms and inertia of contacts lag behind by up to " + number(t.body.turn.value) +
             " rad at the end of a step (" + name_of(t.body.turn) + ")";
    case PlanItem::DeepOverlap:
      return "what is pushed out of overlap may leave it with up to " +
             number(tolerance::kPushRate * t.body.thickness.value) +
             " m/s that relaxing would have taken back";
    case PlanItem::KeptManifolds:
      return "nothing but time: manifolds are found anew in every step";
    case PlanItem::StepLevels:
      return "nothing but time: all islands take all substeps";
    case PlanItem::DirectJoints:
      return loss_of_direct_joints(t);
    case PlanItem::JointSubsteps:
      return loss_of_joint_substeps(t);
    default:
      return "all that it does";
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
