// Choosing instead of branching, for one number; math/wide.h has the same for W of them. What is
// written with these serves both.
#pragma once

#include <cmath>
#include <type_traits>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail {

// The answer to a comparison of two T.
template <class T>
struct MaskFor {
  using Type = bool;
};
template <class T>
using MaskOf = typename MaskFor<T>::Type;

template <class T>
  requires std::is_floating_point_v<T>
constexpr T select(bool condition, T yes, T no) {
  return condition ? yes : no;
}
template <class T>
  requires std::is_floating_point_v<T>
T root_of(T a) {
  return std::sqrt(a);
}
constexpr bool any(bool m) { return m; }
constexpr bool all(bool m) { return m; }
constexpr bool negate(bool m) { return !m; }

// The larger (smaller) one; the first where they are equal or cannot be compared.
template <class T>
constexpr T larger_of(T a, T b) {
  return select(a < b, b, a);
}
template <class T>
constexpr T smaller_of(T a, T b) {
  return select(b < a, b, a);
}
template <class T>
constexpr T size_of(T a) {
  return larger_of(a, -a);
}

}  // namespace plumb::inline PLUMB_ABI::detail
