// Surface properties of a collider and how two of them combine.
#pragma once

#include <cstdint>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI {

enum class CombineRule : std::uint8_t { Average, GeometricMean, Minimum, Maximum, Multiply };

struct Material {
  Real friction = Real(0.6);   // Coulomb coefficient [-] >= 0, finite
  Real restitution = Real(0);  // normal velocity kept by a bounce [-] 0..1
  // Where two colliders name different rules, the one that stands later in CombineRule wins.
  CombineRule friction_rule = CombineRule::GeometricMean;
  CombineRule restitution_rule = CombineRule::Maximum;
};

// What meets what. Two colliders meet when each one's `collides_with` holds a bit of the other's
// `layers`.
struct Filter {
  std::uint32_t layers = 1u;
  std::uint32_t collides_with = 0xffffffffu;
};

}  // namespace plumb::inline PLUMB_ABI
