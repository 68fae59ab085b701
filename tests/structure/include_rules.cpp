#include "structure/include_rules.h"

#include <algorithm>
#include <set>

#include "structure/source_tree.h"

namespace plumb::structure {
namespace {

namespace fs = std::filesystem;

// What one folder's files may name. A prefix that ends in '/' stands for everything below it.
struct FolderRule {
  std::string folder;
  std::vector<std::string> public_prefixes;   // in public headers
  std::vector<std::string> private_prefixes;  // in sources, beside the public ones
  bool may_use_streams = true;                // <iostream>, <fstream>, <cstdio> and their like
  bool may_use_posix = true;                  // <unistd.h> and its like, in sources
};

const std::vector<FolderRule>& folder_rules() {
  static const std::vector<FolderRule> rules = {
      {.folder = "physics",
       .public_prefixes = {"plumb/physics:", "Eigen/"},
       .private_prefixes = {"immintrin.h"},  // the compiler's own vector instructions
       .may_use_streams = false,
       .may_use_posix = false},
      {.folder = "assets",
       .public_prefixes = {"plumb/physics:", "plumb/assets/"},
       .private_prefixes = {"Eigen/", "assimp/", "libqhullcpp/", "libqhull_r/", "nlohmann/"}},
      {.folder = "replay",
       .public_prefixes = {"plumb/physics:", "plumb/replay/"},
       .private_prefixes = {"Eigen/"}},
      {.folder = "integration",
       .public_prefixes = {"plumb/physics:", "plumb/assets/", "plumb/replay/",
                           "plumb/integration/"},
       .private_prefixes = {"Eigen/"}},
  };
  return rules;
}

// Standard headers that read, write or print. Physics does none of these.
const std::set<std::string> kStreamHeaders = {
    "cstdio",  "stdio.h", "iostream", "istream", "ostream",    "fstream",   "sstream",
    "iomanip", "print",   "format",   "ios",     "syncstream", "filesystem"};

bool is_standard_header(const std::string& name) {
  // C++ headers carry neither folder nor ending; the C ones in their old spelling end in .h.
  static const std::set<std::string> c_headers = {
      "assert.h", "errno.h",  "fenv.h",   "float.h", "limits.h", "math.h", "signal.h",
      "stddef.h", "stdint.h", "stdlib.h", "stdio.h", "string.h", "time.h", "stdbool.h"};
  return name.find_first_of("/.") == std::string::npos || c_headers.count(name) != 0;
}

bool is_posix_header(const std::string& name) {
  static const std::set<std::string> headers = {"dlfcn.h", "fcntl.h",   "poll.h", "pthread.h",
                                                "spawn.h", "termios.h", "time.h", "unistd.h"};
  return name.starts_with("sys/") || headers.count(name) != 0;
}

// "plumb/x.h", but not "plumb/assets/x.h".
bool is_physics_header(const std::string& name) {
  return name.starts_with("plumb/") && name.find('/', 6) == std::string::npos;
}

bool matches(const std::string& name, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
    if (prefix == "plumb/physics:") return is_physics_header(name);
    return prefix.ends_with('/') ? name.starts_with(prefix) : name == prefix;
  });
}

// A quoted name that is a file of the same folder: beside the includer or on the folder's own
// include paths (replay/rerun holds the header of the Rerun bridge).
bool is_own_file(const fs::path& root, const SourceFile& file, const std::string& folder,
                 const std::string& name) {
  const fs::path candidates[] = {root / file.path.parent_path() / name,
                                 root / folder / "src" / name, root / folder / "include" / name,
                                 root / folder / "rerun" / name, root / folder / name};
  const std::string own = (root / folder).lexically_normal().string() + "/";
  return std::any_of(std::begin(candidates), std::end(candidates), [&](const fs::path& path) {
    return fs::exists(path) && path.lexically_normal().string().starts_with(own);
  });
}

bool is_allowed(const fs::path& root, const FolderRule& rule, const SourceFile& file,
                const Include& include) {
  const std::string& name = include.target;
  const bool in_public_header = file.path.string().starts_with(rule.folder + "/include/");
  if (is_standard_header(name)) {
    return rule.may_use_streams || kStreamHeaders.count(name) == 0;
  }
  if (matches(name, rule.public_prefixes)) return true;
  // A header of another folder is never "own", whatever the tree looks like.
  if (name.starts_with("plumb/")) return false;
  if (in_public_header) return false;
  if (is_posix_header(name)) return rule.may_use_posix;
  // CLI11 belongs to the program alone.
  if (name.starts_with("CLI/")) return file.path.string().starts_with("integration/src/cli/");
  if (matches(name, rule.private_prefixes)) return true;
  return include.quoted && is_own_file(root, file, rule.folder, name);
}

}  // namespace

std::vector<std::string> find_forbidden_includes(const fs::path& root) {
  std::vector<std::string> violations;
  for (const FolderRule& rule : folder_rules()) {
    for (const SourceFile& file : read_cpp_files(root, rule.folder)) {
      for (const Include& include : file.includes) {
        if (is_allowed(root, rule, file, include)) continue;
        violations.push_back(
            file.path.string() + ":" + std::to_string(include.line) + ": includes " +
            include.target + ", which " + rule.folder +
            " must not see here (the table is in tests/structure/include_rules.h)");
      }
    }
  }
  return violations;
}

std::vector<std::string> find_long_files(const fs::path& root, int max_lines) {
  std::vector<std::string> violations;
  for (const std::string folder : {"physics", "assets", "replay", "integration", "tests"}) {
    for (const SourceFile& file : read_program_files(root, folder)) {
      if (file.line_count <= max_lines) continue;
      violations.push_back(file.path.string() + " has " + std::to_string(file.line_count) +
                           " lines; split it by idea (at most " + std::to_string(max_lines) + ")");
    }
  }
  return violations;
}

std::vector<std::string> find_stray_root_entries(const fs::path& root) {
  // The five folders, what tools look for at the root, and build/, which git ignores.
  static const std::set<std::string> allowed = {"CMakeLists.txt", "CMakePresets.json",
                                                "build.sh",       "LICENSE",
                                                "README.md",      "physics",
                                                "assets",         "replay",
                                                "integration",    "tests",
                                                "build"};
  std::vector<std::string> violations;
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') || allowed.count(name) != 0) continue;
    violations.push_back(name + " lies in the root; it belongs into one of the five folders");
  }
  std::sort(violations.begin(), violations.end());
  return violations;
}

}  // namespace plumb::structure
