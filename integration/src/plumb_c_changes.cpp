// The C interface's changes of what lives: bodies, colliders, and who meets whom.
#include <optional>

#include "plumb_c_world.h"

using namespace plumb_c;  // NOLINT(google-build-using-namespace): the interface's own parts

namespace {

std::optional<Real> value_if(bool given, double value) {
  return given ? std::optional(static_cast<Real>(value)) : std::nullopt;
}

plumb_status set_shape(plumb_world* world, plumb_collider collider, const plumb::Shape& shape) {
  return pass_on(world, world->world.set_shape(ColliderId::from_value(collider), shape));
}

bool is_rule(int32_t rule) { return rule >= PLUMB_AVERAGE && rule <= PLUMB_MULTIPLY; }

}  // namespace

plumb_material plumb_material_default(void) {
  const plumb::Material material;
  plumb_material out{};
  out.friction = static_cast<double>(material.friction);
  out.restitution = static_cast<double>(material.restitution);
  out.friction_rule = static_cast<int32_t>(material.friction_rule);
  out.restitution_rule = static_cast<int32_t>(material.restitution_rule);
  out.grain_friction = static_cast<double>(material.grain_friction);
  return out;
}

plumb_status plumb_body_set_motion_type(plumb_world* world, plumb_body body, int32_t type) {
  return guarded(world, [&] {
    if (type < PLUMB_STATIC || type > PLUMB_DYNAMIC)
      return fail(world, PLUMB_OUT_OF_RANGE, "the motion type is none of plumb_motion_type");
    return pass_on(world, world->world.set_motion_type(BodyId::from_value(body),
                                                       static_cast<plumb::MotionType>(type)));
  });
}

plumb_status plumb_body_set_locks(plumb_world* world, plumb_body body, uint32_t locks) {
  return guarded(world, [&] {
    if (locks >= 2u * PLUMB_LOCK_ANGULAR_Z)
      return fail(world, PLUMB_OUT_OF_RANGE, "the locks are no sum of values of plumb_lock");
    const auto has = [locks](plumb_lock lock) {
      return (locks & static_cast<uint32_t>(lock)) != 0;
    };
    const plumb::MotionLocks wanted{has(PLUMB_LOCK_LINEAR_X),  has(PLUMB_LOCK_LINEAR_Y),
                                    has(PLUMB_LOCK_LINEAR_Z),  has(PLUMB_LOCK_ANGULAR_X),
                                    has(PLUMB_LOCK_ANGULAR_Y), has(PLUMB_LOCK_ANGULAR_Z)};
    return pass_on(world, world->world.set_locks(BodyId::from_value(body), wanted));
  });
}

plumb_status plumb_body_set_damping(plumb_world* world, plumb_body body, double linear,
                                    double angular) {
  return guarded(world, [&] {
    return pass_on(world,
                   world->world.set_damping(BodyId::from_value(body), static_cast<Real>(linear),
                                            static_cast<Real>(angular)));
  });
}

plumb_status plumb_body_set_gravity_scale(plumb_world* world, plumb_body body, double scale) {
  return guarded(world, [&] {
    return pass_on(
        world, world->world.set_gravity_scale(BodyId::from_value(body), static_cast<Real>(scale)));
  });
}

plumb_status plumb_body_set_can_sleep(plumb_world* world, plumb_body body, int32_t can_sleep) {
  return guarded(world, [&] {
    return pass_on(world, world->world.set_can_sleep(BodyId::from_value(body), can_sleep != 0));
  });
}

plumb_status plumb_body_set_continuous(plumb_world* world, plumb_body body, int32_t continuous) {
  return guarded(world, [&] {
    return pass_on(world, world->world.set_continuous(BodyId::from_value(body), continuous != 0));
  });
}

plumb_status plumb_body_set_user_data(plumb_world* world, plumb_body body, uint64_t user_data) {
  return guarded(world, [&] {
    return pass_on(world, world->world.set_user_data(BodyId::from_value(body), user_data));
  });
}

plumb_status plumb_body_set_mass(plumb_world* world, plumb_body body, const plumb_mass* mass) {
  return guarded(world, [&] {
    if (!mass) return null_pointer(world);
    plumb::MassProperties wanted;
    wanted.mass = mass->mass;
    wanted.center = Eigen::Vector3d(mass->center[0], mass->center[1], mass->center[2]);
    const double* t = mass->inertia;
    wanted.I_Bcm_B << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
    return pass_on(world, world->world.set_mass(BodyId::from_value(body), wanted));
  });
}

