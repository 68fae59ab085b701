#include "collision/surface/composite_shape.h"

#include <cmath>
#include <limits>

#include "collision/surface/heightfield_surface.h"
#include "collision/surface/mesh_surface.h"
#include "math/eigen_bridge.h"
#include "plumb/compound.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

NumBox local_bounds(const CollisionShape& shape) {
  if (shape.type == ShapeType::Mesh)
    return MeshSurface(*shape.mesh, cast<Num>(shape.scale)).bounds();
  if (shape.type == ShapeType::Heightfield) return HeightfieldSurface(*shape.heightfield).bounds();
  return shape.compound->tree.bounds();
}

}  // namespace

Status check_mesh(const SurfaceMesh& s) {
  if (s.geometry == nullptr)
    return {StatusCode::BadShape, "a mesh needs a geometry from TriangleMeshGeometry::create"};
  if (!s.scale.allFinite()) return {StatusCode::NotFinite, "a mesh's scale must be finite"};
  const Num smallest = s.scale.minCoeff(), largest = s.scale.maxCoeff();
  if (!(smallest > Num(0)))
    return {StatusCode::OutOfRange,
            "a mesh's scale must be greater than zero on each axis: mirror the geometry instead"};
  const Vec3 far = s.geometry->lower().cwiseAbs().cwiseMax(s.geometry->upper().cwiseAbs());
  if (static_cast<Num>(far.cwiseProduct(s.scale).maxCoeff()) > kLargestSize)
    return {StatusCode::OutOfRange, "a mesh times its scale must lie within +-1e6 m"};
  if (largest > smallest * kLargestAspect)
    return {StatusCode::OutOfRange,
            "the largest scale of a mesh must be at most 1e5 times the smallest"};
  return {};
}
Status check_heightfield(const Heightfield& s) {
  if (s.geometry == nullptr)
    return {StatusCode::BadShape,
            "a heightfield needs a geometry from HeightfieldGeometry::create"};
  return {};
}
Status check_compound(const Compound& s) {
  if (s.geometry == nullptr)
    return {StatusCode::BadShape, "a compound needs a geometry from CompoundGeometry::create"};
  return {};
}

CollisionShape make_mesh(const SurfaceMesh& s) {
  CollisionShape shape;
  shape.type = ShapeType::Mesh;
  shape.mesh = &s.geometry->data();
  shape.scale = to_inner(s.scale);
  shape.owner = s.geometry;
  return shape;
}
CollisionShape make_heightfield(const Heightfield& s) {
  CollisionShape shape;
  shape.type = ShapeType::Heightfield;
  shape.heightfield = s.geometry.get();
  shape.owner = s.geometry;
  return shape;
}
CollisionShape make_compound(const Compound& s) {
  CollisionShape shape;
  shape.type = ShapeType::Compound;
  shape.compound = &s.geometry->data();
  shape.owner = s.geometry;
  return shape;
}

Aabb composite_bounds(const CollisionShape& shape, const Transform& x) {
  if (shape.type == ShapeType::Compound) {
    Vec lower{kUnbounded, kUnbounded, kUnbounded}, upper = -lower;
    for (const CompoundData::Child& child : shape.compound->children) {
      const Aabb box = bounds_of(child.shape, x * child.placed);
      lower = min_each(lower, box.lower);
      upper = max_each(upper, box.upper);
    }
    return {lower, upper};
  }
  // The box of the box: as tight as is worth it for what does not move.
  const NumBox local = local_bounds(shape);
  const Placement at = to_placement(x);
  const NumMatrix R = to_matrix(at.q);
  const NumVec middle = Num(0.5) * (local.lower + local.upper), half = local.upper - middle;
  const NumVec centre = R * middle + at.p;
  const NumVec reach{dot(absolute(R.row0), half), dot(absolute(R.row1), half),
                     dot(absolute(R.row2), half)};
  return {cast<Real>(centre - reach), cast<Real>(centre + reach)};
}

Real composite_radius(const CollisionShape& shape) {
  if (shape.type == ShapeType::Compound) return shape.compound->radius;
  const NumBox box = local_bounds(shape);
  return static_cast<Real>(length(max_each(absolute(box.lower), absolute(box.upper))));
}

