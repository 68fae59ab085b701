/* Compiled as C: proves that the header is C and that the library can be used from it. Every function
 * returns NULL or what went wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plumb/integration/plumb_c.h"

#define REQUIRE(condition) \
  do {                     \
    if (!(condition)) return #condition; \
  } while (0)

const char* c_abi_drop_a_ball(void);
const char* c_abi_refuse_bad_input(void);
const char* c_abi_read_in_bulk(void);
const char* c_abi_cast_rays(void);

const char* c_abi_drop_a_ball(void) {
  plumb_world* world = NULL;
  plumb_body ground = 0, ball = 0;
  plumb_pose poses[2];
  size_t count = 0;
  int k;
  plumb_body_def def = plumb_body_default();
  const double slab[3] = {5, 0.5, 5};

  REQUIRE(plumb_c_abi_version() == PLUMB_C_ABI_VERSION);
  REQUIRE(strlen(plumb_version()) > 0);
  REQUIRE(plumb_world_create(NULL, &world) == PLUMB_OK);
  def.type = PLUMB_STATIC;
  def.position[1] = -0.5;
  REQUIRE(plumb_body_create(world, &def, &ground) == PLUMB_OK);
  REQUIRE(plumb_add_box(world, ground, slab, NULL, NULL) == PLUMB_OK);
  def.type = PLUMB_DYNAMIC;
  def.position[1] = 3;
  def.user_data = 42;
  REQUIRE(plumb_body_create(world, &def, &ball) == PLUMB_OK);
  REQUIRE(plumb_add_sphere(world, ball, 0.5, NULL, NULL) == PLUMB_OK);
  for (k = 0; k < 240; ++k) REQUIRE(plumb_step(world, 1.0 / 60) == PLUMB_OK);
  REQUIRE(fabs(plumb_time(world) - 4) < 1e-9);
  REQUIRE(plumb_read_poses(world, poses, 2, &count) == PLUMB_OK);
  REQUIRE(count == 2 && plumb_body_count(world) == 2);
  REQUIRE(poses[1].body == ball && poses[1].user_data == 42);
  /* At rest on the slab, within the overlap that a resting contact keeps (under 1 % of its size). */
  REQUIRE(fabs(poses[1].position[1] - 0.5) < 0.005);
  plumb_world_destroy(world);
  return NULL;
}

const char* c_abi_refuse_bad_input(void) {
  plumb_world* world = NULL;
  plumb_body body = 0;
  plumb_settings settings = plumb_settings_default();
  plumb_body_def def = plumb_body_default();
  const double flat[3] = {1, 0, 1};

  REQUIRE(plumb_world_create(NULL, NULL) == PLUMB_NULL_POINTER);
  settings.substeps = 0;
  REQUIRE(plumb_world_create(&settings, &world) == PLUMB_OUT_OF_RANGE && world == NULL);
  settings = plumb_settings_default();
  settings.threads = 2;
  REQUIRE(plumb_world_create(&settings, &world) == PLUMB_OK);

  REQUIRE(plumb_body_create(world, NULL, &body) == PLUMB_NULL_POINTER);
  def.type = 7;
  REQUIRE(plumb_body_create(world, &def, &body) == PLUMB_OUT_OF_RANGE);
  REQUIRE(strlen(plumb_message(world)) > 0);
  def = plumb_body_default();
  def.position[2] = NAN;
  REQUIRE(plumb_body_create(world, &def, &body) == PLUMB_NOT_FINITE);
  REQUIRE(body == 0 && plumb_body_count(world) == 0);
  REQUIRE(plumb_add_sphere(world, 0, 1, NULL, NULL) == PLUMB_STALE_HANDLE);
  def = plumb_body_default();
  REQUIRE(plumb_body_create(world, &def, &body) == PLUMB_OK);
  REQUIRE(plumb_add_sphere(world, body, -1, NULL, NULL) != PLUMB_OK);
  REQUIRE(plumb_add_box(world, body, flat, NULL, NULL) != PLUMB_OK);
  REQUIRE(plumb_add_box(world, body, NULL, NULL, NULL) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_step(world, -1) != PLUMB_OK);
  REQUIRE(plumb_step(world, NAN) != PLUMB_OK);
  REQUIRE(plumb_step(NULL, 0.01) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_body_destroy(world, body) == PLUMB_OK);
  REQUIRE(plumb_body_destroy(world, body) == PLUMB_STALE_HANDLE);
  plumb_world_destroy(world);
  plumb_world_destroy(NULL);
  return NULL;
}

