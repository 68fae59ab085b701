#include "record/shape_mesh.h"

#include <cmath>
#include <numbers>

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {
namespace {

constexpr int kTurns = 48;  // around; a multiple of four
constexpr int kRises = 25;  // from pole to pole, odd: none of them on the equator's edge twice

Eigen::Vector3f direction(int rise, int turn) {
  const double pi = std::numbers::pi;
  // Off the poles and off the planes between octants, where the farthest point is not unique.
  const double up = pi * ((rise + 0.5) / (kRises + 1) - 0.5);
  const double around = 2 * pi * (turn + 0.5) / kTurns;
  return Eigen::Vector3d(std::cos(up) * std::cos(around), std::sin(up),
                         std::cos(up) * std::sin(around))
      .cast<float>();
}

// The surface by its farthest points: flat faces come out as the triangles between far corners.
template <class Farthest>
VisualMesh mesh_by_directions(const Farthest& farthest) {
  VisualMesh mesh;
  const auto at = [](int rise, int turn) {
    return static_cast<std::uint32_t>(rise * kTurns + turn % kTurns);
  };
  for (int rise = 0; rise <= kRises; ++rise)
    for (int turn = 0; turn < kTurns; ++turn)
      mesh.vertices.push_back(farthest(direction(rise, turn)));
  for (int rise = 0; rise < kRises; ++rise) {
    for (int turn = 0; turn < kTurns; ++turn) {
      mesh.triangles.emplace_back(at(rise, turn), at(rise + 1, turn), at(rise + 1, turn + 1));
      mesh.triangles.emplace_back(at(rise, turn), at(rise + 1, turn + 1), at(rise, turn + 1));
    }
  }
  // The two ends, as fans.
  for (int turn = 1; turn + 1 < kTurns; ++turn) {
    mesh.triangles.emplace_back(at(0, 0), at(0, turn), at(0, turn + 1));
    mesh.triangles.emplace_back(at(kRises, 0), at(kRises, turn + 1), at(kRises, turn));
  }
  return mesh;
}

struct Mesher {
  using Result = std::optional<VisualMesh>;

  Result operator()(const Sphere&) const { return {}; }
  Result operator()(const Capsule&) const { return {}; }
  Result operator()(const HalfSpace&) const { return {}; }
  Result operator()(const SurfaceMesh&) const { return {}; }
  Result operator()(const Heightfield&) const { return {}; }
  Result operator()(const Compound&) const { return {}; }
  Result operator()(const Box& box) const {
    if (!(box.rounding > Real(0))) return {};
    const Eigen::Vector3f half = box.half_extents.cast<float>();
    const auto rounding = static_cast<float>(box.rounding);
    return mesh_by_directions([&](const Eigen::Vector3f& d) -> Eigen::Vector3f {
      return d.cwiseSign().cwiseProduct(half) + rounding * d;
    });
  }
  Result operator()(const ConvexHull& hull) const {
    if (!(hull.rounding > Real(0)) || !hull.geometry) return {};
    const auto rounding = static_cast<float>(hull.rounding);
    return mesh_by_directions([&](const Eigen::Vector3f& d) -> Eigen::Vector3f {
      Eigen::Vector3f far = hull.geometry->vertices().front().cast<float>();
      for (const Vec3& v : hull.geometry->vertices())
        if (v.cast<float>().dot(d) > far.dot(d)) far = v.cast<float>();
      return far + rounding * d;
    });
  }
  Result operator()(const Cylinder& c) const {
    return round(static_cast<float>(c.half_length), static_cast<float>(c.radius),
                 static_cast<float>(c.radius), static_cast<float>(c.rounding));
  }
  Result operator()(const Cone& c) const {
    return round(static_cast<float>(c.half_length), static_cast<float>(c.radius), 0.0F,
                 static_cast<float>(c.rounding));
  }
  // A frustum between two discs.
  static VisualMesh round(float half, float bottom, float top, float rounding) {
    return mesh_by_directions([&](const Eigen::Vector3f& d) -> Eigen::Vector3f {
      const float aside = std::hypot(d.x(), d.z());
      const bool up = half * d.y() + top * aside > -half * d.y() + bottom * aside;
      const float radius = up ? top : bottom;
      return Eigen::Vector3f(radius * d.x() / aside, up ? half : -half, radius * d.z() / aside) +
             rounding * d;
    });
  }
};

}  // namespace

std::optional<VisualMesh> mesh_of_shape(const Shape& shape) { return std::visit(Mesher{}, shape); }

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
