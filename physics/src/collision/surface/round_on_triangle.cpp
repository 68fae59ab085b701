// Cylinders and cones against triangles: the axis of most room among those that the cones of the
// triangle hold, and the disc or generator of the core laid over the triangle along it.
#include "collision/core_distance.h"
#include "collision/feature_overlay.h"
#include "collision/segment.h"
#include "collision/surface/edge_arc.h"
#include "collision/surface/surface_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Kind = SurfaceFeature::Kind;
constexpr Num kNone = -std::numeric_limits<Num>::infinity();
constexpr Num kAnyDepth = std::numeric_limits<Num>::infinity();

struct Axis {
  NumVec normal{0, 1, 0};  // unit, from the triangle
  Num room = kNone;        // [m]
  SurfaceFeature feature;
};

class Touch {
 public:
  Touch(const ConvexOnSurface& on, const ConvexCore& core, SurfaceTriangle& t, TriangleContact& out)
      : on_(on), core_(core), t_(t), out_(out) {}

  bool run() {
    lowest_ = core_.support(-t_.normal);
    const Num own = t_.height(lowest_);
    if (!(own <= on_.margin)) return false;
    if (t_.height(on_.middle) < -on_.behind) return false;
    if (is_parted()) return false;
    on_.surface.complete(t_);
    polygon_of(t_, polygon_);
    Axis end, edge, corner;
    if (t_.has_sharp_edge()) {
      best_of_ends(end);
      best_of_edges(own, edge);
      best_of_corners(corner);
    }
    const Num best = std::max({own, end.room, edge.room, corner.room});
    if (!(best <= on_.margin)) return false;
    const Num enough = best - kFacePreference * on_.thickness;
    const Num limit = best + (best > Num(0) ? kDeepestTie : kFacePreference) * on_.thickness;
    // Deep below the plane and nearly out at the side: this is a shape beside the surface, not on
    // it.
    const bool beside = own < -kDeepShare * on_.thickness && nearest_exit_ > kExitShare * own;
    const bool own_wins = own >= enough && !beside;
    if (own_wins && over_triangle(own, limit)) return true;
    if (end.room >= enough && over_core(end, true, limit)) return true;
    if (edge.room >= enough && over_core(edge, false, limit)) return true;
    if (corner.room >= enough && over_core(corner, false, limit)) return true;
    // The closest place is a neighbour's, but what lies above this triangle is this triangle's.
    return own_wins && over_triangle(own, kAnyDepth);
  }

 private:
  // From the axis of the core, perpendicular to it [m].
  [[nodiscard]] NumVec aside(NumVec x) const {
    const NumVec d = x - core_.origin();
    return d - dot(d, core_.axis()) * core_.axis();
  }

  // Into the core where its side faces a direction perpendicular to the axis, of any length.
  [[nodiscard]] NumVec into_side(NumVec towards) const {
    const NumVec radial = normalized_or(towards, {on_.R.row0.x, on_.R.row1.x, on_.R.row2.x});
    if (on_.shape.type == ShapeType::Cylinder) return -radial;
    const NumVec half = core_.half();
    return normalized_or(-(Num(2) * half.y) * radial - half.x * core_.axis(), -radial);
  }

  // How far the triangle reaches along a direction, from a place [m].
  struct Extent {
    Num low, high;
  };
  [[nodiscard]] Extent extent(NumVec n, NumVec from) const {
    const Num a = dot(n, t_.corner[0] - from), b = dot(n, t_.corner[1] - from),
              c = dot(n, t_.corner[2] - from);
    return {std::min({a, b, c}), std::max({a, b, c})};
  }

  // Whether an end of the core, or its side where that is nearest to the triangle, parts the two;
  // notes how near to that it is.
  bool is_parted() {
    const NumVec axis = core_.axis(), half = core_.half();
    const auto [low, high] = extent(axis, core_.origin());
    nearest_exit_ = std::max(low, -high) - half.y;
    if (nearest_exit_ > on_.margin) return true;
    // Seen along the axis: the point of the triangle's outline that is nearest to it.
    const NumVec p[3] = {aside(t_.corner[0]), aside(t_.corner[1]), aside(t_.corner[2])};
    NumVec nearest = p[0];
    int left = 0, right = 0;
    for (int k = 0; k < 3; ++k) {
      const Segment side{p[k], p[(k + 1) % 3]};
      const NumVec on_side = point_at(side, closest_parameter(side, {0, 0, 0}));
      if (length_squared(on_side) < length_squared(nearest)) nearest = on_side;
      const Num turn = dot(cross(side.start, side.end), axis);
      left += turn > Num(0) ? 1 : 0;
      right += turn < Num(0) ? 1 : 0;
    }
    // Within it the way out is the other way, over that point.
    const NumVec n = into_side(left == 3 || right == 3 ? -nearest : nearest);
    // A cone's side holds its apex.
    const bool cone = on_.shape.type == ShapeType::Cone;
    const NumVec on_side = core_.origin() + (cone ? half.y * axis : -half.x * n);
    nearest_exit_ = std::max(nearest_exit_, -extent(n, on_side).high);
    return nearest_exit_ > on_.margin;
  }

