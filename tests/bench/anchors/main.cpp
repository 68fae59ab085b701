// plumb-anchors: the anchor scenes in our engine and in its peers, side by side on this machine.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "bench/anchors/growth.h"
#include "bench/anchors/scenes.h"
#include "bench/anchors/table.h"

namespace plumb::anchors {
namespace {

struct Options {
  std::vector<std::string> scenes, engines;
  std::vector<int> threads = {1};
  int repeats = 3, substeps = 0;
  bool profile = false, list = false, growth = false;
  std::string csv, chart;
};

// One line that is written over on a terminal; elsewhere a line a run.
class Progress {
 public:
  void begin(const std::string& what, int steps) {
    what_ = what;
    steps_ = steps;
    if (!terminal_) std::fprintf(stderr, "%s\n", what.c_str());
  }
  void show(int done) const {
    if (terminal_ && (done % 8 == 0 || done == steps_))
      std::fprintf(stderr, "\r\x1b[K%s: step %d of %d", what_.c_str(), done, steps_);
  }
  void end() const {
    if (terminal_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  std::string what_;
  int steps_ = 0;
};

bool wanted(const std::vector<std::string>& names, const std::string& name) {
  for (const std::string& other : names)
    if (other == name) return true;
  return false;
}

// The engines asked for; by default ours as it comes, and all peers. Empty: a name is unknown.
std::vector<const EngineKind*> choose_engines(const Options& options) {
  std::vector<const EngineKind*> out;
  for (const EngineKind& kind : engine_kinds()) {
    const bool by_default = kind.name.find('-') == std::string::npos;  // "ours-auto": a variant
    if (options.engines.empty() ? by_default : wanted(options.engines, kind.name))
      out.push_back(&kind);
  }
  for (const std::string& name : options.engines) {
    bool known = false;
    for (const EngineKind& kind : engine_kinds()) known = known || kind.name == name;
    if (known) continue;
    std::fprintf(stderr, "plumb-anchors: no engine '%s'; --list names them\n", name.c_str());
    return {};
  }
  return out;
}

SceneResult measure(Scene scene, const std::vector<const EngineKind*>& kinds,
                    const Options& options) {
  SceneResult result{std::move(scene), {}};
  for (const EngineKind* kind : kinds)
    for (const int threads : options.threads)
      if (threads <= kind->most_threads) result.entries.push_back({kind, threads, {}, {}, {}});
  Progress progress;
  const auto one = [&](const Entry& entry, bool profiling, bool check, const std::string& what) {
    const EngineOptions how{entry.threads, options.substeps, profiling};
    progress.begin(result.scene.name + " " + entry.kind->name + ", " +
                       std::to_string(entry.threads) + " thread(s), " + what,
                   result.scene.steps);
    Run out = run(*entry.kind, result.scene, how, check, [&](int done) { progress.show(done); });
    progress.end();
    return out;
  };
  for (int r = 0; r < options.repeats; ++r)
    for (Entry& entry : result.entries) {
      if (r > 0 && !entry.built()) continue;
      entry.runs.push_back(
          one(entry, false, r == 0,
              "run " + std::to_string(r + 1) + " of " + std::to_string(options.repeats)));
    }
  if (options.profile)
    for (Entry& entry : result.entries) {
      if (!entry.kind->ours || !entry.built()) continue;
      Run profiled = one(entry, true, false, "profile");
      entry.stages = std::move(profiled.stages);
    }
  return result;
}

bool write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.flush();
  if (file) return true;
  std::fprintf(stderr, "plumb-anchors: %s cannot be written\n", path.c_str());
  return false;
}

template <class Results>
bool draw(const Results& results, const std::string& path) {
  const std::string terminal = path.ends_with(".svg") ? "svg" : "png";
  const std::string script = chart_script(results, terminal, path);
  std::FILE* pipe = popen("gnuplot", "w");
  const bool said =
      pipe != nullptr && std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  if (pipe != nullptr && pclose(pipe) == 0 && said) return true;
  std::fprintf(stderr, "plumb-anchors: gnuplot could not draw %s\n", path.c_str());
  return false;
}

int list() {
  std::puts("scenes:");
  for (const SceneEntry& entry : catalogue()) std::printf("  %s\n", entry.name);
  std::puts("engines:");
  for (const EngineKind& kind : engine_kinds())
    std::printf("  %-12s %s\n", kind.name.c_str(), kind.settings.c_str());
  return 0;
}

int grow(const Options& options) {
  const std::vector<const EngineKind*> kinds = choose_engines(options);
  if (kinds.empty()) return 2;
  Progress progress;
  std::string running;
  const std::vector<Growth> growths =
      measure_growth(kinds, [&](const std::string& what, int done, int steps) {
        if (what != running) progress.begin(running = what, steps);
        progress.show(done);
      });
  progress.end();
  std::fputs(table_of(growths).c_str(), stdout);
  bool good = options.csv.empty() || write_file(options.csv, csv_of(growths));
  if (!options.chart.empty() && !growths.empty()) good = draw(growths, options.chart) && good;
  return good ? 0 : 1;
}

int measure_all(const Options& options) {
  const std::vector<const EngineKind*> kinds = choose_engines(options);
  if (kinds.empty()) return 2;
  for (const std::string& name : options.scenes) {
    bool known = false;
    for (const SceneEntry& entry : catalogue()) known = known || name == entry.name;
    if (known) continue;
    std::fprintf(stderr, "plumb-anchors: no scene '%s'; --list names them\n", name.c_str());
    return 2;
  }
  for (const EngineKind* kind : kinds)
    std::printf("%-12s %s\n", kind->name.c_str(), kind->settings.c_str());
  std::puts(
      "One thread: CPU time of the process; more: wall time. ms a step: median over the steps, "
      "best of the repeats;\nnoise: worst repeat over best; ratio: to the fastest peer with as "
      "many threads.");
  std::vector<SceneResult> results;
  bool good = true;
  for (const SceneEntry& entry : catalogue()) {
    if (!options.scenes.empty() && !wanted(options.scenes, entry.name)) continue;
    results.push_back(measure(entry.make(), kinds, options));
    std::fputs(table_of(results.back()).c_str(), stdout);
    std::fputs(profile_of(results.back()).c_str(), stdout);
    std::fflush(stdout);
    // After every scene: who stops a long run keeps what is done.
    if (good && !options.csv.empty()) good = write_file(options.csv, csv_of(results));
  }
  if (!options.chart.empty()) good = draw(results, options.chart) && good;
  return good ? 0 : 1;
}

int program(int argc, char** argv) {
  CLI::App app("The anchor scenes in Plumb and in its peers, side by side.", "plumb-anchors");
  Options options;
  app.add_option("SCENE", options.scenes, "Scenes such as S1; none: all (--list names them)");
  app.add_option("--engines", options.engines, "Such as ours,bullet; none: ours and all peers")
      ->delimiter(',');
  app.add_option("--threads", options.threads, "Such as 1,2; engines that cannot are left out")
      ->delimiter(',')
      ->check(CLI::Range(1, 256));
  app.add_option("--repeats", options.repeats, "Runs of each engine, taken in turn")
      ->check(CLI::Range(1, 100));
  app.add_option("--substeps", options.substeps, "Of ours; 0: its default")
      ->check(CLI::Range(0, 64));
  app.add_flag("--profile", options.profile, "One more run of ours that tells its stages apart");
  app.add_option("--csv", options.csv, "Write the figures into this file");
  app.add_option("--chart", options.chart, "Draw them into this .svg or .png (needs gnuplot)");
  app.add_flag("--growth", options.growth,
               "Instead: how a step grows with the number of bodies, from 1e3 to 1e5")
      ->excludes("SCENE");
  app.add_flag("--list", options.list, "Name scenes and engines and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (options.list) return list();
  return options.growth ? grow(options) : measure_all(options);
}

}  // namespace
}  // namespace plumb::anchors

int main(int argc, char** argv) {
  try {
    return plumb::anchors::program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plumb-anchors: unexpected: %s\n", error.what());
    return 1;
  }
}
