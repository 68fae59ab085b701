// Boxes against spheres and capsules, in the box's frame: closed forms.
#include "collision/box_view.h"
#include "collision/capsule_contact.h"
#include "collision/collide_pairs.h"
#include "collision/placed_polyhedron.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

NumVec clamp_to_box(NumVec point, NumVec half) { return max_each(-half, min_each(half, point)); }

// Parameter at which an axis is closest to a box. Half the derivative of the squared distance is
// g(t) = sum_i d_i (x_i(t) - clamp(x_i(t))): continuous, never falling, and linear between the
// planes of the box, so that its zero is found exactly.
Num closest_axis_parameter(const Segment& axis, NumVec half) {
  const NumVec d = axis.end - axis.start;
  const auto slope = [&](Num t) {
    const NumVec x = point_at(axis, t);
    return dot(d, x - clamp_to_box(x, half));
  };
  Num below = Num(0), above = Num(1);
  Num slope_below = slope(below), slope_above = slope(above);
  if (!(slope_below < Num(0))) return below;
  if (!(slope_above > Num(0))) return above;
  for (int i = 0; i < 3; ++i) {
    const Num di = component(d, i);
    if (di == Num(0)) continue;
    for (const Num side : {-component(half, i), component(half, i)}) {
      const Num t = (side - component(axis.start, i)) / di;
      if (!(t > below && t < above)) continue;
      const Num g = slope(t);
      if (g < Num(0)) {
        below = t, slope_below = g;
      } else {
        above = t, slope_above = g;
      }
    }
  }
  return below + (above - below) * (slope_below / (slope_below - slope_above));
}

}  // namespace

void collide_box_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const NumVec half = to_num(a.shape.half);
  const NumVec centre = rotate(conjugate(a.q), b.p);
  const Num radius = b.shape.radius;
  const NumVec nearest = clamp_to_box(centre, half);
  const NumVec d = centre - nearest;
  NumVec n;
  Num distance;
  if (d.x != Num(0) || d.y != Num(0) || d.z != Num(0)) {
    distance = length(d);
    if (out.parted(distance - radius, margin)) return;
    n = normalized_or(d, {0, 1, 0});
  } else {
    // Inside: the nearest face pushes out.
    const NumVec inside = absolute(centre) - half;  // separation from each pair of faces
    int axis = inside.y >= inside.x ? 1 : 0;
    if (inside.z > component(inside, axis)) axis = 2;
    distance = component(inside, axis);
    n = {0, 0, 0};
    set_component(n, axis, component(centre, axis) < Num(0) ? Num(-1) : Num(1));
  }
  const Num separation = distance - radius;
  if (out.parted(separation, margin)) return;
  out.normal = rotate(a.q, n);
  out.add(rotate(a.q, centre - (radius + Num(0.5) * separation) * n), separation,
          pair_name(face_name(0), face_name(0)));
}

void collide_box_capsule(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const NumVec half = to_num(a.shape.half), half_axis = to_num(b.shape.half);
  const NumRotation to_box = conjugate(a.q);
  const NumVec centre = rotate(to_box, b.p), reach = rotate(to_box * b.q, half_axis);
  const Segment axis{centre - reach, centre + reach};
  const Num radius = b.shape.radius;
  const Num t = closest_axis_parameter(axis, half);
  const NumVec on_axis = point_at(axis, t), d = on_axis - clamp_to_box(on_axis, half);
  const Num distance = length(d);
  if (out.parted(distance - radius, margin)) return;
  const Num thickness = std::min({half.x, half.y, half.z, radius});
  AxisProximity proximity{normalized_or(d, {0, 1, 0}), distance, on_axis};
  if (!(distance > kTouching * (length(half) + half_axis.y))) {
    proximity = deepest_of_axis(PlacedPolyhedron(a.shape), axis, thickness);
  }
  const BoxView box{{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, half};
  FacePolygon face;
  box.face(box.face_facing(proximity.normal), face);
  add_capsule_contacts(face, axis, radius, proximity, thickness, margin, out);
  out.normal = rotate(a.q, out.normal);
  for (int i = 0; i < out.count; ++i) out.points[i].position = rotate(a.q, out.points[i].position);
}

}  // namespace plumb::inline PLUMB_ABI::detail
