#include "record/ledger_plots.h"

#include "record/series.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

// Entries in the order in which they are drawn.
struct EnergyEntry {
  const char* name;
  double EnergyLedger::*value;
};
constexpr EnergyEntry kEnergy[] = {
    {"gravity", &EnergyLedger::gravity},       {"forces", &EnergyLedger::forces},
    {"damping", &EnergyLedger::damping},       {"normal", &EnergyLedger::normal},
    {"friction", &EnergyLedger::friction},     {"restitution", &EnergyLedger::restitution},
    {"recovery", &EnergyLedger::recovery},     {"joints", &EnergyLedger::joints},
    {"integrator", &EnergyLedger::integrator}, {"kinetic change", &EnergyLedger::kinetic_change}};
struct MomentumEntry {
  const char* name;
  Eigen::Vector3d MomentumLedger::*value;
};
constexpr MomentumEntry kMomentum[] = {
    {"gravity", &MomentumLedger::gravity}, {"forces", &MomentumLedger::forces},
    {"damping", &MomentumLedger::damping}, {"contacts", &MomentumLedger::contacts},
    {"joints", &MomentumLedger::joints},   {"change", &MomentumLedger::change}};
// The last curve: what the entries do not explain, by rounding alone.
constexpr const char* kResidual = "residual";

template <class Entries>
std::vector<std::string> names_of(const Entries& entries, const std::string& unit) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.name + unit);
  names.push_back(kResidual + unit);
  return names;
}

}  // namespace

LedgerPlots::LedgerPlots()
    : energy_(series_table("plots/ledger/energy")),
      momentum_{series_table("plots/ledger/momentum_x"), series_table("plots/ledger/momentum_y"),
                series_table("plots/ledger/momentum_z")} {}

void LedgerPlots::send_names(rrd::Writer& writer) {
  send_series(writer, energy_.entity(), names_of(kEnergy, " [J]"));
  for (const rrd::Table& table : momentum_)
    send_series(writer, table.entity(), names_of(kMomentum, " [kg m/s]"));
}

void LedgerPlots::add(const Frame& frame) {
  const EnergyLedger& energy = frame.report.energy;
  std::vector<double> values;
  for (const EnergyEntry& entry : kEnergy) values.push_back(energy.*entry.value);
  values.push_back(energy.kinetic_change - energy.sum());
  add_row(energy_, frame, values);
  const MomentumLedger& momentum = frame.report.momentum;
  const Eigen::Vector3d residual = momentum.change - momentum.sum();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const MomentumEntry& entry : kMomentum) values.push_back((momentum.*entry.value)[axis]);
    values.push_back(residual[axis]);
    add_row(momentum_[static_cast<std::size_t>(axis)], frame, values);
  }
}

void LedgerPlots::send(rrd::Writer& writer) {
  if (energy_.rows() == 0) return;
  if (!begun_) send_names(writer);
  begun_ = true;
  energy_.send(writer);
  for (rrd::Table& table : momentum_) table.send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
