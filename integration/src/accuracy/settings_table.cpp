#include "accuracy/settings_table.h"

#include <algorithm>
#include <cstdio>

#include "accuracy/report.h"

namespace plumb::accuracy {
namespace {

// What stands for a kind of scene: cases whose errors follow from the settings alone (F5 is about
// the user's force, H12 about a switch, H4 about what the fast solver cannot do).
struct Kind {
  const char* name;  // of SceneKind
  std::vector<std::string> cases;
  bool jointed = false;  // measured at both orders of joints
};
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list{{"Free", {"F2", "F6", "F7", "H7"}},
                                      {"Bouncing", {"I1", "I3", "I4"}},
                                      {"Sliding", {"C1", "C3", "C5", "C6"}},
                                      {"Jointed", {"F8", "F9", "chain"}, true},
                                      {"Stacked", {"C18"}}};
  return list;
}
constexpr int kJointOrders[] = {2, 4};

std::vector<Series> series_for(const TableGrid& grid, const Kind& kind, Precision precision) {
  Series series{"all", {}, false};
  for (const int order : kJointOrders)
    for (const int rate : grid.rates)
      for (const int substeps : grid.substeps) {
        Knobs knobs;
        if (order != knobs.joint_order && !kind.jointed) continue;
        knobs.dt = 1.0 / rate;
        knobs.substeps = substeps;
        knobs.joint_order = order;
        knobs.precision = precision;
        series.settings.push_back(knobs);
      }
  return {series};
}

std::string row_of(const Kind& kind, const Knobs& knobs, double error, double cost) {
  char text[160];
  std::snprintf(text, sizeof text, "    {\"%s\", SceneKind::%s, %d, %d, %d, %.2e, %.2e},\n",
                kPrecisionNames[static_cast<int>(knobs.precision)], kind.name,
                static_cast<int>(1 / knobs.dt + 0.5), knobs.substeps, knobs.joint_order,
                std::min(error, 1e9), cost);
  return text;
}

}  // namespace

std::size_t settings_table_cells(const TableGrid& grid) {
  std::size_t cells = 0;
  for (const Precision precision : grid.precisions)
    for (const Kind& kind : kinds())
      cells += kind.cases.size() * cell_count(series_for(grid, kind, precision));
  return cells;
}

std::string settings_table(const TableGrid& grid, const std::function<void(std::size_t)>& progress,
                           std::string& problem) {
  const Circumstances where = circumstances();
  std::string out =
      "// Written by `plumb accuracy --table physics/src/world/measured_table.h`; see "
      "measured_settings.h.\n// clang-format off\n#pragma once\n\n"
      "#include \"world/measured_settings.h\"\n\n"
      "namespace plumb::inline PLUMB_ABI::detail {\n\n"
      "inline constexpr const char* kMeasuredOn =\n    \"" +
      where.machine + ", " + where.compiler + ", commit " + where.commit + ", " + where.date +
      "\";\ninline constexpr MeasuredSetting kMeasured[] = {\n";
  LabOptions options;
  options.knobs.quick = true;
  options.progress = progress;
  for (const Precision precision : grid.precisions) {
    for (const Kind& kind : kinds()) {
      std::vector<double> error, cost;
      const std::vector<Series> series = series_for(grid, kind, precision);
      for (const std::string& name : kind.cases) {
        const CaseInfo& info = *find_case(name);
        const CaseResult result = run_case(info, series, options, problem);
        if (!problem.empty()) return {};
        error.resize(result.cells.size(), 0);
        cost.resize(result.cells.size(), 0);
        for (std::size_t i = 0; i < result.cells.size(); ++i) {
          error[i] = std::max(error[i], result.cells[i].error / info.scale);
          cost[i] = std::max(cost[i], result.cells[i].cost);
        }
      }
      for (std::size_t i = 0; i < error.size(); ++i)
        out += row_of(kind, series[0].settings[i], error[i], cost[i]);
    }
  }
  return out + "};\n\n}  // namespace plumb::inline PLUMB_ABI::detail\n";
}

}  // namespace plumb::accuracy
