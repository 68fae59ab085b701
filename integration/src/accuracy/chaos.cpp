#include "accuracy/chaos.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plumb::accuracy {
namespace {

constexpr double kEvery = 0.2;      // [s] between looks: a whole number of steps of 1/15 s
constexpr double kShift = 1e-9;     // [m] of the twin
constexpr double kDeparted = 1e-3;  // [m]
constexpr double kNineFive = 1.96;  // half the 95 % interval of a normal distribution [-]

double largest_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i + 2 < a.size() && i + 2 < b.size(); i += 3)
    largest = std::max(largest, std::hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
  return largest;
}

int members_of(const KnobChoice& choice) { return choice.quick ? 8 : 32; }

std::vector<Knobs> settings_of(const CaseInfo& info, const KnobChoice& choice) {
  std::vector<Knobs> out;
  if (!choice.empty()) {
    for (const Series& series : series_of(info, choice))
      out.insert(out.end(), series.settings.begin(), series.settings.end());
    return out;
  }
  for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
    Knobs knobs;
    knobs.dt = 1 / rate;
    if (cells_of(knobs.precision) == nullptr) knobs.precision = Precision::F32;
    out.push_back(knobs);
  }
  Knobs single;
  single.precision = Precision::F32;
  out.push_back(single);
  return out;
}

// Fills everything but the error in; `trace` becomes that of the first member.
ChaosRow measure(const CaseInfo& info, const CellCode& code, const Knobs& knobs, int members,
                 Trace& trace) {
  ChaosRow row;
  row.knobs = knobs;
  std::vector<std::vector<double>> values(std::size(kStatistics));
  for (int member = 0; member < members; ++member) {
    const Trace t = code.trace(info.name, knobs, kEvery, 0, static_cast<std::uint32_t>(member + 1));
    if (member == 0) trace = t;
    for (std::size_t i = 0; t.finite && i < values.size(); ++i)
      values[i].push_back(t.statistics[i]);
  }
  row.horizon =
      horizon_of(trace, code.trace(info.name, knobs, kEvery, kShift, 1), kEvery, kDeparted);
  for (const auto& list : values) row.statistics.push_back(estimate_of(list));
  return row;
}

std::string format(const char* pattern, double a, double b = 0) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

}  // namespace

double horizon_of(const Trace& a, const Trace& b, double every, double apart) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < a.places.size() && i < b.places.size(); ++i) {
    if (!(largest_distance(a.places[i], b.places[i]) <= apart)) break;
    last = i;
  }
  return static_cast<double>(last) * every;
}

Estimate estimate_of(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  if (values.size() < 2) return {values.empty() ? NAN : values[0], INFINITY};
  double mean = 0, square = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) square += (v - mean) * (v - mean);
  return {mean, kNineFive * std::sqrt(square / (n - 1) / n)};
}

std::size_t chaos_cells(const CaseInfo& info, const KnobChoice& choice) {
  return settings_of(info, choice).size() + 1;
}

ChaosResult run_chaos(const CaseInfo& info, const KnobChoice& choice,
                      const std::function<void(std::size_t)>& progress, std::string& problem) {
  ChaosResult result;
  result.info = &info;
  result.members = members_of(choice);
  const CellCode* exact = cells_of(Precision::F64);
  if (exact == nullptr) {
    problem =
        info.name + " needs a double reference, which this build lacks (PLUMB_ALL_PRECISIONS)";
    return result;
  }
  Knobs fine;
  fine.dt = 1.0 / 960;
  Trace right;
  result.reference = measure(info, *exact, fine, result.members, right);
  if (progress) progress(1);
  for (const Knobs& knobs : settings_of(info, choice)) {
    const CellCode* code = cells_of(knobs.precision);
    if (code == nullptr) {
      problem = "this build lacks a number type that was asked for (PLUMB_ALL_PRECISIONS)";
      return result;
    }
    Trace trace;
    ChaosRow row = measure(info, *code, knobs, result.members, trace);
    const double known = std::min(row.horizon, result.reference.horizon);
    const std::size_t looks = static_cast<std::size_t>(std::lround(known / kEvery));
    for (std::size_t i = 0; i <= looks && i < right.places.size(); ++i)
      row.error = std::max(row.error, largest_distance(trace.places[i], right.places[i]));
    row.cost = code->time(info.name, knobs, choice.quick ? 0.006 : 0.03);
    result.rows.push_back(std::move(row));
    if (progress) progress(1);
  }
  return result;
}

std::string table_of(const ChaosResult& result) {
  std::string out = "\n" + result.info->name + "  " + result.info->title + ": chaotic\n";
  out +=
      "    The horizon is where a twin shifted by 1e-9 m is a millimetre away. After it: means "
      "of " +
      std::to_string(result.members) + " scenes,\n    +- the 95 % interval.\n";
  const auto line = [&](const ChaosRow& row, bool reference) {
    out += "    " + words_of(row.knobs) + (reference ? "  (the reference)" : "") +
           "\n      horizon " + format("%.1f s", row.horizon) +
           (reference ? std::string() : format(", error until then %.1e m", row.error)) +
           (row.cost > 0 ? format(", %.3g us/body-s", 1e6 * row.cost) : std::string()) + "\n";
    for (std::size_t i = 0; i < row.statistics.size(); ++i)
      out += std::string("      ") + kStatistics[i] +
             format(" %.4g +- %.2g", row.statistics[i].mean, row.statistics[i].bar) + "\n";
  };
  line(result.reference, true);
  for (const ChaosRow& row : result.rows) line(row, false);
  return out;
}

std::string csv_of(const ChaosResult& result) {
  std::string out = "case,precision,dt_s,substeps,members,horizon_s,error_m,us_per_body_second";
  for (const char* name : kStatistics) out += std::string(",") + name + ",+-";
  out += "\n";
  const auto line = [&](const ChaosRow& row) {
    out += result.info->name + ',' + kPrecisionNames[static_cast<int>(row.knobs.precision)] + ',' +
           format("%.17g", row.knobs.dt) + ',' + std::to_string(row.knobs.substeps) + ',' +
           std::to_string(result.members) + ',' + format("%.3g,%.3g", row.horizon, row.error) +
           ',' + format("%.4g", 1e6 * row.cost);
    for (const Estimate& e : row.statistics) out += ',' + format("%.6g,%.3g", e.mean, e.bar);
    out += '\n';
  };
  line(result.reference);
  for (const ChaosRow& row : result.rows) line(row);
  return out;
}

}  // namespace plumb::accuracy
