// Capsules against triangles: along the face where the axis runs above it, along edges and corners
// where their cones hold the direction.
#include <cmath>

#include "collision/segment.h"
#include "collision/surface/surface_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Names of the places on a capsule: its ends, and its side in between.
constexpr FeatureName kSide = edge_name(0);
constexpr FeatureName end_name(bool second) { return vertex_name(second ? 1 : 0); }

struct ClippedAxis {
  Num at[2];            // parameters on the axis
  FeatureName name[2];  // of the triangle: itself, or the edge that cuts
};

// The part of the axis above the triangle.
bool clip(const SurfaceTriangle& t, const FacePolygon& face, const Segment& axis, Num band,
          ClippedAxis& out) {
  out = {{Num(0), Num(1)}, {face.name, face.name}};
  for (int k = 0; k < 3; ++k) {
    const NumVec outward = normalized_or(cross(t.along(k), t.normal), {0, 0, 0});
    const Num start = dot(outward, axis.start - t.corner[k]) - band;
    const Num end = dot(outward, axis.end - t.corner[k]) - band;
    if (start > Num(0) && end > Num(0)) return false;
    if (start <= Num(0) && end <= Num(0)) continue;
    const Num at = start / (start - end);
    if (start > Num(0)) {
      if (at > out.at[0]) out.at[0] = at, out.name[0] = face.edge_names[k];
    } else {
      if (at < out.at[1]) out.at[1] = at, out.name[1] = face.edge_names[k];
    }
  }
  return out.at[0] <= out.at[1];
}

struct Closest {
  Num squared = std::numeric_limits<Num>::infinity();
  Num on_axis = 0;  // parameter
  NumVec on_triangle{0, 0, 0};
  SurfaceFeature feature;
};

// The closest points of the axis and the triangle's border, and of the axis' ends and its inside.
Closest closest_of(const SurfaceTriangle& t, const Segment& axis) {
  Closest best;
  for (const Num at : {Num(0), Num(1)}) {
    const ClosestOnTriangle c = closest_on_triangle(t, point_at(axis, at));
    const Num squared = length_squared(point_at(axis, at) - c.point);
    if (squared < best.squared) best = {squared, at, c.point, c.feature};
  }
  for (int k = 0; k < 3; ++k) {
    const Segment side{t.corner[k], t.corner[(k + 1) % 3]};
    const SegmentParameters at = closest_parameters(axis, side);
    const NumVec on_side = point_at(side, at.b);
    const Num squared = length_squared(point_at(axis, at.a) - on_side);
    if (!(squared < best.squared)) continue;
    SurfaceFeature feature{SurfaceFeature::Kind::Edge, k};
    if (!(at.b > Num(0))) feature = {SurfaceFeature::Kind::Corner, k};
    if (!(at.b < Num(1))) feature = {SurfaceFeature::Kind::Corner, (k + 1) % 3};
    best = {squared, at.a, on_side, feature};
  }
  return best;
}

struct CapsuleContact {
  const ConvexOnSurface& on;
  const SurfaceTriangle& t;
  const Segment& axis;
  Num radius;
  TriangleContact& out;

  void add(Num at, Num distance, std::uint32_t name) {
    const Num separation = distance - radius;
    if (!(separation <= on.margin)) return;
    out.candidates.points[out.candidates.count++] = {
        point_at(axis, at) - (radius + Num(0.5) * separation) * out.normal, separation, name};
  }

  bool face(const ClippedAxis& part) {
    out.normal = t.normal;
    out.of_face = true;
    for (int i = 0; i < 2; ++i) {
      const bool at_end = part.at[i] == Num(i);
      add(part.at[i], t.height(point_at(axis, part.at[i])),
          pair_name(part.name[i], at_end ? end_name(i == 1) : kSide));
    }
    return out.candidates.count > 0;
  }

