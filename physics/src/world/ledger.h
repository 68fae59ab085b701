// The energy and momentum ledger (plumb/diagnostics.h): who did how much work in a step.
//
// The charges that fill it stand in ledger_charges.h.
#pragma once

#include <vector>

#include "math/quaternion.h"
#include "plumb/diagnostics.h"

namespace plumb::inline PLUMB_ABI::detail {

using Sum = Vector3<double>;

struct LedgerBook {
  EnergyLedger energy;
  MomentumLedger momentum;
  double kinetic = 0;           // [J] of all awake bodies at the last charge
  Sum linear{0, 0, 0};          // [kg m/s] likewise
  double start = 0;             // [J] when the step began
  Sum linear_start{0, 0, 0};    // [kg m/s]
  double credited_gravity = 0;  // [J] by which kicks and flights explained what they changed
  std::uint32_t group = 0;      // whose substeps run (solver/step_groups.h)
  double h = 0;                 // [s] of its substeps
  bool in_substeps = false;     // poses are those of the step's start plus delta
  bool pending = false;         // rows have changed w, L has not been told yet
  std::vector<Vec> place;       // [m] per dense body: dp at the last charge
  std::vector<Vec> drifted;     // [m/s] per dense body: v during the drift
};

}  // namespace plumb::inline PLUMB_ABI::detail
