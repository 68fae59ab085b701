// The `plumb` program: command line, help and exit codes.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "cli/accuracy.h"
#include "cli/commands.h"
#include "plumb/integration/version.h"
#include "plumb/precision.h"

namespace plumb::cli {

void complain(const std::string& text) { std::fprintf(stderr, "plumb: %s\n", text.c_str()); }

namespace {

#if defined(PLUMB_WITH_REPLAY)
constexpr const char* kRecording = "records and replays";
#else
constexpr const char* kRecording = "built without recording";
#endif

constexpr int kMostThreads = 256;
constexpr std::int64_t kMostSteps = 1'000'000'000'000;  // years of computing: beyond is a slip

// An empty text, as of a shell variable that was never set, is no name: it asks for nothing.
CLI::Validator not_empty() {
  return {[](const std::string& text) {
            return text.empty() ? std::string("the name of the file is empty") : std::string();
          },
          ""};
}

void add_forced(CLI::App& command, ForcedNames& forced) {
  command.add_option("--without", forced.off, "Item of the plan to leave out, such as gyroscopic")
      ->allow_extra_args(false);
  command.add_option("--with", forced.on, "Item of the plan to run everywhere, such as look_ahead")
      ->allow_extra_args(false);
}

void add_run(CLI::App& app, RunOptions& options, int& exit_code) {
  CLI::App* run = app.add_subcommand("run", "Simulate a scene; record it with -o");
  run->add_option("SCENE", options.scene, "Scene file (JSON)")->required();
  CLI::Option* output =
      run->add_option("-o,--output", options.output, "Write a Rerun recording (.rrd) to this file")
          ->check(not_empty());
  run->add_option("--steps", options.steps, "Number of steps instead of the scene's duration")
      ->check(CLI::Range(std::int64_t{0}, kMostSteps));
  run->add_option("--dt", options.dt,
                  "Length of a step in seconds, such as 0.01 or 1/60, instead of the scene's");
  run->add_option("--substeps", options.substeps, "Solver steps within one step (1 to 64)");
  run->add_option("--solver", options.solver, "Contact solver instead of the scene's")
      ->check(CLI::IsMember(std::vector<std::string>(kSolverWords.begin(), kSolverWords.end())));
  add_forced(*run, options.forced);
  run->add_option("--threads", options.threads, "Threads to step with; 0: all of the machine")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
  run->add_flag("--labels", options.labels, "Show names beside bodies and joints in the recording");
  run->add_flag("--ledger", options.ledger,
                "Show in the recording where the energy and momentum of each step went; slower")
      ->needs(output);
  run->add_flag("-q,--quiet", options.quiet, "No progress bar and no summary");
  run->callback([&] { exit_code = run_scene(options); });
}

void add_mesh(CLI::App& app, MeshOptions& options, int& exit_code) {
  CLI::App* mesh = app.add_subcommand("mesh", "Certificate, mass and hull of a mesh file");
  mesh->add_option("FILE", options.file, "OBJ, STL, PLY, glTF, FBX, Collada, OFF and more")
      ->required();
  mesh->add_option("--method", options.method, "How the mass is found")
      ->check(CLI::IsMember({"solid", "shell", "hull", "voxel"}))
      ->capture_default_str();
  mesh->add_option("--density", options.density, "In kg/m^3")->capture_default_str();
  mesh->add_option("--thickness", options.thickness, "Of a shell, in metres");
  mesh->add_option("--metres-per-unit", options.metres_per_unit,
                   "Metres in one unit of the file; default: what the file says");
  mesh->add_option("--up", options.up,
                   "Axis of the file that points up; default: what the file says")
      ->check(CLI::IsMember({"x", "y", "z"}));
  mesh->add_flag(
      "--repair", options.repair,
      "Drop needless faces and turn the others outwards first, as a scene's repair does");
  mesh->add_option("--weld", options.weld,
                   "The same, and join vertices nearer than this, in metres");
  mesh->add_flag("--parts", options.parts, "Also cut it into convex parts, and report on them");
  mesh->add_option("--parts-distance", options.parts_distance,
                   "How far parts may reach out of the mesh, in metres (0.02 of its size)");
  mesh->add_option("--max-parts", options.max_parts, "The most parts")->capture_default_str();
  mesh->add_flag("--json", options.json, "For programs: one JSON object");
  mesh->callback([&] { exit_code = inspect_mesh(options); });
}

struct EffectsOptions {
  std::string csv, chart;
  bool scaling = false, audit = false;
  std::vector<std::string> scenes;
};

void add_effects(CLI::App& app, EffectsOptions& options, int& exit_code) {
  CLI::App* effects = app.add_subcommand("effects", "What each effect costs on this machine");
  effects->add_option("--csv", options.csv, "Write the list to this file too")->check(not_empty());
  CLI::Option* scaling = effects->add_flag(
      "--scaling", options.scaling, "Against the number of bodies that have it: cost = a + b k");
  effects->add_option("--chart", options.chart, "Draw it to this file, .svg or .png")
      ->check(not_empty())
      ->needs(scaling);
  CLI::Option* audit =
      effects
          ->add_flag("--audit", options.audit,
                     "Whether the plan chooses rightly: leave each item out and compare")
          ->excludes(scaling);
  effects
      ->add_option("SCENE", options.scenes,
                   "Scene files, or folders of them, to audit beside those drawn by lot")
      ->needs(audit);
  effects->callback([&] {
    if (options.audit) {
      exit_code = audit_plans(options.scenes, options.csv);
      return;
    }
    exit_code = options.scaling ? print_effect_scaling(options.csv, options.chart)
                                : print_effect_prices(options.csv);
  });
}

struct ReplayOptions {
  std::string file_a, file_b;
  int threads = 1;
};

void add_replay(CLI::App& app, ReplayOptions& options, int& exit_code) {
  CLI::App* replay = app.add_subcommand("replay", "Look into recordings and simulate them again");
  replay->require_subcommand(1);
  CLI::App* info = replay->add_subcommand("info", "What a recording holds");
  info->add_option("FILE", options.file_a, "Recording (.rrd)")->required();
  info->callback([&] { exit_code = replay_info(options.file_a); });

  CLI::App* verify = replay->add_subcommand(
      "verify", "Simulate again from the recording alone and compare every frame, bit by bit");
  verify->add_option("FILE", options.file_a, "Recording (.rrd)")->required();
  verify->add_option("--threads", options.threads, "Threads to step with; 0: all of the machine")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
  verify->callback([&] { exit_code = replay_verify(options.file_a, options.threads); });

  CLI::App* diff = replay->add_subcommand("diff", "Where two recordings part");
  diff->add_option("A", options.file_a, "Recording (.rrd)")->required();
  diff->add_option("B", options.file_b, "Recording (.rrd)")->required();
  diff->callback([&] { exit_code = replay_diff(options.file_a, options.file_b); });
}

// Of a command line that names no command: the word that stands in its place; empty if none does.
std::string unknown_command(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  if (!parsed.empty()) return unknown_command(*parsed.front());
  const std::vector<std::string> rest = app.remaining();
  if (rest.empty() || app.get_subcommands({}).empty()) return {};
  std::string names;
  for (const CLI::App* command : app.get_subcommands({}))
    names += (names.empty() ? "" : ", ") + command->get_name();
  return "there is no command '" + rest.front() + "'; there are " + names;
}

int program(int argc, char** argv) {
  CLI::App app("Plumb: rigid-body physics for game engines.", "plumb");
  app.set_version_flag("--version", std::string("plumb ") + PLUMB_VERSION_STRING + " (" +
                                        kPrecisionName + ", " + kRecording + ")");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 all is well, 1 a run or check failed, 2 bad input.\n"
      "Example:    plumb run assets/scenes/default.json -o run.rrd");

