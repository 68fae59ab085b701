#include "collision/polyhedra_axes.h"

#include "collision/polyhedron_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

const AxesKernel& kernel() {
  static const AxesKernel chosen = choose_axes_kernel(0);
  return chosen;
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
  const Num limit = floor + q.lanes().inner_radius;
  const Num uneven = Num(4) * kHullUnevenness * p.inner_radius();
  Num ahead[kMaxHullFaces];
  for (int k = 0; k < p.face_count(); ++k)
    ahead[k] = dot(p.normal(k), q.centre()) - p.offset(k) + uneven;
  int count = 0;
  for (int i = 0; i < p.edge_count(); ++i) {
    const PlacedPolyhedron::Edge& e = p.edge(i);
    const Num first = ahead[e.face_a], second = ahead[e.face_b];
    const Num most = std::max(first, second);
    list[count] = static_cast<std::uint16_t>(i);
    bool beyond = most > limit;
    if (most > Num(0) && !beyond)
      beyond = edge_looks_beyond(first, second, dot(p.normal(e.face_a), p.normal(e.face_b)), limit);
    count += beyond ? 1 : 0;
  }
  return count;
}

// Some edges of a polyhedron. No initial values: large, and only the first ones are read.
class ReachedEdges {
 public:
  ReachedEdges(const PlacedPolyhedron& p, const PlacedPolyhedron& q, Num floor) : p_(p) {
    count_ = edges_in_reach(p, q, floor, list_);
  }
  [[nodiscard]] bool none() const { return count_ == 0; }
  [[nodiscard]] int edge(int place) const { return list_[place]; }
  [[nodiscard]] EdgeLanes lanes() {
    for (int i = 0; i < count_; ++i) {
      const PlacedPolyhedron::Edge& e = p_.edge(list_[i]);
      const NumVec start = p_.vertex(e.v0), along = p_.vertex(e.v1) - start;
      put(i, {start, along, p_.normal(e.face_a), p_.normal(e.face_b)});
    }
    for (int i = count_; i < filled_up(count_); ++i) put(i, {});
    return {column(0), column(1), column(2), column(3),  column(4),  column(5), column(6),
            column(7), column(8), column(9), column(10), column(11), count_};
  }

 private:
  static constexpr int kRoom = filled_up(kMaxHullEdges);
  struct Arc {
    NumVec start{0, 0, 0}, along{0, 0, 0}, normal_a{0, 0, 0}, normal_b{0, 0, 0};
  };
  // Lies close together, however much room there is.
  [[nodiscard]] Num* column(int k) { return numbers_ + k * filled_up(count_); }
  void put(int i, const Arc& arc) {
    int k = 0;
    for (const NumVec& v : {arc.start, arc.along, arc.normal_a, arc.normal_b})
      for (const Num x : {v.x, v.y, v.z}) column(k++)[i] = x;
  }
  const PlacedPolyhedron& p_;
  int count_;
  std::uint16_t list_[kMaxHullEdges + 1];
  Num numbers_[12 * kRoom];
};

// By the edges' own numbers; -1: none that separate more than `floor`.
EdgesAxis best_edges(const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num floor) {
  ReachedEdges of_a(a, b, floor);
  if (of_a.none()) return {floor, -1, -1};
  ReachedEdges of_b(b, a, floor);
  if (of_b.none()) return {floor, -1, -1};
  EdgesAxis best = kernel().best_edges(of_a.lanes(), of_b.lanes(), floor);
  if (best.a >= 0) best = {best.separation, of_a.edge(best.a), of_b.edge(best.b)};
  return best;
}

// ---- the certificate ----------------------------------------------------------------------------
//
// The bodies A and B overlap by h(n) along n, h being the support function of their difference
// M = A - B. A face of M (a face of A moved by a corner of B, or the parallelogram of two edges) at
// distance d from the origin, in which the foot of the origin lies `inside` by r, puts a disc into
// M: along an axis at the angle t to the face's normal
//
//   h >= d cos t + r sin t >= d   while tan(t/2) <= r/d.
//
// Nearly opposite axes are left, sin t <= 2 d/r. There the ball inside both shapes, of radius R
// about c, has h >= R - sin t |c|. Where d < 0 the shapes are apart, the foot is a closest point,
// and -d their distance.

struct Pair {
  const PlacedPolyhedron &a, &b;
};

