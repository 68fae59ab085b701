// Hulls and boxes among themselves: the axis along which they are farthest apart, then the features
// that face one another along it.
#include "collision/collide_pairs.h"
#include "collision/polyhedra_axes.h"
#include "collision/polyhedron_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

ContactAxis face_of_a_axis(const PlacedPolyhedron& a, const PlacedPolyhedron& b,
                           const FaceAxis& best) {
  ContactAxis axis;
  axis.kind = ContactAxis::Kind::FaceOfA;
  axis.normal = normalized_or(a.normal(best.face), {1, 0, 0});
  axis.separation = best.separation;
  axis.face_a = best.face;
  axis.face_b = b.face_facing(-axis.normal);
  return axis;
}

ContactAxis face_of_b_axis(const PlacedPolyhedron& a, const PlacedPolyhedron& b,
                           const FaceAxis& best) {
  ContactAxis axis;
  axis.kind = ContactAxis::Kind::FaceOfB;
  axis.normal = normalized_or(-b.normal(best.face), {1, 0, 0});
  axis.separation = best.separation;
  axis.face_a = a.face_facing(axis.normal);
  axis.face_b = best.face;
  return axis;
}

ContactAxis edges_axis(const PlacedPolyhedron& a, const PlacedPolyhedron& b,
                       const EdgesAxis& best) {
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
// [m]; negative where they overlap.
Num gap_of_balls(const Placed& a, const Placed& b) {
  const Ball ball_a = ball_around(a), ball_b = ball_around(b);
  return length(ball_b.centre - ball_a.centre) - ball_a.radius - ball_b.radius;
}

}  // namespace

void collide_polyhedra(const Placed& placed_a, const Placed& placed_b, Num margin, Contacts& out) {
  if (out.parted(gap_of_balls(placed_a, placed_b), margin)) return;
  const NumRotation to_a = conjugate(placed_a.q);
  const PlacedPolyhedron a(placed_a.shape);
  const PlacedPolyhedron b(placed_b.shape, to_matrix(to_a * placed_b.q), rotate(to_a, placed_b.p));
  const NumVec towards = b.centre() - a.centre();

  PolyhedraAxes axes;
  if (!find_axes(a, b, margin, out, axes)) return;
  const Num thickness = std::min(a.inner_radius(), b.inner_radius());
  PolyhedronContact<PlacedPolyhedron, PlacedPolyhedron> contact{
      a, b, margin, thickness, std::max(a.outer_radius(), b.outer_radius()), towards, out};
  contact.along(axes.face_a.separation, axes.face_b.separation, axes.separation(),
                [&](ContactAxis::Kind kind) {
                  if (kind == ContactAxis::Kind::Edges) return edges_axis(a, b, axes.edges);
                  return kind == ContactAxis::Kind::FaceOfA ? face_of_a_axis(a, b, axes.face_a)
                                                            : face_of_b_axis(a, b, axes.face_b);
                });
  if (out.count == 0) return;
  out.normal = rotate(placed_a.q, out.normal);
  for (int i = 0; i < out.count; ++i) {
    out.points[i].position = rotate(placed_a.q, out.points[i].position);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