  int exit_code = kOk;
  RunOptions run;
  MeshOptions mesh;
  ReplayOptions replay;
  std::string plan_scene;
  add_run(app, run, exit_code);
  add_mesh(app, mesh, exit_code);
  CLI::App* plan = app.add_subcommand("plan", "Which effects and stages a scene pays for, and why");
  plan->add_option("SCENE", plan_scene, "Scene file (JSON)")->required();
  ForcedNames plan_forced;
  add_forced(*plan, plan_forced);
  plan->callback([&] { exit_code = print_plan(plan_scene, plan_forced); });
  EffectsOptions effects;
  add_effects(app, effects, exit_code);
  add_replay(app, replay, exit_code);
  std::vector<std::string> lab_arguments;
  add_accuracy(app, lab_arguments, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_command(app);
    if (!unknown.empty() && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
      complain(unknown);
      return kBadInput;
    }
    // Help and version come this way too, with 0; all else is the user's to correct.
    return app.exit(error) == 0 ? kOk : kBadInput;
  }
  return exit_code;
}

}  // namespace
}  // namespace plumb::cli

int main(int argc, char** argv) {
  try {
    return plumb::cli::program(argc, argv);
  } catch (const std::exception& error) {
    plumb::cli::complain(std::string("unexpected: ") + error.what());
    return plumb::cli::kFailed;
  }
}
