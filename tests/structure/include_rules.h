// Who may include what. The table of dependencies, written down once as data:
//
//   folder        may see
//   physics       Eigen, the standard library without its streams and files
//   assets        physics; assimp, Qhull, nlohmann-json in its sources
//   replay        physics; the Rerun bridge (a header of its own) in its sources
//   integration   physics, assets, replay; CLI11 in the sources of the program
//
// Public headers show no third-party type at all; the one exception is Eigen in physics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::structure {

// One sentence a violation, naming file, line and what is allowed instead.
std::vector<std::string> find_forbidden_includes(const std::filesystem::path& root);

// Files of more than max_lines lines.
std::vector<std::string> find_long_files(const std::filesystem::path& root, int max_lines);

// Entries of the root folder that belong into one of the five folders.
std::vector<std::string> find_stray_root_entries(const std::filesystem::path& root);

}  // namespace plumb::structure
