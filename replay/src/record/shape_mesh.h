// Triangles for the shapes that the viewer has no primitive for: cylinders, cones, rounded boxes
// and hulls. For looking at only; the engine never sees them.
#pragma once

#include <optional>

#include "plumb/replay/recorder.h"
#include "plumb/shapes.h"

namespace plumb::inline PLUMB_ABI {
namespace replay::detail {

// Empty for shapes that are drawn as primitives or from their own geometry.
std::optional<VisualMesh> mesh_of_shape(const Shape& shape);

}  // namespace replay::detail
}  // namespace plumb::inline PLUMB_ABI
