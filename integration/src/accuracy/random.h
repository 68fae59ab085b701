// Random numbers that are the same everywhere: a 32-bit linear congruential generator.
#pragma once

#include <cstdint>

namespace plumb::accuracy {

class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  // Uniform in [low, high).
  double uniform(double low, double high) {
    state_ = state_ * 1664525u + 1013904223u;
    return low + (high - low) * (static_cast<double>(state_ >> 8) / 16777216.0);
  }

 private:
  std::uint32_t state_;
};

}  // namespace plumb::accuracy
