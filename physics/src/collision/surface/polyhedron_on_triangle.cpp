// Boxes and hulls against triangles: the axis of greatest separation among those that the cones of
// the triangle hold, and the faces laid over one another along it.
#include "collision/gjk.h"
#include "collision/segment.h"
#include "collision/surface/surface_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Kind = SurfaceFeature::Kind;
constexpr Num kNone = -std::numeric_limits<Num>::infinity();

struct Axis {
  NumVec normal{0, 1, 0};  // from the triangle
  Num separation = kNone;  // [m]
  SurfaceFeature feature;
  int face = -1;  // of the polyhedron whose normal it is, or -1
  int edge = -1;  // of the polyhedron
};

class Touch {
 public:
  Touch(const ConvexOnSurface& on, const PlacedPolyhedron& p, SurfaceTriangle& t,
        TriangleContact& out)
      : on_(on), p_(p), t_(t), out_(out) {}

  bool run() {
    Axis own;
    own.normal = t_.normal;
    own.separation = p_.lowest_along(t_.normal) - t_.offset;
    if (!(own.separation <= on_.margin)) return false;
    if (t_.height(on_.middle) < -on_.behind) return false;
    if (is_parted()) return false;
    on_.surface.complete(t_);
    polygon_of(t_, polygon_);
    Axis faces, edges;
    best_face(faces);
    if (t_.has_sharp_edge()) best_edge(edges);
    if (!(edges.separation <= on_.margin)) return false;
    const Num best = std::max(own.separation, std::max(faces.separation, edges.separation));
    const bool apart = best > Num(0);
    const Num enough = best - kFacePreference * on_.thickness;
    const Num limit = best + (apart ? kAttained : kFacePreference) * on_.thickness;
    // Deep below the plane and nearly out at the side: this is a shape beside the surface, not on
    // it.
    const bool beside =
        own.separation < -kDeepShare * on_.thickness && nearest_exit_ > kExitShare * own.separation;
    const bool own_wins = own.separation >= enough && !beside;
    if (own_wins && over_triangle(limit)) return true;
    if (faces.separation >= enough && over_face(faces, limit)) return true;
    if (edges.separation >= enough && crossing(edges, limit)) return true;
    if (apart && t_.has_sharp_edge() && nearest()) return true;
    // The closest place is a neighbour's, but what lies above this triangle is this triangle's.
    return own_wins && over_triangle(std::numeric_limits<Num>::infinity());
  }

 private:
  // Whether a face of the polyhedron parts the two; notes how near to that it is.
  bool is_parted() {
    for (int k = 0; k < p_.face_count(); ++k) {
      const NumVec n = -p_.normal(k);
      const Num along =
          std::max(dot(n, t_.corner[0]), std::max(dot(n, t_.corner[1]), dot(n, t_.corner[2])));
      nearest_exit_ = std::max(nearest_exit_, -p_.offset(k) - along);
      if (nearest_exit_ > on_.margin) return true;
    }
    return false;
  }

  // Normals of the polyhedron's faces.
  void best_face(Axis& best) {
    if (!t_.has_sharp_edge()) return;
    for (int k = 0; k < p_.face_count(); ++k) {
      const NumVec n = -p_.normal(k);
      Num along;
      const SurfaceFeature feature = farthest_part(on_, t_, n, along);
      const Num s = -p_.offset(k) - along;
      if (s > best.separation && cone_allows(on_, t_, feature, n)) best = {n, s, feature, k, -1};
    }
  }

  // Pairs of edges whose arcs cross on the Gauss map [Gregorius 2013]; those of the triangle reach
  // from its normal to that of its neighbour, or to the side where there is none.
  void best_edge(Axis& best) const {
    for (int e = 0; e < 3; ++e) {
      if (!t_.is_sharp(e)) continue;
      const NumVec da = t_.along(e), a1 = t_.normal;
      const NumVec a2 = t_.kind[e] == EdgeKind::Convex
                            ? t_.beyond[e]
                            : normalized_or(cross(da, t_.normal), NumVec{1, 0, 0});
      for (int i = 0; i < p_.edge_count(); ++i) {
        const PlacedPolyhedron::Edge edge = p_.edge(i);
        const NumVec b1 = -p_.normal(edge.face_a), b2 = -p_.normal(edge.face_b);
        const Num b1_da = dot(b1, da), b2_da = dot(b2, da);
        if (!(b1_da * b2_da < Num(0))) continue;
        const NumVec db = p_.vertex(edge.v1) - p_.vertex(edge.v0);
        const Num a1_db = dot(a1, db), a2_db = dot(a2, db);
        if (!(a1_db * a2_db < Num(0) && b1_da * a2_db > Num(0))) continue;
        const NumVec across = cross(da, db);
        const Num squared = length_squared(across);
        if (!(squared > kParallelSine * kParallelSine * length_squared(da) * length_squared(db)))
          continue;
        const Num sign = (dot(across, a1 + a2) < Num(0) ? Num(-1) : Num(1)) / std::sqrt(squared);
        const Num s = sign * dot(across, p_.vertex(edge.v0) - t_.corner[e]);
        if (s > best.separation) best = {sign * across, s, {Kind::Edge, e}, -1, i};
      }
    }
  }

