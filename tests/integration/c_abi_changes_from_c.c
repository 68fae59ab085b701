/* Compiled as C: proves that what lives can be changed through the C interface, that contact data
 * set through it act, and that what is wrong is refused. Every function returns NULL or what went
 * wrong. */
#include <math.h>
#include <string.h>

#include "plumb/integration/plumb_c.h"

#define REQUIRE(condition)               \
  do {                                   \
    if (!(condition)) return #condition; \
  } while (0)

const char* c_abi_change_bodies(void);
const char* c_abi_change_colliders(void);
const char* c_abi_set_contact_data(void);
const char* c_abi_refuse_bad_changes(void);

/* A world with a floor whose top is at 0 and, above it, `count` boxes of half a metre, 3 m apart.
 */
static plumb_status make_scene(plumb_world** world, double height, int type, plumb_body* bodies,
                               plumb_collider* colliders, int count) {
  const double slab[3] = {50, 0.5, 5}, half[3] = {0.25, 0.25, 0.25};
  plumb_body_def def = plumb_body_default();
  plumb_body ground = 0;
  int k;
  plumb_status status = plumb_world_create(NULL, world);
  if (status != PLUMB_OK) return status;
  def.type = PLUMB_STATIC;
  def.position[1] = -0.5;
  status = plumb_body_create(*world, &def, &ground);
  if (status == PLUMB_OK) status = plumb_add_box(*world, ground, slab, NULL, &colliders[count]);
  bodies[count] = ground;
  for (k = 0; k < count && status == PLUMB_OK; ++k) {
    def.type = type;
    def.position[0] = 3 * k;
    def.position[1] = height;
    status = plumb_body_create(*world, &def, &bodies[k]);
    if (status == PLUMB_OK)
      status = plumb_add_rounded_box(*world, bodies[k], half, 0, NULL, &colliders[k]);
  }
  return status;
}

static plumb_pose pose_of(plumb_world* world, plumb_body body) {
  plumb_pose poses[8], none;
  size_t count = 0, k;
  memset(&none, 0, sizeof none);
  if (plumb_read_poses(world, poses, 8, &count) != PLUMB_OK) return none;
  for (k = 0; k < count && k < 8; ++k)
    if (poses[k].body == body) return poses[k];
  return none;
}

static void run(plumb_world* world, int steps) {
  for (; steps > 0; --steps) (void)plumb_step(world, 1.0 / 60);
}

