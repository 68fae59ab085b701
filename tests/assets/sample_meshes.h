// Meshes with known answers, for the tests of assets.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "plumb/assets/mesh.h"

namespace plumb::test {

using assets::Triangle;
using assets::TriangleMesh;
using Eigen::Vector3d;

inline constexpr double kPi = std::numbers::pi;

inline void join(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

inline TriangleMesh flipped(TriangleMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// Twelve triangles around a box.
inline TriangleMesh box_mesh(const Vector3d& half, const Vector3d& center = Vector3d::Zero()) {
  TriangleMesh mesh;
  mesh.name = "box";
  for (int i = 0; i < 8; ++i) {
    const Vector3d sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    mesh.vertices.push_back(center + sign.cwiseProduct(half));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Four corners, oriented outwards whatever their order.
inline TriangleMesh tetrahedron_mesh(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                     const Vector3d& d) {
  TriangleMesh mesh;
  mesh.name = "tetrahedron";
  mesh.vertices = {a, b, c, d};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return (b - a).cross(c - a).dot(d - a) > 0 ? mesh : flipped(mesh);
}

// A profile of (radius, height), from the lower pole to the upper, turned about y; poles have
// radius 0.
inline TriangleMesh revolution_mesh(const std::vector<std::pair<double, double>>& profile,
                                    std::uint32_t segments) {
  TriangleMesh mesh;
  mesh.name = "revolution";
  std::vector<std::vector<std::uint32_t>> rows;
  for (const auto& [radius, height] : profile) {
    auto& row = rows.emplace_back();
    for (std::uint32_t k = 0; k < segments; ++k) {
      if (radius == 0 && k > 0) {
        row.push_back(row.front());
        continue;
      }
      const double angle = 2 * kPi * k / segments;
      row.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.emplace_back(radius * std::cos(angle), height, -radius * std::sin(angle));
    }
  }
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    for (std::uint32_t k = 0; k < segments; ++k) {
      const std::uint32_t j = (k + 1) % segments;
      if (rows[r][k] != rows[r][j])
        mesh.triangles.push_back({rows[r][k], rows[r][j], rows[r + 1][j]});
      if (rows[r + 1][k] != rows[r + 1][j])
        mesh.triangles.push_back({rows[r][k], rows[r + 1][j], rows[r + 1][k]});
    }
  }
  return mesh;
}

inline TriangleMesh ellipsoid_mesh(const Vector3d& axes, std::uint32_t n) {
  std::vector<std::pair<double, double>> profile{{0, -1}};
  for (std::uint32_t k = 1; k < n; ++k)
    profile.emplace_back(std::sin(kPi * k / n), -std::cos(kPi * k / n));
  profile.emplace_back(0, 1);
  TriangleMesh mesh = revolution_mesh(profile, 2 * n);
  mesh.name = "ellipsoid";
  for (Vector3d& v : mesh.vertices) v = v.cwiseProduct(axes);
  return mesh;
}

inline TriangleMesh sphere_mesh(double radius, std::uint32_t n) {
  TriangleMesh mesh = ellipsoid_mesh(Vector3d::Constant(radius), n);
  mesh.name = "sphere";
  return mesh;
}

inline TriangleMesh cylinder_mesh(double radius, double height, std::uint32_t n) {
  return revolution_mesh(
      {{0, -height / 2}, {radius, -height / 2}, {radius, height / 2}, {0, height / 2}}, 2 * n);
}

// Base at y = 0, apex at y = height.
inline TriangleMesh cone_mesh(double radius, double height, std::uint32_t n) {
  return revolution_mesh({{0, 0}, {radius, 0}, {0, height}}, 2 * n);
}

// Axis y.
inline TriangleMesh torus_mesh(double ring, double tube, std::uint32_t n) {
  TriangleMesh mesh;
  mesh.name = "torus";
  const std::uint32_t around = 2 * n;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 2 * kPi * i / around, v = 2 * kPi * j / n, r = ring + tube * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), tube * std::sin(v), -r * std::sin(u));
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * n + j, b = (i + 1) % around * n + j;
      const std::uint32_t c = (i + 1) % around * n + (j + 1) % n, d = i * n + (j + 1) % n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

// An L in the x-y plane: a foot of width x height foot_height, a leg of leg_width up to
// full_height; corner at the origin, drawn out along z from -depth / 2 to depth / 2.
inline TriangleMesh l_beam_mesh(double width, double foot_height, double leg_width,
                                double full_height, double depth) {
  TriangleMesh mesh;
  mesh.name = "l_beam";
  const double w = width, f = foot_height, l = leg_width, h = full_height;
  const std::vector<std::pair<double, double>> outline{{0, 0}, {w, 0}, {w, f},
                                                       {l, f}, {l, h}, {0, h}};
  for (const double z : {-depth / 2, depth / 2}) {
    for (const auto& [x, y] : outline) mesh.vertices.emplace_back(x, y, z);
  }
  const std::vector<Triangle> cap{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}};
  for (const Triangle& t : cap) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  return mesh;
}

}  // namespace plumb::test
