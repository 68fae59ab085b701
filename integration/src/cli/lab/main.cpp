// The program behind `plumb accuracy [CASE ...]`: of its own, because it needs the engine in every
// number type and `plumb` only in one.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/chaos.h"
#include "accuracy/peers.h"
#include "accuracy/report.h"
#include "accuracy/settings_table.h"
#include "cli/commands.h"
#include "cli/progress_bar.h"

namespace plumb::cli {
namespace {

using namespace accuracy;

struct AccuracyOptions {
  std::vector<std::string> cases;
  std::vector<std::string> dt, substeps, iterations, rotation, solver, friction, joint_order,
      precision, warm_start, continuous;
  std::string output, error, budget, table;
  bool list = false, quick = false, no_charts = false, quiet = false, peers = false;
};

constexpr std::size_t kMostCells = 100'000;
constexpr const char* kDefaultFolder = "plumb-accuracy";

// Case and '_' do not matter: rk4, RK4, implicit_gyro.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c != '_' && c != '-') out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

// --- what the user wrote -------------------------------------------------------------------------

std::string choose_cases(const std::vector<std::string>& wanted,
                         std::vector<const CaseInfo*>& cases) {
  const auto take = [&](const CaseInfo& info) {
    if (std::find(cases.begin(), cases.end(), &info) == cases.end()) cases.push_back(&info);
  };
  for (const std::string& word : wanted) {
    bool known = false;
    for (const CaseInfo& info : catalogue()) {
      if (plain(info.name) != plain(word) && plain(name_of(info.family)) != plain(word)) continue;
      take(info);
      known = true;
    }
    if (known) continue;
    std::vector<std::string> names;
    for (const CaseInfo& info : catalogue()) names.push_back(info.name);
    return "there is no case '" + word + "'; there are " + joined(names) +
           ", and the families free bouncing sliding jointed stacked published";
  }
  if (wanted.empty())
    for (const CaseInfo& info : catalogue()) take(info);
  return {};
}

// Each word of a list by its place among names; an error text that lists them.
std::string choose(const std::string& option, const std::vector<std::string>& words,
                   const std::vector<std::string>& names, std::vector<int>& out) {
  for (const std::string& word : words) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return plain(name) == plain(word);
    });
    if (found == names.end()) return option + ": '" + word + "' is none of " + joined(names);
    out.push_back(static_cast<int>(found - names.begin()));
  }
  return {};
}

std::string read_knobs(const AccuracyOptions& options, KnobChoice& knobs) {
  knobs.quick = options.quick;
  for (const std::string& word : options.dt) {
    double dt = 0;
    if (!parse_step(word, dt))
      return "--dt: '" + word + "' is no step; give seconds from 1e-5 to 0.5, such as 1/60";
    knobs.dt.push_back(dt);
  }
  std::vector<std::string> counts;
  for (int i = 1; i <= 64; ++i) counts.push_back(std::to_string(i));
  std::string wrong;
  const auto count = [&](const std::string& option, const std::vector<std::string>& words,
                         std::vector<int>& out) {
    for (const std::string& word : words) {
      const auto found = std::find(counts.begin(), counts.end(), word);
      if (found == counts.end() && wrong.empty())
        wrong = option + ": '" + word + "' is no number from 1 to 64";
      out.push_back(static_cast<int>(found - counts.begin()) + 1);
    }
  };
  count("--substeps", options.substeps, knobs.substeps);
  count("--iterations", options.iterations, knobs.iterations);
  if (wrong.empty())
    wrong = choose("--rotation", options.rotation, rotation_names(), knobs.rotation);
  if (wrong.empty()) wrong = choose("--solver", options.solver, solver_names(), knobs.solver);
  if (wrong.empty())
    wrong = choose("--friction", options.friction, friction_names(), knobs.friction);
  std::vector<int> chosen;
  if (wrong.empty()) wrong = choose("--joint-order", options.joint_order, {"2", "4"}, chosen);
  for (const int place : chosen) knobs.joint_order.push_back(place == 0 ? 2 : 4);
  chosen.clear();
  if (wrong.empty())
    wrong = choose("--precision", options.precision,
                   {std::begin(kPrecisionNames), std::end(kPrecisionNames)}, chosen);
  for (const int p : chosen) {
    knobs.precision.push_back(static_cast<Precision>(p));
    if (wrong.empty() && cells_of(knobs.precision.back()) == nullptr)
      wrong = std::string("--precision: this build has no ") + kPrecisionNames[p];
  }
  const auto switches = [&](const char* option, const std::vector<std::string>& words,
                            std::vector<bool>& out) {
    std::vector<int> places;
    if (wrong.empty()) wrong = choose(option, words, {"off", "on"}, places);
    for (const int place : places) out.push_back(place == 1);
  };
  switches("--warm-start", options.warm_start, knobs.warm_start);
  switches("--ccd", options.continuous, knobs.continuous);
  return wrong;
}

struct Questions {
  std::optional<double> error;   // [the case's unit]
  std::optional<double> budget;  // [s] for a body and a simulated second
};

