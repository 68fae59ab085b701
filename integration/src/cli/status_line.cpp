#include "cli/status_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace plumb::cli {
namespace {

constexpr const char* kWipe = "\r\x1b[K";
constexpr std::size_t kUsualWidth = 80;  // [columns] of a terminal that does not tell

// A line that is broken by the terminal could not be wiped.
std::size_t width_of_terminal() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualWidth;
  return size.ws_col;
}

}  // namespace

StatusLine::StatusLine(bool wanted) : visible_(wanted && isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() {
  if (visible_) std::fputs(kWipe, stderr);
}

void StatusLine::show(const std::string& text) {
  if (!visible_) return;
  constexpr const char* kMore = " ...";
  const std::size_t room = width_of_terminal() - 1;
  std::fprintf(stderr, "%s%s%s", kWipe, text.substr(0, room > 4 ? room - 4 : 0).c_str(), kMore);
  std::fflush(stderr);
}

}  // namespace plumb::cli
