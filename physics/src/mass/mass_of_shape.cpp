// Mass properties of a collision shape filled with a uniform density.
//
// A polyhedron is the signed sum of the tetrahedra between a point of reference and the triangles
// of its faces. Of the tetrahedron (o, a, b, c), with 6 V = a . (b x c):
//   integral dV       = V
//   integral r dV     = V/4 (a + b + c)
//   integral r r^T dV = V/20 (a a^T + b b^T + c c^T + s s^T),  s = a + b + c
// exact for every closed surface and any o [Lien 1984], [Mirtich 1996]. o is first a vertex, then
// the centre found with it, so that no digits are lost however far from its own origin the hull
// lies.
#include <cmath>
#include <numbers>

#include "collision/collision_shape.h"
#include "mass/inertia_tensor.h"
#include "mass/rounded_moments.h"
#include "plumb/compound.h"
#include "plumb/mass_properties.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using Moments = detail::VolumeMoments;

Moments moments_about(const HullGeometry& hull, const Eigen::Vector3d& reference) {
  Moments sum;
  const auto vertex = [&](std::uint32_t i) -> Eigen::Vector3d {
    return hull.vertices()[i].cast<double>() - reference;
  };
  for (std::size_t f = 0; f < hull.face_count(); ++f) {
    const std::span<const std::uint32_t> face = hull.face(f);
    const Eigen::Vector3d a = vertex(face[0]);
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Eigen::Vector3d b = vertex(face[k - 1]), c = vertex(face[k]), s = a + b + c;
      const double volume = a.dot(b.cross(c)) / 6;
      sum.volume += volume;
      sum.first += volume / 4 * s;
      sum.second += volume / 20 *
                    (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
  }
  return sum;
}

MassProperties filled(const Moments& moments, double density) {
  const Eigen::Vector3d center = moments.first / moments.volume;
  MassProperties body;
  body.mass = density * moments.volume;
  body.center = center;
  body.I_Bcm_B = density * detail::inertia_from_second_moments(
                               moments.second - moments.volume * center * center.transpose());
  return body;
}

MassProperties of_hull(const HullGeometry& hull, double rounding, double density) {
  const Eigen::Vector3d start = hull.vertices()[0].cast<double>();
  const Moments rough = moments_about(hull, start);
  const Eigen::Vector3d near_center = start + rough.first / rough.volume;
  Moments fine = moments_about(hull, near_center);
  if (rounding > 0) {
    const Moments added = detail::moments_of_hull_rounding(hull, rounding, near_center);
    fine.volume += added.volume;
    fine.first += added.first;
    fine.second += added.second;
  }
  const Eigen::Vector3d rest = fine.first / fine.volume;  // what rounding left of the offset
  MassProperties body;
  body.mass = density * fine.volume;
  body.center = near_center + rest;
  body.I_Bcm_B = density * detail::inertia_from_second_moments(fine.second - fine.volume * rest *
                                                                                 rest.transpose());
  return body;
}

MassProperties of_shape(const Shape& shape, double density);

// Each child about its own centre, then all of them together [Huygens 1673].
MassProperties of_compound(const CompoundGeometry& compound, double density) {
  MassProperties sum;
  bool first = true;
  for (const CompoundGeometry::Child& child : compound.children()) {
    const MassProperties placed =
        of_shape(child.shape, density)
            .placed(child.pose.position.cast<double>(),
                    Eigen::Quaterniond(child.pose.orientation.cast<double>()).normalized());
    sum = first ? placed : sum.plus(placed);
    first = false;
  }
  return sum;
}

MassProperties of_shape(const Shape& shape, double density) {
  constexpr double kPi = std::numbers::pi;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    const double r = static_cast<double>(sphere->radius);
    return inertia_of::solid_sphere(density * 4 / 3 * kPi * r * r * r, r);
  }
  if (const auto* box = std::get_if<Box>(&shape)) {
    const Eigen::Vector3d half = box->half_extents.cast<double>();
    const double rounding = static_cast<double>(box->rounding);
    if (rounding > 0) return filled(detail::moments_of_rounded_box(half, rounding), density);
    return inertia_of::box(density * 8 * half.prod(), half);
  }
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    const double r = static_cast<double>(capsule->radius);
    const double half_length = static_cast<double>(capsule->half_length);
    const double volume = kPi * r * r * (2 * half_length + 4.0 / 3 * r);
    return inertia_of::capsule(density * volume, r, half_length);
  }
  if (const auto* compound = std::get_if<Compound>(&shape)) {
    return of_compound(*compound->geometry, density);
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const double r = static_cast<double>(cylinder->radius);
    const double h = static_cast<double>(cylinder->half_length);
    const double rounding = static_cast<double>(cylinder->rounding);
    if (!(rounding > 0)) return inertia_of::cylinder(density * kPi * r * r * 2 * h, r, 2 * h);
    const detail::ProfilePoint profile[] = {{0, -h}, {r, -h}, {r, h}, {0, h}};
    return filled(detail::moments_of_revolution(profile, rounding), density);
  }
  if (const auto* cone = std::get_if<Cone>(&shape)) {
    const double r = static_cast<double>(cone->radius), h = static_cast<double>(cone->half_length);
    const double rounding = static_cast<double>(cone->rounding);
    if (!(rounding > 0)) {
      MassProperties body = inertia_of::cone(density * kPi * r * r * 2 * h / 3, r, 2 * h);
      body.center.y() -= h;  // from the base to the middle of the axis
      return body;
    }
    const detail::ProfilePoint profile[] = {{0, -h}, {r, -h}, {0, h}};
    return filled(detail::moments_of_revolution(profile, rounding), density);
  }
  const auto& hull = std::get<ConvexHull>(shape);
  return of_hull(*hull.geometry, static_cast<double>(hull.rounding), density);
}

}  // namespace

ShapeMass mass_of(const Shape& shape, double density) {
  if (!std::isfinite(density)) {
    return {{}, {StatusCode::NotFinite, "density is NaN or infinite; give a finite kg/m^3 > 0"}};
  }
  if (density <= 0) {
    return {{}, {StatusCode::OutOfRange, "density is zero or negative; give a kg/m^3 > 0"}};
  }
  if (const Status status = detail::check_shape(shape); !status.ok()) return {{}, status};
  if (std::holds_alternative<HalfSpace>(shape)) {
    return {{}, {StatusCode::BadShape, "a half-space has no finite mass; use it on static bodies"}};
  }
  if (std::holds_alternative<SurfaceMesh>(shape) || std::holds_alternative<Heightfield>(shape)) {
    return {{},
            {StatusCode::BadShape,
             "a mesh or heightfield is a surface and has no mass; give the body's mass itself"}};
  }
  const MassProperties properties = of_shape(shape, density);
  if (const Status status = check(properties); !status.ok()) return {{}, status};
  return {properties, {}};
}

}  // namespace plumb::inline PLUMB_ABI