std::string read_questions(const AccuracyOptions& options, Questions& questions) {
  if (!options.error.empty()) {
    char* end = nullptr;
    const double error = std::strtod(options.error.c_str(), &end);
    if (*end != '\0' || !(error > 0) || error > 1e300)
      return "--error: '" + options.error + "' is no error; give a positive number, such as 1e-3";
    questions.error = error;
  }
  if (!options.budget.empty()) {
    double budget = 0;
    if (!parse_duration(options.budget, budget))
      return "--budget: '" + options.budget + "' is no time; give one such as 200us or 1.5ms";
    questions.budget = budget;
  }
  return {};
}

// --- running -------------------------------------------------------------------------------------

void list_cases() {
  for (const CaseInfo& info : catalogue())
    std::printf("%-11s %-10s %s\n", info.name.c_str(), name_of(info.family), info.title.c_str());
}

void answer(const CaseResult& result, const Questions& questions) {
  const auto say = [&](const std::string& question, const CellResult* cell) {
    if (cell == nullptr) {
      std::printf("%s, %s: no cell of the grid\n", result.info->name.c_str(), question.c_str());
      return;
    }
    std::printf("%s, %s: %s  (error %.2e %s, %.3g us per body and simulated second)\n",
                result.info->name.c_str(), question.c_str(), words_of(cell->knobs).c_str(),
                cell->error, result.info->unit.c_str(), 1e6 * cell->cost);
  };
  char text[80];
  if (questions.error) {
    std::snprintf(text, sizeof text, "error <= %g %s", *questions.error, result.info->unit.c_str());
    say(text, cheapest(result, *questions.error));
  }
  if (questions.budget) {
    std::snprintf(text, sizeof text, "cost <= %g us", 1e6 * *questions.budget);
    say(text, most_accurate(result, *questions.budget));
  }
}

// The charts of all families that have cells; an error text of the first that failed.
std::string draw_all(const std::vector<CaseResult>& results, const std::string& folder) {
  for (int f = 0; f < kFamilyCount; ++f) {
    std::vector<const CaseResult*> members;
    for (const CaseResult& result : results)
      if (static_cast<int>(result.info->family) == f) members.push_back(&result);
    if (members.empty()) continue;
    for (const std::string type : {"png", "svg"}) {
      const std::string path = folder + "/" + name_of(static_cast<Family>(f)) + "." + type;
      const std::string wrong =
          draw(chart_script(members, static_cast<Family>(f), type, path + ".part"), path);
      if (!wrong.empty()) return wrong;
      std::printf("%s\n", path.c_str());
    }
  }
  return {};
}

std::string write_files(const std::vector<CaseResult>& results,
                        const std::vector<ChaosResult>& chaos, const std::string& folder,
                        bool charts) {
  if (!results.empty()) {
    const std::string path = folder + "/cells.csv";
    if (std::string wrong = write_whole(path, csv_of(results, circumstances())); !wrong.empty())
      return wrong;
    std::printf("\n%s\n", path.c_str());
  }
  for (const ChaosResult& result : chaos) {
    const std::string path = folder + "/" + result.info->name + ".csv";
    if (std::string wrong = write_whole(path, csv_of(result)); !wrong.empty()) return wrong;
    std::printf("%s\n", path.c_str());
  }
  if (!charts) return {};
  if (!has_gnuplot()) {
    complain("no charts: gnuplot is not installed (Debian: apt-get install gnuplot-nox)");
    return {};
  }
  return draw_all(results, folder);
}

int write_table(const AccuracyOptions& options) {
  const std::size_t slash = options.table.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : options.table.substr(0, slash + 1);
  if (const std::string wrong = make_folder(folder); !wrong.empty()) {
    complain("accuracy: " + wrong);
    return kBadInput;
  }
  const TableGrid grid;
  ProgressBar bar(settings_table_cells(grid), !options.quiet);
  std::size_t done = 0;
  std::string problem;
  const std::string text = settings_table(
      grid, [&](std::size_t n) { bar.show(done += n, -1); }, problem);
  if (problem.empty()) problem = write_whole(options.table, text);
  if (problem.empty()) return kOk;
  complain("accuracy: " + problem);
  return kBadInput;
}

