// Fewer vertices for a hull: the pieces that hull building and simplification share.
#pragma once

#include <cstddef>
#include <vector>

#include "hull/qhull.h"
#include "plumb/assets/hull.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

// Half the cross products of a fan: normal times area [m^2].
Eigen::Vector3d polygon_area_vector(const std::vector<Eigen::Vector3d>& vertices,
                                    const std::vector<std::uint32_t>& face);

// The polygons with the points they use, in the order of the input.
HullMesh compact_hull(const std::vector<Eigen::Vector3d>& points, const Polygons& polygons);

// Grows a hull from few of the vertices, always adding the one farthest outside, until there are
// `max_vertices`; then measures what was left out. Works on hulls of size about 1.
Result<HullMesh> simplified(const HullMesh& full, std::size_t max_vertices,
                            double coplanar_tolerance);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
