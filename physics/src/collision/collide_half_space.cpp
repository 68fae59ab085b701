// Half-spaces against everything else: the lowest points of the other shape. The normal is the
// plane's, always, however deep the other shape is.
#include "collision/collide_pairs.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// n . x <= offset is solid, relative to the half-space's own origin.
struct Plane {
  NumVec normal;
  Num offset;
};
Plane plane_of(const Placed& half_space) {
  // Single precision leaves the stored normal a rounding away from unit length.
  const NumVec n = normalized_or(to_num(half_space.shape.normal), {0, 1, 0});
  return {rotate(half_space.q, n), static_cast<Num>(half_space.shape.offset)};
}

void add_if_near(const Plane& plane, NumVec core_point, Num radius, FeatureName name, Num margin,
                 Contacts& out) {
  const Num separation = dot(plane.normal, core_point) - plane.offset - radius;
  if (!(separation <= margin)) return;
  out.normal = plane.normal;
  out.add(core_point - (radius + Num(0.5) * separation) * plane.normal, separation,
          pair_name(face_name(0), name));
}

}  // namespace

void collide_half_space_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  add_if_near(plane_of(a), b.p, b.shape.radius, vertex_name(0), margin, out);
}

void collide_half_space_capsule(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const Plane plane = plane_of(a);
  const NumVec half = rotate(b.q, to_num(b.shape.half));
  add_if_near(plane, b.p - half, b.shape.radius, vertex_name(0), margin, out);
  add_if_near(plane, b.p + half, b.shape.radius, vertex_name(1), margin, out);
}

void collide_half_space_box(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const Plane plane = plane_of(a);
  const NumVec n_B = rotate(conjugate(b.q), plane.normal);  // plane normal in the box's frame
  const NumVec half = to_num(b.shape.half);
  const Num centre = dot(plane.normal, b.p) - plane.offset;
  if (out.parted(centre - dot(absolute(n_B), half), margin)) return;
  // The four corners of the face that looks most into the plane; the deepest is among them.
  const NumVec m = absolute(n_B);
  const int axis = m.x >= m.y ? (m.x >= m.z ? 0 : 2) : (m.y >= m.z ? 1 : 2);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bool positive = component(n_B, axis) < Num(0);
  for (int corner = 0; corner < 4; ++corner) {
    const bool positive_u = (corner & 1) != 0, positive_v = (corner & 2) != 0;
    NumVec point = half;
    if (!positive) set_component(point, axis, -component(half, axis));
    if (!positive_u) set_component(point, u, -component(half, u));
    if (!positive_v) set_component(point, v, -component(half, v));
    const int index =
        (positive ? 1 << axis : 0) | (positive_u ? 1 << u : 0) | (positive_v ? 1 << v : 0);
    add_if_near(plane, b.p + rotate(b.q, point), Num(0), vertex_name(index), margin, out);
  }
}

void collide_half_space_hull(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const Plane plane = plane_of(a);
  const NumVec n_B = rotate(conjugate(b.q), plane.normal);
  const HullGeometry& hull = *b.shape.hull;
  const Num centre = dot(plane.normal, b.p) - plane.offset;
  const std::vector<Vec3>& vertices = hull.vertices();
  std::size_t lowest = 0;
  Num depth = dot(to_num(vertices[0]), n_B);
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const Num along = dot(to_num(vertices[i]), n_B);
    if (along < depth) depth = along, lowest = i;
  }
  if (out.parted(centre + depth, margin)) return;

  // Of the faces at the lowest vertex, the one that looks most into the plane.
  std::size_t face = 0;
  Num facing = Num(2);
  for (const HullGeometry::Edge& edge : hull.edges()) {
    if (edge.v0 != lowest && edge.v1 != lowest) continue;
    for (const std::uint32_t k : {edge.face_a, edge.face_b}) {
      const Num along = dot(to_num(hull.face_normals()[k]), n_B);
      if (along < facing) facing = along, face = k;
    }
  }
  ContactCandidates candidates;
  candidates.count = 0;
  for (const std::uint32_t index : hull.face(face)) {
    const NumVec point = b.p + rotate(b.q, to_num(vertices[index]));
    const Num separation = dot(plane.normal, point) - plane.offset;
    if (!(separation <= margin)) continue;
    candidates.points[candidates.count++] = {
        point - Num(0.5) * separation * plane.normal, separation,
        pair_name(face_name(0), vertex_name(static_cast<int>(index)))};
  }
  if (candidates.count > 0) {
    choose_points(candidates, plane.normal, kDeepestTie * static_cast<Num>(hull.inner_radius()),
                  out);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
