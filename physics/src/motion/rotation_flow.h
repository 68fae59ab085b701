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
// Asymmetric  n is carried on in closed form, by Weierstrass's functions (midpoint_turn.h).
//             The attitude follows from n alone. R1^T R0 takes n0 to n1; so does the shortest
//             rotation from n0 to n1, and what the two differ by is a turn about n0:
//                  R1 = R0 Rot(n0, phi) Shortest(n1 -> n0).
//             Differentiating, with the spin of the shortest rotation about n0 written out,
//                  phi' = c - (c n0.n - n0.(g * n)) / (1 + n0.n),   c = n . (g * n) = 2 E h / l.
//             c is constant. The fraction is the rate at which the arc n(t) and its chord enclose
//             solid angle, the geometric phase [Montgomery 1991]; it starts as t^2. Its integral
//             is had by a quadrature made for that. The middle of the piece takes the place of n0:
//             of the fraction only the even half counts there.
//
// Where that is good. The nearest complex singularity of n in time lies no nearer than set by the
// tumble rate s,  s^2 = |b2 b3| n1^2 + |b3 b1| n2^2 + |b1 b2| n3^2,  b = (g3 - g2, g1 - g3, g2 -
// g1): x_i = n_i sqrt|b_j b_k| obey x1' = +-x2 x3, whose solutions are elliptic functions of at
// most s t, with poles at distance >= (pi/2)/s from real time [DLMF 22.4]. Steps are cut so that s
// stays below a limit; fast spin about L alone costs nothing. No case is left out: near-symmetric
// bodies, the separatrix, steady spins and rest are ordinary values. |w| h is no substitute for s
// h: it is larger without need for bodies close to a ball (s <= 0.91 |w| was the largest found for
// real bodies), and too small by any factor where axes are locked.
//
// Splittings into rotations about body axes [McLachlan 1993], [Celledoni 2008] cost more and have
// an order of convergence to watch, as has the Taylor series of n [Moore 1966]. Jacobi's functions
// of the whole time, and the attitude by theta functions [van Zon 2007], cost more and lose digits
// near the separatrix.
#pragma once

#include "math/quaternion.h"
#include "motion/midpoint_turn.h"

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

// A step is cut into no more pieces than this: 1200 rad of tumbling in double. Faster motion has no
// meaning at such a step; the body then turns steadily about L, which keeps energy and momentum.
inline constexpr int kMaxPieces = 4096;

// Square of the tumble rate times step (see above) [rad^2].
template <class T>
constexpr T tumble_squared(Vector3<T> n, Vector3<T> g) {
  const T b1 = size_of(g.z - g.y), b2 = size_of(g.x - g.z), b3 = size_of(g.y - g.x);
  return b2 * b3 * (n.x * n.x) + b3 * b1 * (n.y * n.y) + b1 * b2 * (n.z * n.z);
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

// g [rad]: half a piece's.
template <class T>
void turn_in_pieces(Quaternion<T>& R, Vector3<T> direction, Vector3<T> g, int pieces) {
  for (int i = 0; i < pieces; ++i) {
    R = normalized(R * midpoint_turn<T>(inverse_rotate(R, direction), g, sin_cos<T>));
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
  constexpr T kLimit = PieceChoice<T>::kLimit;
  T size;
  Vector3<T> direction;
  if (!flow::split(L_W, size, direction)) return;
  const Vector3<T> g = (h * size) * J;
  const Vector3<T> n = inverse_rotate(R_WP, direction);
  const T tumble = std::sqrt(tumble_squared(n, g));
  if (tumble <= T(kMaxPieces) * kLimit) {
    const int pieces = std::max(1, static_cast<int>(std::ceil(tumble / kLimit)));
    flow::turn_in_pieces(R_WP, direction, (T(0.5) / static_cast<T>(pieces)) * g, pieces);
  } else {
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
