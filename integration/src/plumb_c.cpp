#include "plumb/integration/plumb_c.h"

#include <cmath>
#include <memory>
#include <new>

#include "plumb/integration/version.h"
#include "plumb_c_world.h"

using namespace plumb_c;  // NOLINT(google-build-using-namespace): the interface's own parts

namespace {

plumb_status add_collider(plumb_world* world, plumb_body body, const plumb::Shape& shape,
                          const plumb_surface* surface, plumb_collider* out) {
  plumb::Collider collider;
  collider.shape = shape;
  if (surface) {
    collider.material.friction = static_cast<Real>(surface->friction);
    collider.material.restitution = static_cast<Real>(surface->restitution);
    collider.density = surface->density;
    collider.pose.position = vec3(surface->position);
    collider.pose.orientation = quat(surface->orientation);
  }
  const auto created = world->world.create_collider(BodyId::from_value(body), collider);
  if (!created.ok()) return pass_on(world, created.status);
  if (out) *out = created.id.value();
  return PLUMB_OK;
}

plumb_status write_poses(plumb_world* world, plumb_pose* out, size_t capacity, size_t* count) {
  *count = world->states.size();
  for (size_t k = 0; k < world->states.size() && k < capacity; ++k) {
    const plumb::BodyState& state = world->states[k];
    out[k].body = state.id.value();
    out[k].user_data = state.user_data;
    write3(state.pose.position, out[k].position);
    const plumb::Quat& q = state.pose.orientation;
    const Real coefficients[] = {q.x(), q.y(), q.z(), q.w()};
    for (size_t c = 0; c < 4; ++c) out[k].orientation[c] = static_cast<double>(coefficients[c]);
  }
  return PLUMB_OK;
}

}  // namespace

uint32_t plumb_c_abi_version(void) { return PLUMB_C_ABI_VERSION; }
const char* plumb_version(void) { return PLUMB_VERSION_STRING; }

plumb_settings plumb_settings_default(void) {
  const plumb::WorldSettings settings;
  plumb_settings out{};
  write3(settings.gravity, out.gravity);
  out.substeps = settings.substeps;
  out.sleeping = settings.sleeping ? 1 : 0;
  out.threads = 1;
  return out;
}

plumb_body_def plumb_body_default(void) {
  plumb_body_def out{};
  out.type = PLUMB_DYNAMIC;
  identity(out.orientation);
  return out;
}

plumb_surface plumb_surface_default(void) {
  const plumb::Collider collider;
  plumb_surface out{};
  out.friction = static_cast<double>(collider.material.friction);
  out.restitution = static_cast<double>(collider.material.restitution);
  out.density = collider.density;
  identity(out.orientation);
  return out;
}

plumb_status plumb_world_create(const plumb_settings* settings, plumb_world** out) {
  if (!out) return PLUMB_NULL_POINTER;
  *out = nullptr;
  const plumb_settings given = settings ? *settings : plumb_settings_default();
  plumb::WorldSettings wanted;
  wanted.gravity = vec3(given.gravity);
  wanted.substeps = given.substeps;
  wanted.sleeping = given.sleeping != 0;
  if (const plumb::Status status = plumb::check(wanted); !status.ok()) return code_of(status.code);
  constexpr int32_t kMostThreads = 256;  // as make_thread_pool
  if (given.threads < 0 || given.threads > kMostThreads) return PLUMB_OUT_OF_RANGE;
  try {
    auto world = std::make_unique<plumb_world>(wanted);
    if (given.threads != 1) {
      world->jobs = plumb::make_thread_pool(given.threads);
      world->world.set_job_system(world->jobs.get());
    }
    *out = world.release();
    return PLUMB_OK;
  } catch (const std::bad_alloc&) {
    return PLUMB_OUT_OF_MEMORY;
  }
}

void plumb_world_destroy(plumb_world* world) { delete world; }

const char* plumb_message(const plumb_world* world) {
  return world ? world->message : "the world is NULL";
}

plumb_status plumb_body_create(plumb_world* world, const plumb_body_def* def, plumb_body* out) {
  return guarded(world, [&] {
    if (!def || !out) return null_pointer(world);
    if (def->type < PLUMB_STATIC || def->type > PLUMB_DYNAMIC)
      return fail(world, PLUMB_OUT_OF_RANGE, "the motion type is none of plumb_motion_type");
    plumb::RigidBody body;
    body.type = static_cast<plumb::MotionType>(def->type);
    body.pose.position = pos3(def->position);
    body.pose.orientation = quat(def->orientation);
    body.linear_velocity = vec3(def->linear_velocity);
    body.angular_velocity = vec3(def->angular_velocity);
    body.user_data = def->user_data;
    const auto created = world->world.create_body(body);
    if (!created.ok()) return pass_on(world, created.status);
    *out = created.id.value();
    return PLUMB_OK;
  });
}