plumb_status plumb_body_derive_mass(plumb_world* world, plumb_body body) {
  return guarded(
      world, [&] { return pass_on(world, world->world.derive_mass(BodyId::from_value(body))); });
}

plumb_status plumb_collider_destroy(plumb_world* world, plumb_collider collider) {
  return guarded(world, [&] {
    return pass_on(world, world->world.destroy_collider(ColliderId::from_value(collider)));
  });
}

plumb_status plumb_collider_set_sphere(plumb_world* world, plumb_collider collider, double radius) {
  return guarded(
      world, [&] { return set_shape(world, collider, plumb::Sphere{static_cast<Real>(radius)}); });
}

plumb_status plumb_collider_set_box(plumb_world* world, plumb_collider collider,
                                    const double half_extents[3], double rounding) {
  return guarded(world, [&] {
    if (!half_extents) return null_pointer(world);
    return set_shape(world, collider, plumb::Box{vec3(half_extents), static_cast<Real>(rounding)});
  });
}

plumb_status plumb_collider_set_capsule(plumb_world* world, plumb_collider collider,
                                        double half_length, double radius) {
  return guarded(world, [&] {
    return set_shape(world, collider,
                     plumb::Capsule{static_cast<Real>(half_length), static_cast<Real>(radius)});
  });
}

plumb_status plumb_collider_set_cylinder(plumb_world* world, plumb_collider collider,
                                         double half_length, double radius, double rounding) {
  return guarded(world, [&] {
    return set_shape(world, collider,
                     plumb::Cylinder{static_cast<Real>(half_length), static_cast<Real>(radius),
                                     static_cast<Real>(rounding)});
  });
}

plumb_status plumb_collider_set_cone(plumb_world* world, plumb_collider collider,
                                     double half_length, double radius, double rounding) {
  return guarded(world, [&] {
    return set_shape(world, collider,
                     plumb::Cone{static_cast<Real>(half_length), static_cast<Real>(radius),
                                 static_cast<Real>(rounding)});
  });
}

plumb_status plumb_collider_set_pose(plumb_world* world, plumb_collider collider,
                                     const double position[3], const double orientation[4]) {
  return guarded(world, [&] {
    if (!position || !orientation) return null_pointer(world);
    return pass_on(world, world->world.set_local_pose(ColliderId::from_value(collider),
                                                      {vec3(position), quat(orientation)}));
  });
}

plumb_status plumb_collider_set_density(plumb_world* world, plumb_collider collider,
                                        double density) {
  return guarded(world, [&] {
    return pass_on(world, world->world.set_density(ColliderId::from_value(collider), density));
  });
}

plumb_status plumb_collider_set_sensor(plumb_world* world, plumb_collider collider,
                                       int32_t is_sensor) {
  return guarded(world, [&] {
    return pass_on(world,
                   world->world.set_sensor(ColliderId::from_value(collider), is_sensor != 0));
  });
}

plumb_status plumb_collider_set_user_data(plumb_world* world, plumb_collider collider,
                                          uint64_t user_data) {
  return guarded(world, [&] {
    return pass_on(world, world->world.set_user_data(ColliderId::from_value(collider), user_data));
  });
}

plumb_status plumb_collider_set_material(plumb_world* world, plumb_collider collider,
                                         const plumb_material* material) {
  return guarded(world, [&] {
    if (!material) return null_pointer(world);
    if (!is_rule(material->friction_rule) || !is_rule(material->restitution_rule))
      return fail(world, PLUMB_OUT_OF_RANGE, "the rule is none of plumb_combine_rule");
    plumb::Material wanted;
    wanted.friction = static_cast<Real>(material->friction);
    wanted.restitution = static_cast<Real>(material->restitution);
    wanted.rolling_friction = static_cast<Real>(material->rolling_friction);
    wanted.torsional_friction = static_cast<Real>(material->torsional_friction);
    wanted.friction_rule = static_cast<plumb::CombineRule>(material->friction_rule);
    wanted.restitution_rule = static_cast<plumb::CombineRule>(material->restitution_rule);
    wanted.kind = material->kind;
    wanted.grain = vec3(material->grain);
    wanted.grain_friction = static_cast<Real>(material->grain_friction);
    wanted.adhesion = static_cast<Real>(material->adhesion);
    return pass_on(world, world->world.set_material(ColliderId::from_value(collider), wanted));
  });
}

