// Entries of the ledger, in the order of the step.
//
// Between any two charges the kinetic energy of all awake bodies is summed once more and the
// difference entered where it belongs, so that the entries telescope to the whole change. Rows tell
// their normal and their friction work apart one by one. None of it runs unless it is asked for.
#pragma once

#include "solver/contact_kernel.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

void open_ledger(WorldState& world);                          // before the substeps
void charge(WorldState& world, double EnergyLedger::*entry);  // all that has changed since
void charge_flight(WorldState& world);                        // bodies that nothing holds
void charge_effects(WorldState& world);
void charge_bounces(WorldState& world);
void charge_kick(WorldState& world);          // gravity, forces, damping
void charge_joint_flight(WorldState& world);  // groups by themselves
void charge_drift(WorldState& world);
void charge_shifts(WorldState& world);  // bodies moved apart where they stand
void charge_finish(WorldState& world);  // of a substep
void weigh_paths(WorldState& world);    // gravity's work, once the paths are final
void close_ledger(WorldState& world);   // at the end of the step

// Kinetic energy of the row's bodies [J], and its change since `before` entered under `entry`;
// returns the energy now.
double row_energy(const WorldState& world, const ContactRow<Real>& row);
double charge_row(WorldState& world, const ContactRow<Real>& row, double before,
                  double EnergyLedger::*entry);
// A warm start acts along both at once: friction's part is its impulse times the mean slip.
void charge_warm_start(WorldState& world, const ContactRow<Real>& row, double before,
                       const RowVelocities<Real>& u0, const RowVelocities<Real>& u1);

}  // namespace plumb::inline PLUMB_ABI::detail
