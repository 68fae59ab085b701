// A scene as plain data that belongs to no engine: ours and every peer are built from the same
// numbers. All bodies have their origin in their centre of mass and their axes along the principal
// ones, so that a pose means the same everywhere. SI units, y up, world axes unless said.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plumb::anchors {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Plane: of the ground alone; solid below the body's xz plane, as far as `half` where an engine has
// no planes and takes a box instead.
enum class ShapeKind { None, Box, Sphere, Capsule, Hull, Mesh, Plane };

struct Shape {
  ShapeKind kind = ShapeKind::None;
  Vector3d half = Vector3d::Zero();  // [m] of a box or a plane
  double radius = 0;                 // [m] of a sphere or capsule
  double half_length = 0;            // [m] of a capsule's segment, along y
  std::size_t hull = 0;              // place in Scene::hulls
};

// Outward triangles, counter-clockwise seen from outside.
struct Hull {
  std::vector<Vector3d> points;  // [m] all of them corners
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Mesh {
  std::vector<Vector3d> vertices;  // [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Body {
  Shape shape{};
  Vector3d position = Vector3d::Zero();               // [m]
  Quaterniond orientation = Quaterniond::Identity();  // R_WB
  Vector3d velocity = Vector3d::Zero();               // [m/s]
  Vector3d spin = Vector3d::Zero();                   // [rad/s]
  double density = 1000;                              // [kg/m^3]
  double mass = 0;                                    // [kg] 0: static
  Vector3d inertia = Vector3d::Zero();                // [kg m^2] principal, in body axes
  Vector3d force = Vector3d::Zero();                  // [N] always, at the centre of mass
};

// Holds two points together.
struct BallJoint {
  int a = -1, b = -1;                // places in Scene::bodies; -1: the world
  Vector3d at_a = Vector3d::Zero();  // [m] body frame; world for the world
  Vector3d at_b = Vector3d::Zero();
};

struct Scene {
  std::string name{}, title{};
  Vector3d gravity{0, -9.81, 0};  // [m/s^2]
  double dt = 1.0 / 60;           // [s]
  int steps = 300;
  int warm_up = 30;  // steps left out of the timing
  double friction = 0.6, restitution = 0;
  double friction_among = 0;   // of bodies on each other, where it is above `friction`
  bool collide = true;         // false: shapes are there but meet nothing
  bool sleeping = false;       // whether engines may put bodies to sleep
  std::vector<Body> bodies{};  // dynamic
  std::vector<Body> ground{};  // static
  std::vector<Hull> hulls{};
  Mesh mesh{};
  std::vector<BallJoint> joints{};

  // What the checker looks at.
  int top = -1;                 // body whose place tells whether a stack stands; -1: none
  bool counts_flips = false;    // of the first body's y axis
  bool watches_energy = false;  // at every step, not only at the end
  Vector3d lower{-1e3, -2, -1e3}, upper{1e3, 1e3, 1e3};  // [m] a body outside has escaped

  // Of bodies on each other; on the ground it is `friction`.
  [[nodiscard]] double friction_of_bodies() const { return std::max(friction, friction_among); }
};

// What an engine says of a body, in double.
struct BodyState {
  Vector3d position = Vector3d::Zero();               // [m] centre of mass
  Quaterniond orientation = Quaterniond::Identity();  // R_WB
  Vector3d velocity = Vector3d::Zero();               // [m/s]
  Vector3d spin = Vector3d::Zero();                   // [rad/s] world axes
};

}  // namespace plumb::anchors
