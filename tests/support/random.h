// Random numbers that are the same everywhere: a 32-bit linear congruential generator, so that a
// scene can be rebuilt in any language from its seed.
#pragma once

#include <cstdint>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}

  // Uniform in [low, high).
  double uniform(double low, double high) {
    state_ = state_ * 1664525u + 1013904223u;
    const double u = static_cast<double>(state_ >> 8) / 16777216.0;  // 24 bits
    return low + (high - low) * u;
  }
  // Uniform direction.
  Eigen::Vector3d direction() {
    const double z = uniform(-1, 1), t = uniform(0, 2 * kPi), r = std::sqrt(1 - z * z);
    return {r * std::cos(t), z, r * std::sin(t)};
  }
  // About a uniform direction, by an angle in [-largest, largest) [rad].
  Quat rotation(double largest) {
    const Eigen::Vector3d axis = direction();
    return turn(uniform(-largest, largest), axis);
  }

 private:
  std::uint32_t state_;
};

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