  void consider(NumVec n, Axis& best) {
    Num along;
    const SurfaceFeature feature = farthest_part(on_, t_, n, along);
    const Num room = dot(n, core_.support(-n)) - along;
    if (room > Num(0)) nearest_exit_ = std::max(nearest_exit_, room);
    if (room > best.room && cone_allows(on_, t_, feature, n)) best = {n, room, feature};
  }

  // Directions into the flat ends.
  void best_of_ends(Axis& best) {
    consider(core_.axis(), best);
    if (on_.shape.type == ShapeType::Cylinder) consider(-core_.axis(), best);
  }

  // From each corner to the nearest point of the core; of corners inside, out through the side (the
  // ends are seen by best_of_ends).
  void best_of_corners(Axis& best) {
    for (const NumVec& corner : t_.corner) {
      const NumVec local = transpose_times(on_.R, corner - on_.p);
      const CoreDistance gap = distance_to_core(on_.shape, local);
      const bool outside = gap.distance > Num(0);
      consider(outside ? -(on_.R * gap.outward) : into_side(aside(corner)), best);
    }
  }

  // Those of the edges: from the triangle's normal to that of the neighbour, or to the side where
  // there is none. Left out are those with no more room than along the triangle's own normal: the
  // lowest point of the core lies on the inner side of the edge, and not out beyond the far end of
  // the arc either, so nowhere on the arc is it farther out than at one of its ends.
  void best_of_edges(Num own, Axis& best) const {
    for (int e = 0; e < 3; ++e) {
      if (!t_.is_sharp(e)) continue;
      const NumVec d = normalized_or(t_.along(e), NumVec{0, 0, 0});
      // A sliver's normal is a neighbour's: not quite perpendicular to its sides.
      const NumVec from = normalized_or(t_.normal - dot(t_.normal, d) * d, t_.normal);
      NumVec to = cross(d, from);
      if (t_.kind[e] == EdgeKind::Convex) {
        const NumVec beyond = t_.beyond[e] - dot(t_.beyond[e], d) * d;
        if (!(dot(beyond, to) > Num(0))) continue;
        to = normalized_or(beyond, to);
      }
      const NumVec lowest = lowest_ - t_.corner[e];
      if (dot(cross(d, from), lowest) <= Num(0) && dot(to, lowest) <= own) continue;
      const ArcRoom found = most_room_on_arc(core_, {t_.corner[e], d, from, to}, on_.margin);
      if (found.room > best.room) best = {found.normal, found.room, {Kind::Edge, e}};
    }
  }

  [[nodiscard]] Overlay overlay_along(NumVec n, Num room) const {
    return {n, room, kClipBand * on_.thickness, kDeepestTie * on_.thickness, on_.margin};
  }
  [[nodiscard]] SupportFeature face_along(NumVec n) const {
    SupportFeature face;
    face.kind = SupportFeature::Kind::Polygon;
    face.name = polygon_.name;
    face.out = n;
    face.normal = polygon_.normal;
    face.offset = polygon_.offset;
    face.polygon = &polygon_;
    return face;
  }
  [[nodiscard]] SupportFeature edge_along(NumVec n, int e) const {
    SupportFeature edge;
    edge.kind = SupportFeature::Kind::Segment;
    edge.name = polygon_.edge_names[e];
    edge.out = n;
    // Lines that stray from one another by up to 2 kParallelCapsules of the half thickness hold on
    // all that they share: the side has bent away by 2e-4 of it there at most.
    edge.bend = on_.thickness;
    edge.segment = {t_.corner[e], t_.corner[(e + 1) % 3]};
    edge.ends[0] = polygon_.vertex_names[e];
    edge.ends[1] = polygon_.vertex_names[(e + 1) % 3];
    return edge;
  }

  void look_along(NumVec n) {
    core_.feature_facing(-n, polygon_, facing_);  // never a polygon, which stays
    out_.candidates.count = 0;
  }
  void add(NumVec on_triangle, NumVec on_core, Num room, FeatureName name) {
    out_.candidates.points[out_.candidates.count++] = {Num(0.5) * (on_triangle + on_core), room,
                                                       pair_name(name, facing_.name)};
  }
  bool finish(NumVec n, const SurfaceFeature* feature) {
    out_.normal = n;
    out_.of_face = feature == nullptr;
    if (feature != nullptr) out_.feature = feature_part(t_, *feature);
    return out_.candidates.count > 0;
  }

