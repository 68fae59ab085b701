#include "world/validate.h"

#include "collision/collision_shape.h"

namespace plumb::inline PLUMB_ABI {
namespace detail {

Status check_motion_type(MotionType type) {
  if (type != MotionType::Static && type != MotionType::Kinematic && type != MotionType::Dynamic)
    return {StatusCode::OutOfRange, "motion type must be Static, Kinematic or Dynamic"};
  return {};
}

Status check_damping(Real linear, Real angular) {
  if (!std::isfinite(linear) || linear < 0)
    return {StatusCode::OutOfRange, "linear damping must be finite and not negative [1/s]"};
  if (!std::isfinite(angular) || angular < 0)
    return {StatusCode::OutOfRange, "angular damping must be finite and not negative [1/s]"};
  return {};
}

Status check_gravity_scale(Real scale) {
  if (!std::isfinite(scale)) return {StatusCode::NotFinite, "gravity scale is not finite"};
  return {};
}

Status check_body(const RigidBody& body) {
  if (const Status status = check_pose(body.pose); !status) return status;
  if (!all_finite(body.linear_velocity))
    return {StatusCode::NotFinite, "linear velocity is not finite [m/s]"};
  if (!all_finite(body.angular_velocity))
    return {StatusCode::NotFinite, "angular velocity is not finite [rad/s]"};
  if (const Status status = check_damping(body.linear_damping, body.angular_damping); !status)
    return status;
  if (const Status status = check_gravity_scale(body.gravity_scale); !status) return status;
  if (const Status status = check_motion_type(body.type); !status) return status;
  if (body.type == MotionType::Static &&
      (body.linear_velocity.squaredNorm() > 0 || body.angular_velocity.squaredNorm() > 0))
    return {StatusCode::WrongMotionType, "a static body cannot have a velocity: make it kinematic"};
  if (body.mass.has_value()) return check(*body.mass);
  return {};
}

namespace {

Status check_surface(Real friction, Real restitution, Real rolling, Real torsional) {
  if (!std::isfinite(friction) || friction < 0)
    return {StatusCode::OutOfRange, "friction must be finite and not negative"};
  if (!std::isfinite(restitution) || restitution < 0 || restitution > 1)
    return {StatusCode::OutOfRange, "restitution must lie in 0..1"};
  if (!std::isfinite(rolling) || rolling < 0)
    return {StatusCode::OutOfRange, "rolling friction must be finite and not negative [m]"};
  if (!std::isfinite(torsional) || torsional < 0)
    return {StatusCode::OutOfRange, "torsional friction must be finite and not negative [m]"};
  return {};
}

}  // namespace

Status check_surface_velocity(const SurfaceVelocity& velocity) {
  if (!all_finite(velocity.linear) || !all_finite(velocity.angular))
    return {StatusCode::NotFinite, "surface velocity is not finite [m/s], [rad/s]"};
  return {};
}

Status check_material_pair(const MaterialPair& values) {
  return check_surface(values.friction.value_or(Real(0)), values.restitution.value_or(Real(0)),
                       values.rolling_friction.value_or(Real(0)),
                       values.torsional_friction.value_or(Real(0)));
}

Status check_material(const Material& m) {
  if (m.friction_rule > CombineRule::Multiply || m.restitution_rule > CombineRule::Multiply)
    return {StatusCode::OutOfRange, "the combine rule is none of its values"};
  if (!all_finite(m.grain)) return {StatusCode::NotFinite, "the grain is not finite"};
  if (!(m.grain_friction >= 0) || m.grain_friction > 1)
    return {StatusCode::OutOfRange, "the friction along the grain must lie in 0..1"};
  if (!std::isfinite(m.adhesion) || m.adhesion < 0)
    return {StatusCode::OutOfRange, "adhesion must be finite and not negative [N]"};
  return check_surface(m.friction, m.restitution, m.rolling_friction, m.torsional_friction);
}

Status check_one_way(const Vec3& direction) {
  if (!all_finite(direction))
    return {StatusCode::NotFinite, "the direction of a one-way collider is not finite"};
  return {};
}

Status check_density(double density) {
  if (!std::isfinite(density) || density < 0)
    return {StatusCode::OutOfRange, "density must be finite and not negative [kg/m^3]"};
  return {};
}

Status check_shape_fits(const Shape& shape, MotionType type) {
  if (std::holds_alternative<HalfSpace>(shape) && type != MotionType::Static)
    return {StatusCode::BadShape,
            "a half-space has no end and no mass: only static bodies may have one"};
  if ((std::holds_alternative<SurfaceMesh>(shape) || std::holds_alternative<Heightfield>(shape)) &&
      type == MotionType::Dynamic)
    return {StatusCode::BadShape,
            "a mesh or heightfield is a surface without inside: for a dynamic body use its convex "
            "hull, or cut it into convex parts and make them a Compound"};
  return {};
}

Status check_collider(const Collider& collider, MotionType type) {
  for (const Status& status :
       {check_shape(collider.shape), check_local_pose(collider.pose),
        check_material(collider.material), check_surface_velocity(collider.surface_velocity),
        check_one_way(collider.one_way), check_density(collider.density),
        check_shape_fits(collider.shape, type)})
    if (!status) return status;
  return {};
}

Status check_added_mass(const Collider& collider) {
  if (collider.is_sensor || collider.density == 0) return {};
  const ShapeMass added = mass_of(collider.shape, collider.density);
  return added.status.ok() ? check(added.properties) : added.status;
}

namespace {

bool is_possible(const PlanChoices& forced) {
  if ((forced.items_off() & forced.items_on()) != 0) return false;
  std::uint64_t off = 0, on = 0;
  for (std::size_t k = 0; k < kPlanItemCount; ++k) {
    const PlanItem item = static_cast<PlanItem>(k);
    if (may_force(item, Choice::Off)) off |= bit_of(item);
    if (may_force(item, Choice::On)) on |= bit_of(item);
  }
  return (forced.items_off() & ~off) == 0 && (forced.items_on() & ~on) == 0;
}

}  // namespace
}  // namespace detail

Status check(const WorldSettings& s) {
  if (!s.gravity.allFinite()) return {StatusCode::NotFinite, "gravity is not finite [m/s^2]"};
  if (s.substeps < 1 || s.substeps > 64)
    return {StatusCode::OutOfRange, "substeps must lie in 1..64"};
  if (!std::isfinite(s.step_tolerance) || s.step_tolerance < 0)
    return {StatusCode::OutOfRange, "step tolerance must be finite and not negative [m]"};
  if (!std::isfinite(s.contact_frequency) || s.contact_frequency <= 0)
    return {StatusCode::OutOfRange, "contact frequency must be finite and positive [Hz]"};
  if (!std::isfinite(s.contact_damping_ratio) || s.contact_damping_ratio < 0)
    return {StatusCode::OutOfRange, "contact damping ratio must be finite and not negative"};
  if (!std::isfinite(s.time_to_sleep) || s.time_to_sleep < 0)
    return {StatusCode::OutOfRange, "time to sleep must be finite and not negative [s]"};
  if (static_cast<int>(s.rotation) >= kRotationMethodCount)
    return {StatusCode::OutOfRange, "rotation method is none of the eight of RotationMethod"};
  if (static_cast<int>(s.contact_solver) >= kContactSolverCount)
    return {StatusCode::OutOfRange, "contact solver is none of SoftStep, Newton, Auto, WorstFirst"};
  if (s.velocity_iterations < 1 || s.velocity_iterations > 64)
    return {StatusCode::OutOfRange, "velocity iterations must lie in 1..64"};
  if (static_cast<int>(s.friction_cone) >= kFrictionConeCount)
    return {StatusCode::OutOfRange, "friction cone is none of the three of FrictionCone"};
  if (s.joint_order != 2 && s.joint_order != 4)
    return {StatusCode::OutOfRange, "joint order must be 2 or 4"};
  if (!detail::is_possible(s.forced))
    return {StatusCode::OutOfRange,
            "an item of the plan is forced on or off that may not be, or both (may_force tells)"};
  return {};
}

}  // namespace plumb::inline PLUMB_ABI
