// How far a convex part reaches beyond the solid it stands for: the depth of the hollows it fills.
#pragma once

#include "decompose/part_hull.h"
#include "decompose/solid_field.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// Whether all points of the part are within `limit` > 0 of the solid. Yes is proven; a part that
// keeps the limit by less than a sixteenth of it may be a no.
bool stays_within(const PartHull& part, const SolidField& solid, double limit);

// The distance from the solid of the farthest point of the part that was looked at, with points
// `resolution` > 0 apart where it might be exceeded.
double reach_beyond(const PartHull& part, const SolidField& solid, double resolution);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
