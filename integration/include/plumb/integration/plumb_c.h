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

/* Axes that a body must not move along or turn about, to be added up. */
typedef enum plumb_lock {
  PLUMB_LOCK_LINEAR_X = 1,
  PLUMB_LOCK_LINEAR_Y = 2,
  PLUMB_LOCK_LINEAR_Z = 4,
  PLUMB_LOCK_ANGULAR_X = 8,
  PLUMB_LOCK_ANGULAR_Y = 16,
  PLUMB_LOCK_ANGULAR_Z = 32
} plumb_lock;

/* How two materials combine; where they name different rules, the later one wins. */
typedef enum plumb_combine_rule {
  PLUMB_AVERAGE = 0,
  PLUMB_GEOMETRIC_MEAN = 1,
  PLUMB_MINIMUM = 2,
  PLUMB_MAXIMUM = 3,
  PLUMB_MULTIPLY = 4
} plumb_combine_rule;

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

typedef struct plumb_mass {
  double mass;       /* [kg] > 0 */
  double center[3];  /* [m] in the body frame */
  double inertia[6]; /* [kg m^2] about the centre, body axes: xx, yy, zz, and xy, xz, yz with the
                        minus signs in */
} plumb_mass;

typedef struct plumb_material {
  double friction;           /* [-] >= 0 */
  double restitution;        /* [-] 0..1 */
  double rolling_friction;   /* [m] >= 0, lever arm of the contact force */
  double torsional_friction; /* [m] >= 0, likewise */
  int32_t friction_rule;     /* plumb_combine_rule */
  int32_t restitution_rule;  /* plumb_combine_rule */
  uint32_t kind;             /* for plumb_set_material_pair; 0: nothing in particular */
  double grain[3];           /* axis in the collider's frame; zeros: no grain */
  double grain_friction;     /* [-] 0..1, friction along the grain over that across it */
  double adhesion;           /* [N] >= 0, pull that a touching pair withstands */
} plumb_material;

/* The values of a plumb_material_pair that count, to be added up. */
typedef enum plumb_pair_value {
  PLUMB_PAIR_FRICTION = 1,
  PLUMB_PAIR_RESTITUTION = 2,
  PLUMB_PAIR_ROLLING_FRICTION = 4,
  PLUMB_PAIR_TORSIONAL_FRICTION = 8
} plumb_pair_value;

/* What two kinds of material do when they meet. Values that are not given are combined from the two
 * materials as ever. */
typedef struct plumb_material_pair {
  uint32_t given;            /* sum of plumb_pair_value */
  double friction;           /* [-] >= 0 */
  double restitution;        /* [-] 0..1 */
  double rolling_friction;   /* [m] >= 0 */
  double torsional_friction; /* [m] >= 0 */
} plumb_material_pair;

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
plumb_material plumb_material_default(void);

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

/* What a body was made with, changed while it lives; see plumb/world.h for what follows. */
plumb_status plumb_body_set_motion_type(plumb_world* world, plumb_body body, int32_t type);
plumb_status plumb_body_set_locks(plumb_world* world, plumb_body body, uint32_t locks);
plumb_status plumb_body_set_damping(plumb_world* world, plumb_body body, double linear,
                                    double angular); /* [1/s] >= 0 */
plumb_status plumb_body_set_gravity_scale(plumb_world* world, plumb_body body, double scale);
plumb_status plumb_body_set_can_sleep(plumb_world* world, plumb_body body, int32_t can_sleep);
plumb_status plumb_body_set_continuous(plumb_world* world, plumb_body body, int32_t continuous);
plumb_status plumb_body_set_user_data(plumb_world* world, plumb_body body, uint64_t user_data);
plumb_status plumb_body_set_mass(plumb_world* world, plumb_body body, const plumb_mass* mass);
/* Takes it back: mass from the densities of the colliders again. */
plumb_status plumb_body_derive_mass(plumb_world* world, plumb_body body);

/* surface: NULL for the defaults. out: NULL if the collider's handle is of no use. */
plumb_status plumb_add_sphere(plumb_world* world, plumb_body body, double radius,
                              const plumb_surface* surface, plumb_collider* out);
plumb_status plumb_add_box(plumb_world* world, plumb_body body, const double half_extents[3],
                           const plumb_surface* surface, plumb_collider* out);
/* rounding: >= 0, radius of a ball added outside of the box [m]. */
plumb_status plumb_add_rounded_box(plumb_world* world, plumb_body body,
                                   const double half_extents[3], double rounding,
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

plumb_status plumb_collider_destroy(plumb_world* world, plumb_collider collider);

/* What a collider was made with, changed while it lives. Shapes as in plumb_add_...; they keep
 * their handle, place and material. */
plumb_status plumb_collider_set_sphere(plumb_world* world, plumb_collider collider, double radius);
plumb_status plumb_collider_set_box(plumb_world* world, plumb_collider collider,
                                    const double half_extents[3], double rounding);
plumb_status plumb_collider_set_capsule(plumb_world* world, plumb_collider collider,
                                        double half_length, double radius);
plumb_status plumb_collider_set_cylinder(plumb_world* world, plumb_collider collider,
                                         double half_length, double radius, double rounding);
plumb_status plumb_collider_set_cone(plumb_world* world, plumb_collider collider,
                                     double half_length, double radius, double rounding);
plumb_status plumb_collider_set_pose(plumb_world* world, plumb_collider collider,
                                     const double position[3],
                                     const double orientation[4]); /* in the body frame */
plumb_status plumb_collider_set_density(plumb_world* world, plumb_collider collider,
                                        double density);
plumb_status plumb_collider_set_sensor(plumb_world* world, plumb_collider collider,
                                       int32_t is_sensor);
plumb_status plumb_collider_set_user_data(plumb_world* world, plumb_collider collider,
                                          uint64_t user_data);
plumb_status plumb_collider_set_material(plumb_world* world, plumb_collider collider,
                                         const plumb_material* material);
plumb_status plumb_collider_get_material(plumb_world* world, plumb_collider collider,
                                         plumb_material* out);
/* How the surface runs over its body, in the axes of the collider. NULL: not at all. */
plumb_status plumb_collider_set_surface_velocity(plumb_world* world, plumb_collider collider,
                                                 const double linear[3],   /* [m/s] */
                                                 const double angular[3]); /* [rad/s] */
/* The side from which it is solid, a direction out of it in its axes; zero: from everywhere. */
plumb_status plumb_collider_set_one_way(plumb_world* world, plumb_collider collider,
                                        const double direction[3]);
/* layers, collides_with: bits. Two of one group that is not 0 always meet if it is positive, never
 * if it is negative. */
plumb_status plumb_collider_set_filter(plumb_world* world, plumb_collider collider, uint32_t layers,
                                       uint32_t collides_with, int32_t group);

/* kinds: of plumb_material, not 0, in any order. values: NULL takes the entry away. */
plumb_status plumb_set_material_pair(plumb_world* world, uint32_t kind_a, uint32_t kind_b,
                                     const plumb_material_pair* values);
/* Excluded, two bodies or colliders never meet; excluded = 0 lets them again. */
plumb_status plumb_exclude_bodies(plumb_world* world, plumb_body a, plumb_body b, int32_t excluded);
plumb_status plumb_exclude_colliders(plumb_world* world, plumb_collider a, plumb_collider b,
                                     int32_t excluded);

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
