// Torque-free rotation, exact to round-off.
//
// State: attitude R (principal axes P to world, a unit quaternion) and angular momentum L in world
// axes, which no part of the flow touches. J = 1/I are the inverse principal moments; J_i = 0 is an
// axis about which the body cannot turn (infinite inertia), as good a value as any other here.
//
// With l = |L|, n = R^T L / l (the direction of L seen from the body) and g = h l J, in units of
// the step h:                     turn rate = g * n (entry by entry),   n' = n x (g * n) [Euler]
// Three cases (classify_inertia):
//
// Isotropic   The turn rate is L J in world axes, constant: R1 = exp(h J L) R0.
//
// Symmetric   J_a = J_b = J_t about the axis c: turn rate = J_t m + (J_c - J_t) m_c e_c with m_c
//             constant, so R1 = exp(h J_t L) R0 exp(h (J_c - J_t) m_c e_c): precession in space,
//             spin in the body, exact at any h [Goldstein 2002, 5.6].
//
// Asymmetric  1. n by its power series: the equation is quadratic, so its coefficients follow from
//                products of the earlier ones [Moore 1966], with b = (g3 - g2, g1 - g3, g2 - g1):
//                     (k+1) n1[k+1] = b1 sum_j n2[j] n3[k-j]   and cyclic.
//             2. The attitude from n alone. R1^T R0 takes n0 to n1; so does the shortest rotation
//                from n0 to n1, and what the two differ by is a turn about n0:
//                     R1 = R0 Rot(n0, phi) Shortest(n1 -> n0).
//                Differentiating, with the spin of the shortest rotation about n0 written out,
//                     phi' = c - (c n0.n - n0.(g * n)) / (1 + n0.n),   c = n . (g * n) = 2 E h / l.
//                c is constant. The fraction is the rate at which the arc n(t) and its chord
//                enclose solid angle, the geometric phase [Montgomery 1991]; it starts as t^2. Its
//                series comes from one division of series.
//
// Where the series is good. n moves no faster, and the nearest complex singularity of its time lies
// no nearer, than set by the tumble rate s,  s^2 = |b2 b3| n1^2 + |b3 b1| n2^2 + |b1 b2| n3^2:
// x_i = n_i sqrt|b_j b_k| obey x1' = +-x2 x3, whose solutions are Jacobi's elliptic functions of at
// most s t, with poles at distance >= (pi/2)/s from real time [DLMF 22.4]. Steps are cut so that s
// stays below a limit; fast spin about L alone costs nothing. No case is left out: near-symmetric
// bodies, the separatrix, steady spins and rest are ordinary values.
//
// Splittings into rotations about body axes [McLachlan 1993], [Celledoni 2008] cost the same and
// have an order of convergence to watch. The closed form in elliptic functions [van Zon 2007] costs
// more and loses digits near the separatrix.
#pragma once

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

enum class RotationKind : unsigned char { Isotropic, Symmetric, Asymmetric };

// By equality to the last bit, of moments or of inverse moments: any other body is right under the
// asymmetric flow too, which only costs more.
template <class T>
constexpr RotationKind classify_inertia(Vector3<T> moments) {
  const bool xy = moments.x == moments.y, yz = moments.y == moments.z, xz = moments.x == moments.z;
  if (xy && yz) return RotationKind::Isotropic;
  return xy || yz || xz ? RotationKind::Symmetric : RotationKind::Asymmetric;
}

// Orders of the series, and the tumble rate times step s h up to which each leaves less than the
// round-off of its type (1e-16, 6e-8). Largest truncation error of the attitude [rad]; the same for
// random bodies, next to the separatrix and with locked axes, and growing as (s h)^(order + 1):
//   s h        0.06   0.10     0.20     0.30     0.40     0.50     1.00
//   order 4    2e-8   2e-7     7e-6     5e-5     2e-4     7e-4     2e-2
//   order 8           1e-12    5e-10    2e-8     3e-7     2e-6     1e-3
//   order 16                   < 1e-16  2e-15    3e-13    1e-11    2e-6
// |w| h is no substitute for s h: it is larger without need for bodies close to a ball (s <= 0.91
// |w| was the largest found for real bodies), and too small by any factor where axes are locked.
template <class T>
struct SeriesChoice;
template <>
struct SeriesChoice<double> {
  static constexpr int kShortOrder = 8, kLongOrder = 16;
  static constexpr double kShortLimit = 0.04, kLongLimit = 0.25;  // [rad]
};
template <>
struct SeriesChoice<float> {
  static constexpr int kShortOrder = 4, kLongOrder = 8;
  static constexpr float kShortLimit = 0.06f, kLongLimit = 0.30f;  // [rad]
};

// A step is cut into no more pieces than this: 1000 rad of tumbling in double. Faster motion has no
// meaning at such a step; the body then turns steadily about L, which keeps energy and momentum.
inline constexpr int kMaxPieces = 4096;

// Square of the tumble rate times step (see above) [rad^2].
template <class T>
constexpr T tumble_squared(Vector3<T> n, Vector3<T> g) {
  const T b1 = size_of(g.z - g.y), b2 = size_of(g.x - g.z), b3 = size_of(g.y - g.x);
  return b2 * b3 * (n.x * n.x) + b3 * b1 * (n.y * n.y) + b1 * b2 * (n.z * n.z);
}

