#include "collision/face_overlay.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Each side adds at most one corner to a convex polygon. Faces that are reflex within the allowed
// unevenness could add more; the last places then stay as they are.
constexpr int kClipCapacity = ContactCandidates::kCapacity;

struct ClipCorner {
  NumVec point;
  std::uint32_t feature;
  int edge;  // of the way to the next corner: edge of b, or side i of a as -1 - i
};
struct ClipPolygon {
  int count;
  ClipCorner corners[kClipCapacity];
};

// The name of the corner where side `side` of a cuts `edge` (see ClipCorner).
std::uint32_t cut_name(const FacePolygon& a, const FacePolygon& b, int side, int edge) {
  if (edge >= 0) return pair_name(a.edge_names[side], b.edge_names[edge]);
  const int other = -1 - edge;  // two sides of a meet in a corner of a, within face b
  const int corner = (other + 1) % a.count == side ? side : other;
  return pair_name(a.vertex_names[corner], b.name);
}

// Keeps what lies inside of one side. Corners within the band count as inside, and no cut is made
// beside them.
void clip_by_side(const FacePolygon& a, const FacePolygon& b, int side, NumVec outward, Num band,
                  const ClipPolygon& in, ClipPolygon& out) {
  out.count = 0;
  const NumVec origin = a.points[side];
  const ClipCorner* from = &in.corners[in.count - 1];
  Num from_distance = dot(outward, from->point - origin);
  for (int i = 0; i < in.count; ++i) {
    const ClipCorner* to = &in.corners[i];
    const Num to_distance = dot(outward, to->point - origin);
    const bool crosses = (from_distance < -band && to_distance > band) ||
                         (from_distance > band && to_distance < -band);
    if (out.count + 2 > kClipCapacity) break;
    if (crosses) {
      const Num t = from_distance / (from_distance - to_distance);
      const bool leaving = to_distance > band;
      out.corners[out.count++] = {from->point + t * (to->point - from->point),
                                  cut_name(a, b, side, from->edge),
                                  leaving ? -1 - side : from->edge};
    }
    if (to_distance <= band) {
      out.corners[out.count] = *to;
      // From a corner on the side outwards: the way on runs along the side.
      const ClipCorner& next = in.corners[i + 1 < in.count ? i + 1 : 0];
      const bool at_side = to_distance >= -band;
      if (at_side && dot(outward, next.point - origin) > band)
        out.corners[out.count].edge = -1 - side;
      ++out.count;
    }
    from = to;
    from_distance = to_distance;
  }
}

}  // namespace

Num overlay_faces(const FacePolygon& a, const FacePolygon& b, NumVec normal, Num least, Num band,
                  Num margin, ContactCandidates& out) {
  ClipPolygon buffers[2];
  ClipPolygon* polygon = &buffers[0];
  ClipPolygon* clipped = &buffers[1];
  polygon->count = b.count;
  for (int i = 0; i < b.count; ++i) {
    polygon->corners[i] = {b.points[i], pair_name(a.name, b.vertex_names[i]), i};
  }
  for (int side = 0; side < a.count && polygon->count > 0; ++side) {
    const NumVec edge = a.points[side + 1 < a.count ? side + 1 : 0] - a.points[side];
    const NumVec outward = cross(edge, normal);
    const Num size = length(outward);
    if (!(size > Num(0))) continue;
    clip_by_side(a, b, side, (Num(1) / size) * outward, band, *polygon, *clipped);
    std::swap(polygon, clipped);
  }

  Num smallest = std::numeric_limits<Num>::infinity();
  const Num per_height = Num(1) / dot(a.normal, normal);
  for (int i = 0; i < polygon->count; ++i) {
    const ClipCorner& corner = polygon->corners[i];
    const Num separation = std::max(least, (dot(a.normal, corner.point) - a.offset) * per_height);
    smallest = std::min(smallest, separation);
    if (!(separation <= margin) || out.count == ContactCandidates::kCapacity) continue;
    out.points[out.count++] = {corner.point - Num(0.5) * separation * normal, separation,
                               corner.feature};
  }
  return smallest;
}

}  // namespace plumb::inline PLUMB_ABI::detail
