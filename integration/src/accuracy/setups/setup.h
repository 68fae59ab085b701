// Cases as plain data that belongs to no engine: the lab builds them in every number type of ours
// (cells/plain.cpp), and tests/bench/peers in other engines, from the same numbers. SI units, y up,
// world axes unless said; a body's origin is its centre of mass, its axes are the principal ones.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/setups/meter.h"

namespace plumb::accuracy {

struct SetupBody {
  enum class Shape : std::uint8_t { None, Box, Sphere };
  Shape shape = Shape::None;
  Eigen::Vector3d half = Eigen::Vector3d::Zero();                   // [m] of a box
  double radius = 0;                                                // [m] of a sphere
  double mass = 1;                                                  // [kg]
  Eigen::Vector3d moments = Eigen::Vector3d::Ones();                // [kg m^2]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               // [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // R_WB
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               // [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                   // [rad/s]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // [N] always, at the centre of mass
};

// Holds a point of two bodies together; a hinge their axes too, where an engine has both (a ball
// joint does as well for a motion that stays in its plane).
struct SetupJoint {
  int a = -1, b = -1;                            // places in Setup::bodies; -1: the world
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // [m]
  bool hinge = false;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // of a hinge
};

struct Setup {
  std::string name{};                    // of the case in catalogue.h
  Eigen::Vector3d gravity{0, -9.81, 0};  // [m/s^2]
  double seconds = 1;                    // [s] to simulate
  int copies = 1;                        // in timed runs, none of which meets another
  Eigen::Vector3d apart{0, 0, 5};        // [m] from copy to copy
  bool floor = false;                    // solid below a plane through the origin
  Eigen::Vector3d normal{0, 1, 0};       // of that plane
  double friction = 0, restitution = 0;  // of everything, but for ...
  double friction_among = 0;             // of bodies on each other, where it is above `friction`
  std::vector<SetupBody> bodies{};       // of one copy
  std::vector<SetupJoint> joints{};
  std::function<MeterPtr()> meter{};
};

inline constexpr int kHeadings = 48;  // of C2, 7.5 degrees apart
const std::vector<Setup>& setups();
const Setup* find_setup(std::string_view name);  // null: the case is none of these

// The bodies and joints of so many copies.
Setup repeated(const Setup& setup, int copies);

}  // namespace plumb::accuracy
