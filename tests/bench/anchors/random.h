// The scenes' random numbers: a 32-bit linear congruential generator, the same everywhere.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace plumb::anchors {

class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}

  // In [low, high), 24 bits.
  double range(double low, double high) {
    state_ = state_ * 1664525u + 1013904223u;
    return low + (high - low) * (static_cast<double>(state_ >> 8) / 16777216.0);
  }

  // A turn by at most `most` [rad] about an axis of any direction.
  Eigen::Quaterniond turn(double most) {
    const double z = range(-1, 1), t = range(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z), angle = range(-most, most);
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(angle, Eigen::Vector3d(r * std::cos(t), z, r * std::sin(t))));
  }

 private:
  std::uint32_t state_;
};

}  // namespace plumb::anchors