int measure_accuracy(const AccuracyOptions& options) {
  std::vector<const CaseInfo*> cases;
  KnobChoice knobs;
  Questions questions;
  std::string wrong = choose_cases(options.cases, cases);
  if (wrong.empty()) wrong = read_knobs(options, knobs);
  if (wrong.empty()) wrong = read_questions(options, questions);
  std::size_t total = 0;
  for (const CaseInfo* info : cases)
    total += info->chaotic ? chaos_cells(*info, knobs) : cell_count(series_of(*info, knobs));
  if (wrong.empty() && total > kMostCells)
    wrong = "that is " + std::to_string(total) + " cells; at most " + std::to_string(kMostCells) +
            " are run at once";
  const bool asked = questions.error || questions.budget;
  const std::string peers = options.peers ? peers_program() : "";
  if (wrong.empty() && options.peers)
    wrong = asked ? "--peers: --error and --budget ask for settings of ours; leave one out"
                  : missing(peers);
  if (options.peers)
    for (const CaseInfo* info : cases) total += kMostPeers * peer_steps(*info, knobs).size();
  const std::string folder =
      options.output.empty() && !asked ? std::string(kDefaultFolder) : options.output;
  if (wrong.empty() && !folder.empty()) wrong = make_folder(folder);
  if (!wrong.empty()) {
    complain("accuracy: " + wrong);
    return kBadInput;
  }

  std::vector<CaseResult> results;
  std::vector<ChaosResult> chaos;
  std::vector<std::string> notes;  // what other engines left out
  {
    auto bar = std::make_unique<ProgressBar>(total, !options.quiet);
    std::size_t done = 0;
    const auto progress = [&](std::size_t n) { bar->show(done += n, -1); };
    const LabOptions lab{knobs, progress};
    for (const CaseInfo* info : cases) {
      if (info->chaotic) {
        if (!asked) chaos.push_back(run_chaos(*info, knobs, progress, wrong));
      } else {
        results.push_back(run_case(*info, series_of(*info, knobs), lab, wrong));
        if (options.peers && wrong.empty())
          wrong = add_peers(peers, results.back(), peer_steps(*info, knobs), knobs.quick, progress,
                            notes);
      }
      if (!wrong.empty()) {
        bar.reset();
        complain("accuracy: " + wrong);
        return kFailed;
      }
    }
  }
  for (const CaseResult& result : results) {
    if (!options.quiet && !asked) std::fputs(table_of(result).c_str(), stdout);
    if (asked) answer(result, questions);
  }
  for (const ChaosResult& result : chaos)
    if (!options.quiet) std::fputs(table_of(result).c_str(), stdout);
  for (const std::string& note : notes)
    if (!options.quiet) std::printf("left out: %s\n", note.c_str());
  if (asked && results.empty())
    complain("accuracy: a chaotic case has no error to ask for; run it without the question");
  if (folder.empty()) return kOk;
  wrong = write_files(results, chaos, folder, !options.no_charts);
  if (wrong.empty()) return kOk;
  complain("accuracy: " + wrong);
  return kFailed;
}

void add_options(CLI::App& app, AccuracyOptions& options) {
  app.add_option("CASE", options.cases, "Cases or families; none: all (--list names them)");
  app.add_flag("--list", options.list, "Name the cases and stop");
  app.add_flag("--quick", options.quick, "Fewer cells and shorter timings: within two minutes");
  app.add_option("--error", options.error,
                 "Print the cheapest setting with at most this error, in the case's unit");
  app.add_option("--budget", options.budget,
                 "Print the most accurate setting within this time for a body and a simulated "
                 "second, such as 200us");
  app.add_option("-o,--output", options.output,
                 "Folder for cells.csv and the charts (plumb-accuracy)");
  app.add_flag("--peers", options.peers,
               "Other engines beside ours, by the program plumb-peers (-DPLUMB_PEERS=ON)");
  app.add_flag("--no-charts", options.no_charts, "CSV only");
  const auto list = [&](const char* name, std::vector<std::string>& words, const char* help) {
    app.add_option(name, words, help)->delimiter(',');
  };
  list("--dt", options.dt, "Steps to run instead of the lab's own, such as 1/60,1/120");
  list("--substeps", options.substeps, "Likewise, 1 to 64");
  list("--rotation", options.rotation, "Likewise, rotation methods, such as Exact,RK4");
  list("--solver", options.solver, "Likewise, contact solvers: SoftStep, Newton, Auto, WorstFirst");
  list("--iterations", options.iterations, "Likewise, passes over the contacts, 1 to 64");
  list("--friction", options.friction, "Likewise, cones: Exact, 4-facets, 8-facets");
  list("--joint-order", options.joint_order, "Likewise, of jointed bodies in flight: 2, 4");
  list("--precision", options.precision, "Likewise: f32, f32d, f64");
  list("--warm-start", options.warm_start, "Likewise: on, off");
  list("--ccd", options.continuous, "Likewise, continuous collision of what flies fast: on, off");
  app.add_option("--table", options.table,
                 "Measure the table of WorldSettings::from_tolerance into this file and stop");
  app.add_flag("-q,--quiet", options.quiet, "No progress bar and no tables");
  app.footer(
      "Options that name knobs are combined with each other; one curve of the chart a "
      "combination.\n"
      "Example: plumb accuracy F6 C5 --quick -o lab");
}

int program(int argc, char** argv) {
  CLI::App app("What accuracy costs: error against time, by case and setting.", "plumb accuracy");
  AccuracyOptions options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kBadInput;
  }
  if (options.list) {
    list_cases();
    return kOk;
  }
  return options.table.empty() ? measure_accuracy(options) : write_table(options);
}

}  // namespace

void complain(const std::string& text) { std::fprintf(stderr, "plumb: %s\n", text.c_str()); }

}  // namespace plumb::cli

int main(int argc, char** argv) {
  try {
    return plumb::cli::program(argc, argv);
  } catch (const std::exception& error) {
    plumb::cli::complain(std::string("accuracy: unexpected: ") + error.what());
    return plumb::cli::kFailed;
  }
}
