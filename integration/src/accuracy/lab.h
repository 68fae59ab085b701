// The lab: runs cells, and says what came of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/grid.h"

namespace plumb::accuracy {

struct CellResult {
  std::size_t series = 0;  // index into CaseResult::series
  Knobs knobs;
  double error = 0;     // in the case's unit; infinite where the run blew up
  double cost = 0;      // [s] of computing for a body and a simulated second
  bool pareto = false;  // no other cell of the case is both cheaper and better
};

// error ~ dt^order over the cells of a series that are neither round-off nor beyond use.
struct OrderFit {
  std::size_t series = 0;
  double order = 0;
  int points = 0;
  bool found = false;  // at least three points, on a line but for a tenth of their spread
};

// Another engine in the case: a curve beside ours, with the step as its knob (peers.h). It takes no
// part in the Pareto front, nor in answers: those are about our settings.
struct CurvePoint {
  double dt = 0;     // [s]
  double error = 0;  // as CellResult's
  double cost = 0;   // [s]
};
struct PeerCurve {
  std::string engine, settings;  // "bullet"; version and what it is run with
  std::vector<CurvePoint> points;
  OrderFit fit;
};

struct CaseResult {
  const CaseInfo* info = nullptr;
  std::vector<Series> series;
  std::vector<CellResult> cells;
  std::vector<OrderFit> fits;
  std::vector<PeerCurve> peers;
  std::vector<double> right;  // the right readings
  // [unit] between the reference and the same at twice its step: errors below a few of these mean
  // nothing. 0 for closed forms.
  double reference_spread = 0;
};

struct LabOptions {
  KnobChoice knobs;
  std::function<void(std::size_t done)> progress;  // cells
};

double distance(const std::vector<double>& a, const std::vector<double>& b);  // Euclidean
double timing_window(bool quick);                                             // [s] of a timed run

// Empty message: all is well.
CaseResult run_case(const CaseInfo& info, const std::vector<Series>& series,
                    const LabOptions& options, std::string& problem);

// --- what the cells say (analysis.cpp) -----------------------------------------------------------

void mark_pareto(std::vector<CellResult>& cells);
OrderFit fit_order(const CaseResult& result, std::size_t series);
OrderFit fit_order(const CaseResult& result, const std::vector<CurvePoint>& points);
// The cheapest with at most that error; the most accurate within that cost. Null: none.
const CellResult* cheapest(const CaseResult& result, double error);
const CellResult* most_accurate(const CaseResult& result, double cost);

}  // namespace plumb::accuracy