bool beats_all(const Pair& pair, Num separation, Num inside) {
  const Num thickness = std::min(pair.a.inner_radius(), pair.b.inner_radius());
  const Num depth = -separation;
  if (!(inside > kFacePreference * thickness)) return false;  // too near to where axes are alike
  if (depth <= Num(0)) return true;
  const Num ball = pair.a.lanes().inner_radius + pair.b.lanes().inner_radius;
  const Num away = length(pair.b.centre() - pair.a.centre());
  return depth < kSureShare * inside &&
         depth * (Num(1) + Num(2) * away / inside) < kSureShare * ball;
}

// The foot of the corner of q that lies deepest behind a face of p.
bool face_beats_all(const Pair& pair, const PlacedPolyhedron& p, const PlacedPolyhedron& q,
                    const FaceAxis& axis) {
  const NumVec corner = q.vertex(q.support_index(-p.normal(axis.face)));
  return beats_all(pair, axis.separation, p.room_within(axis.face, corner));
}

// Whether two edges span a face of M that beats all axes, and more than `floor`.
bool edges_beat_all(const Pair& pair, AxisHint hint, Num floor, EdgesAxis& out) {
  if (!hint.is_edges() || hint.first_edge() >= pair.a.edge_count() ||
      hint.second_edge() >= pair.b.edge_count())
    return false;
  const PlacedPolyhedron::Edge &ea = pair.a.edge(hint.first_edge()),
                               &eb = pair.b.edge(hint.second_edge());
  const Segment sa = pair.a.segment(hint.first_edge()), sb = pair.b.segment(hint.second_edge());
  const NumVec da = sa.end - sa.start, db = sb.end - sb.start;
  const Num side_a = -dot(pair.b.normal(eb.face_a), da),
            side_b = -dot(pair.b.normal(eb.face_b), da);
  const Num of_a = dot(pair.a.normal(ea.face_a), db), of_b = dot(pair.a.normal(ea.face_b), db);
  if (!(side_a * side_b < Num(0) && of_a * of_b < Num(0) && side_a * of_b > Num(0))) return false;
  const NumVec across = cross(da, db);
  const Num squared = length_squared(across);
  const Num squared_a = length_squared(da), squared_b = length_squared(db);
  if (!(squared > kParallelSine * kParallelSine * squared_a * squared_b)) return false;
  const bool turned = dot(across, pair.a.normal(ea.face_a) + pair.a.normal(ea.face_b)) < Num(0);
  const Num along = dot(across, sb.start - sa.start), root = std::sqrt(squared);
  const Num s = (turned ? -along : along) / root;
  if (!(s > floor)) return false;
  const SegmentParameters at = line_parameters(sa, sb);
  const Num inside = root * std::min(std::min(at.a, Num(1) - at.a) / std::sqrt(squared_b),
                                     std::min(at.b, Num(1) - at.b) / std::sqrt(squared_a));
  if (!beats_all(pair, s, inside)) return false;
  out = {s, hint.first_edge(), hint.second_edge()};
  return true;
}

}  // namespace

bool find_axes(const PlacedPolyhedron& a, const PlacedPolyhedron& b, Num margin, Contacts& out,
               PolyhedraAxes& axes) {
  constexpr Num kNone = -std::numeric_limits<Num>::infinity();
  const Pair pair{a, b};
  const AxisHint hint = out.axis;
  out.axis = {};
  const PolyhedronLanes lanes_a = a.lanes(), lanes_b = b.lanes();
  axes.face_b = {kNone, 0};
  axes.face_a = kernel().best_face(lanes_a, lanes_b, kNone);
  axes.edges = {axes.face_a.separation, -1, -1};
  if (out.parted(axes.face_a.separation, margin)) {
    out.axis = AxisHint::of_face(axes.face_a.face, false);
    return false;
  }
  if (face_beats_all(pair, a, b, axes.face_a)) return true;
  axes.face_b = kernel().best_face(lanes_b, lanes_a, axes.face_a.separation);
  if (out.parted(axes.face_b.separation, margin)) {
    out.axis = AxisHint::of_face(axes.face_b.face, true);
    return false;
  }
  const Num best = axes.edges.separation = axes.separation();
  if (best == axes.face_b.separation && face_beats_all(pair, b, a, axes.face_b)) return true;
  if (!edges_beat_all(pair, hint, best, axes.edges)) axes.edges = best_edges(a, b, best);
  if (axes.edges.a >= 0) out.axis = AxisHint::of_edges(axes.edges.a, axes.edges.b);
  return !out.parted(axes.edges.separation, margin);
}

}  // namespace plumb::inline PLUMB_ABI::detail
