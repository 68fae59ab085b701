// Distance of two convex cores by the algorithm of Gilbert, Johnson and Keerthi [Gilbert 1988], in
// double precision. The closest point of a simplex is found by Voronoi regions [Ericson 2005].
#pragma once

#include "collision/collision_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {

// A corner of the simplex: w = b - a, points of the two cores.
struct GjkCorner {
  NumVec w, a, b;
};

struct GjkSimplex {
  int count = 0;
  GjkCorner corners[4];
  Num weights[4] = {1, 0, 0, 0};
};

struct GjkResult {
  bool overlap;  // the cores share a point (to kTouching of their size)
  Num distance;  // [m], 0 when they overlap
  NumVec on_a, on_b;
  NumVec normal;  // unit, from a to b; not set when they overlap
};

// Replaces the simplex by the smallest face of it that holds the point closest to the origin, with
// that point's weights, and returns that point. A full tetrahedron left over means: the origin is
// inside.
NumVec reduce_to_closest(GjkSimplex& simplex);

// The weights of a sliver cancel badly, its closest point does not: where the weighted corners miss
// `point` by more than `allowed` [m], they are replaced by those of the edge that comes nearest.
void mend_weights(GjkSimplex& simplex, NumVec point, Num allowed);

// `support_a(d)`: a farthest point of core A in direction d, likewise for B, in one frame. `guess`:
// any vector from A to B. `scale` [m]: a size of the two cores, for the smallest distance told from
// 0.
template <class SupportA, class SupportB>
GjkResult gjk_distance(const SupportA& support_a, const SupportB& support_b, NumVec guess,
                       Num scale) {
  GjkResult result{};
  GjkSimplex simplex;
  const auto corner_towards = [&](NumVec d) {
    const NumVec a = support_a(d), b = support_b(-d);
    return GjkCorner{b - a, a, b};
  };
  const NumVec fallback{1, 0, 0};
  simplex.corners[0] = corner_towards(normalized_or(guess, fallback));
  simplex.count = 1;
  NumVec v = simplex.corners[0].w;
  const Num touching = kTouching * scale;
  Num squared = length_squared(v);
  bool apart = false;  // some direction has shown room, whatever a sliver of a simplex says
  for (int iteration = 0; iteration < kGjkMaxIterations; ++iteration) {
    if (!(squared > touching * touching)) break;
    const GjkCorner next = corner_towards(v);
    // v . w / |v| is a lower bound of the distance.
    const Num along = dot(v, next.w);
    if (squared - along <= kGjkGap * squared) break;
    apart = apart || (along > Num(0) && along * along > touching * touching * squared);
    bool known = false;
    for (int i = 0; i < simplex.count; ++i) {
      const NumVec d = simplex.corners[i].w - next.w;
      known |= d.x == Num(0) && d.y == Num(0) && d.z == Num(0);
    }
    if (known) break;
    const GjkSimplex before = simplex;
    simplex.corners[simplex.count] = next;
    ++simplex.count;
    const NumVec closer = reduce_to_closest(simplex);
    if (simplex.count == 4) {
      if (apart) {  // rounding: the origin cannot be inside
        simplex = before;
        break;
      }
      squared = Num(0);
      v = {0, 0, 0};
      break;
    }
    const Num closer_squared = length_squared(closer);
    if (!(closer_squared < squared)) {  // rounding: no nearer any more
      simplex = before;
      break;
    }
    v = closer;
    squared = closer_squared;
  }
  if (simplex.count == 3 && squared > Num(0)) mend_weights(simplex, v, kWitness * scale);
  for (int i = 0; i < simplex.count; ++i) {
    result.on_a += simplex.weights[i] * simplex.corners[i].a;
    result.on_b += simplex.weights[i] * simplex.corners[i].b;
  }
  result.overlap = !(squared > touching * touching);
  if (!result.overlap) {
    result.distance = std::sqrt(squared);
    result.normal = (Num(1) / result.distance) * v;
  }
  return result;
}

}  // namespace plumb::inline PLUMB_ABI::detail
