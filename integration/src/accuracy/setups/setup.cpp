#include "accuracy/setups/setup.h"

#include <cmath>
#include <numbers>

#include "accuracy/setups/bodies.h"
#include "accuracy/setups/published.h"

namespace plumb::accuracy {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Quaterniond turn(double angle, const Vector3d& axis) {
  return Quaterniond(Eigen::AngleAxisd(angle, axis));
}

// --- free ----------------------------------------------------------------------------------------

// Torque-free: the attitude after ten seconds.
Setup top(const char* name, const Vector3d& moments, const Vector3d& spin) {
  Setup s{.name = name, .gravity = Vector3d::Zero(), .seconds = 10, .copies = 64};
  s.apart = {10, 0, 0};
  SetupBody body;
  body.moments = moments;
  body.spin = spin;
  s.bodies = {body};
  s.meter = attitude_meter;
  return s;
}

// --- bouncing ------------------------------------------------------------------------------------

constexpr double kBall = 0.5;  // [m] radius of the balls that bounce, slide and roll

// Dropped 1 m.
Setup dropped(const char* name, double seconds, double friction, double restitution, double speed) {
  Setup s{.name = name, .seconds = seconds, .copies = 16};
  s.apart = {0, 0, 3};
  s.floor = true;
  s.friction = friction;
  s.restitution = restitution;
  s.bodies = {ball(1, kBall, {0, kBall + 1, 0})};
  s.bodies[0].velocity = {speed, 0, 0};
  return s;
}

Setup coming_to_rest() {  // I1: the time after which it is at rest
  Setup s = dropped("I1", 6, 0, 0.8, 0);
  s.meter = rest_meter;
  return s;
}
Setup elastic() {  // I3: the largest relative error of the energy
  Setup s = dropped("I3", 10, 0, 1, 0.5);
  s.meter = [] { return worst_energy_meter(kGravity, kBall); };
  return s;
}
Setup rough() {  // I4: after the bounce it rolls at 5/7 of its speed
  Setup s = dropped("I4", 0.6, 0.9, 0.5, 2);
  s.meter = forward_speed_meter;
  return s;
}

// --- sliding -------------------------------------------------------------------------------------

// On a floor that falls towards +x by `slope` [rad], given a speed [m/s] along it; the path.
Setup on_floor(const char* name, double seconds, double slope, double friction, double speed,
               SetupBody body, double height) {
  Setup s{.name = name, .seconds = seconds, .copies = 16};
  s.apart = {0, 0, 4};
  s.floor = true;
  s.friction = friction;
  s.normal = {std::sin(slope), std::cos(slope), 0};
  const Vector3d down(std::cos(slope), -std::sin(slope), 0);
  body.position = height * s.normal;
  body.orientation = turn(-slope, Vector3d::UnitZ());
  body.velocity = speed * down;
  s.bodies = {body};
  s.meter = [down] { return path_meter(down); };
  return s;
}
// A plate of 1000 kg/m^3, 1 m by 1 m, 10 cm thick.
Setup plate_on_floor(const char* name, double seconds, double slope, double friction,
                     double speed) {
  const SetupBody plate = box(1000 * 0.1, {0.5, 0.05, 0.5}, Vector3d::Zero());
  return on_floor(name, seconds, slope, friction, speed, plate, plate.half.y());
}
// C2: plates that all leave one place at 25 m/s, each with a heading of its own.
Setup plates_in_all_directions() {
  Setup s = plate_on_floor("C2", 5, 0, 0.6, 25);
  const SetupBody plate = s.bodies[0];
  s.copies = 1;
  s.bodies.clear();
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * kPi * i / kHeadings;
    const Vector3d along(std::cos(heading), 0, std::sin(heading));
    s.bodies.push_back(plate);
    s.bodies.back().position += 20 * along;  // [m] clear of each other
    s.bodies.back().velocity = plate.velocity.norm() * along;
  }
  s.meter = slides_meter;
  return s;
}
Setup ball_on_floor(const char* name, double slope, double friction, double speed) {
  return on_floor(name, 2, slope, friction, speed, ball(1, kBall, Vector3d::Zero()), kBall);
}

