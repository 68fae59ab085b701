// Terrain over a regular grid, for bodies that nothing pushes (static and kinematic ones).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plumb/math.h"
#include "plumb/status.h"

namespace plumb::inline PLUMB_ABI {

// Heights in y over a grid in x and z: sample (i, k) stands at (i * spacing_x, height, k *
// spacing_z) in the shape's frame. The cell between samples (i, k) and (i + 1, k + 1) is two
// triangles that share the edge between these two; both look towards +y. A cell with a height that
// is NaN is a hole. One number a sample, nothing else is stored.
class HeightfieldGeometry {
 public:
  struct Result {
    std::shared_ptr<const HeightfieldGeometry> field;
    Status status;
  };
  // heights: [m] samples_x * samples_z of them, x running first; finite within +-1e6 m, or NaN.
  // samples >= 2 each, spacing [m] > 0.
  static Result create(std::uint32_t samples_x, std::uint32_t samples_z, Real spacing_x,
                       Real spacing_z, std::span<const Real> heights);

  [[nodiscard]] std::uint32_t samples_x() const { return samples_x_; }
  [[nodiscard]] std::uint32_t samples_z() const { return samples_z_; }
  [[nodiscard]] Real spacing_x() const { return spacing_x_; }  // [m]
  [[nodiscard]] Real spacing_z() const { return spacing_z_; }  // [m]
  [[nodiscard]] const std::vector<Real>& heights() const { return heights_; }
  [[nodiscard]] Real height(std::uint32_t i, std::uint32_t k) const {
    return heights_[static_cast<std::size_t>(k) * samples_x_ + i];
  }
  [[nodiscard]] bool is_hole(std::uint32_t i, std::uint32_t k) const;  // cell (i, k)
  [[nodiscard]] const Vec3& lower() const { return lower_; }           // [m] bounds
  [[nodiscard]] const Vec3& upper() const { return upper_; }           // [m]
  [[nodiscard]] std::size_t holes() const { return holes_; }           // cells
  [[nodiscard]] std::size_t bytes() const { return heights_.size() * sizeof(Real); }

 private:
  std::uint32_t samples_x_ = 0, samples_z_ = 0;
  Real spacing_x_ = 0, spacing_z_ = 0;
  std::vector<Real> heights_;
  Vec3 lower_ = Vec3::Zero(), upper_ = Vec3::Zero();
  std::size_t holes_ = 0;
};

}  // namespace plumb::inline PLUMB_ABI
