// What all shapes share against triangles, and the sphere.
#include "collision/surface/surface_contact.h"

#include <cmath>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr std::uint32_t kNameBits = 0x3fff;  // what a feature name holds of an index

// The unit sphere folded onto a square of two numbers in [-1, 1].
void fold(NumVec n, Num& u, Num& v) {
  const Num sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  u = n.x / sum;
  v = n.z / sum;
  if (n.y >= Num(0)) return;
  const Num a = u, b = v;
  u = (Num(1) - std::abs(b)) * (a < Num(0) ? Num(-1) : Num(1));
  v = (Num(1) - std::abs(a)) * (b < Num(0) ? Num(-1) : Num(1));
}

}  // namespace

std::uint32_t plane_part(NumVec normal, NumVec point, Num cell) {
  Num u, v;
  fold(normal, u, v);
  const auto cell_of = [](Num x) {
    return static_cast<std::uint32_t>(std::floor((x + Num(1)) * (kNormalCells / 2) + kCellShift));
  };
  const Num along = std::floor(dot(normal, point) / cell + kCellShift);
  // Any rule that keeps neighbours apart will do; the low bits of the height tell steps from steps.
  const auto height = static_cast<std::uint32_t>(static_cast<std::int64_t>(along)) & 0xfffU;
  return ((cell_of(u) & 0x3ffU) << 21 | (cell_of(v) & 0x1ffU) << 12 | height) & ~kFeaturePart;
}

std::uint32_t feature_part(const SurfaceTriangle& t, SurfaceFeature feature) {
  const bool edge = feature.kind == SurfaceFeature::Kind::Edge;
  const std::uint32_t id = edge ? t.edge_id[feature.index] : t.corner_id[feature.index];
  return kFeaturePart | id << 1 | (edge ? 1U : 0U);
}

bool allow_normal(const ConvexOnSurface& on, const SurfaceTriangle& t, SurfaceFeature feature,
                  NumVec& n, bool& of_face) {
  of_face = feature.kind == SurfaceFeature::Kind::Face ||
            (dot(n, t.normal) > Num(0) && length(n - t.normal) <= kSnapAngle);
  if (of_face) {
    n = t.normal;
    return true;
  }
  return cone_allows(on, t, feature, n);
}

void polygon_of(const SurfaceTriangle& t, FacePolygon& out) {
  out.count = 3;
  out.name = face_name(0);
  out.normal = t.normal;
  out.offset = t.offset;
  for (int k = 0; k < 3; ++k) {
    out.points[k] = t.corner[k];
    out.vertex_names[k] = vertex_name(static_cast<int>(t.corner_id[k] & kNameBits));
    out.edge_names[k] = edge_name(static_cast<int>(t.edge_id[k] & kNameBits));
  }
}

bool touch_sphere(const ConvexOnSurface& on, SurfaceTriangle& t, TriangleContact& out) {
  const Num radius = on.shape.radius, height = t.height(on.p);
  if (height > radius + on.margin || height < -on.behind) return false;
  const ClosestOnTriangle closest = closest_on_triangle(t, on.p);
  const NumVec d = on.p - closest.point;
  NumVec n = t.normal;
  Num distance = height;
  out.of_face = true;
  // Beside the triangle by no more than the crack between two of a plane: above it.
  if (closest.feature.kind != SurfaceFeature::Kind::Face &&
      length(d - height * t.normal) > kSnapAngle * std::abs(height)) {
    distance = length(d);
    if (!(height > Num(0)) || !(distance - radius <= on.margin)) return false;
    on.surface.complete(t);
    n = (Num(1) / distance) * d;
    if (!allow_normal(on, t, closest.feature, n, out.of_face)) return false;
    out.feature = feature_part(t, closest.feature);
  }
  const Num separation = distance - radius;
  out.normal = n;
  out.candidates.count = 1;
  out.candidates.points[0] = {on.p - (radius + Num(0.5) * separation) * n, separation,
                              pair_name(face_name(0), face_name(0))};
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
