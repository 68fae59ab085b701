// Hulls and boxes among themselves: separating axes over faces and over the edge pairs whose arcs
// cross on the Gauss map [Gregorius 2013]. Faces and edges that cannot beat the best axis found so
// far are passed over by balls inside the shapes.
#include "collision/collide_pairs.h"
#include "collision/placed_polyhedron.h"
#include "collision/polyhedron_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct Best {
  Num separation = -std::numeric_limits<Num>::infinity();
  int a = -1, b = -1;  // face (in a), or edges
};

// Faces may be uneven: the ball that is surely inside is a little smaller.
Num sure_inner_radius(const PlacedPolyhedron& p) {
  return (Num(1) - Num(4) * kHullUnevenness) * p.inner_radius();
}

// The face of p from which q is farthest. Along a face normal q starts no farther out than its
// ball.
Best best_face(const PlacedPolyhedron& p, const PlacedPolyhedron& q, Num floor) {
  const NumVec centre = q.centre();
  const Num radius = sure_inner_radius(q);
  Num bounds[kMaxHullFaces];
  int start = 0;
  for (int k = 0; k < p.face_count(); ++k) {
    bounds[k] = dot(p.normal(k), centre) - p.offset(k) - radius;
    if (bounds[k] > bounds[start]) start = k;
  }
  Best best;
  best.separation = q.lowest_along(p.normal(start)) - p.offset(start);
  best.a = start;
  for (int k = 0; k < p.face_count(); ++k) {
    if (k == start || bounds[k] <= std::max(best.separation, floor)) continue;
    const Num s = q.lowest_along(p.normal(k)) - p.offset(k);
    if (s > best.separation) best.separation = s, best.a = k;
  }
  return best;
}

// The largest n . w over the unit vectors n between n1 and n2 on their great circle.
Num largest_on_arc(NumVec n1, NumVec n2, NumVec w) {
  const Num w1 = dot(n1, w), w2 = dot(n2, w), c = dot(n1, n2);
  const Num u1 = w1 - c * w2, u2 = w2 - c * w1;
  if (!(u1 > Num(0) && u2 > Num(0))) return std::max(w1, w2);
  // w projected to the plane of the arc: alpha n1 + beta n2 with (alpha, beta) = (u1, u2) / (1 -
  // c^2).
  const Num sine_squared = Num(1) - c * c;
  if (!(sine_squared > kParallelSine)) return length(w);
  return std::sqrt(std::max(Num(0), (w1 * u1 + w2 * u2) / sine_squared));
}

// The edges of p whose normals could separate more than `floor` from a ball; sign -1 turns p's
// normals around (for the second shape, whose normals point back).
int edges_in_reach(const PlacedPolyhedron& p, Num sign, NumVec centre, Num radius, Num floor,
                   std::uint16_t* list) {
  int count = 0;
  for (int i = 0; i < p.edge_count(); ++i) {
    const PlacedPolyhedron::Edge e = p.edge(i);
    const NumVec w = sign * (centre - p.vertex(e.v0));
    if (largest_on_arc(sign * p.normal(e.face_a), sign * p.normal(e.face_b), w) - radius > floor) {
      list[count++] = static_cast<std::uint16_t>(i);
    }
  }
  return count;
}

Best best_edges(const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num floor) {
  std::uint16_t list_a[kMaxHullEdges], list_b[kMaxHullEdges];
  const int count_a = edges_in_reach(a, Num(1), b.centre(), sure_inner_radius(b), floor, list_a);
  const int count_b = edges_in_reach(b, Num(-1), a.centre(), sure_inner_radius(a), floor, list_b);
  Best best;
  best.separation = floor;
  for (int i = 0; i < count_a; ++i) {
    const PlacedPolyhedron::Edge ea = a.edge(list_a[i]);
    const NumVec a1 = a.normal(ea.face_a), a2 = a.normal(ea.face_b);
    const NumVec da = a.vertex(ea.v1) - a.vertex(ea.v0);
    for (int k = 0; k < count_b; ++k) {
      const PlacedPolyhedron::Edge eb = b.edge(list_b[k]);
      const NumVec b1 = -b.normal(eb.face_a), b2 = -b.normal(eb.face_b);
      const Num b1_da = dot(b1, da), b2_da = dot(b2, da);
      if (!(b1_da * b2_da < Num(0))) continue;
      const NumVec db = b.vertex(eb.v1) - b.vertex(eb.v0);
      const Num a1_db = dot(a1, db), a2_db = dot(a2, db);
      if (!(a1_db * a2_db < Num(0) && b1_da * a2_db > Num(0))) continue;
      const NumVec across = cross(da, db);
      const Num squared = length_squared(across);
      if (!(squared > kParallelSine * kParallelSine * length_squared(da) * length_squared(db)))
        continue;
      const Num sign = dot(across, a1 + a2) < Num(0) ? Num(-1) : Num(1);
      const Num raw = sign * dot(across, b.vertex(eb.v0) - a.vertex(ea.v0));
      const Num s = raw / std::sqrt(squared);
      if (s > best.separation) best = {s, list_a[i], list_b[k]};
    }
  }
  return best;
}