  // The polyhedron's face laid over the triangle, along the triangle's normal.
  bool over_triangle(Num limit) {
    FacePolygon other;
    p_.face(p_.face_facing(-t_.normal), other);
    out_.candidates.count = 0;
    const Num smallest =
        overlay_faces(polygon_, other, t_.normal, p_.lowest_along(t_.normal) - t_.offset,
                      kClipBand * on_.thickness, on_.margin, out_.candidates);
    if (!(smallest <= limit) || out_.candidates.count == 0) return false;
    out_.normal = t_.normal;
    out_.of_face = true;
    return true;
  }

  // The triangle laid over faces of the polyhedron, along `n`, which touches `feature`.
  template <std::size_t Count>
  bool over_faces(const int (&faces)[Count], NumVec n, Num separation, SurfaceFeature feature,
                  Num limit) {
    FacePolygon other;
    out_.candidates.count = 0;
    Num smallest = std::numeric_limits<Num>::infinity();
    for (const int face : faces) {
      p_.face(face, other);
      if (dot(other.normal, -n) < kSteepFace) continue;
      smallest =
          std::min(smallest, overlay_faces(other, polygon_, -n, separation,
                                           kClipBand * on_.thickness, on_.margin, out_.candidates));
    }
    if (!(smallest <= limit) || out_.candidates.count == 0) return false;
    for (int i = 0; i < out_.candidates.count; ++i)
      out_.candidates.points[i].feature = swapped_name(out_.candidates.points[i].feature);
    out_.normal = n;
    out_.of_face = false;
    out_.feature = feature_part(t_, feature);
    return true;
  }
  bool over_face(const Axis& axis, Num limit) {
    const int only[1] = {axis.face};
    return over_faces(only, normalized_or(axis.normal, {0, 1, 0}), axis.separation, axis.feature,
                      limit);
  }

  // Both sides of the edge that touches: where it nearly runs along the triangle's, either may
  // hold.
  bool over_ridge(NumVec n, Num separation, SurfaceFeature feature, Num limit) {
    int sides[2];
    p_.faces_facing(-n, sides);
    return over_faces(sides, n, separation, feature, limit);
  }

  bool crossing(const Axis& axis, Num limit) {
    const NumVec n = normalized_or(axis.normal, {0, 1, 0});
    if (over_ridge(n, axis.separation, axis.feature, limit)) return true;
    const int e = axis.feature.index;
    const Segment side{t_.corner[e], t_.corner[(e + 1) % 3]}, edge = p_.segment(axis.edge);
    const SegmentParameters at = closest_parameters(side, edge);
    if (!(at.a > Num(0) && at.a < Num(1) && at.b > Num(0) && at.b < Num(1))) return false;
    out_.normal = n;
    out_.of_face = false;
    out_.feature = feature_part(t_, axis.feature);
    out_.candidates.count = 1;
    out_.candidates.points[0] = {Num(0.5) * (point_at(side, at.a) + point_at(edge, at.b)),
                                 axis.separation,
                                 pair_name(polygon_.edge_names[e], edge_name(axis.edge))};
    return true;
  }

  // Corners and edges that meet beside all faces: the direction is that of the closest points.
  bool nearest() {
    const GjkResult closest = gjk_distance(
        [this](NumVec d) {
          const Num a = dot(t_.corner[0], d), b = dot(t_.corner[1], d), c = dot(t_.corner[2], d);
          return t_.corner[a >= b ? (a >= c ? 0 : 2) : (b >= c ? 1 : 2)];
        },
        [this](NumVec d) { return p_.vertex(p_.support_index(d)); }, p_.centre() - t_.corner[0],
        p_.outer_radius());
    if (closest.overlap || !(closest.distance <= on_.margin)) return false;
    NumVec n = closest.normal;
    if (!(dot(n, t_.normal) > -kConeSlack)) return false;
    Num along;
    const SurfaceFeature feature = farthest_part(on_, t_, n, along);
    bool of_face = false;
    if (feature.kind == Kind::Face || !allow_normal(on_, t_, feature, n, of_face) || of_face)
      return false;  // over_triangle() has seen it
    if (over_ridge(n, closest.distance, feature, closest.distance + kAttained * on_.thickness))
      return true;
    out_.normal = n;
    out_.of_face = false;
    out_.feature = feature_part(t_, feature);
    out_.candidates.count = 1;
    out_.candidates.points[0] = {Num(0.5) * (closest.on_a + closest.on_b), closest.distance,
                                 pair_name(face_name(0), vertex_name(p_.support_index(-n)))};
    return true;
  }

  const ConvexOnSurface& on_;
  const PlacedPolyhedron& p_;
  SurfaceTriangle& t_;
  TriangleContact& out_;
  FacePolygon polygon_;
  Num nearest_exit_ =
      kNone;  // [m] largest separation along a face of the polyhedron, allowed or not
};

}  // namespace

bool touch_polyhedron(const ConvexOnSurface& on, const PlacedPolyhedron& polyhedron,
                      SurfaceTriangle& t, TriangleContact& out) {
  return Touch(on, polyhedron, t, out).run();
}

}  // namespace plumb::inline PLUMB_ABI::detail
