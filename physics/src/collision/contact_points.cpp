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

// In their order, and each name once.
void take_chosen(const ContactCandidates& list, const bool* chosen, Contacts& out) {
  for (int i = 0; i < list.count; ++i) {
    if (!chosen[i]) continue;
    bool named = false;
    for (int k = 0; k < out.count; ++k) named |= out.points[k].feature == list.points[i].feature;
    if (!named) out.points[out.count++] = list.points[i];
  }
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
  take_chosen(list, chosen, out);
}

void choose_ridge_points(const ContactCandidates& list, NumVec normal, Num tie, Num margin,
                         Contacts& out) {
  out.normal = normal;
  out.count = 0;
  bool chosen[ContactCandidates::kCapacity] = {};
  const int first = first_of_the_deepest(list, tie);
  chosen[first] = true;
  // [m^2] from the deepest, by how near the surfaces are.
  NumVec arms[ContactCandidates::kCapacity];
  for (int i = 0; i < list.count; ++i) {
    const NumVec d = list.points[i].position - list.points[first].position;
    arms[i] = std::max(margin - list.points[i].separation, Num(0)) * (d - dot(d, normal) * normal);
  }
  int second = first;
  for (int i = 0; i < list.count; ++i)
    if (length_squared(arms[i]) > length_squared(arms[second]) * kSpanGain) second = i;
  const NumVec along = arms[second], across = cross(normal, along);
  const auto take_farthest = [&](NumVec direction, bool either_way) {
    int farthest = first;
    Num best = Num(0);
    for (int i = 0; i < list.count; ++i) {
      const Num reach = either_way ? std::abs(dot(arms[i], direction)) : dot(arms[i], direction);
      if (reach > best * kSpanGain) best = reach, farthest = i;
    }
    chosen[farthest] = true;
  };
  take_farthest(along, false);
  take_farthest(-along, false);
  take_farthest(across, true);
  take_chosen(list, chosen, out);
}

}  // namespace plumb::inline PLUMB_ABI::detail
