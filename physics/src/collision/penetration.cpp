#include "collision/penetration.h"

#include "collision/expanding_polytope.h"
#include "collision/gjk.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

RoomAxis room_along(const ConvexCore& a, const ConvexCore& b, NumVec n) {
  const NumVec on_a = a.support(n), on_b = b.support(-n);
  return {n, dot(n, on_b - on_a), on_a, on_b};
}

void consider(const ConvexCore& a, const ConvexCore& b, NumVec n, RoomAxis& best) {
  const RoomAxis axis = room_along(a, b, n);
  if (axis.room > best.room) best = axis;
}

// Directions perpendicular to the flat faces of `of`; sign -1 when it is the second core, whose
// normals point back.
void consider_faces(const ConvexCore& a, const ConvexCore& b, const ConvexCore& of, Num sign,
                    RoomAxis& best) {
  if (const PlacedPolyhedron* p = of.polyhedron()) {
    for (int k = 0; k < p->face_count(); ++k)
      consider(a, b, sign * normalized_or(p->normal(k), NumVec{0, 1, 0}), best);
    return;
  }
  if (!is_curved(of.shape().type)) return;
  consider(a, b, -sign * of.axis(), best);
  if (of.shape().type == ShapeType::Cylinder) consider(a, b, sign * of.axis(), best);
}

// From the axis of a round core or capsule straight at a point.
void consider_sides(const ConvexCore& a, const ConvexCore& b, const ConvexCore& of, Num sign,
                    NumVec towards, RoomAxis& best) {
  if (!of.has_axis()) return;
  const NumVec u = of.axis(), d = towards - of.origin();
  const NumVec radial = normalized_or(d - dot(d, u) * u, any_perpendicular(u));
  consider(a, b, sign * radial, best);
  if (of.shape().type != ShapeType::Cone) return;
  const NumVec slant = Num(2) * of.half().y * radial + of.half().x * u;
  consider(a, b, sign * normalized_or(slant, radial), best);
}

// Straight sides that cross: both along the direction across them.
void consider_crossing(const ConvexCore& a, const ConvexCore& b, RoomAxis& best) {
  const auto directions = [](const ConvexCore& c, NumVec(&out)[3]) {
    if (c.has_axis()) return out[0] = c.axis(), 1;
    if (c.shape().type != ShapeType::Box) return 0;
    for (int i = 0; i < 3; ++i) out[i] = c.polyhedron()->normal(2 * i);
    return 3;
  };
  NumVec of_a[3], of_b[3];
  const int count_a = directions(a, of_a), count_b = directions(b, of_b);
  for (int i = 0; i < count_a; ++i) {
    for (int k = 0; k < count_b; ++k) {
      const NumVec across = cross(of_a[i], of_b[k]);
      if (!(length_squared(across) > kParallelSine)) continue;
      const NumVec n = normalized_or(across, NumVec{0, 1, 0});
      consider(a, b, n, best);
      consider(a, b, -n, best);
    }
  }
}

// Four points of the difference A - B that span a volume, the first along n.
void span_volume(const ConvexCore& a, const ConvexCore& b, NumVec n, NumVec (&out)[4]) {
  const auto farthest = [&](NumVec d) { return a.support(d) - b.support(-d); };
  const auto of_both = [&](NumVec d, NumVec from) {
    const NumVec up = farthest(d), down = farthest(-d);
    return dot(d, up - from) >= dot(d, from - down) ? up : down;
  };
  out[0] = farthest(n);
  out[1] = farthest(-n);
  const NumVec along = normalized_or(out[1] - out[0], n);
  out[2] = of_both(any_perpendicular(along), out[0]);
  out[3] = of_both(normalized_or(cross(out[1] - out[0], out[2] - out[0]), n), out[0]);
}

