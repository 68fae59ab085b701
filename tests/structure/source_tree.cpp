#include "structure/source_tree.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>

namespace plumb::structure {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> kCppEndings = {".h", ".hpp", ".inl", ".c", ".cpp"};
const std::set<std::string> kProgramEndings = {".h",  ".hpp",   ".inl", ".c", ".cpp",
                                               ".rs", ".cmake", ".sh",  ".py"};
// What a build tool leaves inside a folder is not part of the tree.
const std::set<std::string> kGeneratedFolders = {"target", "build"};

SourceFile read_file(const fs::path& root, const fs::path& path) {
  static const std::regex include_line(R"(^\s*#\s*include\s*([<"])([^">]+)[">])");
  SourceFile file;
  file.path = path.lexically_relative(root);
  std::ifstream stream(path);
  std::string text;
  while (std::getline(stream, text)) {
    ++file.line_count;
    std::smatch match;
    if (std::regex_search(text, match, include_line)) {
      file.includes.push_back({match[2], match[1] == "\"", file.line_count});
    }
  }
  return file;
}

std::vector<SourceFile> read_files(const fs::path& root, const std::string& folder,
                                   const std::set<std::string>& endings) {
  std::vector<SourceFile> files;
  if (!fs::exists(root / folder)) return files;
  for (auto it = fs::recursive_directory_iterator(root / folder);
       it != fs::recursive_directory_iterator(); ++it) {
    if (it->is_directory() && kGeneratedFolders.count(it->path().filename().string()) != 0) {
      it.disable_recursion_pending();
    }
    const bool wanted = endings.count(it->path().extension().string()) != 0 ||
                        it->path().filename() == "CMakeLists.txt";
    if (it->is_regular_file() && wanted) files.push_back(read_file(root, it->path()));
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::vector<SourceFile> read_cpp_files(const fs::path& root, const std::string& folder) {
  std::vector<SourceFile> files = read_files(root, folder, kCppEndings);
  std::erase_if(files, [](const SourceFile& file) { return file.path.extension() == ".txt"; });
  return files;
}

std::vector<SourceFile> read_program_files(const fs::path& root, const std::string& folder) {
  return read_files(root, folder, kProgramEndings);
}

}  // namespace plumb::structure
