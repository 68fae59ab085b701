// A field of small islands, each by itself on one floor, some at rest and some not: what a level of
// detail in time is for. Shared by the test and the benchmark of it.
#pragma once

#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace scenes {

struct Field {
  std::vector<std::vector<BodyId>> islands;
};

// One island of ten kinds: four stacks at rest, a box that slides, a ball that rolls, a pile of two
// that overlap a little as they begin, a box that falls tumbling, two boxes that collide, a tower
// that topples.
inline std::vector<BodyId> add_island(PhysicsWorld& world, int kind, double x, double z,
                                      Random& random) {
  std::vector<BodyId> bodies;
  const auto put = [&](const RigidBody& body, const Shape& shape) {
    bodies.push_back(add(world, body, with(shape)));
  };
  const Quat heading = turn(random.uniform(0, 3), {0, 1, 0});
  const double speed = random.uniform(1, 3);  // [m/s]
  switch (kind) {
    case 4:
      put(moving(at({x, 0.3, z}, heading), vec(speed, 0, 0)), box(0.5, 0.3, 0.4));
      break;
    case 5:
      put(moving(at(x, 0.4, z), vec(speed, 0, 0)), sphere(0.4));
      break;
    case 6:
      for (int j = 0; j < 2; ++j)
        put(body_at(at({x + 0.3 * j, 0.5 + 0.998 * j, z}, heading)), cube(0.5));
      break;
    case 7:
      put(moving(at({x, speed, z}, random.rotation(3)), vec(1, 0, 0), vec(1, 2, 0)),
          box(0.3, 0.4, 0.5));
      break;
    case 8:
      put(body_at(at(x, 0.5, z)), cube(0.5));
      put(moving(at(x - 2, 0.4, z), vec(speed, 0, 0)), cube(0.4));
      break;
    case 9:
      put(body_at(at({x, 1.0, z}, turn(random.uniform(0.3, 0.4), {0, 0, 1}))), box(0.3, 1, 0.3));
      break;
    default:
      for (int j = 0; j < 3; ++j)
        put(body_at(at({x + random.uniform(-0.1, 0.1), 0.5 + j, z}, heading)), cube(0.5));
      break;
  }
  return bodies;
}

inline Field build_field(PhysicsWorld& world, int islands, std::uint32_t seed = 3) {
  constexpr int kColumns = 25;
  constexpr double kPitch = 8;  // [m]
  Field field;
  Random random(seed);
  add_slab(world, kPitch * kColumns, kPitch * std::max(kColumns, islands / kColumns));
  for (int i = 0; i < islands; ++i)
    field.islands.push_back(add_island(world, i % 10, kPitch * (i % kColumns - kColumns / 2),
                                       kPitch * (i / kColumns), random));
  return field;
}

}  // namespace scenes
}  // namespace plumb::inline PLUMB_ABI
