#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// Twice the signed area of a triangle seen along the normal.
Num doubled_area(NumVec a, NumVec b, NumVec c, NumVec normal) {
  return dot(cross(b - a, c - a), normal);
}

int first_of_the_deepest(const ContactCandidates& list, Num tie) {
  Num deepest = list.points[0].separation;
  for (int i = 1; i < list.count; ++i) deepest = std::min(deepest, list.points[i].separation);
  int chosen = 0;
  while (list.points[chosen].separation > deepest + tie) ++chosen;
  return chosen;
}

int farthest_from(const ContactCandidates& list, NumVec from, NumVec normal) {
  int chosen = 0;
  Num best = Num(-1);
  for (int i = 0; i < list.count; ++i) {
    const NumVec d = list.points[i].position - from;
    const Num along = dot(d, normal);
    const Num squared = length_squared(d) - along * along;
    if (squared > best * kSpanGain) best = squared, chosen = i;
  }
  return chosen;
}

}  // namespace

void choose_points(const ContactCandidates& list, NumVec normal, Num tie, Contacts& out) {
  out.normal = normal;
  out.count = 0;
  bool chosen[ContactCandidates::kCapacity] = {};
  if (list.count <= Manifold::kMaxPoints) {
    for (int i = 0; i < list.count; ++i) chosen[i] = true;
  } else {
    const auto at = [&list](int i) { return list.points[i].position; };
    const int first = first_of_the_deepest(list, tie);
    const int second = farthest_from(list, at(first), normal);
    int third = farthest_from(list, at(second), normal);  // for points all on one line
    Num span = Num(0);
    for (int i = 0; i < list.count; ++i) {
      const Num area = std::abs(doubled_area(at(first), at(second), at(i), normal));
      if (area > span * kSpanGain) span = area, third = i;
    }
    // The fourth adds the most area outside the triangle.
    const int corner[3] = {first, second, third};
    const Num turn =
        doubled_area(at(first), at(second), at(third), normal) < Num(0) ? Num(-1) : Num(1);
    int fourth = first;
    Num gain = span * (kSpanGain - Num(1));
    for (int i = 0; i < list.count; ++i) {
      for (int k = 0; k < 3; ++k) {
        const Num outside =
            -turn * doubled_area(at(corner[k]), at(corner[(k + 1) % 3]), at(i), normal);
        if (outside > gain * kSpanGain) gain = outside, fourth = i;
      }
    }
    chosen[first] = chosen[second] = chosen[third] = chosen[fourth] = true;
  }
  for (int i = 0; i < list.count; ++i) {
    if (!chosen[i]) continue;
    bool named = false;
    for (int k = 0; k < out.count; ++k) named |= out.points[k].feature == list.points[i].feature;
    if (!named) out.points[out.count++] = list.points[i];
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
