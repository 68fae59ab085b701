#include "accuracy/lab.h"

#include <cmath>
#include <limits>

namespace plumb::accuracy {
namespace {

// The step of the reference: a 64th of 1/60 s, in double, with the engine's own choices but for
// joints, which are taken at their higher order.
Knobs reference_knobs(const CaseInfo& info, double part) {
  Knobs knobs;
  knobs.precision = Precision::F64;
  knobs.dt = 1.0 / 60 / part;
  if (info.swings) knobs.joint_order = 4;
  return knobs;
}

// The right readings, and how sure they are.
std::vector<double> right_readings(const CaseInfo& info, double& spread, std::string& problem) {
  spread = 0;
  if (info.exact) return *info.exact;
  const CellCode* code = cells_of(Precision::F64);
  if (code == nullptr) {
    problem = info.name +
              " has no closed form and needs a double reference, which this build lacks "
              "(PLUMB_ALL_PRECISIONS)";
    return {};
  }
  const Readings fine = code->run(info.name, reference_knobs(info, 64));
  const Readings half = code->run(info.name, reference_knobs(info, 32));
  spread = distance(fine.values, half.values);
  if (!fine.finite || !half.finite) problem = "the reference of " + info.name + " is not finite";
  return fine.values;
}

}  // namespace

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

double timing_window(bool quick) { return quick ? 0.006 : 0.03; }

CaseResult run_case(const CaseInfo& info, const std::vector<Series>& series,
                    const LabOptions& options, std::string& problem) {
  CaseResult result;
  result.info = &info;
  result.series = series;
  result.right = right_readings(info, result.reference_spread, problem);
  if (!problem.empty()) return result;
  for (std::size_t s = 0; s < series.size(); ++s) {
    for (const Knobs& knobs : series[s].settings) {
      const CellCode* code = cells_of(knobs.precision);
      if (code == nullptr) {
        problem = std::string("this build has no ") +
                  kPrecisionNames[static_cast<int>(knobs.precision)] + " (PLUMB_ALL_PRECISIONS)";
        return result;
      }
      CellResult cell{s, knobs};
      const Readings readings = code->run(info.name, knobs);
      cell.error = readings.finite ? distance(readings.values, result.right)
                                   : std::numeric_limits<double>::infinity();
      cell.cost = code->time(info.name, knobs, timing_window(options.knobs.quick));
      result.cells.push_back(cell);
      if (options.progress) options.progress(1);
    }
  }
  mark_pareto(result.cells);
  for (std::size_t s = 0; s < series.size(); ++s)
    if (series[s].by_step) result.fits.push_back(fit_order(result, s));
  return result;
}

}  // namespace plumb::accuracy
