// What a step tells about its own accuracy, on demand: an estimate of its error, and where energy
// and momentum went. Both cost nothing while they are off and change no bit of the motion.
#pragma once

#include <cstdint>

#include "plumb/ids.h"
#include "plumb/math.h"

namespace plumb::inline PLUMB_ABI {

// What the coming steps report. Like observers and the job system no part of the world's state:
// neither recorded nor saved.
struct StepDiagnostics {
  // Every so many steps the step is taken a second time, in a copy of the world with twice the
  // substeps, and compared (step doubling). 0: never. Costs about three steps each time.
  std::uint32_t error_every = 0;
  // Fills StepReport::energy and momentum. Substeps then run on one thread; some 100 ns a row and
  // substep.
  bool ledger = false;
  // Vectors that the contact solver works with [bit]: 128, 256 or 512, as far as the processor has
  // them; 1: one row at a time; 0: the longest that pays. For comparing their speed.
  int kernel_bits = 0;
};

// How far this step's result lies from that with twice the substeps, the largest over all bodies.
// The error of this step itself is the difference or up to twice that (order 1). Bodies that touch
// nothing fly by closed forms whatever the substeps: 0.
struct ErrorEstimate {
  bool measured = false;  // in this step
  double position = 0;    // [m]
  double angle = 0;       // [rad]
  double velocity = 0;    // [m/s]
  BodyId worst{};         // by position; null when nothing differs
};

// Work done on all dynamic bodies in one step, by what did it [J]. The entries add up to
// kinetic_change to round-off.
struct EnergyLedger {
  double gravity = 0;      // -change of the potential energy
  double forces = 0;       // forces and torques of the user, and of effects
  double damping = 0;      // <= 0
  double normal = 0;       // normal impulses of contacts, without bounces
  double friction = 0;     // with rolling and torsional friction
  double restitution = 0;  // bounces at their own time within a substep, friction there included
  double recovery = 0;     // lifting what is pushed out of overlap: no velocity pays for it
  double joints = 0;       // with motors, springs and limits
  double integrator = 0;   // what the motion between kicks gains or loses by itself
  double kinetic_change = 0;

  [[nodiscard]] double sum() const {
    return gravity + forces + damping + normal + friction + restitution + recovery + joints +
           integrator;
  }
};

// The same for linear momentum [kg m/s].
struct MomentumLedger {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  Eigen::Vector3d forces = Eigen::Vector3d::Zero();
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();
  Eigen::Vector3d contacts = Eigen::Vector3d::Zero();  // from bodies that are not dynamic
  Eigen::Vector3d joints = Eigen::Vector3d::Zero();    // to the world and such bodies
  Eigen::Vector3d change = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d sum() const {
    return gravity + forces + damping + contacts + joints;
  }
};

}  // namespace plumb::inline PLUMB_ABI
