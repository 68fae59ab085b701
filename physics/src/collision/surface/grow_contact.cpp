#include "collision/gjk.h"
#include "collision/surface/surface_contact.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// By how much less than the rounding the point at its distance below a point of the core lies from
// the core [m].
Num missed(const ConvexOnSurface& on, const ConvexCore& core, NumVec on_core, NumVec n) {
  const NumVec below = on_core - on.rounding * n;
  const GjkResult gap =
      gjk_distance([&](NumVec) { return below; }, [&](NumVec d) { return core.support(d); },
                   core.centre() - below, core.outer_radius());
  return on.rounding - gap.distance;
}

}  // namespace

void grow_contact(const ConvexOnSurface& on, const ConvexCore& core, TriangleContact& contact) {
  ContactCandidates& list = contact.candidates;
  const NumVec n = contact.normal;
  int deepest = 0, kept = 0;
  for (int i = 1; i < list.count; ++i)
    if (list.points[i].separation < list.points[deepest].separation) deepest = i;
  for (int i = 0; i < list.count; ++i) {
    ContactPoint point = list.points[i];
    const NumVec on_core = point.position + (Num(0.5) * point.separation) * n;
    if (i != deepest && missed(on, core, on_core, n) > kGrownMiss * on.rounding) continue;
    point.separation -= on.rounding;
    point.position -= (Num(0.5) * on.rounding) * n;
    list.points[kept++] = point;
  }
  list.count = kept;
}

}  // namespace plumb::inline PLUMB_ABI::detail
