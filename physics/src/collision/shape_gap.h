// How far apart two placed shapes are, or how deep in one another, in double precision.
#pragma once

#include "collision/contact_points.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Gap {
  Num distance;       // [m] signed: minus the least translation that parts them
  NumVec on_a, on_b;  // [m] points of the surfaces that far apart along the normal
  NumVec normal;      // unit, from A to B
};

// guess: any vector from A to B; the normal found before makes the next search short. Of two
// half-spaces the distance is infinite: they are never asked about one another.
Gap gap_between(const Placed& a, const Placed& b, NumVec guess);
// Touching counts. Cheaper, because nobody wants to know how deep.
bool shapes_overlap(const Placed& a, const Placed& b);

}  // namespace plumb::inline PLUMB_ABI::detail
