#include "collision/feature_overlay.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Kind = SupportFeature::Kind;

// Names on a rim: fixed points, points that follow the deepest one, cuts by a side (in, out), cuts
// of two rims. Generators use kGeneratorVertex.
constexpr int kRimPoints = 8;
constexpr int kFollowingRim = kRimPoints, kRimCut = 2 * kRimPoints;
constexpr FeatureName kRimEdge = edge_name(0);
constexpr Num kHalfRoot = 0.70710678118654752440;  // sin 45 degrees
constexpr Num kTurnCos[kRimPoints] = {1, kHalfRoot, 0, -kHalfRoot, -1, -kHalfRoot, 0, kHalfRoot};
constexpr Num kTurnSin[kRimPoints] = {0, kHalfRoot, 1, kHalfRoot, 0, -kHalfRoot, -1, -kHalfRoot};

// The feature's point at the lateral place of x (flat features only).
NumVec on_plane(const SupportFeature& f, NumVec n, NumVec x) {
  return x + ((f.offset - dot(f.normal, x)) / dot(f.normal, n)) * n;
}

// Whether a flat feature covers the lateral place of x.
bool covers(const SupportFeature& f, NumVec n, NumVec x, Num band) {
  if (f.kind == Kind::Plane) return true;
  if (f.kind == Kind::Disc) {
    const Num reach = f.radius + band;
    return length_squared(on_plane(f, n, x) - f.centre) <= reach * reach;
  }
  const FacePolygon& p = *f.polygon;
  for (int i = 0; i < p.count; ++i) {
    const NumVec edge = p.points[i + 1 < p.count ? i + 1 : 0] - p.points[i];
    const NumVec outward = cross(edge, f.out);
    const Num beyond = dot(outward, x - p.points[i]);
    if (beyond > Num(0) && beyond * beyond > band * band * length_squared(outward)) return false;
  }
  return true;
}

class Layer {
 public:
  Layer(const SupportFeature& a, const SupportFeature& b, const Overlay& overlay,
        ContactCandidates& out)
      : a_(a), b_(b), o_(overlay), out_(out) {}

  [[nodiscard]] Num smallest() const { return smallest_; }

  // Points of A and B at one lateral place.
  void add(NumVec on_a, NumVec on_b, FeatureName name_a, FeatureName name_b) {
    const Num s = std::max(o_.least, dot(o_.normal, on_b - on_a));
    smallest_ = std::min(smallest_, s);
    if (!(s <= o_.margin) || out_.count == ContactCandidates::kCapacity) return;
    // From the side whose point is exact for any gap: halfway.
    const NumVec middle = Num(0.5) * (on_a + on_b);
    out_.points[out_.count++] = {middle, s, pair_name(name_a, name_b)};
  }
  // A place given on one feature; the other is flat and covers it.
  void add_on(bool first, NumVec x, FeatureName own, FeatureName other) {
    if (first) {
      add(x, on_plane(b_, o_.normal, x), own, other);
    } else {
      add(on_plane(a_, o_.normal, x), x, other, own);
    }
  }

  void rim(bool first);
  void rim_and_polygon(bool disc_first);
  void rims_crossing();
  void segment_over_flat(bool segment_first);
  void parallel_segments();

 private:
  const SupportFeature& a_;
  const SupportFeature& b_;
  const Overlay& o_;
  ContactCandidates& out_;
  Num smallest_ = std::numeric_limits<Num>::infinity();
};

// Rim points of one disc that the other feature covers. As long as the disc is flat on it they are
// fixed to the body: a resting disc keeps its points. Tilted, the first is the deepest.
void Layer::rim(bool first) {
  const SupportFeature& disc = first ? a_ : b_;
  const SupportFeature& other = first ? b_ : a_;
  const NumVec downhill_all = (Num(1) / dot(other.normal, disc.out)) * other.normal;
  const NumVec downhill = downhill_all - dot(downhill_all, disc.normal) * disc.normal;
  const bool tilted = disc.radius * length(downhill) > o_.tie;
  const NumVec u = tilted ? normalized_or(downhill, disc.spoke) : disc.spoke;
  const NumVec v = cross(disc.normal, u);
  for (int i = 0; i < kRimPoints; ++i) {
    const NumVec x =
        disc.centre + (disc.radius * kTurnCos[i]) * u + (disc.radius * kTurnSin[i]) * v;
    if (!covers(other, o_.normal, x, o_.band)) continue;
    add_on(first, x, vertex_name(tilted ? kFollowingRim + i : i), other.name);
  }
}

