#include "record/plots.h"

#include <string>
#include <vector>

#include "record/series.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr double kMillisecondsPerSecond = 1e3, kMillimetersPerMeter = 1e3;

}  // namespace

Plots::Plots()
    : energy_(series_table("plots/energy")),
      counts_(series_table("plots/counts")),
      overlap_(series_table("plots/overlap")),
      timing_(series_table("plots/timing")) {}

void Plots::send_names(rrd::Writer& writer) {
  send_series(writer, energy_.entity(),
              {"total [J]", "kinetic, linear [J]", "kinetic, angular [J]", "potential [J]"});
  send_series(
      writer, counts_.entity(),
      {"awake bodies", "touching pairs", "contact points", "islands", "with fewer substeps"});
  send_series(writer, overlap_.entity(), {"deepest overlap [mm]"});
  std::vector<std::string> stages;
  for (std::size_t i = 0; i < kStageCount; ++i)
    stages.push_back(name_of(static_cast<Stage>(i)) + std::string(" [ms]"));
  send_series(writer, timing_.entity(), stages);
}

void Plots::add(const Frame& frame) {
  const StepReport& report = frame.report;
  const EnergyReport& energy = frame.energy;
  add_row(
      energy_, frame,
      std::array{energy.total(), energy.kinetic_linear, energy.kinetic_angular, energy.potential});
  add_row(counts_, frame,
          std::array{
              static_cast<double>(report.awake_bodies), static_cast<double>(report.touching_pairs),
              static_cast<double>(report.contact_points), static_cast<double>(report.islands),
              static_cast<double>(report.coarse_bodies)});
  add_row(overlap_, frame, std::array{report.largest_penetration * kMillimetersPerMeter});
  if (frame.profiled) {
    std::array<double, kStageCount> milliseconds{};
    for (std::size_t i = 0; i < kStageCount; ++i)
      milliseconds[i] = report.stage_seconds[i] * kMillisecondsPerSecond;
    add_row(timing_, frame, milliseconds);
  }
}

void Plots::send(rrd::Writer& writer) {
  for (rrd::Table* table : {&energy_, &counts_, &overlap_, &timing_}) table->send(writer);
}

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
