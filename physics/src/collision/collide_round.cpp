// Spheres and capsules among themselves: closest points of the cores, minus the radii.
#include "collision/collide_pairs.h"
#include "collision/segment.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr std::uint32_t kSingle = pair_name(face_name(0), face_name(0));

Segment axis_of(const Placed& capsule) {
  const NumVec half = rotate(capsule.q, to_num(capsule.shape.half));
  return {capsule.p - half, capsule.p + half};
}

// One point between core points pa and pb. `fallback` is the normal where they coincide.
void add_core_contact(NumVec pa, Num ra, NumVec pb, Num rb, NumVec fallback, Num margin,
                      Contacts& out) {
  const NumVec d = pb - pa;
  const Num distance = length(d), separation = distance - ra - rb;
  if (out.parted(separation, margin)) return;
  out.normal = distance > kTouching * (ra + rb) ? normalized_or(d, fallback) : fallback;
  // Halfway between the surface points pa + ra n and pb - rb n.
  out.add(Num(0.5) * (pa + pb + (ra - rb) * out.normal), separation, kSingle);
}

// The parts of two capsules that run beside one another, if they do so nearly in parallel: a point
// at each end of that part, both along the one normal. The separation along it is exact, the
// contact points lie on the surfaces to kParallelCapsules^2 / 2 of the radii.
bool add_parallel_contacts(const Segment& a, Num ra, const Segment& b, Num rb, NumVec normal,
                           Num margin, Contacts& out) {
  const NumVec da = a.end - a.start, db = b.end - b.start;
  const Num aa = dot(da, da), ab = dot(da, db);
  const Num start = dot(b.start - a.start, da) / aa, end = dot(b.end - a.start, da) / aa;
  if (!(ab * ab >= (Num(1) - kParallelTilt * kParallelTilt) * aa * dot(db, db))) return false;
  const Num lower = std::max(Num(0), std::min(start, end));
  const Num upper = std::min(Num(1), std::max(start, end));
  const Num reach = ra + rb, aside_limit = kParallelCapsules * reach;
  if (!(upper > lower && (upper - lower) * (upper - lower) * aa > aside_limit * aside_limit))
    return false;
  const Num at[2] = {lower, upper};
  const int start_of_b = start < end ? 0 : 1;  // which of the two ends belongs to b.start
  NumVec on_a[2];
  Num gap[2];
  for (int i = 0; i < 2; ++i) {
    on_a[i] = point_at(a, at[i]);
    const NumVec on_b = point_at(b, (at[i] - start) / (end - start));
    gap[i] = dot(on_b - on_a[i], normal);
    const NumVec aside = on_b - on_a[i] - gap[i] * normal;
    if (length_squared(aside) > aside_limit * aside_limit) return false;
  }
  for (int i = 0; i < 2; ++i) {
    const Num separation = gap[i] - reach;
    if (!(separation <= margin)) continue;
    const bool end_of_a = at[i] == Num(i);
    const std::uint32_t name = end_of_a
                                   ? pair_name(vertex_name(i), face_name(0))
                                   : pair_name(face_name(0), vertex_name(i == start_of_b ? 0 : 1));
    out.add(on_a[i] + (ra + Num(0.5) * separation) * normal, separation, name);
  }
  return out.count > 0;
}

}  // namespace

void collide_spheres(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  add_core_contact(a.p, a.shape.radius, b.p, b.shape.radius, {0, 1, 0}, margin, out);
}

void collide_capsule_sphere(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const Segment axis = axis_of(a);
  const NumVec on_axis = point_at(axis, closest_parameter(axis, b.p));
  const NumVec along = normalized_or(axis.end - axis.start, {0, 1, 0});
  add_core_contact(on_axis, a.shape.radius, b.p, b.shape.radius, any_perpendicular(along), margin,
                   out);
}

void collide_capsules(const Placed& a, const Placed& b, Num margin, Contacts& out) {
  const Segment axis_a = axis_of(a), axis_b = axis_of(b);
  const Num ra = a.shape.radius, rb = b.shape.radius;
  const SegmentParameters at = closest_parameters(axis_a, axis_b);
  const NumVec pa = point_at(axis_a, at.a), pb = point_at(axis_b, at.b);
  const NumVec da = normalized_or(axis_a.end - axis_a.start, {0, 1, 0});
  const NumVec db = normalized_or(axis_b.end - axis_b.start, {0, 1, 0});
  // Cores that cross part soonest along the direction across both, away from the centres.
  const NumVec across = cross(da, db);
  NumVec fallback = length_squared(across) > kParallelSine * kParallelSine
                        ? normalized_or(across, {0, 1, 0})
                        : any_perpendicular(da);
  if (dot(fallback, pb - pa) < Num(0)) fallback = -fallback;
  add_core_contact(pa, ra, pb, rb, fallback, margin, out);
  if (out.count == 0) return;
  const ContactPoint single = out.points[0];
  out.count = 0;
  if (!add_parallel_contacts(axis_a, ra, axis_b, rb, out.normal, margin, out)) {
    out.count = 0;
    out.points[out.count++] = single;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
