// plumb run SCENE
#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>

#include "cli/commands.h"
#include "cli/forcing.h"
#include "cli/progress_bar.h"
#include "cli/read_number.h"
#include "cli/recording_file.h"
#include "cli/run_summary.h"
#include "cli/status_line.h"
#include "plumb/assets/scene.h"
#include "plumb/world.h"

namespace plumb::cli {
namespace {

constexpr double kShortestStep = 1e-9;  // [s] as in scene files
constexpr double kLongestStep = 1e3;    // [s]

// Ctrl-C, or a polite kill as of `timeout`, ends the run early instead of losing its recording; a
// second one ends the program at once.
volatile std::sig_atomic_t stop_wanted = 0;
extern "C" void ask_to_stop(int signal_number) {
  stop_wanted = 1;
  std::signal(signal_number, SIG_DFL);
}

std::string apply(const RunOptions& options, assets::Scene& scene) {
  if (options.dt) {
    double dt = 0;
    if (!(parse_seconds(*options.dt, dt) && dt >= kShortestStep && dt <= kLongestStep)) {
      return "--dt: '" + *options.dt +
             "' is no step; it must be from 1e-9 to 1e3 seconds, for example 0.01 or 1/60";
    }
    scene.step.dt = dt;
  }
  if (options.substeps) {
    scene.settings.substeps = *options.substeps;
    if (const Status status = check(scene.settings); !status.ok()) {
      return std::string("--substeps: ") + status.message;
    }
  }
  if (options.solver) {
    const auto word = std::find(kSolverWords.begin(), kSolverWords.end(), *options.solver);
    scene.settings.contact_solver = static_cast<ContactSolver>(word - kSolverWords.begin());
  }
  return force(options.forced, scene.settings);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Steps the world and fills the summary in; an error text if the run had to be given up.
std::string simulate(PhysicsWorld& world, const assets::Scene& scene, std::uint64_t steps,
                     bool quiet, const RecordingFile& recording, RunSummary& summary) {
  summary.begin(world);
  ProgressBar bar(steps, !quiet);
  for (std::uint64_t k = 0; k < steps && stop_wanted == 0; ++k) {
    const auto start = std::chrono::steady_clock::now();
    const StepReport& report = world.step(scene.step.dt);
    summary.step_seconds += seconds_since(start);
    if (!report.status.ok()) {
      return "step " + std::to_string(k + 1) + " was refused: " + report.status.message;
    }
    summary.add(world, report);
    if (std::string problem = recording.problem(); !problem.empty()) return problem;
    bar.show(k + 1, world.time());
  }
  return {};
}

}  // namespace

int run_scene(const RunOptions& options) {
  assets::Result<assets::Scene> loaded = assets::load_scene(options.scene);
  if (!loaded.ok()) {
    complain(loaded.error());
    return kBadInput;
  }
  assets::Scene& scene = loaded.value();
  if (const std::string wrong = apply(options, scene); !wrong.empty()) {
    complain(wrong);
    return kBadInput;
  }
  const std::uint64_t steps =
      options.steps ? static_cast<std::uint64_t>(*options.steps) : scene.step.count();
  if (options.steps) scene.step.duration = static_cast<double>(steps) * scene.step.dt;

  scene.settings.profiling = !options.output.empty();  // a recording shows the stages' times
  std::unique_ptr<JobSystem> jobs;  // outlives the world; made when all meshes are read by forks
  PhysicsWorld world;
  const assets::Result<assets::SceneInstance> instance = [&] {
    StatusLine status(!options.quiet);
    const auto show = [&](const std::string& work) { status.show(work); };
    return assets::instantiate(scene, world, {.guarded = true, .on_work = show});
  }();
  if (!instance.ok()) {
    complain(instance.error());
    return kBadInput;
  }
  if (options.threads != 1) jobs = make_thread_pool(options.threads);
  world.set_job_system(jobs.get());
  if (!options.quiet) {
    for (const std::string& note : instance->notes) complain("note: " + note);
  }

  StepDiagnostics diagnostics;
  diagnostics.ledger = options.ledger;
  world.set_diagnostics(diagnostics);
  RecordingFile recording;
  if (!options.output.empty()) {
    const std::string wrong =
        recording.open(options.output, scene, *instance, world, options.labels);
    if (!wrong.empty()) {
      complain(wrong);
      return kBadInput;
    }
  }

  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  RunSummary summary;
  std::string wrong = simulate(world, scene, steps, options.quiet, recording, summary);
  if (recording.is_open()) {
    const std::string unfinished = recording.finish(world);
    if (wrong.empty()) wrong = unfinished;
  }
  if (!options.quiet) summary.print(scene, *instance, world, recording, options.output);
  if (!wrong.empty()) complain(wrong);
  for (const std::string& lost : summary.lost_bodies(*instance, world)) complain(lost);
  if (stop_wanted != 0) complain("stopped at step " + std::to_string(summary.steps));
  const bool good = wrong.empty() && summary.lost.empty() && stop_wanted == 0;
  return good ? kOk : kFailed;
}

}  // namespace plumb::cli