const char* c_abi_change_bodies(void) {
  plumb_world* world = NULL;
  plumb_body b[5];
  plumb_collider c[5];
  plumb_mass mass = {2, {0, 0, 0}, {0.1, 0.2, 0.25, 0, 0, 0}};
  const double push[3] = {1, 0, 0};
  double before;

  REQUIRE(make_scene(&world, 10, PLUMB_STATIC, b, c, 4) == PLUMB_OK);
  run(world, 10);
  REQUIRE(pose_of(world, b[0]).position[1] == 10);
  REQUIRE(plumb_body_set_motion_type(world, b[0], PLUMB_DYNAMIC) == PLUMB_OK);
  REQUIRE(plumb_body_set_motion_type(world, b[1], PLUMB_DYNAMIC) == PLUMB_OK);
  REQUIRE(plumb_body_set_locks(world, b[1], PLUMB_LOCK_LINEAR_Y | PLUMB_LOCK_ANGULAR_Z) ==
          PLUMB_OK);
  REQUIRE(plumb_body_set_motion_type(world, b[2], PLUMB_DYNAMIC) == PLUMB_OK);
  REQUIRE(plumb_body_set_gravity_scale(world, b[2], 0) == PLUMB_OK);
  REQUIRE(plumb_body_set_can_sleep(world, b[2], 0) == PLUMB_OK);
  REQUIRE(plumb_body_set_continuous(world, b[2], 1) == PLUMB_OK);
  REQUIRE(plumb_body_set_user_data(world, b[2], 77) == PLUMB_OK);
  REQUIRE(plumb_body_set_mass(world, b[2], &mass) == PLUMB_OK);
  REQUIRE(plumb_body_set_damping(world, b[2], 1, 0) == PLUMB_OK);
  REQUIRE(plumb_body_apply_impulse(world, b[2], push) == PLUMB_OK);
  run(world, 60);
  /* One fell for a second, one may not, one coasts from 0.5 m/s against 1/s. */
  REQUIRE(fabs(pose_of(world, b[0]).position[1] - (10 - 9.81 / 2)) < 1e-3);
  REQUIRE(pose_of(world, b[1]).position[1] == 10);
  REQUIRE(pose_of(world, b[2]).user_data == 77);
  REQUIRE(fabs(pose_of(world, b[2]).position[0] - (6 + 0.5 * (1 - exp(-1)))) < 1e-4);
  REQUIRE(plumb_body_derive_mass(world, b[2]) == PLUMB_OK);
  /* 125 kg again: the same push is hardly felt. */
  REQUIRE(plumb_body_set_motion_type(world, b[2], PLUMB_STATIC) == PLUMB_OK);
  REQUIRE(plumb_body_set_motion_type(world, b[2], PLUMB_DYNAMIC) == PLUMB_OK);
  before = pose_of(world, b[2]).position[0];
  REQUIRE(plumb_body_set_damping(world, b[2], 0, 0) == PLUMB_OK);
  REQUIRE(plumb_body_apply_impulse(world, b[2], push) == PLUMB_OK);
  run(world, 60);
  REQUIRE(fabs(pose_of(world, b[2]).position[0] - before - 1.0 / 125) < 1e-4);
  plumb_world_destroy(world);
  return NULL;
}

const char* c_abi_change_colliders(void) {
  plumb_world* world = NULL;
  plumb_body b[6];
  plumb_collider c[6];
  plumb_ray_hit hit;
  const double cube[3] = {0.5, 0.5, 0.5}, up[3] = {0, 1, 0}, straight[4] = {0, 0, 0, 1};
  const double none[3] = {0, 0, 0}, down[3] = {0, -20, 0};
  const double tops[5] = {0.4, 0.6, 0.75, 0.7, 1.25};
  int k;

  REQUIRE(make_scene(&world, 0, PLUMB_STATIC, b, c, 5) == PLUMB_OK);
  REQUIRE(plumb_collider_set_sphere(world, c[0], 0.4) == PLUMB_OK);
  REQUIRE(plumb_collider_set_box(world, c[1], cube, 0.1) == PLUMB_OK);
  REQUIRE(plumb_collider_set_capsule(world, c[2], 0.5, 0.25) == PLUMB_OK);
  REQUIRE(plumb_collider_set_cylinder(world, c[3], 0.6, 0.25, 0.1) == PLUMB_OK);
  REQUIRE(plumb_collider_set_cone(world, c[4], 0.6, 0.5, 0) == PLUMB_OK);
  REQUIRE(plumb_collider_set_sphere(world, c[4], 0.25) == PLUMB_OK);
  REQUIRE(plumb_collider_set_pose(world, c[4], up, straight) == PLUMB_OK);
  for (k = 0; k < 5; ++k) {
    const double from[3] = {3.0 * k, 10, 0};
    REQUIRE(plumb_cast_ray(world, from, down, &hit) == PLUMB_OK && hit.hit == 1);
    REQUIRE(hit.collider == c[k]);
    REQUIRE(fabs(hit.point[1] - tops[k]) < 1e-5);
  }
  REQUIRE(plumb_collider_destroy(world, c[0]) == PLUMB_OK);
  REQUIRE(plumb_collider_set_sphere(world, c[0], 1) == PLUMB_STALE_HANDLE);
  /* One that only senses lets fall what it is, and weighs nothing. */
  REQUIRE(plumb_body_set_motion_type(world, b[1], PLUMB_DYNAMIC) == PLUMB_OK);
  REQUIRE(plumb_collider_set_density(world, c[1], 10) == PLUMB_OK);
  REQUIRE(plumb_collider_set_sensor(world, c[1], 1) == PLUMB_OK);
  REQUIRE(plumb_collider_set_user_data(world, c[1], 5) == PLUMB_OK);
  run(world, 120);
  REQUIRE(pose_of(world, b[1]).position[1] < -10);
  REQUIRE(plumb_collider_set_pose(world, c[2], none, straight) == PLUMB_OK);
  plumb_world_destroy(world);
  return NULL;
}

