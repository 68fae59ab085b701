#include "collision/shape_gap.h"

#include <limits>

#include "collision/collide.h"
#include "collision/collide_parts.h"
#include "collision/core_support.h"
#include "collision/gjk.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

bool is_plane(const Placed& x) { return x.shape.type == ShapeType::HalfSpace; }
Num radius_of(const Placed& x) { return static_cast<Num>(x.shape.radius); }
Num size_of(const Placed& x) { return static_cast<Num>(bounding_radius(x.shape)); }

// Farthest points of a placed core.
class Core {
 public:
  Core(const Placed& x, NumVec origin) : shape_(x.shape), rows_(to_matrix(x.q)), p_(x.p - origin) {}
  [[nodiscard]] NumVec support(NumVec d) const {
    return rows_ * core_support(shape_, transpose_times(rows_, d)) + p_;
  }

 private:
  const CollisionShape& shape_;
  NumMatrix rows_;
  NumVec p_;
};

// The first shape is the half-space.
Gap from_plane(const Placed& plane, const Placed& other) {
  const NumVec n = rotate(plane.q, normalized_or(to_num(plane.shape.normal), NumVec{0, 1, 0}));
  const Num offset = dot(n, plane.p) + static_cast<Num>(plane.shape.offset);
  const NumVec lowest = Core(other, {0, 0, 0}).support(-n) - radius_of(other) * n;
  const Num distance = dot(n, lowest) - offset;
  return {distance, lowest - distance * n, lowest, n};
}

GjkResult distance_of_cores(const Placed& a, const Placed& b, NumVec guess) {
  const Core core_a(a, a.p), core_b(b, a.p);
  return gjk_distance([&](NumVec d) { return core_a.support(d); },
                      [&](NumVec d) { return core_b.support(d); }, guess, size_of(a) + size_of(b));
}

// Cores that overlap: the deepest contact.
Gap inside_gap(const Placed& a, const Placed& b, NumVec guess) {
  const auto real = [](NumRotation q) {
    return Rotation{static_cast<Real>(q.x), static_cast<Real>(q.y), static_cast<Real>(q.z),
                    static_cast<Real>(q.w)};
  };
  const NumVec fallback = normalized_or(guess, NumVec{0, 1, 0});
  Gap gap{0, a.p, a.p, fallback};
  Manifold manifold;
  const Real margin = static_cast<Real>(std::min(size_of(a), size_of(b)));
  if (!collide(a.shape, {{0, 0, 0}, real(a.q)}, b.shape, {cast<Real>(b.p - a.p), real(b.q)}, margin,
               manifold))
    return gap;
  int deepest = 0;
  for (int i = 1; i < manifold.count; ++i)
    if (manifold.points[i].separation < manifold.points[deepest].separation) deepest = i;
  gap.distance = static_cast<Num>(manifold.points[deepest].separation);
  gap.normal = normalized_or(to_num(manifold.normal), fallback);
  const NumVec middle = a.p + to_num(manifold.points[deepest].position);
  gap.on_a = middle - (Num(0.5) * gap.distance) * gap.normal;
  gap.on_b = middle + (Num(0.5) * gap.distance) * gap.normal;
  return gap;
}

// Where a shape has parts: the nearest of them. A surface has no inside, so that what overlaps it
// is as deep as its contacts say.
Gap gap_of_parts(const Placed& a, const Placed& b, NumVec guess) {
  const auto placement = [&](const Placed& x) {
    const NumVec p = x.p - a.p;
    return Transform{cast<Real>(p), Rotation{static_cast<Real>(x.q.x), static_cast<Real>(x.q.y),
                                             static_cast<Real>(x.q.z), static_cast<Real>(x.q.w)}};
  };
  const Proximity near = closest_parts(a.shape, placement(a), b.shape, placement(b));
  if (!(near.distance > Real(0))) return inside_gap(a, b, guess);
  return {static_cast<Num>(near.distance), a.p + to_num(near.on_a), a.p + to_num(near.on_b),
          to_num(near.normal)};
}

}  // namespace

Gap gap_between(const Placed& a, const Placed& b, NumVec guess) {
  if (is_plane(a) && is_plane(b))
    return {std::numeric_limits<Num>::infinity(), a.p, b.p, NumVec{0, 1, 0}};
  if (has_parts(a.shape.type) || has_parts(b.shape.type)) return gap_of_parts(a, b, guess);
  if (is_plane(a)) return from_plane(a, b);
  if (is_plane(b)) {
    const Gap gap = from_plane(b, a);
    return {gap.distance, gap.on_b, gap.on_a, -gap.normal};
  }
  const GjkResult cores = distance_of_cores(a, b, guess);
  if (cores.overlap) return inside_gap(a, b, guess);
  const NumVec n = cores.normal;
  return {cores.distance - radius_of(a) - radius_of(b), a.p + cores.on_a + radius_of(a) * n,
          a.p + cores.on_b - radius_of(b) * n, n};
}

bool shapes_overlap(const Placed& a, const Placed& b) {
  if (is_plane(a) && is_plane(b)) return false;
  if (has_parts(a.shape.type) || has_parts(b.shape.type))
    return gap_of_parts(a, b, b.p - a.p).distance <= Num(0);
  if (is_plane(a)) return from_plane(a, b).distance <= Num(0);
  if (is_plane(b)) return from_plane(b, a).distance <= Num(0);
  const GjkResult cores = distance_of_cores(a, b, b.p - a.p);
  return cores.overlap || cores.distance <= radius_of(a) + radius_of(b);
}

}  // namespace plumb::inline PLUMB_ABI::detail
