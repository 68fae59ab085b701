// From the contacts of single triangles to the manifolds of a pair: what lies in one plane becomes
// one manifold, whose four points are chosen among the corners of all of it.
#include <algorithm>
#include <cmath>

#include "collision/surface/finish_parts.h"
#include "collision/surface/surface_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Group = PartManifolds::Group;

// The point of the surface below a contact point.
NumVec on_surface(const ContactPoint& p, NumVec normal) {
  return p.position - Num(0.5) * p.separation * normal;
}

bool is_coplanar(const Group& group, const TriangleContact& contact, Num tolerance) {
  if (dot(group.normal, contact.normal) <= Num(0) ||
      length(group.normal - contact.normal) > kSameNormal)
    return false;
  for (int i = 0; i < contact.candidates.count; ++i) {
    const NumVec p = on_surface(contact.candidates.points[i], contact.normal);
    if (std::abs(dot(group.normal, p - group.origin)) > tolerance) return false;
  }
  return true;
}

// Twice the signed area of a triangle seen along the normal.
Num turn(NumVec a, NumVec b, NumVec c, NumVec normal) { return dot(cross(b - a, c - a), normal); }

// Of points nearer to one another than `same`, the deepest stays; the first of those as deep to
// `level`.
void drop_doubles(std::vector<ContactPoint>& points, Num same, Num level) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool is_new = true;
    for (std::size_t k = 0; k < kept && is_new; ++k) {
      if (length_squared(points[i].position - points[k].position) > same * same) continue;
      is_new = false;
      if (points[i].separation < points[k].separation - level) points[k] = points[i];
    }
    if (is_new) points[kept++] = points[i];
  }
  points.resize(kept);
}

// Keeps the corners of the area that the points span, in order around it (Andrew's monotone chain
// in the plane of the contact), and the deepest point of all.
void keep_hull(std::vector<ContactPoint>& points, NumVec normal, Num tolerance) {
  if (points.size() < 3) return;
  NumVec u, v;
  tangent_frame(normal, u, v);
  std::sort(points.begin(), points.end(), [&](const ContactPoint& a, const ContactPoint& b) {
    const Num ua = dot(u, a.position), ub = dot(u, b.position);
    if (ua != ub) return ua < ub;
    const Num va = dot(v, a.position), vb = dot(v, b.position);
    return va != vb ? va < vb : a.feature < b.feature;
  });
  std::vector<ContactPoint> chain;
  const auto add = [&](const ContactPoint& p, std::size_t floor) {
    while (chain.size() >= floor + 2) {
      const NumVec a = chain[chain.size() - 2].position, b = chain.back().position;
      // Height of b over the line from a to p.
      if (turn(a, b, p.position, normal) > tolerance * length(p.position - a)) break;
      chain.pop_back();
    }
    chain.push_back(p);
  };
  for (const ContactPoint& p : points) add(p, 0);
  const std::size_t lower = chain.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  chain.pop_back();
  // The deepest point counts wherever it lies, if it is deeper than the corners show.
  const auto deeper = [](const ContactPoint& a, const ContactPoint& b) {
    return a.separation < b.separation;
  };
  const ContactPoint deepest = *std::min_element(points.begin(), points.end(), deeper);
  const ContactPoint shown = *std::min_element(chain.begin(), chain.end(), deeper);
  if (deepest.separation < shown.separation - tolerance) chain.push_back(deepest);
  points = std::move(chain);
}

void prune(Group& group, Num thickness) {
  drop_doubles(group.points, kSamePoint * thickness, kAttained * thickness);
  keep_hull(group.points, group.normal, kOnHullLine * thickness);
}

// Points of one manifold have names of their own.
void part_names(std::vector<ContactPoint>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (bool again = true; again;) {
      again = false;
      for (std::size_t k = 0; k < i && !again; ++k) again = points[k].feature == points[i].feature;
      if (again) points[i].feature += 1U << 16;
    }
  }
}

Num deepest_of(const Group& group) {
  Num deepest = std::numeric_limits<Num>::infinity();
  for (const ContactPoint& p : group.points) deepest = std::min(deepest, p.separation);
  return deepest;
}

// A shape halfway through a thin sheet meets its other side from behind: the side in front of its
// middle counts.
bool is_back_of_sheet(const PartManifolds& all, std::size_t index) {
  const Group& group = all.groups[index];
  if (!group.behind) return false;
  for (std::size_t k = 0; k < all.group_count; ++k) {
    const Group& other = all.groups[k];
    if (!other.behind && dot(other.normal, group.normal) < Num(0) && deepest_of(other) < Num(0))
      return true;
  }
  return false;
}

}  // namespace

void gather(PartManifolds& all, const ConvexOnSurface& on, const SurfaceTriangle& t,
            const TriangleContact& contact) {
  const bool behind = t.height(on.middle) < Num(0);
  const Num tolerance = kSamePlane * on.thickness;
  std::size_t index = 0;
  while (index < all.group_count && !is_coplanar(all.groups[index], contact, tolerance)) ++index;
  if (index == all.group_count) {
    if (all.groups.size() == all.group_count) all.groups.emplace_back();
    ++all.group_count;
    Group& group = all.groups[index];
    group.normal = contact.normal;
    group.origin = on_surface(contact.candidates.points[0], contact.normal);
    group.behind = behind;
    group.of_face = contact.of_face;
    group.feature = contact.feature;
    group.points.clear();
  }
  Group& group = all.groups[index];
  // A face knows its normal better than the edge beside it.
  if (contact.of_face && !group.of_face) {
    group.normal = contact.normal;
    group.of_face = true;
  }
  group.behind = group.behind && behind;
  for (int i = 0; i < contact.candidates.count; ++i)
    group.points.push_back(contact.candidates.points[i]);
  if (group.points.size() > static_cast<std::size_t>(kPruneAt)) prune(group, on.thickness);
}

void finish_parts(PartManifolds& all, const SurfacePlacement& at, Num thickness, bool swapped,
                  std::vector<PartManifold>& parts) {
  const std::size_t begin = parts.size();
  for (std::size_t index = 0; index < all.group_count; ++index) {
    Group& group = all.groups[index];
    if (is_back_of_sheet(all, index)) continue;
    prune(group, thickness);
    part_names(group.points);
    ContactCandidates candidates;
    candidates.count = 0;
    for (const ContactPoint& p : group.points)
      if (candidates.count < ContactCandidates::kCapacity)
        candidates.points[candidates.count++] = p;
    Contacts chosen;
    choose_points(candidates, group.normal, kDeepestTie * thickness, chosen);
    PartManifold part;
    part.part = group.of_face ? plane_part(group.normal, group.origin, thickness) : group.feature;
    const NumVec normal = normalized_or(rotate(at.q, group.normal), NumVec{0, 1, 0});
    part.manifold.normal = cast<Real>(swapped ? -normal : normal);
    part.manifold.count = chosen.count;
    for (int i = 0; i < chosen.count; ++i) {
      const ContactPoint& p = chosen.points[i];
      part.manifold.points[i] = {cast<Real>(at.p + rotate(at.q, p.position)),
                                 static_cast<Real>(p.separation),
                                 swapped ? swapped_name(p.feature) : p.feature};
    }
    parts.push_back(part);
  }
  std::stable_sort(parts.begin() + static_cast<std::ptrdiff_t>(begin), parts.end(),
                   [](const PartManifold& a, const PartManifold& b) { return a.part < b.part; });
  for (std::size_t i = begin + 1; i < parts.size(); ++i)
    parts[i].part = std::max(parts[i].part, parts[i - 1].part + 1);
}

}  // namespace plumb::inline PLUMB_ABI::detail
