#include "collision/collision_shape.h"

#include <limits>

#include "collision/collision_tolerances.h"
#include "collision/round_core.h"
#include "collision/surface/composite_shape.h"
#include "math/eigen_bridge.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr Status kNotFinite{StatusCode::NotFinite, "a shape's sizes must be finite numbers"};
constexpr Status kNoVolume{StatusCode::BadShape, "a shape's sizes must be greater than zero"};
constexpr Status kSizeRange{StatusCode::OutOfRange,
                            "a shape's sizes must lie between 1e-5 m and 1e6 m"};
constexpr Status kAspect{StatusCode::OutOfRange,
                         "the largest extent of a shape must be at most 1e5 times the smallest"};

Status check_extents(Real x, Real y, Real z) {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return kNotFinite;
  const Num smallest = std::min(x, std::min(y, z)), largest = std::max(x, std::max(y, z));
  if (!(smallest > Num(0))) return kNoVolume;
  // Rounding of the limits to single precision must not refuse the limit itself.
  constexpr Num kRounding = Num(1) + 2 * std::numeric_limits<float>::epsilon();
  if (smallest * kRounding < kSmallestSize || largest > kLargestSize * kRounding) return kSizeRange;
  if (largest > smallest * kLargestAspect * kRounding) return kAspect;
  return {};
}

constexpr Status kRounding{StatusCode::OutOfRange,
                           "a shape's rounding must lie between 0 and 1e6 m"};

Status check_rounding(Real rounding) {
  if (!std::isfinite(rounding)) return kNotFinite;
  if (!(rounding >= Real(0)) || static_cast<Num>(rounding) > kLargestSize) return kRounding;
  return {};
}

struct Check {
  Status operator()(const Sphere& s) const { return check_extents(s.radius, s.radius, s.radius); }
  Status operator()(const Box& s) const {
    if (const Status status = check_rounding(s.rounding); !status.ok()) return status;
    return check_extents(s.half_extents.x(), s.half_extents.y(), s.half_extents.z());
  }
  Status operator()(const Capsule& s) const {
    return check_extents(s.half_length, s.radius, s.radius);
  }
  Status operator()(const Cylinder& s) const {
    if (const Status status = check_rounding(s.rounding); !status.ok()) return status;
    return check_extents(s.radius, s.half_length, s.radius);
  }
  Status operator()(const Cone& s) const {
    if (const Status status = check_rounding(s.rounding); !status.ok()) return status;
    return check_extents(s.radius, s.half_length, s.radius);
  }
  Status operator()(const ConvexHull& s) const {
    if (const Status status = check_rounding(s.rounding); !status.ok()) return status;
    if (s.geometry == nullptr) {
      return {StatusCode::BadShape, "a convex hull needs a geometry from HullGeometry::create"};
    }
    const Real inner = s.geometry->inner_radius(), outer = s.geometry->outer_radius();
    return check_extents(inner, inner, outer);
  }
  Status operator()(const HalfSpace& s) const {
    if (!s.normal.allFinite() || !std::isfinite(s.offset)) return kNotFinite;
    if (!(s.normal.cwiseAbs().maxCoeff() > Real(0))) {
      return {StatusCode::BadShape, "a half-space's normal must not be zero"};
    }
    return {};
  }
  Status operator()(const SurfaceMesh& s) const { return check_mesh(s); }
  Status operator()(const Heightfield& s) const { return check_heightfield(s); }
  Status operator()(const Compound& s) const { return check_compound(s); }
};

