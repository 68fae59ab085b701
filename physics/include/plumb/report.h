// What a step did.
#pragma once

#include <array>
#include <cstdint>

#include "plumb/diagnostics.h"
#include "plumb/math.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

enum class Stage : std::uint8_t {
  Plan,
  Broadphase,
  Narrowphase,
  Islands,
  Coloring,
  Rows,
  Impacts,
  Substeps,
  Continuous,
  Finalize,
  Sleep,
  Count,
};
inline constexpr std::size_t kStageCount = static_cast<std::size_t>(Stage::Count);
const char* name_of(Stage stage);

struct StepReport {
  Status status;           // not ok: the step was refused and nothing changed
  std::uint64_t step = 0;  // number of this step, the first is 1
  double time = 0;         // [s] simulated since the world was made, after this step
  double dt = 0;           // [s]

  std::uint32_t bodies = 0;           // all of them
  std::uint32_t awake_bodies = 0;     // dynamic or moving kinematic ones that were stepped
  std::uint32_t candidate_pairs = 0;  // bounds overlap
  std::uint32_t touching_pairs = 0;   // manifold with at least one point
  std::uint32_t contact_points = 0;
  std::uint32_t islands = 0;  // awake ones; 0 when sleeping is off
  std::uint32_t colors = 0;
  std::uint32_t impacts = 0;       // bounces handled at their own time within the step
  std::uint32_t looked_ahead = 0;  // contacts of fast pairs, made where they will first touch
  std::uint32_t continuous = 0;    // bodies that would have passed something and were stopped at it

  std::uint32_t kept_pairs = 0;      // whose contacts were taken over from an earlier step
  std::uint32_t fast_turning = 0;    // contacts that bore something after a fast turn was told
  std::uint32_t deep_bodies = 0;     // deep in others, and visibly relaxed more than once
  std::uint32_t direct_joints = 0;   // solved with all that hang together with them, at once
  std::uint32_t joint_substeps = 0;  // of joint groups beyond the world's own
  std::uint32_t coarse_bodies = 0;   // with fewer substeps than the world's (step_tolerance)

  // Of the accurate solver (ContactSolver::Newton), over all substeps; zero where it is not used.
  std::uint32_t newton_islands = 0;         // solved by it
  std::uint32_t newton_factorizations = 0;  // of their matrices: what the step cost
  std::uint32_t newton_fallbacks = 0;       // solves cut off at their budget and ended by ADMM
  std::uint32_t newton_too_large = 0;       // islands left to the fast solver: too much to factor
  double newton_residual = 0;  // [m/s] >= 0 by which the contact laws are missed, worst

  double largest_penetration = 0;  // [m] >= 0, at the start of the step

  // Bodies whose state became non-finite: put back to their last valid pose, disabled, reported.
  std::uint32_t quarantined = 0;

  // Wall time per stage [s]; zero unless WorldSettings::profiling.
  std::array<double, kStageCount> stage_seconds{};

  // Zero unless PhysicsWorld::set_diagnostics asks for them.
  ErrorEstimate error;
  EnergyLedger energy;
  MomentumLedger momentum;
};

// Mechanical energy and momentum of all dynamic bodies, summed in double.
struct EnergyReport {
  double kinetic_linear = 0;   // [J]
  double kinetic_angular = 0;  // [J]
  double potential = 0;        // [J] in the uniform gravity, zero at the world's origin
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  // [kg m/s]
  Eigen::Vector3d angular_momentum =
      Eigen::Vector3d::Zero();  // [kg m^2/s] about the world's origin
  double effects = 0;           // [J] potential of springs, fields, water (plumb/effects.h)

  [[nodiscard]] double total() const {
    return kinetic_linear + kinetic_angular + potential + effects;
  }
};

}  // namespace plumb::inline PLUMB_ABI
