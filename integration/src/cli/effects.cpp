// plumb effects: what each effect costs a body and step on this machine.
//
// A thousand bodies that fly freely are stepped with one effect on each, and without: the
// difference, by bodies, is the price. The best of several runs counts; the rest is what else the
// machine was doing.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <vector>

#include "cli/commands.h"
#include "cli/effect_flight.h"
#include "cli/output_path.h"
#include "plumb/world.h"

namespace plumb::cli {
namespace {

constexpr int kBodies = 1000;
constexpr int kSteps = 20;
constexpr int kRuns = 7;
constexpr int kBar = 40;  // [characters] of the dearest

struct Price {
  const char* name;
  EffectKind kind;
  double nanoseconds = 0;  // a body and step
};

// Seconds a step; null: without effects.
double step_time(const EffectKind* kind) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    EffectFlight flight(kind != nullptr ? *kind : EffectKind{}, kBodies,
                        kind != nullptr ? kBodies : 0);
    flight.step(3);
    const auto begin = std::chrono::steady_clock::now();
    flight.step(kSteps);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count() / kSteps);
  }
  return best;
}

}  // namespace

int print_effect_prices(const std::string& csv) {
  if (const std::string wrong = csv.empty() ? "" : why_no_file(csv); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  std::vector<Price> prices;
  for (const NamedEffect& effect : every_effect()) prices.push_back({effect.name, effect.kind});
  const double bare = step_time(nullptr);
  double dearest = 0;
  for (Price& price : prices) {
    price.nanoseconds = std::max(0.0, step_time(&price.kind) - bare) / kBodies * 1e9;
    dearest = std::max(dearest, price.nanoseconds);
  }
  std::printf(
      "Nanoseconds a body and step of %d substeps, %s, one thread; a free body alone: %.0f\n",
      WorldSettings{}.substeps, kPrecisionName, bare / kBodies * 1e9);
  for (const Price& price : prices) {
    const int length = dearest > 0 ? static_cast<int>(kBar * price.nanoseconds / dearest + 0.5) : 0;
    std::printf("%-20s %8.0f  ", price.name, price.nanoseconds);
    for (int i = 0; i < length; ++i) std::fputc('#', stdout);
    std::fputc('\n', stdout);
  }
  if (csv.empty()) return kOk;
  std::ofstream file(csv);
  file << "effect,nanoseconds_per_body_and_step\nnone," << bare / kBodies * 1e9 << "\n";
  for (const Price& price : prices) file << price.name << "," << price.nanoseconds << "\n";
  file.flush();
  if (!file) {
    complain("cannot write " + csv + "; is the disk full?");
    return kFailed;
  }
  return kOk;
}

}  // namespace plumb::cli
