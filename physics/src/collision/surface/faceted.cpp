#include "collision/surface/faceted.h"

#include <cmath>

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr std::uint32_t kSides = 32;

// A ring of corners at a height; counter-clockwise seen from below.
void add_ring(std::vector<Vec3>& vertices, Real radius, Real height) {
  constexpr double kTwoPi = 6.283185307179586476925;
  const double half_angle = 0.5 * kTwoPi / kSides;
  double sine = 0, cosine = 1;
  sin_cos(half_angle, sine, cosine);
  const double reach = static_cast<double>(radius) * 2 / (1 + cosine);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    sin_cos(2 * half_angle * i, sine, cosine);
    vertices.emplace_back(static_cast<Real>(reach * cosine), height,
                          static_cast<Real>(reach * sine));
  }
}

struct Faces {
  std::vector<std::uint32_t> sizes, corners;
  void add(std::initializer_list<std::uint32_t> face) {
    sizes.push_back(static_cast<std::uint32_t>(face.size()));
    corners.insert(corners.end(), face);
  }
  void add_end(std::uint32_t first, bool up) {
    sizes.push_back(kSides);
    for (std::uint32_t i = 0; i < kSides; ++i) corners.push_back(first + (up ? kSides - 1 - i : i));
  }
};

}  // namespace

std::shared_ptr<const HullGeometry> faceted_cylinder(Real half_length, Real radius) {
  std::vector<Vec3> vertices;
  add_ring(vertices, radius, -half_length);
  add_ring(vertices, radius, half_length);
  Faces faces;
  faces.add_end(0, false);
  faces.add_end(kSides, true);
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t next = (i + 1) % kSides;
    faces.add({i, kSides + i, kSides + next, next});
  }
  return HullGeometry::create(vertices, faces.sizes, faces.corners).hull;
}

std::shared_ptr<const HullGeometry> faceted_cone(Real half_length, Real radius) {
  std::vector<Vec3> vertices;
  add_ring(vertices, radius, -half_length);
  vertices.emplace_back(Real(0), half_length, Real(0));
  Faces faces;
  faces.add_end(0, false);
  for (std::uint32_t i = 0; i < kSides; ++i) faces.add({i, kSides, (i + 1) % kSides});
  return HullGeometry::create(vertices, faces.sizes, faces.corners).hull;
}

}  // namespace plumb::inline PLUMB_ABI::detail
