// Chaotic scenes: what can be said of them, and for how long.
//
// A twin whose first body is shifted by 1e-9 m leaves its original by more than a millimetre after
// some time: the horizon. Until then an error means something and is given; after it only
// statistics over an ensemble of scenes do, each with the bar of its 95 % confidence.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accuracy/grid.h"

namespace plumb::accuracy {

struct Estimate {
  double mean = 0, bar = 0;  // half the 95 % interval
};

struct ChaosRow {
  Knobs knobs;
  double horizon = 0;  // [s]
  double error = 0;    // [m] largest distance from the reference up to the nearer horizon
  std::vector<Estimate> statistics;  // in the order of kStatistics
  double cost = 0;                   // [s] for a body and a simulated second
};

struct ChaosResult {
  const CaseInfo* info = nullptr;
  int members = 0;     // of the ensemble
  ChaosRow reference;  // double at a 16th of 1/60 s
  std::vector<ChaosRow> rows;
};

ChaosResult run_chaos(const CaseInfo& info, const KnobChoice& choice,
                      const std::function<void(std::size_t)>& progress, std::string& problem);
std::size_t chaos_cells(const CaseInfo& info, const KnobChoice& choice);
std::string table_of(const ChaosResult& result);
std::string csv_of(const ChaosResult& result);

// --- pieces, for tests ---------------------------------------------------------------------------

// [s] of the last look at which two traces were no farther apart than `apart` [m].
double horizon_of(const Trace& a, const Trace& b, double every, double apart);
Estimate estimate_of(const std::vector<double>& values);

}  // namespace plumb::accuracy