// What lies on the other side of the rim: corners within the disc, sides that cut it.
void Layer::rim_and_polygon(bool disc_first) {
  const SupportFeature& disc = disc_first ? a_ : b_;
  const FacePolygon& p = *(disc_first ? b_ : a_).polygon;
  const Num reach = disc.radius + o_.band;
  for (int i = 0; i < p.count; ++i) {
    const NumVec x = p.points[i], next = p.points[i + 1 < p.count ? i + 1 : 0];
    const NumVec start = on_plane(disc, o_.normal, x) - disc.centre;
    if (length_squared(start) <= reach * reach)
      add_on(!disc_first, x, p.vertex_names[i], disc.name);
    const NumVec d = on_plane(disc, o_.normal, next) - disc.centre - start;
    const Num dd = length_squared(d);
    if (!(dd > Num(0))) continue;
    const Num middle = -dot(start, d) / dd;
    const Num room = disc.radius * disc.radius - length_squared(start + middle * d);
    if (!(room > Num(0))) continue;
    const Num half = std::sqrt(room / dd);
    for (int k = 0; k < 2; ++k) {
      const Num t = k == 0 ? middle - half : middle + half;
      if (!(t > Num(0) && t < Num(1))) continue;
      add_on(!disc_first, x + t * (next - x), p.edge_names[i], vertex_name(kRimCut + k));
    }
  }
}

// Where two rims cross, seen along the normal: as circles first, then by Newton's steps on the rim
// of A, because a tilted disc is seen as an ellipse.
void Layer::rims_crossing() {
  const NumVec d_all = on_plane(a_, o_.normal, b_.centre) - a_.centre;
  const Num dd = length_squared(d_all), ra = a_.radius, rb = b_.radius;
  if (!(dd > o_.band * o_.band)) return;
  const Num along = (dd + ra * ra - rb * rb) / (Num(2) * dd);
  const Num room = ra * ra - along * along * dd;
  if (!(room > Num(0))) return;
  const NumVec aside = std::sqrt(room / dd) * cross(a_.normal, d_all);
  constexpr int kSteps = 4;  // each squares the error
  for (int k = 0; k < 2; ++k) {
    NumVec spoke = along * d_all + (k == 0 ? aside : -aside);
    NumVec on_b = on_plane(b_, o_.normal, a_.centre + spoke);
    for (int i = 0; i < kSteps; ++i) {
      const NumVec tangent = cross(a_.normal, spoke);
      const NumVec moved =
          tangent - (dot(b_.normal, tangent) / dot(b_.normal, o_.normal)) * o_.normal;
      const NumVec from = on_b - b_.centre;
      const Num slope = Num(2) * dot(from, moved);
      if (slope == Num(0)) break;
      const Num turn = (rb * rb - length_squared(from)) / slope;
      spoke = ra * normalized_or(spoke + turn * tangent, spoke);
      on_b = on_plane(b_, o_.normal, a_.centre + spoke);
    }
    if (!(std::abs(length(on_b - b_.centre) - rb) <= o_.band)) continue;
    add(a_.centre + spoke, on_b, vertex_name(kRimCut + k), kRimEdge);
  }
}