const char* c_abi_read_in_bulk(void) {
  enum { kBodies = 5 };
  plumb_world* world = NULL;
  plumb_pose poses[kBodies];
  plumb_body bodies[kBodies];
  size_t count = 0;
  int k;
  const double push[3] = {1, 0, 0}, there[3] = {0, 9, 0}, quarter[4] = {0, 0.6, 0, 0.8};
  plumb_settings settings = plumb_settings_default();

  memset(settings.gravity, 0, sizeof settings.gravity);
  REQUIRE(plumb_world_create(&settings, &world) == PLUMB_OK);
  for (k = 0; k < kBodies; ++k) {
    plumb_body_def def = plumb_body_default();
    def.type = k < 3 ? PLUMB_STATIC : PLUMB_DYNAMIC;
    def.position[0] = 3 * k;
    def.user_data = (uint64_t)(100 + k);
    REQUIRE(plumb_body_create(world, &def, &bodies[k]) == PLUMB_OK);
    REQUIRE(plumb_add_capsule(world, bodies[k], 0.5, 0.25, NULL, NULL) == PLUMB_OK);
  }
  REQUIRE(plumb_body_set_pose(world, bodies[4], there, quarter) == PLUMB_OK);
  REQUIRE(plumb_body_apply_impulse(world, bodies[3], push) == PLUMB_OK);
  REQUIRE(plumb_step(world, 0.01) == PLUMB_OK);

  REQUIRE(plumb_read_poses(world, NULL, 0, &count) == PLUMB_OK && count == kBodies);
  memset(poses, 0, sizeof poses);
  REQUIRE(plumb_read_poses(world, poses, 2, &count) == PLUMB_OK && count == kBodies);
  REQUIRE(poses[1].user_data == 101 && poses[2].user_data == 0); /* not past the capacity */
  REQUIRE(plumb_read_poses(world, poses, kBodies, &count) == PLUMB_OK);
  REQUIRE(poses[4].position[1] == 9);
  REQUIRE(fabs(poses[4].orientation[1] - 0.6) < 1e-6 && fabs(poses[4].orientation[3] - 0.8) < 1e-6);
  REQUIRE(poses[3].position[0] > 9);
  /* Static bodies never move. */
  REQUIRE(plumb_read_moved_poses(world, poses, kBodies, &count) == PLUMB_OK);
  REQUIRE(count >= 1 && count <= 2);
  REQUIRE(plumb_read_poses(world, NULL, 1, &count) == PLUMB_NULL_POINTER);
  plumb_world_destroy(world);
  return NULL;
}

const char* c_abi_cast_rays(void) {
  plumb_world* world = NULL;
  plumb_body body = 0;
  plumb_collider collider = 0;
  plumb_ray_hit hit;
  plumb_body_def def = plumb_body_default();
  plumb_surface surface = plumb_surface_default();
  const double from[3] = {0, 10, 0}, down[3] = {0, -20, 0}, up[3] = {0, 20, 0}, none[3] = {0, 0, NAN};

  REQUIRE(plumb_world_create(NULL, &world) == PLUMB_OK);
  def.type = PLUMB_STATIC;
  REQUIRE(plumb_body_create(world, &def, &body) == PLUMB_OK);
  surface.position[1] = 1;
  REQUIRE(plumb_add_sphere(world, body, 1, &surface, &collider) == PLUMB_OK);
  REQUIRE(plumb_step(world, 0.01) == PLUMB_OK);
  REQUIRE(plumb_cast_ray(world, from, down, &hit) == PLUMB_OK && hit.hit == 1);
  REQUIRE(hit.body == body && hit.collider == collider);
  /* The top of the sphere is at 2 m, 8 of 20 m down the ray; single precision may be in between. */
  REQUIRE(fabs(hit.point[1] - 2) < 1e-5 && fabs(hit.normal[1] - 1) < 1e-5);
  REQUIRE(fabs(hit.fraction - 0.4) < 1e-6);
  REQUIRE(plumb_cast_ray(world, from, up, &hit) == PLUMB_OK && hit.hit == 0);
  REQUIRE(plumb_cast_ray(world, from, none, &hit) == PLUMB_NOT_FINITE);
  REQUIRE(plumb_cast_ray(world, from, down, NULL) == PLUMB_NULL_POINTER);
  plumb_world_destroy(world);
  return NULL;
}
