// Distance of two shapes: GJK between the cores, minus the radii.
#include "collision/collide.h"
#include "collision/collide_parts.h"
#include "collision/contact_points.h"
#include "collision/core_support.h"
#include "collision/gjk.h"
#include "collision/round_core.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Farthest point of a core in a direction of the common frame.
class PlacedCore {
 public:
  PlacedCore(const CollisionShape& shape, const Transform& x, NumVec origin)
      : shape_(shape),
        q_(normalized(NumRotation{x.q.x, x.q.y, x.q.z, x.q.w})),
        rows_(to_matrix(q_)),
        p_(to_num(x.p) - origin) {}

  [[nodiscard]] NumVec support(NumVec direction) const {
    const NumVec d = transpose_times(rows_, direction);
    return rows_ * local_support(d) + p_;
  }
  [[nodiscard]] NumVec middle() const {
    if (shape_.type != ShapeType::Hull) return p_;
    return rows_ * to_num(shape_.hull->interior_point()) + p_;
  }
  [[nodiscard]] Num size() const {
    if (shape_.type == ShapeType::Hull) return shape_.hull->outer_radius();
    return length(to_num(shape_.half)) + static_cast<Num>(shape_.radius);
  }
  [[nodiscard]] Num radius() const { return shape_.radius; }
  [[nodiscard]] NumVec plane_normal() const {
    return rows_ * normalized_or(to_num(shape_.normal), NumVec{0, 1, 0});
  }
  // n . x of the boundary of a half-space.
  [[nodiscard]] Num plane_offset() const {
    return dot(plane_normal(), p_) + static_cast<Num>(shape_.offset);
  }

 private:
  [[nodiscard]] NumVec local_support(NumVec d) const {
    if (shape_.type == ShapeType::Hull) return farthest_corner(*shape_.hull, d);
    if (is_curved(shape_.type)) return support_of_round(shape_, d);
    const NumVec half = to_num(shape_.half);
    return {d.x < Num(0) ? -half.x : half.x, d.y < Num(0) ? -half.y : half.y,
            d.z < Num(0) ? -half.z : half.z};
  }

  const CollisionShape& shape_;
  NumRotation q_;
  NumMatrix rows_;
  NumVec p_;
};

struct Closest {
  Num distance;
  NumVec on_a, on_b, normal;
};

// The first shape is the half-space.
Closest from_half_space(const PlacedCore& plane, const PlacedCore& other) {
  const NumVec n = plane.plane_normal();
  const NumVec lowest = other.support(-n) - other.radius() * n;
  const Num distance = dot(n, lowest) - plane.plane_offset();
  return {distance, lowest - distance * n, lowest, n};
}

Proximity rounded(const Closest& c, NumVec origin) {
  NumVec on_a = c.on_a, on_b = c.on_b;
  if (!(c.distance > Num(0))) on_a = on_b = Num(0.5) * (c.on_a + c.on_b);
  return {static_cast<Real>(std::max(c.distance, Num(0))), cast<Real>(origin + on_a),
          cast<Real>(origin + on_b), cast<Real>(c.normal)};
}

// Cores that overlap have no closest points; the deepest contact stands in for them.
Proximity touching(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                   const Transform& xb, Vec shared) {
  Proximity result{0, shared, shared, {0, 1, 0}};
  Manifold manifold;
  const Real margin =
      std::min(bounding_radius(a), bounding_radius(b));  // touching cores always count
  if (!collide(a, xa, b, xb, margin, manifold)) return result;
  result.normal = manifold.normal;
  int deepest = 0;
  for (int i = 1; i < manifold.count; ++i) {
    if (manifold.points[i].separation < manifold.points[deepest].separation) deepest = i;
  }
  result.on_a = result.on_b = manifold.points[deepest].position;
  return result;
}

}  // namespace

Proximity closest_points(const CollisionShape& a, const Transform& xa, const CollisionShape& b,
                         const Transform& xb) {
  if (has_parts(a.type) || has_parts(b.type)) return closest_parts(a, xa, b, xb);
  const NumVec origin = to_num(xa.p);
  const PlacedCore core_a(a, xa, origin), core_b(b, xb, origin);
  const bool plane_a = a.type == ShapeType::HalfSpace, plane_b = b.type == ShapeType::HalfSpace;
  if (plane_a && plane_b) {  // never asked for a contact: reported as touching
    return {0, xa.p, xa.p, {0, 1, 0}};
  }
  if (plane_a) return rounded(from_half_space(core_a, core_b), origin);
  if (plane_b) {
    const Closest c = from_half_space(core_b, core_a);
    return rounded({c.distance, c.on_b, c.on_a, -c.normal}, origin);
  }
  const GjkResult cores = gjk_distance(
      [&](NumVec d) { return core_a.support(d); }, [&](NumVec d) { return core_b.support(d); },
      core_b.middle() - core_a.middle(), core_a.size() + core_b.size());
  if (cores.overlap) return touching(a, xa, b, xb, cast<Real>(origin + cores.on_a));
  const NumVec n = cores.normal;
  return rounded({cores.distance - core_a.radius() - core_b.radius(),
                  cores.on_a + core_a.radius() * n, cores.on_b - core_b.radius() * n, n},
                 origin);
}

}  // namespace plumb::inline PLUMB_ABI::detail
