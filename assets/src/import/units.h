// What the reader's metadata say about units and axes.
#pragma once

#include <Eigen/Core>

#include "plumb/assets/import.h"
#include "plumb/assets/result.h"

struct aiScene;

namespace plumb::inline PLUMB_ABI::assets::detail {

// From what the reader hands out to metres in world axes: p_world = M p_reader, applied after the
// node transforms. Fills in units, axes and notes of the report.
Result<Eigen::Matrix3d> to_world(const aiScene& scene, const std::string& extension,
                                 const ImportOptions& options, ImportReport& report);

}  // namespace plumb::inline PLUMB_ABI::assets::detail
