// Reads the source tree as text: which files there are, and what each of them includes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::structure {

struct Include {
  std::string target;   // what stands between the brackets or quotes
  bool quoted = false;  // "target" rather than <target>
  int line = 0;         // 1-based
};

struct SourceFile {
  std::filesystem::path path;  // relative to the root of the tree, e.g. physics/src/world/step.cpp
  std::vector<Include> includes;
  int line_count = 0;
};

// All C and C++ files below root/folder, in the order of their paths.
std::vector<SourceFile> read_cpp_files(const std::filesystem::path& root,
                                       const std::string& folder);

// All hand-written text of a program below root/folder: C++, Rust, CMake, scripts.
std::vector<SourceFile> read_program_files(const std::filesystem::path& root,
                                           const std::string& folder);

}  // namespace plumb::structure
