#include "accuracy/setups/published.h"

#include <cmath>
#include <numbers>

#include "accuracy/random.h"
#include "accuracy/setups/bodies.h"

namespace plumb::accuracy {
namespace {

using Eigen::Vector3d;

// --- balls ---------------------------------------------------------------------------------------

constexpr double kMarble = 0.1;  // [m] radius; 10 kg

Setup marbles(const char* name, double seconds, double restitution) {
  Setup s{.name = name, .seconds = seconds};
  s.floor = true;
  s.restitution = restitution;
  if (restitution > 0) {
    s.meter = [] { return energy_meter(kGravity, 10, 0.4 * 10 * kMarble * kMarble); };
  } else {
    s.meter = [] { return overlap_meter(kMarble); };
  }
  return s;
}

Setup bouncing49() {
  Setup s = marbles("bouncing49", 20, 1);
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k) s.bodies.push_back(ball(10, kMarble, {1.0 * i, 5, 1.0 * k}));
  return s;
}

// 666: a grid of 6 x 6 x 6 that is not quite even, its first layer at a height [m].
Setup grid(const char* name, double lowest, double restitution) {
  Setup s = marbles(name, 10, restitution);
  Random random(666);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 6; ++k) {
        const double x = 0.21 * i + random.uniform(0, 1e-3);
        const double z = 0.21 * k + random.uniform(0, 1e-3);
        const double y = lowest + 0.21 * j + random.uniform(0, 1e-3);
        s.bodies.push_back(ball(10, kMarble, {x, y, z}));
      }
  return s;
}

// --- rolling -------------------------------------------------------------------------------------

// A plate is pulled from under 25 balls, along the floor at an angle [rad] from the x axis. All
// slides on the floor, the balls roll on the plate: its acceleration is 3.5 times theirs.
Setup rolling(const char* name, double angle) {
  constexpr double kPlate = 10, kBall = 1, kPull = 150;  // [kg], [kg], [N]
  constexpr int kBalls = 25;
  Setup s{.name = name, .seconds = 4};
  s.floor = true;
  s.friction = 0.4;
  s.friction_among = 0.8;
  const Vector3d along(std::cos(angle), 0, std::sin(angle));
  s.bodies.push_back(box(kPlate, {10, 0.5, 10}, {0, 0.5, 0}));
  s.bodies[0].force = kPull * along;
  for (int i = -2; i <= 2; ++i)
    for (int k = -2; k <= 2; ++k) s.bodies.push_back(ball(kBall, 0.5, {2.0 * i, 1.5, 2.0 * k}));
  const double left = kPull - s.friction * (kPlate + kBalls * kBall) * kGravity;   // [N]
  const double ball = left / (3.5 * kPlate + kBalls * kBall), plate = 3.5 * ball;  // [m/s^2]
  s.meter = [=] { return acceleration_meter({plate * along, ball * along}); };
  return s;
}

// --- Kapla ---------------------------------------------------------------------------------------

// A wall of six floors, each of eight standing boards and nine that lie across them, four on one
// side and five on the other; one minute of the published ten.
Setup kapla() {
  constexpr double kMass = 10, kLength = 0.2, kHeight = 0.1, kFloor = 2 * kHeight;  // [kg], [m]
  const Vector3d base(0.025, 0.05, 0.125), wall(0.1, 0.05, 0.025);                  // [m] halves
  Setup s{.name = "kapla", .seconds = 60};
  s.floor = true;
  s.friction = 0.8;
  s.friction_among = 0.8;
  for (int floor = 0; floor < 6; ++floor) {
    const double y = floor * kFloor + kHeight / 2;
    const auto lay = [&](double x, double z) {
      s.bodies.push_back(box(kMass, wall, {x, y + kHeight, z}));
    };
    for (int i = 0; i < 8; ++i) s.bodies.push_back(box(kMass, base, {i * kLength, y, 0}));
    for (int i = 0; i < 4; ++i) lay(2 * i * kLength + 0.1, -0.1);
    for (int i = 0; i < 3; ++i) lay(2 * i * kLength + 0.3, 0.1);
    lay(0.1, 0.1);
    lay(6 * kLength + 0.1, 0.1);
  }
  s.meter = displacement_meter;
  return s;
}

}  // namespace

std::vector<Setup> published_setups() {
  return {rolling("rolling", 0),
          rolling("rolling60", std::numbers::pi / 3),
          bouncing49(),
          grid("666", 0.101, 0),
          grid("elastic666", 1.101, 1),
          kapla()};
}

}  // namespace plumb::accuracy
