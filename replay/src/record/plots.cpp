#include "record/plots.h"

#include <string>
#include <vector>

#include "record/placed_part.h"
#include "rrd/writer.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr double kMillisecondsPerSecond = 1e3, kMillimetersPerMeter = 1e3;

void send_series(rrd::Writer& writer, const std::string& entity,
                 const std::vector<std::string>& names) {
  rrd::Table table(entity);
  const std::size_t column = table.add_text_column("SeriesLines:names");
  const std::size_t colors = table.add_column<std::uint32_t>("SeriesLines:colors");
  for (std::size_t i = 0; i < names.size(); ++i) {
    table.column(column).append_text(names[i]);
    table.column(colors).append_one(kBodyColors[i % kBodyColors.size()]);
  }
  table.send_static(writer);
}

}  // namespace

Plots::Plots()
    : energy_("plots/energy"),
      counts_("plots/counts"),
      overlap_("plots/overlap"),
      timing_("plots/timing") {
  for (rrd::Table* table : {&energy_, &counts_, &overlap_, &timing_})
    table->add_column<double>("Scalars:scalars");
}

void Plots::send_names(rrd::Writer& writer) {
  send_series(writer, energy_.entity(),
              {"total [J]", "kinetic, linear [J]", "kinetic, angular [J]", "potential [J]"});
  send_series(writer, counts_.entity(),
              {"awake bodies", "touching pairs", "contact points", "islands"});
  send_series(writer, overlap_.entity(), {"deepest overlap [mm]"});
  std::vector<std::string> stages;
  for (std::size_t i = 0; i < kStageCount; ++i)
    stages.push_back(name_of(static_cast<Stage>(i)) + std::string(" [ms]"));
  send_series(writer, timing_.entity(), stages);
}

void Plots::add_row(rrd::Table& table, const Frame& frame, std::span<const double> values) {
  table.column(0).append(values);
  table.end_row(frame.number, frame.time);
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
              static_cast<double>(report.contact_points), static_cast<double>(report.islands)});
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
