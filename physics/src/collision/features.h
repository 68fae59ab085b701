// Names of the features (vertex, edge, face) that meet in a contact point: 16 bits for each shape,
// so that the same pair of features has the same name whichever of them is called the reference.
#pragma once

#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

using FeatureName = std::uint16_t;  // of one shape: 2 bits kind, 14 bits index

constexpr FeatureName vertex_name(int index) { return static_cast<FeatureName>(index); }
constexpr FeatureName edge_name(int index) { return static_cast<FeatureName>(0x4000 | index); }
constexpr FeatureName face_name(int index) { return static_cast<FeatureName>(0x8000 | index); }

constexpr std::uint32_t pair_name(FeatureName a, FeatureName b) {
  return (static_cast<std::uint32_t>(a) << 16) | b;
}
constexpr std::uint32_t swapped_name(std::uint32_t pair) { return (pair << 16) | (pair >> 16); }

}  // namespace plumb::inline PLUMB_ABI::detail
