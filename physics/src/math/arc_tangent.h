// The angle of (x, y), from the same operations on every system (the C library's differs in the
// last bit between systems).
#pragma once

#include <cmath>

namespace plumb::inline PLUMB_ABI::detail {

// atan t for 0 <= t <= 1: two halvings, atan t = 2 atan(t / (1 + sqrt(1 + t^2))), bring t below
// tan(pi/16) = 0.199, where the series is done after t^23 (0.199^25 / 25 = 1e-19).
inline double arc_tangent_below_one(double t) {
  t = t / (1 + std::sqrt(1 + t * t));
  t = t / (1 + std::sqrt(1 + t * t));
  const double t2 = t * t;
  double sum = 0;
  for (int n = 23; n >= 3; n -= 2) sum = t2 * (1.0 / n - sum);
  return 4 * t * (1 - sum);
}

// In (-pi, pi]; 0 at the origin.
template <class T>
T arc_tangent(T y_of, T x_of) {
  constexpr double kPi = 3.14159265358979323846;
  const double y = static_cast<double>(y_of), x = static_cast<double>(x_of);
  const double ax = std::abs(x), ay = std::abs(y);
  if (!(ax > 0) && !(ay > 0)) return T(0);
  const double first =
      ay <= ax ? arc_tangent_below_one(ay / ax) : 0.5 * kPi - arc_tangent_below_one(ax / ay);
  const double upper = x < 0 ? kPi - first : first;
  return static_cast<T>(y < 0 ? -upper : upper);
}

}  // namespace plumb::inline PLUMB_ABI::detail
