// --without and --with: items of the plan that the user forces off and on.
#pragma once

#include <string>

#include "cli/commands.h"
#include "plumb/settings.h"

namespace plumb::cli {

// Adds them to the settings; an error text, and nothing is changed, where one of them cannot be.
std::string force(const ForcedNames& names, WorldSettings& settings);

}  // namespace plumb::cli