const char* c_abi_set_contact_data(void) {
  plumb_world* world = NULL;
  plumb_body b[5];
  plumb_collider c[5];
  plumb_material m = plumb_material_default();
  plumb_material_pair pair = {PLUMB_PAIR_FRICTION, 0, 7, 7, 7};
  const double belt[3] = {1, 0, 0}, aside[3] = {20, 0.25, 0}, straight[4] = {0, 0, 0, 1};
  const double below[3] = {0, -1, 0};

  REQUIRE(make_scene(&world, 0.25, PLUMB_DYNAMIC, b, c, 4) == PLUMB_OK);
  run(world, 30);
  REQUIRE(plumb_collider_set_surface_velocity(world, c[4], belt, NULL) == PLUMB_OK);
  m.kind = 3;
  m.rolling_friction = 0.125;
  m.grain[2] = 1;
  m.grain_friction = 0.5;
  m.adhesion = 8;
  m.friction_rule = PLUMB_MULTIPLY;
  REQUIRE(plumb_collider_set_material(world, c[1], &m) == PLUMB_OK);
  memset(&m, 0, sizeof m);
  REQUIRE(plumb_collider_get_material(world, c[1], &m) == PLUMB_OK);
  REQUIRE(m.kind == 3 && m.rolling_friction == 0.125 && m.grain[2] == 1 && m.grain_friction == 0.5 &&
          m.adhesion == 8 && m.friction_rule == PLUMB_MULTIPLY);
  m = plumb_material_default();
  REQUIRE(m.grain_friction == 1 && m.adhesion == 0);
  m.kind = 4;
  REQUIRE(plumb_collider_set_material(world, c[4], &m) == PLUMB_OK);
  REQUIRE(plumb_set_material_pair(world, 4, 3, &pair) == PLUMB_OK);
  REQUIRE(plumb_exclude_bodies(world, b[2], b[4], 1) == PLUMB_OK);
  run(world, 120);
  /* The belt carries one, slides below the next, does not meet the third. */
  REQUIRE(pose_of(world, b[0]).position[0] > 1.5);
  REQUIRE(fabs(pose_of(world, b[1]).position[0] - 3) < 1e-3);
  REQUIRE(pose_of(world, b[2]).position[1] < -5);
  REQUIRE(plumb_set_material_pair(world, 3, 4, NULL) == PLUMB_OK);
  run(world, 60);
  REQUIRE(pose_of(world, b[1]).position[0] > 3.2);

  REQUIRE(plumb_exclude_colliders(world, c[1], c[4], 1) == PLUMB_OK);
  run(world, 60);
  REQUIRE(pose_of(world, b[1]).position[1] < -1);
  REQUIRE(plumb_exclude_bodies(world, b[2], b[4], 0) == PLUMB_OK);
  REQUIRE(plumb_collider_set_surface_velocity(world, c[4], NULL, NULL) == PLUMB_OK);
  REQUIRE(plumb_body_set_pose(world, b[2], aside, straight) == PLUMB_OK);
  run(world, 60);
  REQUIRE(fabs(pose_of(world, b[2]).position[1] - 0.25) < 0.01);
  REQUIRE(plumb_collider_set_filter(world, c[2], 1, 0xffffffffu, -5) == PLUMB_OK);
  REQUIRE(plumb_collider_set_filter(world, c[4], 1, 0xffffffffu, -5) == PLUMB_OK);
  run(world, 60);
  REQUIRE(pose_of(world, b[2]).position[1] < -1);
  REQUIRE(fabs(pose_of(world, b[0]).position[1] - 0.25) < 0.01);
  REQUIRE(plumb_collider_set_one_way(world, c[4], below) == PLUMB_OK);
  run(world, 60);
  REQUIRE(pose_of(world, b[0]).position[1] < -1);
  plumb_world_destroy(world);
  return NULL;
}

