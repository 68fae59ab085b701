#include "accuracy/files.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace plumb::accuracy {
namespace fs = std::filesystem;

namespace {

std::string rename_to(const std::string& from, const std::string& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return {};
  fs::remove(from, error);
  return to + " cannot be written";
}

}  // namespace

std::string make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path, error))
    return path + ": no such folder can be made (" + error.message() + ")";
  if (access(path.c_str(), W_OK | X_OK) != 0) return path + ": no files can be written there";
  return {};
}

std::string write_whole(const std::string& path, const std::string& text) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return path + " is a folder; give the name of a file";
  // A device or a pipe is written to: renaming a file onto it would put the file in its place.
  const bool is_device = fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
  const std::string part = is_device ? path : path + ".part";
  {
    std::ofstream file(part, std::ios::binary | std::ios::trunc);
    file << text;
    file.flush();
    if (!file) {
      if (!is_device) fs::remove(part, ignored);
      return path + " cannot be written";
    }
  }
  return is_device ? std::string() : rename_to(part, path);
}

std::string in_quotes(const std::string& path) {  // ' is doubled
  std::string out = "'";
  for (const char c : path) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

bool has_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

std::string draw(const std::string& script, const std::string& path) {
  std::FILE* pipe = popen("gnuplot >/dev/null 2>&1", "w");
  if (pipe == nullptr) return path + ": gnuplot could not be started";
  const bool said = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
  const bool ended = pclose(pipe) == 0;
  const std::string part = path + ".part";
  std::error_code error;
  if (said && ended && fs::exists(part, error) && fs::file_size(part, error) > 0)
    return rename_to(part, path);
  fs::remove(part, error);
  return path + ": gnuplot could not draw it";
}

}  // namespace plumb::accuracy
