// The component that gives a body a shape and a surface. A body may have any number of them.
#pragma once

#include <cstdint>

#include "plumb/material.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI {

// How a surface runs over its own body, which stays where it is: a conveyor belt, a tread, a
// turntable. Friction acts relative to it. Only what lies in the contact plane counts.
struct SurfaceVelocity {
  Vec3 linear = Vec3::Zero();   // [m/s] in the collider's axes, finite
  Vec3 angular = Vec3::Zero();  // [rad/s] about the collider's origin, in its axes, finite
  friend bool operator==(const SurfaceVelocity&, const SurfaceVelocity&) = default;
};

struct Collider {
  Shape shape = Sphere{};
  LocalPose pose{};  // of the shape in the body frame
  Material material{};
  Filter filter{};
  double density = 1000;  // [kg/m^3] >= 0; 0: this collider adds no mass
  // Reports what overlaps it, never pushes, adds no mass. Sees every solid collider of a body that
  // is not static; on a body that is not static itself, the static ones too. Never another sensor.
  bool is_sensor = false;
  SurfaceVelocity surface_velocity{};
  // The side from which the collider is solid, as a direction out of it in its own axes [-] of any
  // length, finite; zero: solid from everywhere. What comes from elsewhere (more than 60 degrees
  // off) or overlaps it when they first meet passes through unhindered until it has left it.
  Vec3 one_way = Vec3::Zero();
  std::uint64_t user_data = 0;  // the engine's own, never looked at
};

}  // namespace plumb::inline PLUMB_ABI
