// From gathered contacts to manifolds.
#pragma once

#include "collision/part_manifolds.h"

namespace plumb::inline PLUMB_ABI::detail {

// The surface, from the reference point of the pair.
struct SurfacePlacement {
  NumVec p;  // [m]
  NumRotation q;
};

// Appends one manifold a group, in ascending order of part. `swapped`: the surface is the second
// shape. `thickness` [m]: half of the convex shape's smallest.
void finish_parts(PartManifolds& all, const SurfacePlacement& at, Num thickness, bool swapped,
                  std::vector<PartManifold>& parts);

}  // namespace plumb::inline PLUMB_ABI::detail
