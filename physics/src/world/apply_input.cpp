// Doing again what a recorded call did.
#include "effects/effect_numbers.h"
#include "world/inputs.h"
#include "world/joint_inputs.h"

namespace plumb::inline PLUMB_ABI {

const char* name_of(InputKind kind) {
  switch (kind) {
    case InputKind::CreateBody:
      return "create_body";
    case InputKind::DestroyBody:
      return "destroy_body";
    case InputKind::CreateCollider:
      return "create_collider";
    case InputKind::DestroyCollider:
      return "destroy_collider";
    case InputKind::SetPose:
      return "set_pose";
    case InputKind::SetLinearVelocity:
      return "set_linear_velocity";
    case InputKind::SetAngularVelocity:
      return "set_angular_velocity";
    case InputKind::SetMass:
      return "set_mass";
    case InputKind::ApplyForce:
      return "apply_force";
    case InputKind::ApplyForceAt:
      return "apply_force_at";
    case InputKind::ApplyForceAtBodyPoint:
      return "apply_force_at_body_point";
    case InputKind::ApplyTorque:
      return "apply_torque";
    case InputKind::ApplyImpulse:
      return "apply_impulse";
    case InputKind::ApplyImpulseAt:
      return "apply_impulse_at";
    case InputKind::ApplyImpulseAtBodyPoint:
      return "apply_impulse_at_body_point";
    case InputKind::ApplyAngularImpulse:
      return "apply_angular_impulse";
    case InputKind::SetAwake:
      return "set_awake";
    case InputKind::SetSettings:
      return "set_settings";
    case InputKind::CreateJoint:
      return "create_joint";
    case InputKind::DestroyJoint:
      return "destroy_joint";
    case InputKind::SetJointMotor:
      return "set_joint_motor";
    case InputKind::SetJointLimit:
      return "set_joint_limit";
    case InputKind::SetSurfaceVelocity:
      return "set_surface_velocity";
    case InputKind::SetFilter:
      return "set_filter";
    case InputKind::SetMaterialPair:
      return "set_material_pair";
    case InputKind::ExcludeBodyPair:
      return "exclude_body_pair";
    case InputKind::ExcludeColliderPair:
      return "exclude_collider_pair";
    case InputKind::DeriveMass:
      return "derive_mass";
    case InputKind::SetMotionType:
      return "set_motion_type";
    case InputKind::SetLocks:
      return "set_locks";
    case InputKind::SetDamping:
      return "set_damping";
    case InputKind::SetGravityScale:
      return "set_gravity_scale";
    case InputKind::SetCanSleep:
      return "set_can_sleep";
    case InputKind::SetContinuous:
      return "set_continuous";
    case InputKind::SetBodyUserData:
      return "set_body_user_data";
    case InputKind::SetShape:
      return "set_shape";
    case InputKind::SetLocalPose:
      return "set_local_pose";
    case InputKind::SetMaterial:
      return "set_material";
    case InputKind::SetDensity:
      return "set_density";
    case InputKind::SetSensor:
      return "set_sensor";
    case InputKind::SetOneWay:
      return "set_one_way";
    case InputKind::SetColliderUserData:
      return "set_collider_user_data";
    case InputKind::CreateEffect:
      return "create_effect";
    case InputKind::SetEffect:
      return "set_effect";
    case InputKind::DestroyEffect:
      return "destroy_effect";
  }
  return "unknown";
}

Status PhysicsWorld::apply_input(const InputRecord& input) {
  detail::NumberReader in(input.numbers);
  const BodyId body = BodyId::from_value(input.target);
  const ColliderId collider = ColliderId::from_value(input.target);
  const Status malformed{StatusCode::BadSnapshot,
                         "the recorded input does not have the numbers of its kind"};
  // Everything is read before anything is done, so that a malformed record changes nothing.
  switch (input.kind) {
    case InputKind::CreateBody: {
      const RigidBody made = in.body();
      return in.complete() ? create_body(made).status : malformed;
    }
    case InputKind::DestroyBody:
      return in.complete() ? destroy_body(body) : malformed;
    case InputKind::CreateCollider: {
      const Collider made = in.collider();
      return in.complete() ? create_collider(body, made).status : malformed;
    }
    case InputKind::DestroyCollider:
      return in.complete() ? destroy_collider(collider) : malformed;
    case InputKind::SetPose: {
      Pose pose;
      pose.position = in.position();
      pose.orientation = in.orientation();
      return in.complete() ? set_pose(body, pose) : malformed;
    }
    case InputKind::SetMass: {
      const MassProperties mass = in.mass();
      return in.complete() ? set_mass(body, mass) : malformed;
    }
    case InputKind::SetAwake: {
      const bool awake = in.flag();
      return in.complete() ? set_awake(body, awake) : malformed;
    }
    case InputKind::SetSettings: {
      const WorldSettings chosen = in.settings();
      return in.complete() ? set_settings(chosen) : malformed;
    }
    case InputKind::CreateJoint: {
      bool ok = true;
      const Joint made = detail::read_joint(in, ok);
      return ok && in.complete() ? create_joint(made).status : malformed;
    }
    case InputKind::DestroyJoint:
      return in.complete() ? destroy_joint(JointId::from_value(input.target)) : malformed;
    case InputKind::SetJointMotor: {
      bool ok = true;
      const int axis = static_cast<int>(in.number());
      const auto motor = detail::read_motor(in, ok);
      return ok && in.complete() ? set_joint_motor(JointId::from_value(input.target), motor, axis)
                                 : malformed;
    }
    case InputKind::SetJointLimit: {
      bool ok = true;
      const int axis = static_cast<int>(in.number());
      const auto limit = detail::read_limit(in, ok);
      return ok && in.complete() ? set_joint_limit(JointId::from_value(input.target), limit, axis)
                                 : malformed;
    }
    case InputKind::SetSurfaceVelocity: {
      const SurfaceVelocity velocity = in.surface_velocity();
      return in.complete() ? set_surface_velocity(collider, velocity) : malformed;
    }
    case InputKind::SetFilter: {
      const Filter filter = in.filter();
      return in.complete() ? set_filter(collider, filter) : malformed;
    }
    case InputKind::SetMaterialPair: {
      const std::uint32_t kind_a = in.word(), kind_b = in.word();
      const std::optional<MaterialPair> values = in.material_pair();
      return in.complete() ? set_material_pair(kind_a, kind_b, values) : malformed;
    }
    case InputKind::ExcludeBodyPair: {
      const BodyId other = BodyId::from_value(in.long_word());
      const bool excluded = in.flag();
      return in.complete() ? exclude_pair(body, other, excluded) : malformed;
    }
    case InputKind::ExcludeColliderPair: {
      const ColliderId other = ColliderId::from_value(in.long_word());
      const bool excluded = in.flag();
      return in.complete() ? exclude_pair(collider, other, excluded) : malformed;
    }
    case InputKind::DeriveMass:
      return in.complete() ? derive_mass(body) : malformed;
    case InputKind::SetMotionType: {
      const MotionType type = in.motion_type();
      return in.complete() ? set_motion_type(body, type) : malformed;
    }
    case InputKind::SetLocks: {
      const MotionLocks locks = in.locks();
      return in.complete() ? set_locks(body, locks) : malformed;
    }
    case InputKind::SetDamping: {
      const Real linear = in.real(), angular = in.real();
      return in.complete() ? set_damping(body, linear, angular) : malformed;
    }
    case InputKind::SetGravityScale: {
      const Real scale = in.real();
      return in.complete() ? set_gravity_scale(body, scale) : malformed;
    }
    case InputKind::SetCanSleep: {
      const bool can_sleep = in.flag();
      return in.complete() ? set_can_sleep(body, can_sleep) : malformed;
    }
    case InputKind::SetContinuous: {
      const bool continuous = in.flag();
      return in.complete() ? set_continuous(body, continuous) : malformed;
    }
    case InputKind::SetBodyUserData: {
      const std::uint64_t user_data = in.long_word();
      return in.complete() ? set_user_data(body, user_data) : malformed;
    }
    case InputKind::SetShape: {
      const Shape shape = in.shape();
      return in.complete() ? set_shape(collider, shape) : malformed;
    }
    case InputKind::SetLocalPose: {
      const LocalPose pose = in.local_pose();
      return in.complete() ? set_local_pose(collider, pose) : malformed;
    }
    case InputKind::SetMaterial: {
      const Material material = in.material();
      return in.complete() ? set_material(collider, material) : malformed;
    }
    case InputKind::SetDensity: {
      const double density = in.number();
      return in.complete() ? set_density(collider, density) : malformed;
    }
    case InputKind::SetSensor: {
      const bool is_sensor = in.flag();
      return in.complete() ? set_sensor(collider, is_sensor) : malformed;
    }
    case InputKind::SetOneWay: {
      const Vec3 direction = in.vector();
      return in.complete() ? set_one_way(collider, direction) : malformed;
    }
    case InputKind::SetColliderUserData: {
      const std::uint64_t user_data = in.long_word();
      return in.complete() ? set_user_data(collider, user_data) : malformed;
    }
    case InputKind::CreateEffect:
    case InputKind::SetEffect: {
      bool ok = true;
      const Effect given = detail::read_effect(in, ok);
      if (!ok || !in.complete()) return malformed;
      return input.kind == InputKind::CreateEffect
                 ? create_effect(given).status
                 : set_effect(EffectId::from_value(input.target), given);
    }
    case InputKind::DestroyEffect:
      return in.complete() ? destroy_effect(EffectId::from_value(input.target)) : malformed;
    case InputKind::ApplyForceAt:
    case InputKind::ApplyImpulseAt: {
      const Vec3 v = in.vector();
      const Pos3 p = in.position();
      if (!in.complete()) return malformed;
      return input.kind == InputKind::ApplyForceAt ? apply_force_at(body, v, p)
                                                   : apply_impulse_at(body, v, p);
    }
    case InputKind::ApplyForceAtBodyPoint:
    case InputKind::ApplyImpulseAtBodyPoint: {
      const Vec3 v = in.vector(), p = in.vector();
      if (!in.complete()) return malformed;
      return input.kind == InputKind::ApplyForceAtBodyPoint
                 ? apply_force_at_body_point(body, v, p)
                 : apply_impulse_at_body_point(body, v, p);
    }
    default:
      break;
  }
  const Vec3 v = in.vector();
  if (!in.complete()) return malformed;
  switch (input.kind) {
    case InputKind::SetLinearVelocity:
      return set_linear_velocity(body, v);
    case InputKind::SetAngularVelocity:
      return set_angular_velocity(body, v);
    case InputKind::ApplyForce:
      return apply_force(body, v);
    case InputKind::ApplyTorque:
      return apply_torque(body, v);
    case InputKind::ApplyImpulse:
      return apply_impulse(body, v);
    case InputKind::ApplyAngularImpulse:
      return apply_angular_impulse(body, v);
    default:
      return {StatusCode::BadSnapshot, "the recorded input is of an unknown kind"};
  }
}

}  // namespace plumb::inline PLUMB_ABI
