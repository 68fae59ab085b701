// Contact points of two supporting features laid over one another along the contact normal, at
// least one of which belongs to a round core: discs, generators of a curved side, polygons, planes.
#pragma once

#include "collision/convex_core.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Overlay {
  NumVec normal;  // unit, from A to B
  Num least;      // [m] the room of the cores along the normal: no point is nearer
  Num band;       // [m] this far beside a feature still counts as on it
  Num tie;        // [m] a rim that rises by less is flat
  Num margin;     // [m] of the cores; points farther apart are left out
};

// Appends the extreme points of the area that the two features share. Each lies midway between
// them. Returns the smallest separation met, infinity where the features share nothing.
Num overlay_features(const SupportFeature& a, const SupportFeature& b, const Overlay& overlay,
                     ContactCandidates& out);

}  // namespace plumb::inline PLUMB_ABI::detail
