// Whether a file can appear under a name that the user gave, found out before the work is done.
#pragma once

#include <string>

namespace plumb::cli {

// Why no file can be written there, with a remedy; empty if one can: a folder of that name, no such
// folder, or one that may not be written.
std::string why_no_file(const std::string& path);

// Something that is written to but is no file, and that no file may take the place of: a device, a
// pipe, a socket.
bool is_device(const std::string& path);

// The file that a chain of links ends at, so that a new file replaces it and not the link; the path
// itself where it is no link, or one that leads nowhere.
std::string behind_links(const std::string& path);

}  // namespace plumb::cli