const char* c_abi_refuse_bad_changes(void) {
  plumb_world* world = NULL;
  plumb_body b[2];
  plumb_collider c[2];
  plumb_material m = plumb_material_default();
  plumb_material_pair pair = {PLUMB_PAIR_RESTITUTION, 0, NAN, 0, 0};
  plumb_mass mass = {0, {0, 0, 0}, {1, 1, 1, 0, 0, 0}};
  const double bad[3] = {0, NAN, 0}, zero[4] = {0, 0, 0, 0}, here[3] = {0, 0, 0};

  REQUIRE(make_scene(&world, 0.25, PLUMB_DYNAMIC, b, c, 1) == PLUMB_OK);
  REQUIRE(plumb_body_set_motion_type(world, b[0], 3) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_body_set_motion_type(world, 0, PLUMB_STATIC) == PLUMB_STALE_HANDLE);
  REQUIRE(plumb_body_set_motion_type(NULL, b[0], PLUMB_STATIC) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_body_set_locks(world, b[0], 64) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_body_set_damping(world, b[0], -1, 0) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_body_set_gravity_scale(world, b[0], NAN) == PLUMB_NOT_FINITE);
  REQUIRE(plumb_body_set_mass(world, b[0], NULL) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_body_set_mass(world, b[0], &mass) == PLUMB_BAD_MASS);
  REQUIRE(plumb_body_derive_mass(world, b[1]) == PLUMB_WRONG_MOTION_TYPE);
  REQUIRE(plumb_add_rounded_box(world, b[0], NULL, 0, NULL, NULL) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_collider_set_box(world, c[0], NULL, 0) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_collider_set_sphere(world, c[0], -1) != PLUMB_OK);
  REQUIRE(plumb_collider_set_pose(world, c[0], bad, zero) == PLUMB_NOT_FINITE);
  REQUIRE(plumb_collider_set_pose(world, c[0], here, zero) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_collider_set_density(world, c[0], -1) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_collider_set_surface_velocity(world, c[0], bad, NULL) == PLUMB_NOT_FINITE);
  REQUIRE(plumb_collider_set_one_way(world, c[0], bad) == PLUMB_NOT_FINITE);
  REQUIRE(plumb_collider_set_one_way(world, c[0], NULL) == PLUMB_NULL_POINTER);
  REQUIRE(plumb_collider_set_material(world, c[0], NULL) == PLUMB_NULL_POINTER);
  m.friction_rule = 5;
  REQUIRE(plumb_collider_set_material(world, c[0], &m) == PLUMB_OUT_OF_RANGE);
  m = plumb_material_default();
  m.torsional_friction = -1;
  REQUIRE(plumb_collider_set_material(world, c[0], &m) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_collider_get_material(world, 0, &m) == PLUMB_STALE_HANDLE);
  REQUIRE(plumb_set_material_pair(world, 0, 1, NULL) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_set_material_pair(world, 2, 1, &pair) == PLUMB_OUT_OF_RANGE);
  pair.given = 16;
  REQUIRE(plumb_set_material_pair(world, 2, 1, &pair) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_exclude_bodies(world, b[0], b[0], 1) == PLUMB_OUT_OF_RANGE);
  REQUIRE(plumb_exclude_colliders(world, c[0], 0, 1) == PLUMB_STALE_HANDLE);
  REQUIRE(strlen(plumb_message(world)) > 0);
  run(world, 60);
  REQUIRE(fabs(pose_of(world, b[0]).position[1] - 0.25) < 0.01);
  plumb_world_destroy(world);
  return NULL;
}
