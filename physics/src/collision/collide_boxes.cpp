// Box against box: the fifteen axes [Gottschalk 1996], then faces laid over one another. Works in
// the frame of the first box, where its axes are the coordinate axes.
#include "collision/box_view.h"
#include "collision/collide_pairs.h"
#include "collision/polyhedron_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct BoxPair {
  Num ha[3], hb[3];  // [m] half extents
  Num t[3];          // [m] centre of B in A's frame
  Num r[3][3];       // r[i][j]: component i of B's axis j
  Num m[3][3];       // |r|
  Num tb[3];         // [m] t along B's axes
};

struct Best {
  Num separation = -std::numeric_limits<Num>::infinity();
  int i = 0, j = 0;
};

BoxPair make_pair(const Placed& a, const Placed& b, NumVec t, const NumMatrix& R) {
  BoxPair pair;
  const NumVec rows[3] = {R.row0, R.row1, R.row2};
  for (int i = 0; i < 3; ++i) {
    pair.ha[i] = component(to_num(a.shape.half), i);
    pair.hb[i] = component(to_num(b.shape.half), i);
    pair.t[i] = component(t, i);
    for (int j = 0; j < 3; ++j) {
      pair.r[i][j] = component(rows[i], j);
      pair.m[i][j] = std::abs(pair.r[i][j]);
    }
  }
  for (int j = 0; j < 3; ++j) {
    pair.tb[j] = pair.t[0] * pair.r[0][j] + pair.t[1] * pair.r[1][j] + pair.t[2] * pair.r[2][j];
  }
  return pair;
}

Best best_face_of_a(const BoxPair& p) {
  Best best;
  for (int i = 0; i < 3; ++i) {
    const Num reach = p.hb[0] * p.m[i][0] + p.hb[1] * p.m[i][1] + p.hb[2] * p.m[i][2];
    const Num s = std::abs(p.t[i]) - p.ha[i] - reach;
    if (s > best.separation) best = {s, i, 0};
  }
  return best;
}

Best best_face_of_b(const BoxPair& p) {
  Best best;
  for (int j = 0; j < 3; ++j) {
    const Num reach = p.ha[0] * p.m[0][j] + p.ha[1] * p.m[1][j] + p.ha[2] * p.m[2][j];
    const Num s = std::abs(p.tb[j]) - p.hb[j] - reach;
    if (s > best.separation) best = {s, 0, j};
  }
  return best;
}

// Axes e_i x b_j that separate more than `floor`. Lengths are compared squared: a root is only
// taken for an axis that wins.
Best best_edges(const BoxPair& p, Num floor) {
  Best best;
  best.separation = floor;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const Num squared = p.r[i1][j] * p.r[i1][j] + p.r[i2][j] * p.r[i2][j];
      if (!(squared > kParallelSine * kParallelSine)) continue;
      const Num reach = p.ha[i1] * p.m[i2][j] + p.ha[i2] * p.m[i1][j] + p.hb[j1] * p.m[i][j2] +
                        p.hb[j2] * p.m[i][j1];
      const Num raw = std::abs(p.t[i2] * p.r[i1][j] - p.t[i1] * p.r[i2][j]) - reach;
      const Num bar = best.separation;
      const bool more = raw >= Num(0) ? (bar < Num(0) || raw * raw > bar * bar * squared)
                                      : (bar < Num(0) && raw * raw < bar * bar * squared);
      if (more) best = {raw / std::sqrt(squared), i, j};
    }
  }
  return best;
}

NumVec axis_vector(int i, Num sign) {
  NumVec v{0, 0, 0};
  set_component(v, i, sign);
  return v;
}

ContactAxis edge_axis(const BoxView& box_a, const BoxView& box_b, const Best& best) {
  const int i = best.i, j = best.j;
  NumVec n = normalized_or(cross(axis_vector(i, Num(1)), box_b.axes[j]), {1, 0, 0});
  if (dot(n, box_b.centre) < Num(0)) n = -n;
  ContactAxis axis;
  axis.kind = ContactAxis::Kind::Edges;
  axis.normal = n;
  axis.separation = best.separation;
  // The edge of A farthest along n, that of B farthest against it.
  const auto edge_of = [](const BoxView& box, int along, NumVec d, Segment& edge,
                          FeatureName& name) {
    const int bit = 1 << along, start = box.support_index(d) & ~bit;
    edge = {box.vertex(start), box.vertex(start | bit)};
    name = edge_name(box_edge_index(start, start | bit));
  };
  edge_of(box_a, i, n, axis.edge_a, axis.name_a);
  edge_of(box_b, j, -n, axis.edge_b, axis.name_b);
  axis.face_a = box_a.face_facing(n);
  axis.face_b = box_b.face_facing(-n);
  return axis;
}

ContactAxis face_axis(ContactAxis::Kind kind, NumVec n, Num separation, const BoxView& box_a,
                      const BoxView& box_b) {
  ContactAxis axis;
  axis.kind = kind;
  axis.normal = n;
  axis.separation = separation;
  axis.face_a = box_a.face_facing(n);
  axis.face_b = box_b.face_facing(-n);
  return axis;
}

}  // namespace

void collide_boxes(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const NumRotation to_a = conjugate(a.q);
  const NumVec t = rotate(to_a, b.p);
  const NumMatrix R = to_matrix(to_a * b.q);
  const BoxPair pair = make_pair(a, b, t, R);
  const Best face_a = best_face_of_a(pair);
  if (out.parted(face_a.separation, margin)) return;
  const Best face_b = best_face_of_b(pair);
  if (out.parted(face_b.separation, margin)) return;
  const NumVec half_a = to_num(a.shape.half), half_b = to_num(b.shape.half);
  const Num thickness = std::min({half_a.x, half_a.y, half_a.z, half_b.x, half_b.y, half_b.z});
  const Num best_face = std::max(face_a.separation, face_b.separation);
  const Best edges = best_edges(pair, best_face);
  if (out.parted(edges.separation, margin)) return;

  const BoxView box_a{{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, half_a};
  const BoxView box_b{t,
                      {{R.row0.x, R.row1.x, R.row2.x},
                       {R.row0.y, R.row1.y, R.row2.y},
                       {R.row0.z, R.row1.z, R.row2.z}},
                      half_b};
  const auto axis_of = [&](ContactAxis::Kind kind) {
    if (kind == ContactAxis::Kind::Edges) return edge_axis(box_a, box_b, edges);
    if (kind == ContactAxis::Kind::FaceOfA) {
      return face_axis(kind, axis_vector(face_a.i, pair.t[face_a.i] < Num(0) ? Num(-1) : Num(1)),
                       face_a.separation, box_a, box_b);
    }
    return face_axis(kind, (pair.tb[face_b.j] < Num(0) ? Num(-1) : Num(1)) * box_b.axes[face_b.j],
                     face_b.separation, box_a, box_b);
  };
  const Num size = std::max(length(half_a), length(half_b));
  PolyhedronContact<BoxView, BoxView> contact{box_a, box_b, margin, thickness, size, t, out};
  contact.along(face_a.separation, face_b.separation, std::max(edges.separation, best_face),
                axis_of);
  if (out.count == 0) return;
  out.normal = rotate(a.q, out.normal);
  for (int i = 0; i < out.count; ++i) out.points[i].position = rotate(a.q, out.points[i].position);
}

}  // namespace plumb::inline PLUMB_ABI::detail