  // One point, or two where the axis runs along the edge.
  bool edge_or_corner(SurfaceFeature feature, Num at, Num distance) {
    out.feature = feature_part(t, feature);
    const NumVec along = axis.end - axis.start;
    if (feature.kind == SurfaceFeature::Kind::Edge) {
      const NumVec e = t.along(feature.index), v = t.corner[feature.index];
      const Num size_e = length_squared(e), size = length_squared(along), dots = dot(e, along);
      const Num sine_squared = Num(1) - dots * dots / (size_e * size);
      if (sine_squared <= kParallelTilt * kParallelTilt) {
        // Where the axis passes the ends of the edge.
        const Num first = dot(v - axis.start, e) / dots, last = first + size_e / dots;
        const Num from = std::clamp(std::min(first, last), Num(0), Num(1));
        const Num to = std::clamp(std::max(first, last), Num(0), Num(1));
        if ((to - from) * std::sqrt(size) > kParallelCapsules * radius) {
          for (const Num end : {from, to}) {
            const bool at_end = end == Num(0) || end == Num(1);
            add(end, dot(out.normal, point_at(axis, end) - v),
                pair_name(face_name(0), at_end ? end_name(end > Num(0)) : kSide));
          }
          if (out.candidates.count > 0) return true;
        }
      }
    }
    add(at, distance, pair_name(face_name(0), face_name(0)));
    return out.candidates.count > 0;
  }

  // The axis passes through the triangle: the least way out over a face or a ridge.
  bool pierced(const ClippedAxis& part) {
    Num deepest = std::min(t.height(axis.start), t.height(axis.end));
    int ridge = -1;
    NumVec ridge_normal = t.normal;
    SegmentParameters ridge_at{};
    const NumVec along = axis.end - axis.start;
    for (int k = 0; k < 3; ++k) {
      if (!t.is_sharp(k)) continue;
      NumVec n = normalized_or(cross(t.along(k), along), {0, 0, 0});
      if (dot(n, cross(t.along(k), t.normal)) < Num(0)) n = -n;  // outwards over the edge
      if (!edge_allows(t, k, n)) continue;
      const Segment side{t.corner[k], t.corner[(k + 1) % 3]};
      const SegmentParameters at = closest_parameters(axis, side);
      if (!(at.a > Num(0) && at.a < Num(1) && at.b > Num(0) && at.b < Num(1))) continue;
      const Num s = dot(n, axis.start - t.corner[k]);
      if (s > deepest + kFacePreference * on.thickness)
        deepest = s, ridge = k, ridge_normal = n, ridge_at = at;
    }
    if (ridge < 0) return face(part);
    out.normal = ridge_normal;
    out.of_face = false;
    out.feature = feature_part(t, {SurfaceFeature::Kind::Edge, ridge});
    add(ridge_at.a, deepest, pair_name(face_name(0), kSide));
    return out.candidates.count > 0;
  }
};

}  // namespace

bool touch_capsule(const ConvexOnSurface& on, SurfaceTriangle& t, TriangleContact& out) {
  const NumVec half = on.R * to_num(on.shape.half);
  const Segment axis{on.p - half, on.p + half};
  const Num radius = on.shape.radius;
  const Num start = t.height(axis.start), end = t.height(axis.end);
  if (std::min(start, end) > radius + on.margin || t.height(on.middle) < -on.behind) return false;
  const Closest closest = closest_of(t, axis);
  const Num distance = std::sqrt(closest.squared);
  // An axis that passes through is far from the border: only beside the triangle is this the end.
  if (std::min(start, end) > Num(0) && !(distance - radius <= on.margin)) return false;
  on.surface.complete(t);
  FacePolygon polygon;
  polygon_of(t, polygon);
  out.candidates.count = 0;
  CapsuleContact contact{on, t, axis, radius, out};
  ClippedAxis part;
  const bool above = clip(t, polygon, axis, kAttained * on.thickness, part);
  const Num lowest =
      above ? std::min(t.height(point_at(axis, part.at[0])), t.height(point_at(axis, part.at[1])))
            : std::numeric_limits<Num>::infinity();
  if (above && lowest <= Num(0)) return contact.pierced(part);

  if (!(distance - radius <= on.margin)) return false;
  if (above && lowest <= distance + kFacePreference * on.thickness) return contact.face(part);
  const NumVec d = point_at(axis, closest.on_axis) - closest.on_triangle;
  if (distance > kTouching * on.thickness && dot(d, t.normal) > Num(0)) {
    NumVec n = (Num(1) / distance) * d;
    if (allow_normal(on, t, closest.feature, n, out.of_face)) {
      out.normal = n;
      return contact.edge_or_corner(closest.feature, closest.on_axis, distance);
    }
  }
  // The closest place is a neighbour's, but what lies above this triangle is this triangle's.
  return above && contact.face(part);
}

}  // namespace plumb::inline PLUMB_ABI::detail