struct Make {
  CollisionShape operator()(const Sphere& s) const {
    CollisionShape shape;
    shape.type = ShapeType::Sphere;
    shape.radius = s.radius;
    return shape;
  }
  CollisionShape operator()(const Box& s) const {
    CollisionShape shape;
    shape.type = ShapeType::Box;
    shape.half = to_inner(s.half_extents);
    shape.radius = s.rounding;
    return shape;
  }
  CollisionShape operator()(const Cylinder& s) const {
    CollisionShape shape;
    shape.type = ShapeType::Cylinder;
    shape.half = {s.radius, s.half_length, s.radius};
    shape.radius = s.rounding;
    return shape;
  }
  CollisionShape operator()(const Cone& s) const {
    CollisionShape shape;
    shape.type = ShapeType::Cone;
    shape.half = {s.radius, s.half_length, s.radius};
    shape.radius = s.rounding;
    return shape;
  }
  CollisionShape operator()(const Capsule& s) const {
    CollisionShape shape;
    shape.type = ShapeType::Capsule;
    shape.radius = s.radius;
    shape.half = {0, s.half_length, 0};
    return shape;
  }
  CollisionShape operator()(const ConvexHull& s) const {
    CollisionShape shape;
    shape.type = ShapeType::Hull;
    shape.hull = s.geometry.get();
    shape.owner = s.geometry;
    shape.radius = s.rounding;
    return shape;
  }
  CollisionShape operator()(const HalfSpace& s) const {
    CollisionShape shape;
    shape.type = ShapeType::HalfSpace;
    shape.normal = normalized_or(to_inner(s.normal), Vec{0, 1, 0});
    shape.offset = s.offset;
    return shape;
  }
  CollisionShape operator()(const SurfaceMesh& s) const { return make_mesh(s); }
  CollisionShape operator()(const Heightfield& s) const { return make_heightfield(s); }
  CollisionShape operator()(const Compound& s) const { return make_compound(s); }
};

// How far a disc of unit radius about the shape's y axis reaches along each world axis.
Vec disc_reach(const Matrix3<Real>& R) {
  return {std::hypot(R.row0.x, R.row0.z), std::hypot(R.row1.x, R.row1.z),
          std::hypot(R.row2.x, R.row2.z)};
}

Aabb cylinder_bounds(const CollisionShape& shape, const Transform& x) {
  const Matrix3<Real> R = to_matrix(x.q);
  const Vec along{shape.half.y * R.row0.y, shape.half.y * R.row1.y, shape.half.y * R.row2.y};
  const Vec grown = shape.half.x * disc_reach(R) + Vec{shape.radius, shape.radius, shape.radius};
  const Vec reach = absolute(along) + grown;
  return {x.p - reach, x.p + reach};
}

Aabb cone_bounds(const CollisionShape& shape, const Transform& x) {
  const Matrix3<Real> R = to_matrix(x.q);
  const Vec apex{shape.half.y * R.row0.y, shape.half.y * R.row1.y, shape.half.y * R.row2.y};
  const Vec disc = shape.half.x * disc_reach(R), r{shape.radius, shape.radius, shape.radius};
  return {x.p + min_each(apex, -apex - disc) - r, x.p + max_each(apex, disc - apex) + r};
}

// The end of a half-space along one axis, if its normal is that axis (to round-off).
void bound_axis(Real n, Real others, Real plane, Real& lower, Real& upper) {
  constexpr Real kStraight = 4 * std::numeric_limits<Real>::epsilon();
  lower = -kUnbounded;
  upper = kUnbounded;
  if (others > kStraight) return;
  (n > Real(0) ? upper : lower) = n * plane;
}

Aabb half_space_bounds(const CollisionShape& shape, const Transform& x) {
  const Vec n = rotate(x.q, shape.normal), m = absolute(n);
  const Real plane = shape.offset + dot(n, x.p);
  Aabb box;
  bound_axis(n.x, m.y + m.z, plane, box.lower.x, box.upper.x);
  bound_axis(n.y, m.z + m.x, plane, box.lower.y, box.upper.y);
  bound_axis(n.z, m.x + m.y, plane, box.lower.z, box.upper.z);
  return box;
}

}  // namespace

CollisionShape make_collision_shape(const Shape& shape) { return std::visit(Make{}, shape); }
Status check_shape(const Shape& shape) { return std::visit(Check{}, shape); }

