// Meshes, heightfields and compounds for tests.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "plumb/compound.h"
#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace surfaces {

using Eigen::Vector3d;

struct Soup {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;

  std::uint32_t add(const Vector3d& p) {
    vertices.push_back(p.cast<Real>());
    return static_cast<std::uint32_t>(vertices.size() - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) indices.push_back(v);
  }
  // Corners counter-clockwise from the front, in two triangles.
  void quad(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const std::uint32_t i = add(a), j = add(b), k = add(c), l = add(d);
    triangle(i, j, k);
    triangle(i, k, l);
  }
  [[nodiscard]] TriangleMeshGeometry::Result create() const {
    return TriangleMeshGeometry::create(vertices, indices);
  }
};

inline std::shared_ptr<const TriangleMeshGeometry> made(const Soup& soup) {
  auto result = soup.create();
  if (!result.status.ok()) throw std::runtime_error(result.status.message);
  return result.mesh;
}

// height(x, z) over a grid of cells_x by cells_z in [x0, x1] x [z0, z1]; normals up. `flip` turns
// every other diagonal.
inline Soup grid(double x0, double x1, double z0, double z1, int cells_x, int cells_z,
                 const std::function<double(double, double)>& height, bool flip = false) {
  Soup soup;
  for (int k = 0; k <= cells_z; ++k) {
    for (int i = 0; i <= cells_x; ++i) {
      const double x = x0 + (x1 - x0) * i / cells_x, z = z0 + (z1 - z0) * k / cells_z;
      soup.add({x, height(x, z), z});
    }
  }
  const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(k * (cells_x + 1) + i); };
  for (int k = 0; k < cells_z; ++k) {
    for (int i = 0; i < cells_x; ++i) {
      if (flip && (i + k) % 2 != 0) {
        soup.triangle(at(i, k), at(i, k + 1), at(i + 1, k));
        soup.triangle(at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
      } else {
        soup.triangle(at(i, k), at(i, k + 1), at(i + 1, k + 1));
        soup.triangle(at(i, k), at(i + 1, k + 1), at(i + 1, k));
      }
    }
  }
  return soup;
}
inline double level(double, double) { return 0; }

// The twelve triangles of a box, outwards.
inline Soup box_soup(double hx, double hy, double hz) {
  Soup s;
  const auto p = [&](int i) {
    return Vector3d((i & 1) != 0 ? hx : -hx, (i & 2) != 0 ? hy : -hy, (i & 4) != 0 ? hz : -hz);
  };
  s.quad(p(0), p(4), p(6), p(2));
  s.quad(p(1), p(3), p(7), p(5));
  s.quad(p(0), p(1), p(5), p(4));
  s.quad(p(2), p(6), p(7), p(3));
  s.quad(p(0), p(2), p(3), p(1));
  s.quad(p(4), p(5), p(7), p(6));
  return s;
}

// A ball's surface as a mesh: `rings` of `2 rings` facets.
inline Soup ball_soup(double radius, int rings) {
  Soup s;
  const int around = 2 * rings;
  for (int r = 0; r <= rings; ++r) {
    for (int k = 0; k < around; ++k) {
      const double t = testing_support::kPi * r / rings, f = 2 * testing_support::kPi * k / around;
      const double wide = r == 0 || r == rings ? 0 : radius * std::sin(t);  // one point at a pole
      s.add({wide * std::cos(f), radius * std::cos(t), wide * std::sin(f)});
    }
  }
  const auto at = [&](int r, int k) { return static_cast<std::uint32_t>(r * around + k % around); };
  for (int r = 0; r < rings; ++r) {
    for (int k = 0; k < around; ++k) {
      if (r + 1 < rings) s.triangle(at(r, k), at(r + 1, k + 1), at(r + 1, k));
      if (r > 0) s.triangle(at(r, k), at(r, k + 1), at(r + 1, k + 1));
    }
  }
  return s;
}

inline std::shared_ptr<const HeightfieldGeometry> field(
    int samples_x, int samples_z, double spacing, const std::function<double(int, int)>& height) {
  std::vector<Real> heights;
  for (int k = 0; k < samples_z; ++k)
    for (int i = 0; i < samples_x; ++i) heights.push_back(static_cast<Real>(height(i, k)));
  auto result = HeightfieldGeometry::create(
      static_cast<std::uint32_t>(samples_x), static_cast<std::uint32_t>(samples_z),
      static_cast<Real>(spacing), static_cast<Real>(spacing), heights);
  if (!result.status.ok()) throw std::runtime_error(result.status.message);
  return result.field;
}

// One plane cut in many ways, from -10 to 120 m along x and 20 m to both sides, at height 0.
struct FlatGround {
  const char* name;
  Shape shape;
  Vector3d origin{0, 0, 0};
};
inline std::vector<FlatGround> flat_grounds() {
  const auto mesh = [](int nx, int nz) {
    return SurfaceMesh{made(grid(-10, 120, -20, 20, nx, nz, level, true))};
  };
  return {
      {"two triangles", mesh(1, 1)},
      {"1e4 triangles", mesh(130, 40)},
      {"slivers across", mesh(2000, 1)},
      {"slivers along", mesh(1, 2000)},
      {"heightfield", Heightfield{field(131, 41, 1, [](int, int) { return 0.0; })}, {-10, 0, -20}}};
}

inline CompoundGeometry::Child child(const Shape& shape, const Vector3d& at,
                                     const Quat& q = Quat::Identity()) {
  return {shape, {at.cast<Real>(), q}};
}
inline Compound compound(const std::vector<CompoundGeometry::Child>& children) {
  auto result = CompoundGeometry::create(children);
  if (!result.status.ok()) throw std::runtime_error(result.status.message);
  return Compound{result.compound};
}

}  // namespace surfaces
}  // namespace plumb::inline PLUMB_ABI
