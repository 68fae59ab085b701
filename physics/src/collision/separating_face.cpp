#include "collision/separating_face.h"

#include <algorithm>
#include <cmath>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// The full search rounds elsewhere. A gap is told smaller by this much of the shapes' sizes [-], so
// that both always agree; double precision errs by a hundred thousandth of it.
constexpr Num kGuard = Num(1e-10);

struct Plane {
  NumVec normal;  // frame of the shape
  Num offset;     // [m]
};

bool is_polyhedron(const CollisionShape& shape) {
  return shape.type == ShapeType::Box || shape.type == ShapeType::Hull;
}

std::size_t face_count(const CollisionShape& shape) {
  return shape.type == ShapeType::Box ? 6 : shape.hull->face_count();
}

Plane plane_of(const CollisionShape& shape, std::size_t face) {
  if (shape.type == ShapeType::Hull)
    return {to_num(shape.hull->face_normals()[face]),
            static_cast<Num>(shape.hull->face_offsets()[face])};
  const int axis = static_cast<int>(face / 2);  // as in box_view.h
  NumVec normal{0, 0, 0};
  set_component(normal, axis, face % 2 == 0 ? Num(1) : Num(-1));
  return {normal, static_cast<Num>(component(shape.half, axis))};
}

// [m] The smallest n . x over the core, in the frame of the shape.
Num lowest_along(const CollisionShape& shape, NumVec n) {
  if (shape.type == ShapeType::Box) return -dot(absolute(n), to_num(shape.half));
  Num lowest = std::numeric_limits<Num>::infinity();
  for (const Vec3& vertex : shape.hull->vertices())
    lowest = std::min(lowest, dot(n, to_num(vertex)));
  return lowest;
}

Num size_of(const CollisionShape& shape) {
  return shape.type == ShapeType::Box ? length(to_num(shape.half))
                                      : static_cast<Num>(shape.hull->outer_radius());
}

}  // namespace

Num gap_along(AxisHint axis, const Placed& first, const Placed& second) {
  constexpr Num kUnknown = -std::numeric_limits<Num>::infinity();
  if (!axis.is_face() || !is_polyhedron(first.shape) || !is_polyhedron(second.shape))
    return kUnknown;
  const Placed& p = axis.of_second() ? second : first;
  const Placed& q = axis.of_second() ? first : second;
  if (static_cast<std::size_t>(axis.face()) >= face_count(p.shape))
    return kUnknown;  // the shape was changed
  const Plane plane = plane_of(p.shape, static_cast<std::size_t>(axis.face()));
  const NumVec n = rotate(p.q, plane.normal);
  const NumVec way = q.p - p.p;
  const Num gap = dot(n, way) - plane.offset + lowest_along(q.shape, rotate(conjugate(q.q), n));
  return gap - kGuard * (size_of(p.shape) + size_of(q.shape) + length(way));
}

}  // namespace plumb::inline PLUMB_ABI::detail