Aabb bounds_of(const CollisionShape& shape, const Transform& x) {
  switch (shape.type) {
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      return composite_bounds(shape, x);
    case ShapeType::HalfSpace:
      return half_space_bounds(shape, x);
    case ShapeType::Hull: {
      const Matrix3<Real> R = to_matrix(x.q);
      Vec lower{kUnbounded, kUnbounded, kUnbounded}, upper = -lower;
      for (const Vec3& vertex : shape.hull->vertices()) {
        const Vec v = R * to_inner(vertex);
        lower = min_each(lower, v);
        upper = max_each(upper, v);
      }
      const Vec r{shape.radius, shape.radius, shape.radius};
      return {x.p + lower - r, x.p + upper + r};
    }
    case ShapeType::Cylinder:
      return cylinder_bounds(shape, x);
    case ShapeType::Cone:
      return cone_bounds(shape, x);
    case ShapeType::Sphere:
    case ShapeType::Capsule:
    case ShapeType::Box:
      break;
  }
  const Vec r{shape.radius, shape.radius, shape.radius};
  if (shape.type == ShapeType::Sphere) return {x.p - r, x.p + r};
  const Matrix3<Real> R = to_matrix(x.q);
  const Vec reach = r + Vec{dot(absolute(R.row0), shape.half), dot(absolute(R.row1), shape.half),
                            dot(absolute(R.row2), shape.half)};
  return {x.p - reach, x.p + reach};
}

Real bounding_radius(const CollisionShape& shape) {
  switch (shape.type) {
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      return composite_radius(shape);
    case ShapeType::HalfSpace:
      return kUnbounded;
    case ShapeType::Hull: {
      Real squared = 0;
      for (const Vec3& v : shape.hull->vertices()) squared = std::max(squared, v.squaredNorm());
      return std::sqrt(squared) + shape.radius;
    }
    case ShapeType::Cylinder:
    case ShapeType::Cone:
      return std::hypot(shape.half.x, shape.half.y) + shape.radius;
    case ShapeType::Sphere:
    case ShapeType::Capsule:
    case ShapeType::Box:
      break;
  }
  return length(shape.half) + shape.radius;
}

Real smallest_thickness(const CollisionShape& shape) {
  switch (shape.type) {
    case ShapeType::Sphere:
    case ShapeType::Capsule:
      return Real(2) * shape.radius;
    case ShapeType::Box:
      return Real(2) *
             (std::min(shape.half.x, std::min(shape.half.y, shape.half.z)) + shape.radius);
    case ShapeType::Hull:
      return Real(2) * (shape.hull->inner_radius() + shape.radius);
    case ShapeType::Compound:
      return composite_thickness(shape);
    case ShapeType::Cylinder:
      return Real(2) * (std::min(shape.half.x, shape.half.y) + shape.radius);
    case ShapeType::Cone:
      return Real(2) * (static_cast<Real>(cone_inner_radius(to_num(shape.half))) + shape.radius);
    case ShapeType::HalfSpace:
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
      break;
  }
  return kUnbounded;
}

Vec support(const CollisionShape& shape, Vec d) {
  switch (shape.type) {
    case ShapeType::Sphere:
      return {0, 0, 0};
    case ShapeType::Capsule:
    case ShapeType::Box:
      return {d.x < Real(0) ? -shape.half.x : shape.half.x,
              d.y < Real(0) ? -shape.half.y : shape.half.y,
              d.z < Real(0) ? -shape.half.z : shape.half.z};
    case ShapeType::Hull: {
      Vec farthest = to_inner(shape.hull->vertices().front());
      Real best = dot(farthest, d);
      for (const Vec3& vertex : shape.hull->vertices()) {
        const Vec v = to_inner(vertex);
        const Real along = dot(v, d);
        if (along > best) best = along, farthest = v;
      }
      return farthest;
    }
    case ShapeType::Mesh:
    case ShapeType::Heightfield:
    case ShapeType::Compound:
      return composite_support(shape, d);
    case ShapeType::Cylinder:
    case ShapeType::Cone:
      return cast<Real>(support_of_round(shape, to_num(d)));
    case ShapeType::HalfSpace:
      break;
  }
  // The plane's own point: a half-space has no farthest point in any other direction.
  return shape.offset * shape.normal;
}

}  // namespace plumb::inline PLUMB_ABI::detail