// The turn of the body over one step, in its axes at the start: R1 = normalized(R0 * result). Not a
// unit quaternion. Free of branches, so that T may be several numbers side by side.
//   n0  direction of L in principal axes, unit (or zero: no turn)
//   g   h |L| J [rad], with tumble_squared(n0, g) below the square of the order's limit
//   sine_and_cosine  (T angle, T& s, T& c)
template <int Order, class T, class SinCos>
Quaternion<T> series_turn(Vector3<T> n0, Vector3<T> g, SinCos&& sine_and_cosine) {
  const Vector3<T> b{g.z - g.y, g.x - g.z, g.y - g.x};
  const T c = dot(n0, multiply_each(g, n0));
  const Vector3<T> weight = multiply_each(Vector3<T>{c - g.x, c - g.y, c - g.z}, n0);

  Vector3<T> n[Order + 1];
  n[0] = n0;
  for (int k = 0; k < Order; ++k) {
    Vector3<T> sum{n[0].y * n[k].z, n[0].z * n[k].x, n[0].x * n[k].y};
    for (int j = 1; j <= k; ++j) {
      sum += Vector3<T>{n[j].y * n[k - j].z, n[j].z * n[k - j].x, n[j].x * n[k - j].y};
    }
    n[k + 1] = multiply_each((T(1) / T(static_cast<float>(k + 1))) * b, sum);
  }

  // With X = series of n0.n (X[0] = 1, X[1] = 0) and F = c X - n0.(g * n), which begins at t^2:
  // fraction W = F / (1 + X), so 2 W[k] = F[k] - sum_j X[j] W[k-j]; `enclosed` is its integral.
  T X[Order + 1], W[Order + 1];
  T enclosed = T(0);
  for (int k = 2; k <= Order; ++k) {
    X[k] = dot(n0, n[k]);
    T rest = dot(weight, n[k]);
    for (int j = 2; j <= k - 2; ++j) rest = rest - X[j] * W[k - j];
    W[k] = T(0.5) * rest;
    enclosed = enclosed + (T(1) / T(static_cast<float>(k + 1))) * W[k];
  }

  Vector3<T> moved = n[Order];  // n1 - n0, small terms first
  for (int k = Order - 1; k >= 1; --k) moved += n[k];
  T sine, cosine;
  sine_and_cosine(T(0.5) * (c - enclosed), sine, cosine);
  const Vector3<T> about = sine * n0;
  const Vector3<T> chord = cross(moved, n0);  // n1 x n0
  return Quaternion<T>{about.x, about.y, about.z, cosine} *
         Quaternion<T>{chord.x, chord.y, chord.z, T(2) + dot(n0, moved)};
}

namespace flow {

// L = size * direction, safe against squares that under- or overflow. False for zero (or NaN).
template <class T>
bool split(Vector3<T> L, T& size, Vector3<T>& direction) {
  const Vector3<T> a = absolute(L);
  const T largest = std::max(a.x, std::max(a.y, a.z));
  if (!(largest > T(0))) return false;
  const Vector3<T> scaled{L.x / largest, L.y / largest, L.z / largest};
  const T scaled_length = length(scaled);
  size = largest * scaled_length;
  direction = (T(1) / scaled_length) * scaled;
  return true;
}

template <int Order, class T>
void turn_in_pieces(Quaternion<T>& R, Vector3<T> direction, Vector3<T> g, int pieces) {
  for (int i = 0; i < pieces; ++i) {
    R = normalized(R * series_turn<Order>(inverse_rotate(R, direction), g, sin_cos<T>));
  }
}

}  // namespace flow

// The three cases, over a time h [s] of either sign. L [kg m^2/s] world axes, J [1/(kg m^2)] >= 0.

template <class T>
void advance_isotropic(Quaternion<T>& R_WP, Vector3<T> L_W, T inverse_moment, T h) {
  R_WP = normalized(from_rotation_vector((h * inverse_moment) * L_W) * R_WP);
}

template <class T>
void advance_symmetric(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> J, T h) {
  const int axis = J.x == J.y ? 2 : (J.y == J.z ? 0 : 1);
  const T across = component(J, axis == 0 ? 1 : 0);
  const T m = component(inverse_rotate(R_WP, L_W), axis);
  Vector3<T> spin{T(0), T(0), T(0)};
  set_component(spin, axis, h * (component(J, axis) - across) * m);
  R_WP = normalized(from_rotation_vector((h * across) * L_W) * (R_WP * from_rotation_vector(spin)));
}

template <class T>
void advance_asymmetric(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> J, T h) {
  using Choice = SeriesChoice<T>;
  T size;
  Vector3<T> direction;
  if (!flow::split(L_W, size, direction)) return;
  const Vector3<T> g = (h * size) * J;
  const T tumble = std::sqrt(tumble_squared(inverse_rotate(R_WP, direction), g));
  if (tumble <= Choice::kShortLimit) {
    flow::turn_in_pieces<Choice::kShortOrder>(R_WP, direction, g, 1);
  } else if (tumble <= T(kMaxPieces) * Choice::kLongLimit) {
    const int pieces = static_cast<int>(std::ceil(tumble / Choice::kLongLimit));
    flow::turn_in_pieces<Choice::kLongOrder>(R_WP, direction, (T(1) / static_cast<T>(pieces)) * g,
                                             pieces);
  } else {
    const Vector3<T> n = inverse_rotate(R_WP, direction);
    R_WP = normalized(from_rotation_vector(dot(n, multiply_each(g, n)) * direction) * R_WP);
  }
}

// Whichever case applies.
template <class T>
void advance_rotation(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> inverse_moments, T h) {
  switch (classify_inertia(inverse_moments)) {
    case RotationKind::Isotropic:
      advance_isotropic(R_WP, L_W, inverse_moments.x, h);
      return;
    case RotationKind::Symmetric:
      advance_symmetric(R_WP, L_W, inverse_moments, h);
      return;
    case RotationKind::Asymmetric:
      advance_asymmetric(R_WP, L_W, inverse_moments, h);
      return;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
