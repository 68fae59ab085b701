#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "mass/compensated_sum.h"
#include "mass/integrals.h"

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

using Eigen::Vector3d;

// Roundings along the way from three corners to one summand, as a multiple of the unit roundoff.
constexpr double kSummandRoundings = 16;

// Sums over the tetrahedra that the faces span with the reference point. With corners a, b, c
// relative to it, s = a + b + c and d = a . (b x c), each adds [Tonon 2004; Eberly 2002]
//   volume d / 6,  first moment d / 24 s,  second moment d / 120 (a a^T + b b^T + c c^T + s s^T).
struct Sums {
  CompensatedSum volume;
  std::array<CompensatedSum, 3> first;
  std::array<CompensatedSum, 6> second;  // xx yy zz xy xz yz
  double area = 0;
  double area_times_distance_squared = 0;
};

constexpr std::array<std::array<Eigen::Index, 2>, 6> kEntries{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

Sums sums_about(const TriangleMesh& mesh, const Vector3d& reference) {
  Sums sums;
  for (const Triangle& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]] - reference;
    const Vector3d b = mesh.vertices[t[1]] - reference;
    const Vector3d c = mesh.vertices[t[2]] - reference;
    const Vector3d s = a + b + c;
    const double d = a.dot(b.cross(c));
    sums.volume.add(d / 6);
    for (Eigen::Index i = 0; i < 3; ++i) sums.first[static_cast<std::size_t>(i)].add(d / 24 * s[i]);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [i, j] = kEntries[k];
      sums.second[k].add(d / 120 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]));
    }
    const double area = 0.5 * (b - a).cross(c - a).norm();
    sums.area += area;
    sums.area_times_distance_squared += area * (s / 3).squaredNorm();
  }
  return sums;
}

Vector3d first_moment(const Sums& sums) {
  return {sums.first[0].value(), sums.first[1].value(), sums.first[2].value()};
}

}  // namespace

Moments polyhedron_moments(const TriangleMesh& mesh) {
  // First about the middle of the box, so that a body far from the origin loses nothing; then about
  // the centre of mass found, so that nothing large is taken off the second moments.
  Vector3d reference = bounds_of(mesh).center();
  Sums sums = sums_about(mesh, reference);
  if (sums.volume.value() != 0) {
    const Vector3d shifted = reference + first_moment(sums) / sums.volume.value();
    if (shifted.allFinite()) {
      reference = shifted;
      sums = sums_about(mesh, reference);
    }
  }

  Moments moments;
  moments.volume = sums.volume.value();
  moments.area = sums.area;
  const Vector3d rest = first_moment(sums) / moments.volume;  // what the first pass left over
  moments.center = reference + rest;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kEntries[k];
    moments.second(i, j) = moments.second(j, i) =
        sums.second[k].value() - moments.volume * rest[i] * rest[j];
  }

  // Rounding of the sums, and of the coordinates: a face moved by delta along its normal adds
  // area x delta to the volume, and that times the square of its distance to the second moments.
  constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
  const MeshBounds bounds = bounds_of(mesh);
  const double largest = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).maxCoeff();
  const double delta = std::max(mesh.coordinate_rounding, kUnitRoundoff * largest);
  const double volume = std::abs(moments.volume);
  const double trace = moments.second.trace();
  double first_size = 0, second_size = 0;
  for (const CompensatedSum& sum : sums.first) first_size = std::max(first_size, sum.size());
  for (std::size_t k = 0; k < 3; ++k) second_size += sums.second[k].size();
  const double summand = kSummandRoundings * kUnitRoundoff;
  moments.error.volume = (summand * sums.volume.size() + delta * sums.area) / volume;
  moments.error.center =
      (summand * first_size + delta * std::sqrt(sums.area * sums.area_times_distance_squared)) /
          volume +
      kUnitRoundoff * largest;
  moments.error.inertia =
      (summand * second_size + delta * sums.area_times_distance_squared) / std::abs(trace);
  moments.error.basis =
      "rounding of coordinates and sums; the polyhedron itself is integrated exactly";
  return moments;
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
