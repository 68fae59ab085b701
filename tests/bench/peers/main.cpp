// plumb-peers: cases of the accuracy lab in other engines. Prints CSV, a row a run; lines that
// begin with # say what was left out. `plumb accuracy --peers` starts it and draws its rows beside
// ours.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/peers/run.h"

namespace plumb::peers {
namespace {

using anchors::EngineKind;

constexpr int kBadInput = 2;

struct Options {
  std::vector<std::string> cases, engines;
  std::vector<double> dt = {1.0 / 15, 1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480, 1e-3};
  double window = 0.03;  // [s]
  bool list = false;
};

int refuse(const std::string& text) {
  std::fprintf(stderr, "plumb-peers: %s\n", text.c_str());
  return kBadInput;
}

int list() {
  for (const accuracy::Setup& setup : accuracy::setups())
    std::printf("case %s\n", setup.name.c_str());
  for (const EngineKind& kind : anchors::engine_kinds())
    std::printf("engine %s %s\n", kind.name.c_str(), kind.settings.c_str());
  return 0;
}

bool wanted(const Options& options, const EngineKind& kind) {
  if (options.engines.empty()) return !kind.ours;
  return std::find(options.engines.begin(), options.engines.end(), kind.name) !=
         options.engines.end();
}

int measure(const Options& options) {
  std::vector<const accuracy::Setup*> cases;
  for (const std::string& name : options.cases) {
    cases.push_back(accuracy::find_setup(name));
    if (cases.back() == nullptr)
      return refuse("there is no case '" + name + "'; --list names them");
  }
  for (const std::string& name : options.engines) {
    bool known = false;
    for (const EngineKind& kind : anchors::engine_kinds()) known = known || kind.name == name;
    if (!known) return refuse("there is no engine '" + name + "'; --list names them");
  }
  if (std::none_of(anchors::engine_kinds().begin(), anchors::engine_kinds().end(),
                   [&](const EngineKind& kind) { return wanted(options, kind); }))
    return refuse("no other engine was found when this was built");
  if (options.cases.empty())
    for (const accuracy::Setup& setup : accuracy::setups()) cases.push_back(&setup);
  std::fputs(header_row().c_str(), stdout);
  for (const accuracy::Setup* setup : cases)
    for (const EngineKind& kind : anchors::engine_kinds()) {
      if (!wanted(options, kind)) continue;
      for (const double dt : options.dt) {
        const Outcome outcome = run(kind, *setup, dt);
        if (!outcome.built) {
          std::printf("# %s: %s cannot build it\n", setup->name.c_str(), kind.name.c_str());
          break;
        }
        const double seconds = cost(kind, *setup, dt, options.window);
        std::fputs(row_of(setup->name, kind, dt, outcome, seconds).c_str(), stdout);
        std::fflush(stdout);  // whoever reads along sees each as it comes
      }
    }
  return 0;
}

int program(int argc, char** argv) {
  CLI::App app("Cases of the accuracy lab in other engines, as CSV.", "plumb-peers");
  Options options;
  app.add_option("CASE", options.cases, "Cases such as F6; none: all (--list names them)");
  app.add_option("--engines", options.engines, "Such as bullet,ours; none: all peers")
      ->delimiter(',');
  app.add_option("--dt", options.dt, "Steps [s]")->delimiter(',')->check(CLI::Range(1e-5, 0.5));
  app.add_option("--window", options.window, "Seconds of a timed run")
      ->check(CLI::Range(1e-4, 100.0));
  app.add_flag("--list", options.list, "Name cases and engines and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  return options.list ? list() : measure(options);
}

}  // namespace
}  // namespace plumb::peers

int main(int argc, char** argv) {
  try {
    return plumb::peers::program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plumb-peers: unexpected: %s\n", error.what());
    return 1;
  }
}
