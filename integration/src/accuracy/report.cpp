#include "accuracy/report.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "accuracy/peers.h"

#ifndef PLUMB_COMMIT
#define PLUMB_COMMIT "unknown"
#endif

namespace plumb::accuracy {
namespace {

std::string number(double value, const char* format = "%.3g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
std::string padded(std::string text, std::size_t width, bool right = false) {
  if (text.size() < width) text.insert(right ? 0 : text.size(), width - text.size(), ' ');
  return text;
}
// The fields hold no quotes; commas they do.
std::string quoted(const std::string& text) { return '"' + text + '"'; }

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line)) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

// Ours in the measure and the seconds of the publication, and the published figures under them.
std::string published_of(const CaseResult& result) {
  const CaseInfo& info = *result.info;
  if (info.published.empty()) return {};
  std::string out = "    as published [Kang 2018]: mean square [" + info.measure_unit +
                    "], seconds for the whole scene\n";
  const auto row = [&](const std::string& who, double dt, double measure, double seconds) {
    out += "      " + padded(who, 50) + padded(step_words(dt), 8) +
           padded(number(measure, "%.2e"), 12, true) +
           padded(seconds > 0 ? number(seconds) + " s" : "-", 12, true) + "\n";
  };
  for (const CellResult& cell : result.cells)
    row("Plumb, " + result.series[cell.series].label, cell.knobs.dt,
        info.measure * cell.error * cell.error, cell.cost * info.body_seconds);
  for (const PeerCurve& curve : result.peers)
    for (const CurvePoint& point : curve.points)
      row(curve.engine + ", here", point.dt, info.measure * point.error * point.error,
          point.cost * info.body_seconds);
  for (const Published& p : info.published)
    row(p.engine + (p.at_most ? ", published: at most" : ", published"), p.dt, p.measure,
        p.seconds);
  return out;
}

std::string table_row(const std::string& mark, const std::string& label, double dt,
                      const std::string& substeps, double error, double cost) {
  return "  " + padded(mark, 2) + padded(label, 50) + padded(step_words(dt), 8) +
         padded(substeps, 10) +
         padded(std::isfinite(error) ? number(error, "%.2e") : "not finite", 22, true) +
         padded(number(1e6 * cost), 12, true) + "\n";
}

}  // namespace

Circumstances circumstances() {
  Circumstances where;
  where.machine = processor();
#if defined(__clang__)
  where.compiler = "clang " __clang_version__;
#else
  where.compiler = "g++ " __VERSION__;
#endif
  where.commit = PLUMB_COMMIT;
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  where.date = text;
  return where;
}

std::string table_of(const CaseResult& result) {
  const CaseInfo& info = *result.info;
  std::string out = "\n" + info.name + "  " + info.title + "\n";
  if (!info.exact)
    out += "    against double at 1/3840 s, which differs from 1/1920 s by " +
           number(result.reference_spread, "%.1e") + " " + info.unit + "\n";
  out += "    " + padded("series", 50) + padded("step", 8) + padded("substeps", 10) +
         padded("error [" + info.unit + "]", 22, true) + padded("us/body-s", 12, true) + "\n";
  for (const CellResult& cell : result.cells)
    out += table_row(cell.pareto ? "* " : "", result.series[cell.series].label, cell.knobs.dt,
                     std::to_string(cell.knobs.substeps), cell.error, cell.cost);
  for (const PeerCurve& curve : result.peers)
    for (const CurvePoint& point : curve.points)
      out += table_row("", label_of(curve), point.dt, "-", point.error, point.cost);
  const auto order = [&](const std::string& label, const OrderFit& fit) {
    if (fit.found)
      out += "    order of " + label + ": " + number(fit.order, "%.2f") + " (" +
             std::to_string(fit.points) + " points)\n";
  };
  for (const OrderFit& fit : result.fits) order(result.series[fit.series].label, fit);
  for (const PeerCurve& curve : result.peers) order(label_of(curve), curve.fit);
  return out + published_of(result);
}

// Our knobs stay empty in a row of another engine.
std::string csv_of(const std::vector<CaseResult>& results, const Circumstances& where) {
  std::string out =
      "case,family,title,engine,series,precision,dt_s,substeps,rotation,solver,iterations,friction,"
      "joint_order,warm_"
      "start,"
      "continuous,"
      "error,unit,"
      "relative_error,us_per_body_second,pareto,reference,reference_spread,machine,compiler,commit,"
      "date\n";
  for (const CaseResult& result : results) {
    const CaseInfo& info = *result.info;
    const std::string what =
        info.name + ',' + name_of(info.family) + ',' + quoted(info.title) + ',';
    const auto measured = [&](double error, double cost, bool pareto) {
      return number(error, "%.9g") + ',' + quoted(info.unit) + ',' +
             number(error / info.scale, "%.9g") + ',' + number(1e6 * cost, "%.6g") + ',' +
             (pareto ? "1," : "0,") + (info.exact ? "closed form," : "double at 1/3840 s,") +
             number(result.reference_spread, "%.3g") + ',' + quoted(where.machine) + ',' +
             quoted(where.compiler) + ',' + quoted(where.commit) + ',' + where.date + '\n';
    };
    for (const CellResult& cell : result.cells) {
      const Knobs& k = cell.knobs;
      out += what + "plumb," + quoted(result.series[cell.series].label) + ',' +
             kPrecisionNames[static_cast<int>(k.precision)] + ',' + number(k.dt, "%.17g") + ',' +
             std::to_string(k.substeps) + ',' +
             rotation_names()[static_cast<std::size_t>(k.rotation)] + ',' +
             solver_names()[static_cast<std::size_t>(k.solver)] + ',' +
             std::to_string(k.iterations) + ',' +
             friction_names()[static_cast<std::size_t>(k.friction)] + ',' +
             std::to_string(k.joint_order) + ',' + (k.warm_start ? "1," : "0,") +
             (k.continuous ? "1," : "0,") + measured(cell.error, cell.cost, cell.pareto);
    }
    for (const PeerCurve& curve : result.peers)
      for (const CurvePoint& point : curve.points)
        out += what + curve.engine + ',' + quoted(label_of(curve)) + ",," +
               number(point.dt, "%.17g") + ",,,,,,,,," + measured(point.error, point.cost, false);
  }
  return out;
}

}  // namespace plumb::accuracy
