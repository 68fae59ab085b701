// plumb accuracy: hands over to plumb-accuracy.
#include "cli/accuracy.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "cli/commands.h"

namespace plumb::cli {
namespace {

int hand_over(const std::vector<std::string>& arguments) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string lab = (self.parent_path() / "plumb-accuracy").string();
  std::vector<char*> words{const_cast<char*>(lab.c_str())};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(lab.c_str(), words.data());
  complain("accuracy: " + lab + " cannot be run (" + std::strerror(errno) +
           "); build it: cmake --build <folder> --target plumb-accuracy");
  return kFailed;
}

}  // namespace

void add_accuracy(CLI::App& app, std::vector<std::string>& arguments, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "accuracy", "What accuracy costs: error against time, by case and setting");
  command->prefix_command();
  command->set_help_flag();  // the lab's program has its own
  command->callback([command, &arguments, &exit_code] {
    arguments = command->remaining();
    exit_code = hand_over(arguments);
  });
}

}  // namespace plumb::cli
