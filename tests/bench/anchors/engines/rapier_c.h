// The C interface of rapier/src/lib.rs: a scene in plain numbers, and what steps it.
#pragma once

#include <cstdint>

extern "C" {

struct RapierBody {
  std::int32_t kind;     // of anchors::ShapeKind
  std::int32_t dynamic;  // 0: static
  std::uint32_t hull;
  float half[3], radius, half_length;  // [m]
  float position[3], turn[4];          // [m], quaternion x y z w
  float velocity[3], spin[3];          // [m/s], [rad/s]
  float mass, inertia[3];              // [kg], [kg m^2] principal
  float force[3];                      // [N] always, at the centre of mass
};

struct RapierJoint {
  std::int32_t a, b;       // places among all bodies; a may be -1: the world
  float at_a[3], at_b[3];  // [m]
};

struct RapierScene {
  float gravity[3], friction, friction_of_bodies, restitution;
  std::int32_t collide, sleeping;
  const RapierBody* bodies;
  std::size_t body_count;
  const float* points;               // of all hulls, three numbers each
  const std::uint32_t* hull_starts;  // first point of each hull, and the end
  std::size_t hull_count;
  const float* vertices;  // of the mesh, three numbers each
  std::size_t vertex_count;
  const std::uint32_t* corners;  // three a triangle
  std::size_t triangle_count;
  const RapierJoint* joints;
  std::size_t joint_count;
};

void* plumb_rapier_new(const RapierScene* scene, std::size_t threads);
void plumb_rapier_step(void* world, float dt);
// Thirteen numbers a body: position, quaternion x y z w, velocity, spin.
void plumb_rapier_read(const void* world, float* out);
void plumb_rapier_free(void* world);
}
