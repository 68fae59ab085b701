#include <cstdio>

#include "plumb/assets/decompose.h"

namespace plumb::inline PLUMB_ABI::assets {

std::string DecompositionReport::text() const {
  char line[512];
  std::snprintf(
      line, sizeof line,
      "%zu convex part%s with %zu vertices (%zu at most); %.4g m^3 for %.4g m^3 of mesh, "
      "%.2g m^3 of it shared; reaching %.3g m out of the mesh (%.3g m asked for), leaving "
      "out %.2g m",
      parts, parts == 1 ? "" : "s", vertices, most_vertices, parts_volume, mesh_volume,
      overlap_volume, parts_beyond_mesh, max_distance, mesh_beyond_parts);
  std::string text = line;
  if (!within_distance)
    text += "; NOT within the distance: allow more parts, more vertices or a larger distance";
  return text;
}

}  // namespace plumb::inline PLUMB_ABI::assets
