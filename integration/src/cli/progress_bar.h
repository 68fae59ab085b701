// One line that fills up, drawn only for people: when stderr is a terminal.
#pragma once

#include <chrono>
#include <cstdint>

namespace plumb::cli {

class ProgressBar {
 public:
  ProgressBar(std::uint64_t total, bool wanted);
  ~ProgressBar() { finish(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // simulated_seconds: below zero where there is nothing to say about them.
  void show(std::uint64_t done, double simulated_seconds);
  void finish();  // wipes the line; nothing is shown any more

 private:
  using Clock = std::chrono::steady_clock;
  std::uint64_t total_;
  bool visible_;
  Clock::time_point start_;
  Clock::time_point next_draw_;
};

}  // namespace plumb::cli