ContactAxis face_of_a_axis(const PlacedPolyhedron& a, const PlacedPolyhedron& b, const Best& best) {
  ContactAxis axis;
  axis.kind = ContactAxis::Kind::FaceOfA;
  axis.normal = normalized_or(a.normal(best.a), {1, 0, 0});
  axis.separation = best.separation;
  axis.face_a = best.a;
  axis.face_b = b.face_facing(-axis.normal);
  return axis;
}

ContactAxis face_of_b_axis(const PlacedPolyhedron& a, const PlacedPolyhedron& b, const Best& best) {
  ContactAxis axis;
  axis.kind = ContactAxis::Kind::FaceOfB;
  axis.normal = normalized_or(-b.normal(best.a), {1, 0, 0});
  axis.separation = best.separation;
  axis.face_a = a.face_facing(axis.normal);
  axis.face_b = best.a;
  return axis;
}

ContactAxis edges_axis(const PlacedPolyhedron& a, const PlacedPolyhedron& b, const Best& best) {
  const PlacedPolyhedron::Edge ea = a.edge(best.a), eb = b.edge(best.b);
  ContactAxis axis;
  axis.kind = ContactAxis::Kind::Edges;
  axis.edge_a = a.segment(best.a);
  axis.edge_b = b.segment(best.b);
  axis.name_a = edge_name(best.a);
  axis.name_b = edge_name(best.b);
  NumVec n = normalized_or(
      cross(axis.edge_a.end - axis.edge_a.start, axis.edge_b.end - axis.edge_b.start), {1, 0, 0});
  if (dot(n, a.normal(ea.face_a) + a.normal(ea.face_b)) < Num(0)) n = -n;
  axis.normal = n;
  axis.separation = best.separation;
  axis.face_a = dot(a.normal(ea.face_a), n) >= dot(a.normal(ea.face_b), n) ? ea.face_a : ea.face_b;
  axis.face_b = dot(b.normal(eb.face_a), n) <= dot(b.normal(eb.face_b), n) ? eb.face_a : eb.face_b;
  return axis;
}

// The ball about a shape's inner point.
struct Ball {
  NumVec centre;
  Num radius;  // [m]
};
Ball ball_around(const Placed& x) {
  if (x.shape.type == ShapeType::Box) return {x.p, length(to_num(x.shape.half))};
  return {x.p + rotate(x.q, to_num(x.shape.hull->interior_point())),
          static_cast<Num>(x.shape.hull->outer_radius())};
}
bool balls_apart(const Placed& a, const Placed& b, Num margin) {
  const Ball ball_a = ball_around(a), ball_b = ball_around(b);
  const Num reach = ball_a.radius + ball_b.radius + margin;
  return !(length_squared(ball_b.centre - ball_a.centre) <= reach * reach);
}

}  // namespace

void collide_polyhedra(const Placed& placed_a, const Placed& placed_b, Num margin, Contacts& out) {
  if (balls_apart(placed_a, placed_b, margin)) return;
  const NumRotation to_a = conjugate(placed_a.q);
  const NumMatrix identity{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PlacedPolyhedron a(placed_a.shape, identity, {0, 0, 0});
  const PlacedPolyhedron b(placed_b.shape, to_matrix(to_a * placed_b.q), rotate(to_a, placed_b.p));
  const NumVec towards = b.centre() - a.centre();

  const Best face_a = best_face(a, b, -std::numeric_limits<Num>::infinity());
  if (!(face_a.separation <= margin)) {
    out.apart = {face_a.a, false};
    return;
  }
  const Num thickness = std::min(a.inner_radius(), b.inner_radius());
  const Num preference = kFacePreference * thickness;
  const Best face_b = best_face(b, a, face_a.separation);
  if (!(face_b.separation <= margin)) {
    out.apart = {face_b.a, true};
    return;
  }
  const Num best_of_faces = std::max(face_a.separation, face_b.separation);
  const Best edges = best_edges(a, b, best_of_faces);
  if (!(edges.separation <= margin)) return;

  PolyhedronContact<PlacedPolyhedron, PlacedPolyhedron> contact{
      a, b, margin, thickness, std::max(a.outer_radius(), b.outer_radius()), towards, out};
  const bool edges_win = edges.separation > best_of_faces;
  const Num enough = std::max(edges.separation, best_of_faces) - preference;
  const ContactAxis axis_a = face_of_a_axis(a, b, face_a), axis_b = face_of_b_axis(a, b, face_b);
  const ContactAxis axis_e = edges_win ? edges_axis(a, b, edges) : axis_a;
  const ContactAxis& best =
      edges_win ? axis_e : (face_a.separation >= face_b.separation ? axis_a : axis_b);
  contact.along(
      face_a.separation >= enough ? axis_a : (face_b.separation >= enough ? axis_b : best), best);

  if (out.count == 0) return;
  out.normal = rotate(placed_a.q, out.normal);
  for (int i = 0; i < out.count; ++i) {
    out.points[i].position = rotate(placed_a.q, out.points[i].position);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