Real composite_thickness(const CollisionShape& compound) { return compound.compound->thickness; }

Vec composite_support(const CollisionShape& shape, Vec d) {
  if (shape.type == ShapeType::Compound) {
    Vec farthest{0, 0, 0};
    Real best = -std::numeric_limits<Real>::infinity();
    for (const CompoundData::Child& child : shape.compound->children) {
      const Vec unit = normalized_or(d, Vec{0, 1, 0});
      const Vec core = support(child.shape, inverse_rotate(child.placed.q, d));
      const Vec p = transform_point(child.placed, core) + child.shape.radius * unit;
      if (dot(p, d) > best) best = dot(p, d), farthest = p;
    }
    return farthest;
  }
  // The corner of the bounds: surfaces are never asked for more.
  const NumBox box = local_bounds(shape);
  return cast<Real>(NumVec{d.x < Real(0) ? box.lower.x : box.upper.x,
                           d.y < Real(0) ? box.lower.y : box.upper.y,
                           d.z < Real(0) ? box.lower.z : box.upper.z});
}

}  // namespace plumb::inline PLUMB_ABI::detail

namespace plumb::inline PLUMB_ABI {

CompoundGeometry::Result CompoundGeometry::create(std::span<const Child> children) {
  using namespace detail;
  const auto bad = [](StatusCode code, const char* message) {
    return Result{nullptr, {code, message}};
  };
  if (children.empty()) return bad(StatusCode::BadShape, "a compound needs at least one child");
  if (children.size() > kMaxChildren)
    return bad(StatusCode::CapacityExceeded, "a compound may have at most 65535 children");
  auto data = std::make_shared<CompoundData>();
  auto compound = std::make_shared<CompoundGeometry>();
  data->thickness = kUnbounded;
  std::vector<NumBox> boxes;
  for (Child child : children) {
    if (const Status status = check_shape(child.shape); !status.ok()) return {nullptr, status};
    CompoundData::Child made;
    made.shape = make_collision_shape(child.shape);
    if (made.shape.type == ShapeType::HalfSpace || has_parts(made.shape.type))
      return bad(StatusCode::BadShape,
                 "a compound's children must be convex and bounded: no half-space, mesh, "
                 "heightfield or compound");
    if (!child.pose.position.allFinite() || !child.pose.orientation.coeffs().allFinite())
      return bad(StatusCode::NotFinite, "a compound child's pose must be finite");
    constexpr Real kUnit = Real(1e-3);
    if (std::abs(child.pose.orientation.norm() - Real(1)) > kUnit)
      return bad(StatusCode::OutOfRange,
                 "a compound child's orientation must be a unit quaternion (length 1 within 1e-3)");
    // What is of unit length to rounding stays as it is: made again from a snapshot, a compound has
    // the same bits.
    constexpr Real kRounding = Real(8) * std::numeric_limits<Real>::epsilon();
    if (std::abs(child.pose.orientation.squaredNorm() - Real(1)) > kRounding)
      child.pose.orientation.normalize();
    made.placed = {to_inner(child.pose.position), to_inner(child.pose.orientation)};
    const Aabb box = bounds_of(made.shape, made.placed);
    const Vec far = max_each(absolute(box.lower), absolute(box.upper));
    if (static_cast<Num>(std::max({far.x, far.y, far.z})) > kLargestSize)
      return bad(StatusCode::OutOfRange, "a compound must lie within +-1e6 m of its origin");
    boxes.push_back({cast<Num>(box.lower), cast<Num>(box.upper)});
    data->radius = std::max(data->radius, length(made.placed.p) + bounding_radius(made.shape));
    data->thickness = std::min(data->thickness, smallest_thickness(made.shape));
    data->children.push_back(std::move(made));
    compound->children_.push_back(std::move(child));
  }
  data->order = data->tree.build(boxes);
  compound->data_ = std::move(data);
  return {std::move(compound), {}};
}

}  // namespace plumb::inline PLUMB_ABI
