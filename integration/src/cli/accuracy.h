// The subcommand `accuracy`.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace plumb::cli {

// Everything after `accuracy` goes to the lab's own program, `plumb-accuracy`, which stands beside
// this one: it needs the engine in every number type, and the rest of `plumb` does not.
void add_accuracy(CLI::App& app, std::vector<std::string>& arguments, int& exit_code);

}  // namespace plumb::cli