// The part of a segment above a flat feature: its two ends, or where it is cut.
void Layer::segment_over_flat(bool segment_first) {
  const SupportFeature& line = segment_first ? a_ : b_;
  const SupportFeature& flat = segment_first ? b_ : a_;
  const NumVec n = o_.normal, d = line.segment.end - line.segment.start;
  Num at[2] = {Num(0), Num(1)};
  FeatureName cut[2] = {flat.name, flat.name};
  if (flat.kind == Kind::Disc) {
    const NumVec start = on_plane(flat, n, line.segment.start) - flat.centre;
    const NumVec way = on_plane(flat, n, line.segment.end) - flat.centre - start;
    const Num ww = length_squared(way), reach = flat.radius + o_.band;
    const Num middle = ww > Num(0) ? -dot(start, way) / ww : Num(0);
    const Num room = reach * reach - length_squared(start + middle * way);
    if (!(room > Num(0))) return;
    const Num half = ww > Num(0) ? std::sqrt(room / ww) : Num(1);
    if (middle - half > at[0]) at[0] = middle - half, cut[0] = vertex_name(kRimCut);
    if (middle + half < at[1]) at[1] = middle + half, cut[1] = vertex_name(kRimCut + 1);
  } else if (flat.kind == Kind::Polygon) {
    const FacePolygon& p = *flat.polygon;
    for (int i = 0; i < p.count; ++i) {
      const NumVec edge = p.points[i + 1 < p.count ? i + 1 : 0] - p.points[i];
      const NumVec outward = normalized_or(cross(edge, flat.out), NumVec{0, 0, 0});
      const Num start = dot(outward, line.segment.start - p.points[i]) - o_.band;
      const Num end = dot(outward, line.segment.end - p.points[i]) - o_.band;
      if (start > Num(0) && end > Num(0)) return;
      if (start <= Num(0) && end <= Num(0)) continue;
      const Num t = start / (start - end);
      if (start > Num(0)) {
        if (t > at[0]) at[0] = t, cut[0] = p.edge_names[i];
      } else {
        if (t < at[1]) at[1] = t, cut[1] = p.edge_names[i];
      }
    }
  }
  if (!(at[0] <= at[1])) return;
  for (int k = 0; k < 2; ++k) {
    const bool own_end = at[k] == static_cast<Num>(k);
    add_on(segment_first, line.segment.start + at[k] * d, own_end ? line.ends[k] : line.name,
           cut[k]);
  }
}

// Two segments that run beside one another: the ends of the part that they share, if they do not
// stray from one another by more than kParallelCapsules of the smaller diameter.
void Layer::parallel_segments() {
  const Segment &sa = a_.segment, &sb = b_.segment;
  const NumVec n = o_.normal;
  const auto flatten = [n](NumVec x) { return x - dot(x, n) * n; };
  const NumVec da = flatten(sa.end - sa.start), db = flatten(sb.end - sb.start);
  const Num aa = length_squared(da), bb = length_squared(db), ab = dot(da, db);
  if (!(aa > Num(0) && bb > Num(0))) return;
  if (!(ab * ab >= (Num(1) - kParallelTilt * kParallelTilt) * aa * bb)) return;
  const Num start = dot(flatten(sb.start - sa.start), da) / aa;
  const Num end = dot(flatten(sb.end - sa.start), da) / aa;
  const Num at[2] = {std::max(Num(0), std::min(start, end)),
                     std::min(Num(1), std::max(start, end))};
  const Num limit = std::max(o_.band, Num(2) * kParallelCapsules * std::min(a_.bend, b_.bend));
  if (!(at[1] > at[0] && (at[1] - at[0]) * (at[1] - at[0]) * aa > limit * limit)) return;
  const int start_of_b = start < end ? 0 : 1;
  NumVec on_a[2], on_b[2];
  for (int k = 0; k < 2; ++k) {
    on_a[k] = point_at(sa, at[k]);
    on_b[k] = point_at(sb, (at[k] - start) / (end - start));
    if (length_squared(flatten(on_b[k] - on_a[k])) > limit * limit) return;
  }
  for (int k = 0; k < 2; ++k) {
    const bool end_of_a = at[k] == static_cast<Num>(k);
    add(on_a[k], on_b[k], end_of_a ? a_.ends[k] : a_.name,
        end_of_a ? b_.name : b_.ends[k == start_of_b ? 0 : 1]);
  }
}

}  // namespace

Num overlay_features(const SupportFeature& a, const SupportFeature& b, const Overlay& overlay,
                     ContactCandidates& out) {
  Layer layer(a, b, overlay, out);
  for (const SupportFeature* f : {&a, &b}) {
    if (f->kind == Kind::Point) return layer.smallest();
    if (f->is_flat() && !(dot(f->normal, f->out) >= kSteepFace)) return layer.smallest();
  }
  const bool line_a = a.kind == Kind::Segment, line_b = b.kind == Kind::Segment;
  if (line_a && line_b) {
    layer.parallel_segments();
  } else if (line_a || line_b) {
    layer.segment_over_flat(line_a);
  } else {
    if (a.kind == Kind::Disc) layer.rim(true);
    if (b.kind == Kind::Disc) layer.rim(false);
    if (a.kind == Kind::Disc && b.kind == Kind::Polygon) layer.rim_and_polygon(true);
    if (a.kind == Kind::Polygon && b.kind == Kind::Disc) layer.rim_and_polygon(false);
    if (a.kind == Kind::Disc && b.kind == Kind::Disc) layer.rims_crossing();
  }
  return layer.smallest();
}

}  // namespace plumb::inline PLUMB_ABI::detail