plumb_status plumb_collider_get_material(plumb_world* world, plumb_collider collider,
                                         plumb_material* out) {
  return guarded(world, [&] {
    if (!out) return null_pointer(world);
    const ColliderId id = ColliderId::from_value(collider);
    if (!world->world.is_valid(id))
      return fail(world, PLUMB_STALE_HANDLE, "no such collider: it was destroyed, or never was");
    const plumb::Material material = world->world.collider(id).material;
    out->friction = static_cast<double>(material.friction);
    out->restitution = static_cast<double>(material.restitution);
    out->rolling_friction = static_cast<double>(material.rolling_friction);
    out->torsional_friction = static_cast<double>(material.torsional_friction);
    out->friction_rule = static_cast<int32_t>(material.friction_rule);
    out->restitution_rule = static_cast<int32_t>(material.restitution_rule);
    out->kind = material.kind;
    for (int i = 0; i < 3; ++i) out->grain[i] = static_cast<double>(material.grain[i]);
    out->grain_friction = static_cast<double>(material.grain_friction);
    out->adhesion = static_cast<double>(material.adhesion);
    return PLUMB_OK;
  });
}

plumb_status plumb_collider_set_surface_velocity(plumb_world* world, plumb_collider collider,
                                                 const double linear[3], const double angular[3]) {
  return guarded(world, [&] {
    plumb::SurfaceVelocity wanted;
    if (linear) wanted.linear = vec3(linear);
    if (angular) wanted.angular = vec3(angular);
    return pass_on(world,
                   world->world.set_surface_velocity(ColliderId::from_value(collider), wanted));
  });
}

plumb_status plumb_collider_set_one_way(plumb_world* world, plumb_collider collider,
                                        const double direction[3]) {
  return guarded(world, [&] {
    if (!direction) return null_pointer(world);
    return pass_on(world,
                   world->world.set_one_way(ColliderId::from_value(collider), vec3(direction)));
  });
}

plumb_status plumb_collider_set_filter(plumb_world* world, plumb_collider collider, uint32_t layers,
                                       uint32_t collides_with, int32_t group) {
  return guarded(world, [&] {
    return pass_on(world, world->world.set_filter(ColliderId::from_value(collider),
                                                  {layers, collides_with, group}));
  });
}

plumb_status plumb_set_material_pair(plumb_world* world, uint32_t kind_a, uint32_t kind_b,
                                     const plumb_material_pair* values) {
  return guarded(world, [&] {
    std::optional<plumb::MaterialPair> wanted;
    if (values) {
      const uint32_t given = values->given;
      if (given >= 2u * PLUMB_PAIR_TORSIONAL_FRICTION)
        return fail(world, PLUMB_OUT_OF_RANGE, "given is no sum of values of plumb_pair_value");
      wanted = plumb::MaterialPair{
          value_if(given & PLUMB_PAIR_FRICTION, values->friction),
          value_if(given & PLUMB_PAIR_RESTITUTION, values->restitution),
          value_if(given & PLUMB_PAIR_ROLLING_FRICTION, values->rolling_friction),
          value_if(given & PLUMB_PAIR_TORSIONAL_FRICTION, values->torsional_friction)};
    }
    return pass_on(world, world->world.set_material_pair(kind_a, kind_b, wanted));
  });
}

plumb_status plumb_exclude_bodies(plumb_world* world, plumb_body a, plumb_body b,
                                  int32_t excluded) {
  return guarded(world, [&] {
    return pass_on(world, world->world.exclude_pair(BodyId::from_value(a), BodyId::from_value(b),
                                                    excluded != 0));
  });
}

plumb_status plumb_exclude_colliders(plumb_world* world, plumb_collider a, plumb_collider b,
                                     int32_t excluded) {
  return guarded(world, [&] {
    return pass_on(world, world->world.exclude_pair(ColliderId::from_value(a),
                                                    ColliderId::from_value(b), excluded != 0));
  });
}
