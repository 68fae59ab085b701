// What the `plumb` program can do: one function a subcommand, each returns the exit code.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plumb::cli {

enum ExitCode : int {
  kOk = 0,
  kFailed = 1,    // a run or a check did not succeed
  kBadInput = 2,  // the user has to correct something: an option, a file, a path
};

// The words of the scene key contact_solver, in the order of ContactSolver.
inline constexpr std::array<const char*, 4> kSolverWords{"soft_step", "newton", "auto",
                                                         "worst_first"};

// Items of the plan that the user forces off and on, by name.
struct ForcedNames {
  std::vector<std::string> off, on;
};

struct RunOptions {
  std::string scene;
  ForcedNames forced;
  std::string output;                 // empty: nothing is recorded
  std::optional<std::int64_t> steps;  // >= 0
  std::optional<std::string> dt;      // [s] "0.01" or "1/60"
  std::optional<int> substeps;
  std::optional<std::string> solver;  // one of kSolverWords
  int threads = 1;                    // 0: as many as the machine has
  bool labels = false;                // names in the recording's 3D view
  bool ledger = false;                // energy and momentum ledger in the recording's plots
  bool quiet = false;
};
int run_scene(const RunOptions& options);

struct MeshOptions {
  std::string file;
  std::string method = "solid";
  std::string up;         // empty: what the file says
  double density = 1000;  // [kg/m^3]
  double thickness = 0;   // [m] of a shell
  std::optional<double> metres_per_unit;
  std::optional<double> weld;            // [m] >= 0; asks for a repair too
  bool repair = false;                   // drop needless faces and turn the others outwards
  bool parts = false;                    // cut it into convex parts
  std::optional<double> parts_distance;  // [m] the same, with this distance
  std::size_t max_parts = 32;
  bool json = false;
};
int inspect_mesh(const MeshOptions& options);

// The price list of effects; also as a table for programs, if `csv` names a file.
int print_effect_prices(const std::string& csv);
// What each costs against the number of bodies that carry it; `chart` names an .svg or .png.
int print_effect_scaling(const std::string& csv, const std::string& chart);
// Whether the plan chooses rightly, over these scenes and many drawn by lot.
int audit_plans(const std::vector<std::string>& scenes, const std::string& csv);
int print_plan(const std::string& scene, const ForcedNames& forced);

int replay_info(const std::string& recording);
int replay_verify(const std::string& recording, int threads);
int replay_diff(const std::string& recording_a, const std::string& recording_b);

// To stderr, with the program's name before it.
void complain(const std::string& text);

}  // namespace plumb::cli
