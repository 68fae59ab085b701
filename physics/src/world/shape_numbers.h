// A shape as a row of numbers, for snapshots: its place in the Shape variant, up to four sizes, and
// for a hull its place in the list of geometries.
#pragma once

#include <memory>
#include <vector>

#include "plumb/shapes.h"
#include "world/snapshot_geometry.h"

namespace plumb::inline PLUMB_ABI::detail {

struct ShapeNumbers {
  static constexpr std::uint32_t kNoHull = 0xffffffffu;
  std::uint32_t type = 0, hull = kNoHull;
  double n[4]{};
};

using HullList = std::vector<std::shared_ptr<const HullGeometry>>;

// Adds the shape's geometry to `hulls` or `geometries` unless it is there.
ShapeNumbers numbers_of(const Shape& shape, HullList& hulls, GeometryTable& geometries);
// False when the numbers name no shape.
bool shape_from(const ShapeNumbers& numbers, const HullList& hulls, const GeometryTable& geometries,
                Shape& out);

}  // namespace plumb::inline PLUMB_ABI::detail
