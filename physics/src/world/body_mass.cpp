// Mass, centre of mass and principal axes of a body, from what the user gave or from its colliders.
#include <algorithm>
#include <cmath>

#include "math/eigen_bridge.h"
#include "motion/body_motion.h"
#include "world/inner_edges.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr double kPointMass = 1.0;  // [kg] of a dynamic body that nothing gives a mass

// Moments that agree to this relative difference are taken as equal [-]: rounding of a cube's or
// sphere's tensor must not make its principal axes arbitrary.
constexpr double kEqualMoments = 1e-12;

MassProperties properties_from_colliders(const WorldState& world, const BodyInfo& info) {
  MassProperties sum;
  for (const std::uint32_t slot : info.colliders) {
    const Collider& component = world.colliders.info[slot].component;
    if (component.is_sensor || component.density == 0) continue;
    const ShapeMass part = mass_of(component.shape, component.density);
    if (!part.status.ok())
      continue;  // half-spaces; refused on dynamic bodies when they are created
    const MassProperties placed = part.properties.placed(
        component.pose.position.template cast<double>(),
        Eigen::Quaterniond(component.pose.orientation.template cast<double>()));
    sum = sum.mass > 0 ? sum.plus(placed) : placed;
  }
  return sum;
}

Rotation rotation_from(const Eigen::Matrix3d& R) {
  if (R.isIdentity(0)) return {0, 0, 0, 1};
  const Eigen::Quaterniond q(R);
  return normalized(Rotation{static_cast<Real>(q.x()), static_cast<Real>(q.y()),
                             static_cast<Real>(q.z()), static_cast<Real>(q.w())});
}

Real inverse_or_zero(double a) { return a > 0 ? static_cast<Real>(1 / a) : Real(0); }

}  // namespace

// Recomputes mass and principal frame; keeps the body frame's pose and the velocity of its origin.
void update_mass(WorldState& world, std::uint32_t body) {
  BodyStore& bodies = world.bodies;
  BodyInfo& info = bodies.info[body];
  const std::uint32_t dense = info.dense;
  BodyMass& mass = bodies.mass[dense];
  BodyPose& pose = bodies.pose[dense];
  BodyVelocity& velocity = bodies.velocity[dense];

  const Rotation R_WB = normalized(pose.q * conjugate(info.R_BP));
  const Vec old_arm = rotate(R_WB, info.center_B);
  const PosVec origin = pose.x - cast<PosReal>(old_arm);

  if (!info.has_own_mass) info.properties = properties_from_colliders(world, info);
  Vec center{0, 0, 0};
  Rotation R_BP{0, 0, 0, 1};
  const Real gravity_scale = mass.gravity_scale;
  mass = {};
  mass.gravity_scale = gravity_scale;
  if (info.type == MotionType::Dynamic) {
    if (!(info.properties.mass > 0)) {
      info.properties = {};
      info.properties.mass = kPointMass;
    }
    center = {static_cast<Real>(info.properties.center.x()),
              static_cast<Real>(info.properties.center.y()),
              static_cast<Real>(info.properties.center.z())};
    const MassProperties::Principal principal = info.properties.principal();
    Eigen::Vector3d I = principal.moments;
    Eigen::Matrix3d R = principal.R_BP;
    const Eigen::Matrix3d& tensor = info.properties.I_Bcm_B;
    const double products =
        std::max({std::abs(tensor(0, 1)), std::abs(tensor(0, 2)), std::abs(tensor(1, 2))});
    if (I.maxCoeff() - I.minCoeff() <= kEqualMoments * I.maxCoeff()) {
      I.setConstant(I.mean());
      R.setIdentity();
    } else if (products <= kEqualMoments * I.maxCoeff()) {
      I = tensor
              .diagonal();  // body axes are principal axes already: keep them, whatever their order
      R.setIdentity();
    }
    R_BP = rotation_from(R);
    const Real inverse = inverse_or_zero(info.properties.mass);
    mass.mass = static_cast<Real>(info.properties.mass);
    mass.inverse_mass = {inverse, inverse, inverse};
    mass.moments = {static_cast<Real>(I.x()), static_cast<Real>(I.y()), static_cast<Real>(I.z())};
    mass.inverse_moments = {inverse_or_zero(I.x()), inverse_or_zero(I.y()), inverse_or_zero(I.z())};
  }
  info.center_B = center;
  info.R_BP = R_BP;
  const Vec new_arm = rotate(R_WB, center);
  pose.q = normalized(R_WB * R_BP);
  pose.x = origin + cast<PosReal>(new_arm);
  velocity.v += cross(velocity.w, new_arm - old_arm);
  if (info.disabled) mass = {};
  update_locks(world, body);
  update_collider_frames(world, body);
}

// Ends the motion that the locks forbid, and what could bring it back.
void update_locks(WorldState& world, std::uint32_t body) {
  BodyStore& bodies = world.bodies;
  const BodyInfo& info = bodies.info[body];
  const MotionLocks& k = info.locks;
  BodyMass& mass = bodies.mass[info.dense];
  BodyVelocity& velocity = bodies.velocity[info.dense];
  const Real inverse = mass.mass > Real(0) ? inverse_or_zero(info.properties.mass) : Real(0);
  const auto unlocked = [](bool x, bool y, bool z, Vec a) {
    return Vec{x ? Real(0) : a.x, y ? Real(0) : a.y, z ? Real(0) : a.z};
  };
  mass.inverse_mass = unlocked(k.linear_x, k.linear_y, k.linear_z, {inverse, inverse, inverse});
  mass.angular_locks = 0;
  if (mass.mass > Real(0))
    mass.angular_locks =
        (k.angular_x ? 1u : 0u) | (k.angular_y ? 2u : 0u) | (k.angular_z ? 4u : 0u);
  velocity.v = unlocked(k.linear_x, k.linear_y, k.linear_z, velocity.v);
  velocity.w = unlocked(k.angular_x, k.angular_y, k.angular_z, velocity.w);
  bodies.momentum[info.dense].L = angular_momentum_of(mass, bodies.pose[info.dense].q, velocity.w);
}

// Places the colliders relative to the centre of mass and the principal axes.
void update_collider_frames(WorldState& world, std::uint32_t body) {
  BodyInfo& info = world.bodies.info[body];
  if (world.effects != nullptr) world.effects->forget_surface(body);
  note_neighbours(world, body);
  BodyExtent extent;
  for (const std::uint32_t slot : info.colliders) {
    ColliderInfo& collider = world.colliders.info[slot];
    const LocalPose& local = collider.component.pose;
    collider.in_body.p = inverse_rotate(info.R_BP, to_inner(local.position) - info.center_B);
    collider.in_body.q = normalized(conjugate(info.R_BP) * to_inner(local.orientation));
    collider.thickness = smallest_thickness(collider.shape);
    collider.farthest = length(collider.in_body.p) + bounding_radius(collider.shape);
    if (collider.component.is_sensor) continue;
    extent.size =
        extent.size > Real(0) ? std::min(extent.size, collider.thickness) : collider.thickness;
    extent.radius = std::max(extent.radius, collider.farthest);
    // A ball about the centre turns on the spot.
    extent.turning_radius =
        std::max(extent.turning_radius, collider.farthest - collider.shape.radius);
  }
  world.bodies.extent[body] = extent;
}

}  // namespace plumb::inline PLUMB_ABI::detail