plumb_status plumb_body_destroy(plumb_world* world, plumb_body body) {
  return guarded(
      world, [&] { return pass_on(world, world->world.destroy_body(BodyId::from_value(body))); });
}

plumb_status plumb_body_set_pose(plumb_world* world, plumb_body body, const double position[3],
                                 const double orientation[4]) {
  return guarded(world, [&] {
    if (!position || !orientation) return null_pointer(world);
    return pass_on(world, world->world.set_pose(BodyId::from_value(body),
                                                {pos3(position), quat(orientation)}));
  });
}

plumb_status plumb_body_apply_impulse(plumb_world* world, plumb_body body,
                                      const double impulse[3]) {
  return guarded(world, [&] {
    if (!impulse) return null_pointer(world);
    return pass_on(world, world->world.apply_impulse(BodyId::from_value(body), vec3(impulse)));
  });
}

plumb_status plumb_add_sphere(plumb_world* world, plumb_body body, double radius,
                              const plumb_surface* surface, plumb_collider* out) {
  return guarded(world, [&] {
    return add_collider(world, body, plumb::Sphere{static_cast<Real>(radius)}, surface, out);
  });
}

plumb_status plumb_add_box(plumb_world* world, plumb_body body, const double half_extents[3],
                           const plumb_surface* surface, plumb_collider* out) {
  return guarded(world, [&] {
    if (!half_extents) return null_pointer(world);
    return add_collider(world, body, plumb::Box{vec3(half_extents)}, surface, out);
  });
}

plumb_status plumb_add_rounded_box(plumb_world* world, plumb_body body,
                                   const double half_extents[3], double rounding,
                                   const plumb_surface* surface, plumb_collider* out) {
  return guarded(world, [&] {
    if (!half_extents) return null_pointer(world);
    const plumb::Box box{vec3(half_extents), static_cast<Real>(rounding)};
    return add_collider(world, body, box, surface, out);
  });
}

plumb_status plumb_add_capsule(plumb_world* world, plumb_body body, double half_length,
                               double radius, const plumb_surface* surface, plumb_collider* out) {
  return guarded(world, [&] {
    const plumb::Capsule capsule{static_cast<Real>(half_length), static_cast<Real>(radius)};
    return add_collider(world, body, capsule, surface, out);
  });
}

plumb_status plumb_add_cylinder(plumb_world* world, plumb_body body, double half_length,
                                double radius, double rounding, const plumb_surface* surface,
                                plumb_collider* out) {
  return guarded(world, [&] {
    const plumb::Cylinder cylinder{static_cast<Real>(half_length), static_cast<Real>(radius),
                                   static_cast<Real>(rounding)};
    return add_collider(world, body, cylinder, surface, out);
  });
}

plumb_status plumb_add_cone(plumb_world* world, plumb_body body, double half_length, double radius,
                            double rounding, const plumb_surface* surface, plumb_collider* out) {
  return guarded(world, [&] {
    const plumb::Cone cone{static_cast<Real>(half_length), static_cast<Real>(radius),
                           static_cast<Real>(rounding)};
    return add_collider(world, body, cone, surface, out);
  });
}

plumb_status plumb_step(plumb_world* world, double dt) {
  return guarded(world, [&] { return pass_on(world, world->world.step(dt).status); });
}

double plumb_time(const plumb_world* world) { return world ? world->world.time() : 0; }
size_t plumb_body_count(const plumb_world* world) { return world ? world->world.body_count() : 0; }

plumb_status plumb_read_poses(plumb_world* world, plumb_pose* out, size_t capacity, size_t* count) {
  return guarded(world, [&] {
    if (!count || (!out && capacity > 0)) return null_pointer(world);
    world->world.copy_body_states(world->states);
    return write_poses(world, out, capacity, count);
  });
}

plumb_status plumb_read_moved_poses(plumb_world* world, plumb_pose* out, size_t capacity,
                                    size_t* count) {
  return guarded(world, [&] {
    if (!count || (!out && capacity > 0)) return null_pointer(world);
    world->world.copy_moved_body_states(world->states);
    return write_poses(world, out, capacity, count);
  });
}

plumb_status plumb_cast_ray(plumb_world* world, const double origin[3], const double translation[3],
                            plumb_ray_hit* out) {
  return guarded(world, [&] {
    if (!origin || !translation || !out) return null_pointer(world);
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(origin[k]) || !std::isfinite(translation[k]))
        return fail(world, PLUMB_NOT_FINITE, "origin and translation of a ray must be finite");
    }
    *out = plumb_ray_hit{};
    const auto hit = world->world.cast_ray(pos3(origin), vec3(translation));
    if (!hit) return PLUMB_OK;
    out->hit = 1;
    out->body = hit->body.value();
    out->collider = hit->collider.value();
    write3(hit->point, out->point);
    write3(hit->normal, out->normal);
    out->fraction = static_cast<double>(hit->fraction);
    return PLUMB_OK;
  });
}
