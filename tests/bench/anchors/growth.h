// How the time of a step grows with the number of bodies, from 1e3 to 1e5.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/anchors/run.h"

namespace plumb::anchors {

// One kind of scene in one engine.
struct Growth {
  std::string title, engine;
  struct At {
    int bodies = 0;
    double step = 0;  // [s] median
  };
  std::vector<At> at;
  // p of the power law time ~ (n log n)^p that fits best: at most 1 where nothing grows faster.
  [[nodiscard]] double exponent() const;
};

// progress: told what runs, and the steps done of how many.
using GrowthProgress = std::function<void(const std::string&, int, int)>;
// Engines that cannot do a scene are left out.
std::vector<Growth> measure_growth(const std::vector<const EngineKind*>& engines,
                                   const GrowthProgress& progress);

std::string table_of(const std::vector<Growth>& growths);
std::string csv_of(const std::vector<Growth>& growths);
// Time a body over the number of bodies. terminal: "svg" or "png".
std::string chart_script(const std::vector<Growth>& growths, const std::string& terminal,
                         const std::string& output);

}  // namespace plumb::anchors
