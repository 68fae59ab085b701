// The component that gives a body a shape and a surface. A body may have any number of them.
#pragma once

#include <cstdint>

#include "plumb/material.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI {

struct Collider {
  Shape shape = Sphere{};
  LocalPose pose{};  // of the shape in the body frame
  Material material{};
  Filter filter{};
  double density = 1000;        // [kg/m^3] >= 0; 0: this collider adds no mass
  bool is_sensor = false;       // reports overlaps, never pushes, adds no mass
  std::uint64_t user_data = 0;  // the engine's own, never looked at
};

}  // namespace plumb::inline PLUMB_ABI
