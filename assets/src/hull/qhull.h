// One run of Qhull [Barber 1996]: points in, outward polygons out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/assets/result.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

using Polygons =
    std::vector<std::vector<std::uint32_t>>;  // point numbers, counter-clockwise from outside

struct QhullRun {
  Polygons polygons;
  double outer = 0;  // no point stands farther out of a face than this, by Qhull's own account
};

// `points` should be of size about 1; faces flat to `coplanar_tolerance` are merged.
Result<QhullRun> run_qhull(const std::vector<Eigen::Vector3d>& points, double coplanar_tolerance);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
