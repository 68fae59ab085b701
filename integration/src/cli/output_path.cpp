#include "cli/output_path.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace plumb::cli {
namespace fs = std::filesystem;

namespace {

// Why no file can be made beside this one; empty if one can. Permissions alone do not tell: the
// folders of the system's own make no files for anybody.
std::string why_none_beside(const std::string& path) {
  const std::string probe = path + "." + std::to_string(getpid()) + ".probe";
  const int file = open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return std::strerror(errno);
  close(file);
  unlink(probe.c_str());
  return {};
}

}  // namespace

std::string why_no_file(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return path + " is a folder; give the name of a file";
  const fs::path parent = fs::path(path).parent_path();
  const fs::path folder = parent.empty() ? "." : parent;
  if (!fs::is_directory(folder, ignored)) {
    return path + " cannot be written: there is no folder " + folder.string() +
           "; make it first or give another name";
  }
  const bool there = fs::exists(path, ignored);
  if (const std::string reason = is_device(path) ? "" : why_none_beside(path); !reason.empty()) {
    return path + " cannot be written: no files can be made in the folder " + folder.string() +
           " (" + reason + "); give another name";
  }
  if (there && access(path.c_str(), W_OK) != 0) {
    return path + " cannot be written: it is there already and may not be changed; give another " +
           "name";
  }
  return {};
}

bool is_device(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) &&
         !fs::is_directory(path, ignored);
}

std::string behind_links(const std::string& path) {
  std::error_code problem;
  if (!fs::is_symlink(path, problem)) return path;
  const fs::path target = fs::weakly_canonical(path, problem);
  return problem ? path : target.string();
}

}  // namespace plumb::cli
