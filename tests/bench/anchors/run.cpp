#include "bench/anchors/run.h"

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <limits>

namespace plumb::anchors {
namespace {

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Run run(const EngineKind& kind, const Scene& scene, const EngineOptions& options, bool check,
        const std::function<void(int)>& progress) {
  Run out;
  const double heap = heap_bytes();
  const std::unique_ptr<Engine> engine = kind.make(scene, options);
  if (engine == nullptr) return out;
  out.built = true;
  out.build_bytes = heap_bytes() - heap;

  const clockid_t clock = options.threads > 1 ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID;
  Checker checker(scene);
  std::vector<BodyState> bodies(scene.bodies.size());
  std::vector<double> times;
  for (int i = 0; i < scene.steps; ++i) {
    const double begin = seconds(clock);
    engine->step(scene.dt);
    const double time = seconds(clock) - begin;
    if (i >= scene.warm_up) {
      times.push_back(time);
      if (options.profiling) {
        const Named stages = engine->stages();
        out.stages.resize(stages.size());
        for (std::size_t k = 0; k < stages.size(); ++k) {
          out.stages[k].first = stages[k].first;
          out.stages[k].second += stages[k].second / (scene.steps - scene.warm_up);
        }
      }
    }
    if (check && checker.watches()) {
      engine->read(bodies);
      checker.after_step(bodies);
    }
    progress(i + 1);
  }
  out.counts = engine->counts();
  for (const double time : times) out.mean += time / static_cast<double>(times.size());
  out.median = median_of(std::move(times));
  out.end_bytes = heap_bytes() - heap;
  if (check) {
    engine->read(bodies);
    out.quality = checker.finish(bodies);
  }
  return out;
}

double Entry::best() const {
  double out = std::numeric_limits<double>::infinity();
  for (const Run& r : runs) out = std::min(out, r.median);
  return out;
}
double Entry::worst() const {
  double out = 0;
  for (const Run& r : runs) out = std::max(out, r.median);
  return out;
}
double Entry::mean() const {
  double out = std::numeric_limits<double>::infinity();
  for (const Run& r : runs) out = std::min(out, r.mean);
  return out;
}

}  // namespace plumb::anchors
