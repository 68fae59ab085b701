/* Plumb for C and for every language that can call C.
 *
 *   plumb_world* world = NULL;
 *   plumb_world_create(NULL, &world);
 *   plumb_body_def def = plumb_body_default();
 *   plumb_body ball = 0;
 *   plumb_body_create(world, &def, &ball);
 *   plumb_add_sphere(world, ball, 0.5, NULL, NULL);
 *   plumb_step(world, 1.0 / 60);
 *
 * Every call returns a status and changes nothing when it is not PLUMB_OK; plumb_message() then
 * says why. Numbers are doubles and SI units whatever the build computes in. Not thread-safe: one
 * thread at a time for each world. */
#ifndef PLUMB_INTEGRATION_PLUMB_C_H
#define PLUMB_INTEGRATION_PLUMB_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Raised when a struct or the meaning of a call changes. */
#define PLUMB_C_ABI_VERSION 1

typedef struct plumb_world plumb_world;
typedef uint64_t plumb_body;     /* 0: none */
typedef uint64_t plumb_collider; /* 0: none */

typedef enum plumb_status {
  PLUMB_OK = 0,
  PLUMB_STALE_HANDLE = 1,
  PLUMB_NOT_FINITE = 2,
  PLUMB_OUT_OF_RANGE = 3,
  PLUMB_BAD_SHAPE = 4,
  PLUMB_BAD_MASS = 5,
  PLUMB_WRONG_MOTION_TYPE = 6,
  PLUMB_CAPACITY_EXCEEDED = 7,
  PLUMB_BAD_SNAPSHOT = 8,
  PLUMB_INSIDE_STEP = 9,
  PLUMB_NULL_POINTER = 100,
  PLUMB_OUT_OF_MEMORY = 101
} plumb_status;

typedef enum plumb_motion_type {
  PLUMB_STATIC = 0,
  PLUMB_KINEMATIC = 1,
  PLUMB_DYNAMIC = 2
} plumb_motion_type;

typedef struct plumb_settings {
  double gravity[3]; /* [m/s^2] */
  int32_t substeps;  /* [-] 1..64 */
  int32_t sleeping;  /* 0 or 1 */
  int32_t threads;   /* [-] 1..256; 0: as many as the machine has */
} plumb_settings;

typedef struct plumb_body_def {
  int32_t type;               /* plumb_motion_type */
  double position[3];         /* [m] */
  double orientation[4];      /* unit quaternion x, y, z, w */
  double linear_velocity[3];  /* [m/s] */
  double angular_velocity[3]; /* [rad/s] world axes */
  uint64_t user_data;         /* the caller's own */
} plumb_body_def;

typedef struct plumb_surface {
  double friction;       /* [-] >= 0 */
  double restitution;    /* [-] 0..1 */
  double density;        /* [kg/m^3] >= 0 */
  double position[3];    /* [m] of the shape in the body frame */
  double orientation[4]; /* unit quaternion x, y, z, w */
} plumb_surface;

typedef struct plumb_pose {
  plumb_body body;
  uint64_t user_data;
  double position[3];    /* [m] */
  double orientation[4]; /* unit quaternion x, y, z, w */
} plumb_pose;

typedef struct plumb_ray_hit {
  int32_t hit; /* 0: nothing was hit and the rest means nothing */
  plumb_body body;
  plumb_collider collider;
  double point[3];  /* [m] */
  double normal[3]; /* unit, outward */
  double fraction;  /* 0..1 along the ray */
} plumb_ray_hit;

/* PLUMB_C_ABI_VERSION of the library that is linked. */
uint32_t plumb_c_abi_version(void);
const char* plumb_version(void);

plumb_settings plumb_settings_default(void);
plumb_body_def plumb_body_default(void); /* dynamic, at rest, at the origin */
plumb_surface plumb_surface_default(void);

/* settings: NULL for the defaults. */
plumb_status plumb_world_create(const plumb_settings* settings, plumb_world** out);
void plumb_world_destroy(plumb_world* world); /* NULL does nothing */
/* Why the last call on this world that did not return PLUMB_OK did not; valid until the next one.
 */
const char* plumb_message(const plumb_world* world);

plumb_status plumb_body_create(plumb_world* world, const plumb_body_def* def, plumb_body* out);
plumb_status plumb_body_destroy(plumb_world* world, plumb_body body);
plumb_status plumb_body_set_pose(plumb_world* world, plumb_body body, const double position[3],
                                 const double orientation[4]);
plumb_status plumb_body_apply_impulse(plumb_world* world, plumb_body body, const double impulse[3]);

/* surface: NULL for the defaults. out: NULL if the collider's handle is of no use. */
plumb_status plumb_add_sphere(plumb_world* world, plumb_body body, double radius,
                              const plumb_surface* surface, plumb_collider* out);
plumb_status plumb_add_box(plumb_world* world, plumb_body body, const double half_extents[3],
                           const plumb_surface* surface, plumb_collider* out);
/* Along the y axis of the shape. */
plumb_status plumb_add_capsule(plumb_world* world, plumb_body body, double half_length,
                               double radius, const plumb_surface* surface, plumb_collider* out);
/* About the y axis of the shape, the origin in the middle; a cone's apex points to +y. rounding: >=
 * 0, radius of a ball added outside of these sizes [m]. */
plumb_status plumb_add_cylinder(plumb_world* world, plumb_body body, double half_length,
                                double radius, double rounding, const plumb_surface* surface,
                                plumb_collider* out);
plumb_status plumb_add_cone(plumb_world* world, plumb_body body, double half_length, double radius,
                            double rounding, const plumb_surface* surface, plumb_collider* out);

plumb_status plumb_step(plumb_world* world, double dt);
double plumb_time(const plumb_world* world); /* [s] simulated */
size_t plumb_body_count(const plumb_world* world);

/* Writes up to `capacity` poses, in the order of creation slots, and their full number to *count.
 * A capacity of 0 with out NULL asks for the number only. */
plumb_status plumb_read_poses(plumb_world* world, plumb_pose* out, size_t capacity, size_t* count);
/* Only of bodies that the last step moved. */
plumb_status plumb_read_moved_poses(plumb_world* world, plumb_pose* out, size_t capacity,
                                    size_t* count);

/* The nearest hit between origin and origin + translation [m]. */
plumb_status plumb_cast_ray(plumb_world* world, const double origin[3], const double translation[3],
                            plumb_ray_hit* out);

#ifdef __cplusplus
}
#endif

#endif
