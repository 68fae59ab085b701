// What a decomposition is off by: the figures of its report.
#pragma once

#include <vector>

#include "decompose/part_hull.h"
#include "decompose/solid_field.h"
#include "plumb/assets/decompose.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// Fills in the report of `out`, whose parts are those of `parts` to be, simplified, in the same
// frame. Its mesh_volume and max_distance are set.
void measure(const std::vector<Eigen::Vector3d>& places, const std::vector<Triangle>& faces,
             const SolidField& solid, const std::vector<PartHull>& parts, Decomposition& out);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
