// Scenes shared by tests, benchmarks and demos: one builder each, parametrised, so that a picture,
// a time and a proof are about the same thing. Every builder fills a world that the caller has made
// (settings are the caller's) and returns the handles that matter, in the order of building.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "support/build.h"
#include "support/random.h"

namespace plumb::inline PLUMB_ABI {
namespace scenes {

using namespace testing_support;

// A floor of finite size, its top at height y.
inline BodyId add_slab(PhysicsWorld& world, double half_x, double half_z,
                       const Material& surface = {}, double y = 0) {
  return add(world, body_at(at(0, y - 1, 0), MotionType::Static),
             with(box(half_x, 1, half_z), surface));
}

// --- stacks
// ----------------------------------------------------------------------------------------
struct Stack {
  int count = 10;
  double half = 0.5;      // [m] half edge of each cube
  double gap = 0;         // [m] between neighbours; negative: overlap
  double shift = 0;       // [m] sideways, alternating +-
  double density = 1000;  // [kg/m^3] of the lowest cube
  double growth = 1;      // density of each cube over that of the one below
  Material surface = {};
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();  // [m] point of the floor below the stack
};
struct Built {
  BodyId ground;
  std::vector<BodyId> bodies;
};

// A column of cubes on an endless floor.
inline Built build_stack(PhysicsWorld& world, const Stack& stack = {}) {
  Built built;
  built.ground = add_floor(world, stack.surface, Eigen::Vector3d::UnitY(), stack.foot.y());
  double density = stack.density;
  for (int i = 0; i < stack.count; ++i, density *= stack.growth) {
    const Eigen::Vector3d p =
        stack.foot + Eigen::Vector3d((i % 2 == 0 ? 1 : -1) * stack.shift,
                                     stack.half * (1 + 2 * i) + stack.gap * (i + 1), 0);
    built.bodies.push_back(add(world, body_at(at(p, Quat::Identity())),
                               with(cube(stack.half), stack.surface, density)));
  }
  return built;
}

// Boxes of one metre on a slab, with more ways to make it hard.
struct Column {
  int count = 10;
  double growth = 1;  // density of each box over that of the one below
  double shift = 0;   // [m] sideways, alternating +-
  double tilt = 0;    // [rad] each box turned by up to so much about a direction of its own
  double gap = 0;     // [m] between neighbours
  double density = 1000;
  Material surface = {};
};
inline Built build_column(PhysicsWorld& world, const Column& column = {}) {
  Built built;
  built.ground = add_slab(world, 100, 100, column.surface);
  Random random(7);
  double density = column.density;
  for (int i = 0; i < column.count; ++i, density *= column.growth) {
    const Eigen::Vector3d p((i % 2 == 0 ? 1 : -1) * column.shift, 0.5 + i + column.gap * (i + 1),
                            0);
    Quat q = Quat::Identity();
    if (column.tilt > 0) q = random.rotation(column.tilt);
    built.bodies.push_back(add(world, body_at(at(p, q)), with(cube(0.5), column.surface, density)));
  }
  return built;
}

// --- pyramid
// ---------------------------------------------------------------------------------------
struct Pyramid {
  int base = 10;
  double half = 0.5;    // [m]
  double pitch = 1.05;  // [-] distance of neighbours in a row over their edge
  Material surface = {};
};

// One cube thick, each row one cube shorter than the row below.
inline Built build_pyramid(PhysicsWorld& world, const Pyramid& pyramid = {}) {
  Built built;
  const double edge = 2 * pyramid.half;
  built.ground = add_slab(world, 100 * edge, 100 * edge, pyramid.surface);
  for (int i = 0; i < pyramid.base; ++i) {
    const int row = pyramid.base - i;
    for (int j = 0; j < row; ++j) {
      const double x = (j - (row - 1) / 2.0) * pyramid.pitch * edge;
      built.bodies.push_back(add(world, body_at(at(x, pyramid.half + i * edge, 0)),
                                 with(cube(pyramid.half), pyramid.surface)));
    }
  }
  return built;
}

// --- slope
// -----------------------------------------------------------------------------------------
struct Slope {
  double angle = kPi / 6;  // [rad] from the horizontal, falling towards +x
  double friction = 0.5;
  Shape shape = cube(0.5);
  double height = 0.5;  // [m] of the shape's centre above the slope when it touches
  std::optional<MassProperties> mass = {};
  Eigen::Vector3d start =
      Eigen::Vector3d::Zero();  // [m] on the slope, down the slope is x, z level
};
struct OnSlope {
  BodyId ground, body;
  Eigen::Vector3d down, normal;  // unit
};

inline OnSlope build_slope(PhysicsWorld& world, const Slope& slope = {}) {
  OnSlope built;
  built.normal = {std::sin(slope.angle), std::cos(slope.angle), 0};
  built.down = {std::cos(slope.angle), -std::sin(slope.angle), 0};
  const Material surface = material(slope.friction);
  built.ground = add_floor(world, surface, built.normal);
  const Quat tilted = turn(-slope.angle, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d p = slope.start.x() * built.down +
                            (slope.height + slope.start.y()) * built.normal +
                            slope.start.z() * Eigen::Vector3d::UnitZ();
  RigidBody body = body_at(at(p, tilted));
  body.mass = slope.mass;
  built.body = add(world, body, with(slope.shape, surface));
  return built;
}

// --- cradle
// ----------------------------------------------------------------------------------------
struct Cradle {
  int count = 5;
  int moving = 1;          // so many balls at the left end come in together
  double speed = 1;        // [m/s]
  double radius = 0.5;     // [m]
  double gap = 0;          // [m] between neighbours
  double approach = 0.25;  // [m] the moving balls start so far away
  double restitution = 1;
};

// Balls in a row along x, without strings; for a world without gravity.
inline std::vector<BodyId> build_cradle(PhysicsWorld& world, const Cradle& cradle = {}) {
  std::vector<BodyId> balls;
  for (int i = 0; i < cradle.count; ++i) {
    const bool in = i < cradle.moving;
    const double x = i * (2 * cradle.radius + cradle.gap) - (in ? cradle.approach : 0);
    balls.push_back(add(world, moving(at(x, 0, 0), vec(in ? cradle.speed : 0, 0, 0)),
                        with(sphere(cradle.radius), material(0, cradle.restitution))));
  }
  return balls;
}

// --- many bodies
// -----------------------------------------------------------------------------------
struct Pile {
  int side = 16;  // side^3 bodies
  std::uint32_t seed = 2;
};

// Boxes, balls and capsules in turn, dropped between four walls.
inline Built build_pile(PhysicsWorld& world, const Pile& pile = {}) {
  Built built;
  built.ground = add_slab(world, 100, 100);
  const double w = 0.75 * pile.side + 1, t = w + 1;
  for (double s : {-1.0, 1.0}) {
    add(world, body_at(at(s * w, 20, 0), MotionType::Static), with(box(1, 20, t)));
    add(world, body_at(at(0, 20, s * w), MotionType::Static), with(box(t, 20, 1)));
  }
  Random random(pile.seed);
  const double middle = (pile.side - 1) / 2.0;
  int counter = 0;
  for (int j = 0; j < pile.side; ++j)
    for (int i = 0; i < pile.side; ++i)
      for (int k = 0; k < pile.side; ++k, ++counter) {
        const double x = (i - middle) * 1.5 + random.uniform(-0.05, 0.05);
        const double z = (k - middle) * 1.5 + random.uniform(-0.05, 0.05);
        const double y = 1 + 1.5 * j + random.uniform(-0.05, 0.05);
        const double a = random.uniform(0, 1), b = random.uniform(0, 1), d = random.uniform(0, 1);
        const Quat q = random.rotation(0.3);
        const Shape shape = counter % 3 == 0
                                ? Shape(box(0.35 + 0.15 * a, 0.35 + 0.15 * b, 0.35 + 0.15 * d))
                            : counter % 3 == 1 ? Shape(sphere(0.4 + 0.15 * a))
                                               : Shape(capsule(0.25 + 0.1 * b, 0.25 + 0.1 * a));
        built.bodies.push_back(add(world, body_at(at({x, y, z}, q)), with(shape)));
      }
  return built;
}

// Convex hulls in turn, dropped on a floor: side^3 bodies.
inline Built build_hull_pile(PhysicsWorld& world,
                             std::span<const std::shared_ptr<const HullGeometry>> hulls,
                             int side = 10, std::uint32_t seed = 3) {
  Built built;
  built.ground = add_slab(world, 100, 100);
  Random random(seed);
  const double middle = (side - 1) / 2.0;
  std::size_t counter = 0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      for (int k = 0; k < side; ++k, ++counter) {
        const double x = (i - middle) * 1.5 + random.uniform(-0.1, 0.1);
        const double z = (k - middle) * 1.5 + random.uniform(-0.1, 0.1);
        const Quat q = random.rotation(kPi);
        built.bodies.push_back(add(world, body_at(at({x, 1 + 1.5 * j, z}, q)),
                                   with(ConvexHull{hulls[counter % hulls.size()]})));
      }
  return built;
}

// Boxes with three different moments turning freely, no two of which can meet; for no gravity.
inline Built build_free(PhysicsWorld& world, int count, std::uint32_t seed = 4) {
  Built built;
  Random random(seed);
  Collider collider = with(box(0.2, 0.4, 0.6));
  collider.filter.collides_with = 0;
  for (int c = 0; c < count; ++c) {
    const double x = 3.0 * (c % 45), z = 3.0 * (c / 45 % 45), y = 3.0 * (c / (45 * 45));
    const auto three = [&](double m) {
      const double a = random.uniform(-m, m), b = random.uniform(-m, m), d = random.uniform(-m, m);
      return Eigen::Vector3d(a, b, d);
    };
    const Eigen::Vector3d w = three(5), v = three(0.1);
    built.bodies.push_back(
        add(world, moving(at({x, y, z}, random.rotation(kPi)), vec(v), vec(w)), collider));
  }
  return built;
}

// Unit boxes side by side on a floor, touching only the floor.
inline Built build_spread(PhysicsWorld& world, int count, double pitch = 2) {
  Built built;
  const int columns = std::max(1, static_cast<int>(std::ceil(std::sqrt(count))));
  const double middle = (columns - 1) / 2.0, half = columns * pitch;
  built.ground = add_slab(world, half, half);
  for (int c = 0; c < count; ++c)
    built.bodies.push_back(
        add(world, body_at(at((c % columns - middle) * pitch, 0.5, (c / columns - middle) * pitch)),
            with(cube(0.5))));
  return built;
}

// --- bouncing
// -------------------------------------------------------------------------------------- side x
// side elastic balls without friction, 0.1 m and 10 kg each, 5 m above a floor. [Kang and Hwangbo
// 2018]
inline Built build_bouncing(PhysicsWorld& world, int side = 7) {
  Built built;
  const Material surface = material(0, 1);
  built.ground = add_floor(world, surface);
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      RigidBody body = body_at(at(i - (side - 1) / 2.0, 5, k - (side - 1) / 2.0));
      body.mass = inertia_of::solid_sphere(10, 0.1);
      built.bodies.push_back(add(world, body, with(sphere(0.1), surface)));
    }
  return built;
}

// 6 x 6 x 6 frictionless balls in a jittered grid. [Kang and Hwangbo 2018]
struct BallGrid {
  double restitution = 0;
  double lowest = 0.101;  // [m] height of the first layer's centres
  int side = 6;
  std::uint32_t seed = 666;
};
inline Built build_ball_grid(PhysicsWorld& world, const BallGrid& grid = {}) {
  Built built;
  const Material surface = material(0, grid.restitution);
  built.ground = add_floor(world, surface);
  Random random(grid.seed);
  for (int j = 0; j < grid.side; ++j)
    for (int i = 0; i < grid.side; ++i)
      for (int k = 0; k < grid.side; ++k) {
        const double x = 0.21 * i + random.uniform(0, 1e-3);
        const double z = 0.21 * k + random.uniform(0, 1e-3);
        const double y = grid.lowest + 0.21 * j + random.uniform(0, 1e-3);
        RigidBody body = body_at(at(x, y, z));
        body.mass = inertia_of::solid_sphere(10, 0.1);
        built.bodies.push_back(add(world, body, with(sphere(0.1), surface)));
      }
  return built;
}

// Mixed convex bodies flying at and through each other; for no gravity.
struct Cluster {
  int count = 40;
  double friction = 0.5, restitution = 0.3;
  double speed = 3;  // [m/s] towards the middle
  double spin = 4;   // [rad/s]
  std::uint32_t seed = 10;
};
inline Built build_cluster(PhysicsWorld& world, const Cluster& cluster = {}) {
  Built built;
  Random random(cluster.seed);
  const int side = static_cast<int>(std::ceil(std::cbrt(cluster.count)));
  const double middle = (side - 1) / 2.0;
  for (int c = 0; c < cluster.count; ++c) {
    const Eigen::Vector3d cell(c % side - middle, c / side % side - middle,
                               c / (side * side) - middle);
    const Eigen::Vector3d v = -cluster.speed * (cell + 0.3 * random.direction());
    const Eigen::Vector3d w = cluster.spin * random.direction();
    const Quat q = random.rotation(kPi);
    const double density = random.uniform(500, 2000);
    const Shape shape = c % 3 == 0   ? Shape(box(0.3, 0.4, 0.5))
                        : c % 3 == 1 ? Shape(sphere(0.45))
                                     : Shape(capsule(0.3, 0.25));
    built.bodies.push_back(
        add(world, moving(at(1.5 * cell, q), vec(v), vec(w)),
            with(shape, material(cluster.friction, cluster.restitution), density)));
  }
  return built;
}

}  // namespace scenes
}  // namespace plumb::inline PLUMB_ABI
