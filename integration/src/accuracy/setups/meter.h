// What is read off a run: the same code for every engine and number type.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <vector>

namespace plumb::accuracy {

// A body as an engine tells it, in double whatever the engine computes in.
struct BodyReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               // [m] centre of mass
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // R_WB
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               // [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();                   // [rad/s] world axes
};
using BodyReadings = std::vector<BodyReading>;

// Readings are chosen so that the Euclidean distance of two lists is the error in the case's unit.
class Meter {
 public:
  Meter() = default;
  Meter(const Meter&) = delete;
  Meter& operator=(const Meter&) = delete;
  virtual ~Meter() = default;
  virtual void begin(const BodyReadings&) {}
  virtual void after_step(double /*time [s]*/, const BodyReadings&) {}
  [[nodiscard]] virtual std::vector<double> readings(const BodyReadings& end) const = 0;
};
using MeterPtr = std::unique_ptr<Meter>;

// Of the first body:
MeterPtr attitude_meter();                          // [rad] nine numbers
MeterPtr rest_meter();                              // [s] after which it is at rest
MeterPtr forward_speed_meter();                     // [m/s] along x
MeterPtr path_meter(const Eigen::Vector3d& along);  // [m] from the start; along: a unit vector
MeterPtr precession_meter();                        // [rad] about y, from +x towards -z
MeterPtr period_meter();                            // [s] of a swing about z through the origin
MeterPtr worst_energy_meter(double gravity, double floor);  // [-] relative; floor: [m] lowest place
// Of all:
MeterPtr places_meter();  // [m] three numbers a body
MeterPtr slides_meter();  // [m] rms over the bodies of their ways in x, z
MeterPtr energy_meter(double gravity, double mass, double moment);  // [-] rms, relative
MeterPtr overlap_meter(double radius);  // [m] rms of balls' overlaps with each other and the floor
MeterPtr displacement_meter();          // [m] rms over the bodies, end against start
// [m/s] rms over the steps of the velocities of the first bodies against these accelerations
// [m/s^2] from rest, all of them together.
MeterPtr acceleration_meter(std::vector<Eigen::Vector3d> right);

// The attitude as nine numbers whose distance is the angle between two, as long as it is small.
void append_attitude(std::vector<double>& out, const Eigen::Quaterniond& q);

}  // namespace plumb::accuracy