// --- jointed -------------------------------------------------------------------------------------

Setup pendulum() {  // F9: a point mass on a hinge, 1 m, let go level; the period
  Setup s{.name = "F9", .seconds = 12, .copies = 16};
  SetupBody bob;
  bob.moments = Vector3d::Constant(1e-6);
  bob.position = {1, 0, 0};
  bob.orientation = turn(kPi / 2, Vector3d::UnitZ());
  s.bodies = {bob};
  s.joints = {{.b = 0, .hinge = true, .axis = Vector3d::UnitZ()}};
  s.meter = period_meter;
  return s;
}

Setup heavy_top() {  // F8: on a ball joint in steady slow precession; the angle after ten seconds
  Setup s{.name = "F8", .seconds = 10, .copies = 16};
  constexpr double kTilt = kPi / 6, kSpin = 40, kRate = 0.2479112965, kArm = 0.5;
  SetupBody body;
  body.orientation = turn(-kTilt, Vector3d::UnitZ());
  const Vector3d axis = body.orientation * Vector3d::UnitY();
  const Vector3d w = kSpin * axis + kRate * (Vector3d::UnitY() - axis.y() * axis);
  body.moments = {1 - kArm * kArm, 0.5, 1 - kArm * kArm};
  body.position = kArm * axis;
  body.spin = w;
  body.velocity = w.cross(kArm * axis);
  s.bodies = {body};
  s.joints = {{.b = 0}};
  s.meter = precession_meter;
  return s;
}

Setup chain() {  // ten links on ball joints, let go level; where they are after one second
  Setup s{.name = "chain", .seconds = 1, .copies = 4};
  constexpr double kLength = 0.2;  // [m] of a link
  for (int i = 0; i < 10; ++i) {
    SetupBody link;
    link.moments = {0.001, 0.0034, 0.0034};
    link.position = {(i + 0.5) * kLength, 0, 0};
    s.bodies.push_back(link);
    s.joints.push_back({.a = i - 1, .b = i, .at = {i * kLength, 0, 0}});
  }
  s.meter = places_meter;
  return s;
}

std::vector<Setup> own_setups() {
  return {
      top("F6", {1, 2, 3}, {0.1, 10, 0}),
      top("F7", {1, 1, 1.8}, {0.3, 0, 4}),
      top("H7", {1, 190, 190.9}, {20, 20, 5}),  // a rod: thin, and not quite round
      coming_to_rest(),
      elastic(),
      rough(),
      plate_on_floor("C1", 3, 0, 0.5, 10),
      plates_in_all_directions(),
      plate_on_floor("C3", 2, kPi / 6, 0.3, 0),
      ball_on_floor("C5", 0, 0.3, 7),
      ball_on_floor("C6", kPi / 6, 0.8, 0),
      heavy_top(),
      pendulum(),
      chain(),
  };
}

}  // namespace

const std::vector<Setup>& setups() {
  static const std::vector<Setup> all = [] {
    std::vector<Setup> list = own_setups();
    for (Setup& setup : published_setups()) list.push_back(std::move(setup));
    return list;
  }();
  return all;
}

const Setup* find_setup(std::string_view name) {
  for (const Setup& setup : setups())
    if (setup.name == name) return &setup;
  return nullptr;
}

Setup repeated(const Setup& setup, int copies) {
  Setup out = setup;
  const int count = static_cast<int>(setup.bodies.size());
  for (int c = 1; c < copies; ++c) {
    for (SetupBody body : setup.bodies) {
      body.position += c * setup.apart;
      out.bodies.push_back(body);
    }
    for (SetupJoint joint : setup.joints) {
      if (joint.a >= 0) joint.a += c * count;
      joint.b += c * count;
      joint.at += c * setup.apart;
      out.joints.push_back(joint);
    }
  }
  return out;
}

}  // namespace plumb::accuracy
