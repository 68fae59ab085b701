#include "collision/gjk.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// A candidate: corners kept (as indices into the simplex) and their weights.
struct Nearest {
  int count = 0;
  int corner[3];
  Num weight[3];
  NumVec point;
  Num squared;
};

Nearest nearest_of_corner(const GjkSimplex& s, int i) {
  const NumVec w = s.corners[i].w;
  return {1, {i, 0, 0}, {1, 0, 0}, w, length_squared(w)};
}

Nearest nearest_of_edge(const GjkSimplex& s, int i, int j) {
  const NumVec a = s.corners[i].w, b = s.corners[j].w, d = b - a;
  const Num along = -dot(a, d), whole = length_squared(d);
  if (!(along > Num(0))) return nearest_of_corner(s, i);
  if (!(along < whole)) return nearest_of_corner(s, j);
  const Num t = along / whole;
  const NumVec point = a + t * d;
  return {2, {i, j, 0}, {Num(1) - t, t, 0}, point, length_squared(point)};
}

Nearest nearer(const Nearest& a, const Nearest& b) { return b.squared < a.squared ? b : a; }

Nearest nearest_of_edges(const GjkSimplex& s, int i, int j, int k) {
  return nearer(nearest_of_edge(s, i, j),
                nearer(nearest_of_edge(s, j, k), nearest_of_edge(s, k, i)));
}

Nearest nearest_of_triangle(const GjkSimplex& s, int i, int j, int k) {
  const NumVec a = s.corners[i].w, b = s.corners[j].w, c = s.corners[k].w;
  const NumVec n = cross(b - a, c - a);
  const Num squared = length_squared(n);
  if (!(squared > Num(0))) return nearest_of_edges(s, i, j, k);
  const Num wa = dot(n, cross(b, c)), wb = dot(n, cross(c, a)), wc = dot(n, cross(a, b));
  if (!(wa > Num(0) && wb > Num(0) && wc > Num(0))) return nearest_of_edges(s, i, j, k);
  // The foot of the perpendicular, from the plane rather than from the weights: they cancel badly
  // for a sliver seen from far, the plane does not.
  const NumVec point = (dot(n, a) / squared) * n;
  const Num sum = wa + wb + wc;
  return {3, {i, j, k}, {wa / sum, wb / sum, wc / sum}, point, length_squared(point)};
}

}  // namespace

NumVec reduce_to_closest(GjkSimplex& s) {
  Nearest nearest;
  if (s.count == 2) {
    nearest = nearest_of_edge(s, 0, 1);
  } else if (s.count == 3) {
    nearest = nearest_of_triangle(s, 0, 1, 2);
  } else {
    constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    bool outside = false;
    for (const auto& face : kFaces) {
      const NumVec a = s.corners[face[0]].w;
      const NumVec n = cross(s.corners[face[1]].w - a, s.corners[face[2]].w - a);
      const Num of_origin = -dot(n, a), of_fourth = dot(n, s.corners[face[3]].w - a);
      if (of_origin * of_fourth > Num(0)) continue;  // on the inner side of this face
      const Nearest here = nearest_of_triangle(s, face[0], face[1], face[2]);
      nearest = outside ? nearer(nearest, here) : here;
      outside = true;
    }
    if (!outside) return {0, 0, 0};
  }
  GjkSimplex reduced;
  reduced.count = nearest.count;
  for (int i = 0; i < nearest.count; ++i) {
    reduced.corners[i] = s.corners[nearest.corner[i]];
    reduced.weights[i] = nearest.weight[i];
  }
  s = reduced;
  return nearest.point;
}

void mend_weights(GjkSimplex& s, NumVec point, Num allowed) {
  const auto miss = [&s, point](const Num(&weights)[4]) {
    NumVec sum = -point;
    for (int i = 0; i < s.count; ++i) sum += weights[i] * s.corners[i].w;
    return length_squared(sum);
  };
  Num best = miss(s.weights);
  if (!(best > allowed * allowed)) return;
  for (int i = 0; i < s.count; ++i) {
    const int k = (i + 1) % s.count;
    const NumVec a = s.corners[i].w, d = s.corners[k].w - a;
    const Num whole = length_squared(d);
    const Num t = whole > Num(0) ? std::clamp(dot(point - a, d) / whole, Num(0), Num(1)) : Num(0);
    Num weights[4] = {0, 0, 0, 0};
    weights[i] = Num(1) - t;
    weights[k] = t;
    const Num here = miss(weights);
    if (here < best) {
      best = here;
      std::copy(weights, weights + 4, s.weights);
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
