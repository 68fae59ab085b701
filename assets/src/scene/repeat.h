// Where the copies of a repeated body stand. Only additions, products, quotients and square roots
// enter, so that a seed means the same scene on every machine.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "plumb/assets/scene.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// Linear congruential generator modulo 2^64 with the multiplier and increment of MMIX [Knuth 1997].
class Lcg {
 public:
  explicit Lcg(std::uint64_t seed) : state_(seed) { next(); }
  // Uniform in [-1, 1), from the upper 53 bits: the lower ones of such a generator are poor.
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t state_;
};

struct RepeatPlace {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m] world axes
  Eigen::Quaterniond turn =
      Eigen::Quaterniond::Identity();  // applied after the body's own orientation
};

// In the order x fastest, then y, then z.
std::vector<RepeatPlace> places_of(const SceneRepeat& repeat);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
