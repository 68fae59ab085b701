// Hulls against spheres and capsules, in the hull's frame: closest points of the cores while they
// are apart, least way out through a face or past an edge when they are not.
#include "collision/capsule_contact.h"
#include "collision/collide_pairs.h"
#include "collision/gjk.h"
#include "collision/placed_polyhedron.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct FaceDistance {
  int face;
  Num distance;
};
// The face above which a core (a segment; a point has start = end) lies highest.
FaceDistance highest_above(const PlacedPolyhedron& hull, const Segment& core) {
  FaceDistance best{0, -std::numeric_limits<Num>::infinity()};
  for (int k = 0; k < hull.face_count(); ++k) {
    const NumVec n = hull.normal(k);
    const Num s = std::min(dot(n, core.start), dot(n, core.end)) - hull.offset(k);
    if (s > best.distance) best = {k, s};
  }
  return best;
}

GjkResult distance_to_core(const PlacedPolyhedron& hull, const Segment& core) {
  const NumVec middle = Num(0.5) * (core.start + core.end);
  const Num size = hull.outer_radius() + length(core.end - core.start);
  return gjk_distance(
      [&hull](NumVec d) { return hull.vertex(hull.support_index(d)); },
      [&core](NumVec d) { return dot(core.end - core.start, d) > Num(0) ? core.end : core.start; },
      middle - hull.centre(), size);
}

}  // namespace

void collide_hull_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const NumVec centre = rotate(conjugate(a.q), b.p);
  const Num radius = b.shape.radius;
  const PlacedPolyhedron hull(a.shape);
  const FaceDistance face = highest_above(hull, {centre, centre});
  if (out.parted(face.distance - radius, margin)) return;
  NumVec n = normalized_or(hull.normal(face.face), {0, 1, 0});
  Num distance = face.distance;
  if (distance > Num(0)) {
    const GjkResult closest = distance_to_core(hull, {centre, centre});
    if (!closest.overlap) n = closest.normal, distance = closest.distance;
  }
  const Num separation = distance - radius;
  if (out.parted(separation, margin)) return;
  out.normal = rotate(a.q, n);
  out.add(rotate(a.q, centre - (radius + Num(0.5) * separation) * n), separation,
          pair_name(face_name(0), face_name(0)));
}

void collide_hull_capsule(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const NumRotation to_hull = conjugate(a.q);
  const NumVec centre = rotate(to_hull, b.p), reach = rotate(to_hull * b.q, to_num(b.shape.half));
  const Segment axis{centre - reach, centre + reach};
  const Num radius = b.shape.radius;
  const PlacedPolyhedron hull(a.shape);
  const FaceDistance highest = highest_above(hull, axis);
  if (out.parted(highest.distance - radius, margin)) return;
  const Num thickness = std::min(hull.inner_radius(), radius);
  const GjkResult closest = distance_to_core(hull, axis);
  AxisProximity proximity{closest.normal, closest.distance, closest.on_b};
  if (closest.overlap) proximity = deepest_of_axis(hull, axis, thickness);
  if (out.parted(proximity.distance - radius, margin)) return;
  FacePolygon face;
  hull.face(hull.face_facing(proximity.normal), face);
  add_capsule_contacts(face, axis, radius, proximity, thickness, margin, out);
  out.normal = rotate(a.q, out.normal);
  for (int i = 0; i < out.count; ++i) out.points[i].position = rotate(a.q, out.points[i].position);
}

}  // namespace plumb::inline PLUMB_ABI::detail
