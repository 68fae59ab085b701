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

// An edge separates along normals between those of its two faces. Among these the one that looks
// most towards a point is found from how far the point is in front of the two faces (`first`,
// `second`) [m] and the cosine between their normals; returns whether the point is farther than
// `limit` [m] in front of the edge along that one.
bool edge_looks_beyond(Num first, Num second, Num cosine, Num limit) {
  const Num u1 = first - cosine * second, u2 = second - cosine * first;
  if (!(u1 > Num(0) && u2 > Num(0))) return false;  // it is one of the faces' own
  // The point seen from the edge, projected to the plane of both normals, is alpha n1 + beta n2
  // with (alpha, beta) = (u1, u2) / (1 - cosine^2).
  const Num sine_squared = Num(1) - cosine * cosine;
  if (!(sine_squared > kParallelSine)) return true;
  return first * u1 + second * u2 > limit * limit * sine_squared;
}

// The edges of p whose normals could separate more than `floor` from q: from a ball inside it.
// Faces may be uneven, so an edge's corner may lie that much behind the planes of its faces.
int edges_in_reach(const PlacedPolyhedron& p, const PlacedPolyhedron& q, Num floor,
                   std::uint16_t* list) {
  const Num limit = floor + sure_inner_radius(q);
  const Num uneven = Num(4) * kHullUnevenness * p.inner_radius();
  Num ahead[kMaxHullFaces];
  for (int k = 0; k < p.face_count(); ++k)
    ahead[k] = dot(p.normal(k), q.centre()) - p.offset(k) + uneven;
  int count = 0;
  for (int i = 0; i < p.edge_count(); ++i) {
    const PlacedPolyhedron::Edge& e = p.edge(i);
    const Num first = ahead[e.face_a], second = ahead[e.face_b];
    const Num most = std::max(first, second);
    if (most > limit ||
        (most > Num(0) &&
         edge_looks_beyond(first, second, dot(p.normal(e.face_a), p.normal(e.face_b)), limit))) {
      list[count++] = static_cast<std::uint16_t>(i);
    }
  }
  return count;
}

// An edge with the normals of its faces, which span its arc on the Gauss map.
struct EdgeArc {
  NumVec start, along, normal_a, normal_b;
};
EdgeArc arc_of(const PlacedPolyhedron& p, int edge) {
  const PlacedPolyhedron::Edge& e = p.edge(edge);
  return {p.vertex(e.v0), p.vertex(e.v1) - p.vertex(e.v0), p.normal(e.face_a), p.normal(e.face_b)};
}

Best best_edges(const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num floor) {
  Best best;
  best.separation = floor;
  std::uint16_t list_a[kMaxHullEdges], list_b[kMaxHullEdges];
  const int count_a = edges_in_reach(a, b, floor, list_a);
  if (count_a == 0) return best;
  const int count_b = edges_in_reach(b, a, floor, list_b);
  EdgeArc arcs_b[kMaxHullEdges];
  for (int k = 0; k < count_b; ++k) arcs_b[k] = arc_of(b, list_b[k]);
  for (int i = 0; i < count_a; ++i) {
    const EdgeArc ea = arc_of(a, list_a[i]);
    const NumVec da = ea.along;
    for (int k = 0; k < count_b; ++k) {
      // The arc of -b: it crosses that of a if the ends of each lie on both sides of the other.
      const EdgeArc& eb = arcs_b[k];
      const Num b1_da = -dot(eb.normal_a, da), b2_da = -dot(eb.normal_b, da);
      if (!(b1_da * b2_da < Num(0))) continue;
      const NumVec db = eb.along;
      const Num a1_db = dot(ea.normal_a, db), a2_db = dot(ea.normal_b, db);
      if (!(a1_db * a2_db < Num(0) && b1_da * a2_db > Num(0))) continue;
      const NumVec across = cross(da, db);
      const Num squared = length_squared(across);
      if (!(squared > kParallelSine * kParallelSine * length_squared(da) * length_squared(db)))
        continue;
      const Num sign = dot(across, ea.normal_a + ea.normal_b) < Num(0) ? Num(-1) : Num(1);
      const Num raw = sign * dot(across, eb.start - ea.start);
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
  const PlacedPolyhedron::Edge &ea = a.edge(best.a), &eb = b.edge(best.b);
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
  axis.face_a = static_cast<int>(
      dot(a.normal(ea.face_a), n) >= dot(a.normal(ea.face_b), n) ? ea.face_a : ea.face_b);
  axis.face_b = static_cast<int>(
      dot(b.normal(eb.face_a), n) <= dot(b.normal(eb.face_b), n) ? eb.face_a : eb.face_b);
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
  const Best face_b = best_face(b, a, face_a.separation);
  if (!(face_b.separation <= margin)) {
    out.apart = {face_b.a, true};
    return;
  }
  const Num best_of_faces = std::max(face_a.separation, face_b.separation);
  const Best edges = best_edges(a, b, best_of_faces);
  if (!(edges.separation <= margin)) return;

  const Num separation = std::max(edges.separation, best_of_faces);
  PolyhedronContact<PlacedPolyhedron, PlacedPolyhedron> contact{
      a, b, margin, thickness, std::max(a.outer_radius(), b.outer_radius()), towards, out};
  contact.along(face_a.separation, face_b.separation, separation, [&](ContactAxis::Kind kind) {
    if (kind == ContactAxis::Kind::Edges) return edges_axis(a, b, edges);
    return kind == ContactAxis::Kind::FaceOfA ? face_of_a_axis(a, b, face_a)
                                              : face_of_b_axis(a, b, face_b);
  });
  if (out.count == 0) return;
  out.normal = rotate(placed_a.q, out.normal);
  for (int i = 0; i < out.count; ++i) {
    out.points[i].position = rotate(placed_a.q, out.points[i].position);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
