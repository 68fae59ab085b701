// The table behind WorldSettings::from_tolerance, measured on this machine.
#pragma once

#include <functional>
#include <string>

namespace plumb::accuracy {

// The text of physics/src/world/measured_table.h. Takes a minute or two.
std::string settings_table(const std::function<void(std::size_t done)>& progress,
                           std::string& problem);
std::size_t settings_table_cells();

}  // namespace plumb::accuracy