// Raises `best` to the most room that two overlapping cores have in any direction, to the gap.
void search_all_around(const ConvexCore& a, const ConvexCore& b, Num gap, RoomAxis& best) {
  NumVec first[4];
  span_volume(a, b, best.normal, first);
  ExpandingPolytope polytope(first, a.outer_radius() + b.outer_radius());
  for (int i = 0; i < kDepthMaxIterations; ++i) {
    const ExpandingPolytope::Face* face = polytope.nearest();
    if (face == nullptr || face->distance >= -best.room - gap) return;
    const Num distance = face->distance;
    const RoomAxis axis = room_along(a, b, face->normal);
    if (axis.room > best.room) best = axis;
    if (-axis.room - distance <= gap || !polytope.add(axis.on_a - axis.on_b)) return;
  }
}

}  // namespace

// With the second core moved out by t along n, the direction n' of the closest points has the most
// room there, room(n') + t n . n', and so at least as much as n: room(n') >= room(n) + t (1 - n .
// n'). Repeated it climbs to the end of the valley, at once where that is a face or two edges.
void refine_room(const ConvexCore& a, const ConvexCore& b, Num thickness, RoomAxis& axis) {
  const Num scale = a.outer_radius() + b.outer_radius();
  for (int i = 0; i < kMaxRefinements; ++i) {
    const Num t = kRefineClearance * thickness - axis.room;
    const NumVec n = axis.normal, moved = t * n;
    const GjkResult closest =
        gjk_distance([&a](NumVec d) { return a.support(d); },
                     [&](NumVec d) { return b.support(d) + moved; }, n, scale);
    if (closest.overlap) return;
    const Num gain = room_along(a, b, closest.normal).room - axis.room;
    // Without gain the direction stays; the points are those of a direction as good.
    if (gain > Num(0)) axis.normal = closest.normal, axis.room += gain;
    axis.on_a = closest.on_a;
    axis.on_b = closest.on_b - moved;
    axis.facing = true;
    if (!(gain > kAttained * kAttained * thickness)) return;
  }
}

bool most_room(const ConvexCore& a, const ConvexCore& b, Num thickness, Num reach, RoomAxes& out) {
  constexpr Num kNone = -std::numeric_limits<Num>::infinity();
  const NumVec towards = b.centre() - a.centre();
  const Num scale = a.outer_radius() + b.outer_radius();
  if (!(length_squared(towards) <= (scale + reach) * (scale + reach))) return false;
  RoomAxis face_a{{}, kNone, {}, {}}, face_b{{}, kNone, {}, {}};
  consider_faces(a, b, a, Num(1), face_a);
  consider_faces(a, b, b, Num(-1), face_b);
  if (!(face_a.room <= reach && face_b.room <= reach)) return false;

  const GjkResult cores = gjk_distance([&a](NumVec d) { return a.support(d); },
                                       [&b](NumVec d) { return b.support(d); }, towards, scale);
  RoomAxis best = face_b.room > face_a.room ? face_b : face_a;
  Num preference = kFacePreference * thickness;
  if (!cores.overlap && cores.distance > kNearlyTouching * scale) {
    if (!(cores.distance <= reach)) return false;
    best = {cores.normal, room_along(a, b, cores.normal).room, cores.on_a, cores.on_b, true};
    preference = kAttained * thickness;
  } else {
    consider_sides(a, b, a, Num(1), b.centre(), best);
    consider_sides(a, b, b, Num(-1), a.centre(), best);
    consider_crossing(a, b, best);
    if (!cores.overlap) consider(a, b, cores.normal, best);
    if (best.room < Num(0)) search_all_around(a, b, kDepthGap * thickness, best);
    const bool flat = std::max(face_a.room, face_b.room) >= best.room;
    if (!flat) refine_room(a, b, thickness, best);
  }
  out.best = best;
  out.preferred = face_a.room >= best.room - preference   ? face_a
                  : face_b.room >= best.room - preference ? face_b
                                                          : best;
  return true;
}

}  // namespace plumb::inline PLUMB_ABI::detail
