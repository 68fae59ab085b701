// One scene in one engine, timed step by step and judged.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/anchors/engines/engine.h"
#include "bench/anchors/judge/check.h"

namespace plumb::anchors {

using Named = std::vector<std::pair<std::string, double>>;

struct Run {
  bool built = false;  // false: the engine cannot do the scene
  // Over the steps after the warm-up; CPU time of the process with one thread, wall time with more.
  double median = 0;       // [s] a step
  double mean = 0;         // [s] a step
  double build_bytes = 0;  // [B] by which the heap grew when the scene was built
  double end_bytes = 0;    // [B] by which it has grown at the end
  Named stages;            // [s] a step, mean; where the engine tells
  Named counts;            // of the last step
  Quality quality;
};

// progress: told the steps done. check: false leaves out what takes the checker seconds.
Run run(const EngineKind& kind, const Scene& scene, const EngineOptions& options, bool check,
        const std::function<void(int)>& progress);

// All repeats of one engine and number of threads in one scene.
struct Entry {
  const EngineKind* kind = nullptr;
  int threads = 1;
  std::vector<Run> runs;  // quality of the first
  Named stages, counts;   // of a run of its own, with profiling

  [[nodiscard]] bool built() const { return !runs.empty() && runs.front().built; }
  // [s] a step: the least and largest of the runs' medians, the least of their means.
  [[nodiscard]] double best() const;
  [[nodiscard]] double worst() const;
  [[nodiscard]] double mean() const;
};

// One scene with all its entries, in the order of engine_kinds().
struct SceneResult {
  Scene scene;  // bodies kept: their number is printed
  std::vector<Entry> entries;
};

}  // namespace plumb::anchors
