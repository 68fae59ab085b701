#include "cli/progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace plumb::cli {
namespace {

constexpr std::size_t kWidth = 40;  // [characters]
// Often enough to look smooth, seldom enough to cost nothing.
constexpr std::chrono::milliseconds kDrawEvery{100};
constexpr const char* kWipe = "\r\x1b[K";

}  // namespace

ProgressBar::ProgressBar(std::uint64_t total, bool wanted)
    : total_(total),
      visible_(wanted && isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      next_draw_(start_) {}

void ProgressBar::finish() {
  if (visible_) std::fputs(kWipe, stderr);
  visible_ = false;
}

void ProgressBar::show(std::uint64_t done, double simulated_seconds) {
  if (!visible_ || Clock::now() < next_draw_) return;
  next_draw_ = Clock::now() + kDrawEvery;
  const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1;
  const auto filled = static_cast<std::size_t>(share * static_cast<double>(kWidth));
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double left = share > 0 ? elapsed / share - elapsed : 0;
  std::fprintf(stderr, "%s[%s%s] %3.0f %%  ", kWipe, std::string(filled, '#').c_str(),
               std::string(kWidth - filled, '.').c_str(), 100 * share);
  if (simulated_seconds >= 0) std::fprintf(stderr, "%.1f s simulated, ", simulated_seconds);
  std::fprintf(stderr, "%.0f s left", left);
}

}  // namespace plumb::cli
