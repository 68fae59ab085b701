// Files and charts that appear whole or not at all. Each returns an error text, empty if all is
// well.
#pragma once

#include <string>

namespace plumb::accuracy {

std::string make_folder(const std::string& path);  // and finds out whether it can be written into
std::string write_whole(const std::string& path, const std::string& text);
bool has_gnuplot();
std::string in_quotes(const std::string& path);  // for gnuplot
std::string draw(const std::string& script,
                 const std::string& path);  // `script` writes path + ".part"

}  // namespace plumb::accuracy
