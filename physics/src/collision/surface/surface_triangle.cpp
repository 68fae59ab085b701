#include "collision/surface/surface_triangle.h"

#include "collision/segment.h"

namespace plumb::inline PLUMB_ABI::detail {

NumVec doubled_area(NumVec a, NumVec b, NumVec c) {
  const NumVec ab = b - a, bc = c - b, ca = a - c;
  const Num of_ab = length_squared(ab), of_bc = length_squared(bc), of_ca = length_squared(ca);
  if (of_ab >= of_bc && of_ab >= of_ca) return cross(bc, ca);
  if (of_bc >= of_ca) return cross(ca, ab);
  return cross(ab, bc);
}

ClosestOnTriangle closest_on_triangle(const SurfaceTriangle& t, NumVec p) {
  using Kind = SurfaceFeature::Kind;
  bool inside = true;
  ClosestOnTriangle best{p, {Kind::Face, 0}};
  Num nearest = std::numeric_limits<Num>::infinity();
  for (int k = 0; k < 3; ++k) {
    const NumVec edge = t.along(k);
    if (dot(cross(t.normal, edge), p - t.corner[k]) >= Num(0)) continue;
    inside = false;
    const Segment side{t.corner[k], t.corner[(k + 1) % 3]};
    const Num at = closest_parameter(side, p);
    const NumVec q = point_at(side, at);
    const Num squared = length_squared(p - q);
    if (!(squared < nearest)) continue;
    nearest = squared;
    best.point = q;
    if (at > Num(0) && at < Num(1)) {
      best.feature = {Kind::Edge, k};
    } else {
      best.feature = {Kind::Corner, at > Num(0) ? (k + 1) % 3 : k};
    }
  }
  if (inside) best.point = p - t.height(p) * t.normal;
  return best;
}

EdgeKind kind_of_edge(NumVec v0, NumVec v1, NumVec normal_a, NumVec far_a, NumVec normal_b,
                      NumVec far_b, Num noise) {
  const NumVec along = normalized_or(v1 - v0, NumVec{0, 0, 0});
  const auto across = [&](NumVec far) {
    const NumVec d = far - v0;
    return length(d - dot(d, along) * along);
  };
  const Num rise_b = dot(normal_a, far_b - v0), rise_a = dot(normal_b, far_a - v0);
  const bool level = std::abs(rise_b) <= std::max(kFlatSine * across(far_b), noise) ||
                     std::abs(rise_a) <= std::max(kFlatSine * across(far_a), noise);
  // Folded back onto itself: two sheets end here, each of its own.
  if (level) return dot(normal_a, normal_b) > Num(0) ? EdgeKind::Flat : EdgeKind::Open;
  // For a thin triangle beside a large one the steeper of the two views is the sure one.
  const Num sine_b = rise_b / across(far_b), sine_a = rise_a / across(far_a);
  const Num rise = std::abs(rise_b) > std::abs(rise_a) ? sine_b : sine_a;
  return rise < Num(0) ? EdgeKind::Convex : EdgeKind::Concave;
}

bool edge_allows(const SurfaceTriangle& t, int k, NumVec n) {
  if (!t.is_sharp(k)) return false;
  const NumVec along = normalized_or(t.along(k), NumVec{0, 0, 0});
  if (dot(n, cross(t.normal, along)) > kConeSlack) return false;  // into this triangle
  if (t.kind[k] == EdgeKind::Open) return dot(n, t.normal) >= -kConeSlack;
  return dot(n, cross(along, t.beyond[k])) <= kConeSlack;  // into its neighbour
}

}  // namespace plumb::inline PLUMB_ABI::detail
