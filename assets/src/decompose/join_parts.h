// Joins parts again where one hull does for two: cuts for the sake of one corner of a body run
// through all of it.
#pragma once

#include <cstddef>
#include <vector>

#include "decompose/part_hull.h"
#include "decompose/solid_field.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// First all pairs whose common hull stays within the limit and out of the other parts, the one that
// fills least first; then, while there are more than `max_parts`, the one that fills least,
// whatever it fills.
void join_parts(std::vector<PartHull>& parts, const SolidField& solid, const Tolerances& tolerances,
                std::size_t max_parts);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
