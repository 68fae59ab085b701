// A shape as a row of numbers, for snapshots: its place in the Shape variant, up to four sizes, and
// for a hull its place in the list of geometries.
#pragma once

#include <memory>
#include <vector>

#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI::detail {

struct ShapeNumbers {
  static constexpr std::uint32_t kNoHull = 0xffffffffu;
  std::uint32_t type = 0, hull = kNoHull;
  double n[4]{};
};

// Adds the shape's geometry to `hulls` unless it is there.
ShapeNumbers numbers_of(const Shape& shape,
                        std::vector<std::shared_ptr<const HullGeometry>>& hulls);
// False when the numbers name no shape.
bool shape_from(const ShapeNumbers& numbers,
                const std::vector<std::shared_ptr<const HullGeometry>>& hulls, Shape& out);

}  // namespace plumb::inline PLUMB_ABI::detail