  // The core's feature laid over the triangle, along the triangle's normal.
  bool over_triangle(Num own, Num limit) {
    const NumVec n = t_.normal;
    look_along(n);
    Num smallest = overlay_features(face_along(n), facing_, overlay_along(n, own), out_.candidates);
    // A rim or an apex whose features rise too steeply to be laid over anything.
    if (!(smallest <= own + kDeepestTie * on_.thickness) && is_above(lowest_)) {
      add(lowest_ - own * n, lowest_, own, polygon_.name);
      smallest = own;
    }
    return smallest <= limit && finish(n, nullptr);
  }

  [[nodiscard]] bool is_above(NumVec x) const {
    for (int k = 0; k < 3; ++k) {
      const NumVec outward = normalized_or(cross(t_.along(k), t_.normal), {0, 0, 0});
      if (dot(outward, x - t_.corner[k]) > kClipBand * on_.thickness) return false;
    }
    return true;
  }

  // Along a normal of the core (`end`: its flat end may lie on more than the feature) or of an
  // edge.
  bool over_core(const Axis& axis, bool end, Num limit) {
    const NumVec n = axis.normal;
    look_along(n);
    Num smallest = kAnyDepth;
    if (end && facing_.kind == SupportFeature::Kind::Disc && dot(n, t_.normal) >= kSteepFace)
      smallest =
          overlay_features(face_along(n), facing_, overlay_along(n, axis.room), out_.candidates);
    if (!(smallest <= limit) && axis.feature.kind == Kind::Edge) {
      out_.candidates.count = 0;
      smallest = overlay_features(edge_along(n, axis.feature.index), facing_,
                                  overlay_along(n, axis.room), out_.candidates);
    }
    if (!(smallest <= limit) && !one_point(axis)) return false;
    return finish(n, &axis.feature);
  }

  // Where an edge or corner lies below the core, seen along the normal: below its lowest point, an
  // edge across a generator, a corner below a generator or an end.
  bool one_point(const Axis& axis) {
    const NumVec n = axis.normal, lowest = core_.support(-n);
    const bool is_edge = axis.feature.kind == Kind::Edge;
    const int first = axis.feature.index, last = is_edge ? (first + 1) % 3 : first;
    const Segment ground{t_.corner[first], t_.corner[last]};
    out_.candidates.count = 0;
    const FeatureName name = is_edge ? polygon_.edge_names[first] : polygon_.vertex_names[first];
    const auto try_points = [&](NumVec on_triangle, NumVec on_core) {
      const NumVec way = on_core - on_triangle;
      const Num band = kClipBand * on_.thickness;
      if (!(length_squared(way - axis.room * n) <= band * band)) return false;
      add(on_triangle, on_core, axis.room, name);
      return true;
    };
    const NumVec below = lowest - axis.room * n;
    if (try_points(point_at(ground, closest_parameter(ground, below)), lowest)) return true;
    if (facing_.kind == SupportFeature::Kind::Disc) {
      const Num rise = facing_.offset - dot(facing_.normal, ground.start);
      const NumVec over = ground.start + (rise / dot(facing_.normal, n)) * n;
      const bool within = length_squared(over - facing_.centre) <= facing_.radius * facing_.radius;
      return !is_edge && within && try_points(ground.start, over);
    }
    const Segment raised{ground.start + axis.room * n, ground.end + axis.room * n};
    SegmentParameters at{Num(0), closest_parameter(facing_.segment, raised.start)};
    if (is_edge) at = closest_parameters(raised, facing_.segment);
    return try_points(point_at(ground, at.a), point_at(facing_.segment, at.b));
  }

  const ConvexOnSurface& on_;
  const ConvexCore& core_;
  SurfaceTriangle& t_;
  TriangleContact& out_;
  FacePolygon polygon_;
  NumVec lowest_;          // [m] the core's point farthest back along the triangle's normal
  SupportFeature facing_;  // of the core
  // [m] Most room along a normal of the core, or where that is positive of any, allowed or not.
  Num nearest_exit_ = kNone;
};

}  // namespace

bool touch_round(const ConvexOnSurface& on, const ConvexCore& core, SurfaceTriangle& t,
                 TriangleContact& out) {
  return Touch(on, core, t, out).run();
}

}  // namespace plumb::inline PLUMB_ABI::detail
