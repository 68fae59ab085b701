// Bodies thrown at a surface at 5 to 500 m/s from 2 m above, to see that none passes.
#pragma once

#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

// Throws shapes of a few centimetres at a mesh and at a heightfield.
template <class ShapeOf>  // (trial) -> Shape
void expect_nothing_fast_passes(unsigned seed, const ShapeOf& shape_of) {
  using Eigen::Vector3d;
  constexpr double kDt = 1.0 / 60;  // [s]
  const std::vector<std::pair<Shape, Vector3d>> walls = {
      {SurfaceMesh{surfaces::made(surfaces::grid(-5, 5, -5, 5, 7, 7, surfaces::level, true))},
       {0, 0, 0}},
      {Heightfield{surfaces::field(11, 11, 1, [](int, int) { return 0.0; })}, {-5, 0, -5}}};
  oracle::Random random(seed);
  for (const auto& [shape, origin] : walls) {
    for (int trial = 0; trial < 60; ++trial) {
      PhysicsWorld world(no_sleep());
      add(world, body_at(at(origin, Quat::Identity()), MotionType::Static), with(shape));
      const double speed = random.scale(5, 500);
      const Vector3d slant(random.uniform(-0.5, 0.5), -1, random.uniform(-0.5, 0.5));
      // From 2 m above such that the flight ends within the wall.
      const Vector3d from = Vector3d(random.uniform(-1, 1), 0, random.uniform(-1, 1)) - 2 * slant;
      RigidBody flying = moving(at(from, turn(random.uniform(0, 3), slant + Vector3d(1, 0, 0))),
                                vec(speed * slant));
      const BodyId id = add(world, flying, with(shape_of(trial), material(0.9)));
      double lowest = 1;
      run(world, 1, kDt, [&] {
        const Vector3d p = position(world, id);
        if (std::abs(p.x()) < 4.8 && std::abs(p.z()) < 4.8) lowest = std::min(lowest, p.y());
      });
      // The sweep follows the path of a body, not its turning: an impact that sets it spinning may
      // press it in by up to half of its size, from where it comes back.
      EXPECT_GT(lowest, -0.05) << "trial " << trial << " speed " << speed;
      const Vector3d end = position(world, id);
      if (std::abs(end.x()) < 4.8 && std::abs(end.z()) < 4.8) {
        EXPECT_GT(end.y(), -0.005) << "trial " << trial << " speed " << speed;
      }
    }
  }
}

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
