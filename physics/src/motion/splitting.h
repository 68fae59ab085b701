// Free rotation split into rotations about the principal axes, for comparison with the exact flow.
//
// The energy is a sum of three terms m_i^2 J_i/2, and each alone is solved at once: the body turns
// about its own axis i by m_i J_i h, with m_i constant [McLachlan 1993]. Taken in turn, half of
// each on both sides of the middle one, they give a symmetric method of order 2 that keeps L
// exactly and energy within bounds; symmetric compositions of it give higher orders [Hairer 2006,
// V.3].
//
// R attitude (principal axes to world), L [kg m^2/s] in world axes, J [1/(kg m^2)], a time h [s] of
// either sign.
#pragma once

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

// The flow of the one term m_i^2 J_i/2.
template <class T>
void turn_about_axis(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> J, int axis, T h) {
  T sine, cosine;
  sin_cos(T(0.5) * h * component(J, axis) * component(inverse_rotate(R_WP, L_W), axis), sine,
          cosine);
  Vector3<T> about{T(0), T(0), T(0)};
  set_component(about, axis, sine);
  R_WP = normalized(R_WP * Quaternion<T>{about.x, about.y, about.z, cosine});
}

// Order 2: halves of x and y, the whole of z, halves of y and x.
template <class T>
void advance_splitting(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> J, T h) {
  const T half = T(0.5) * h;
  turn_about_axis(R_WP, L_W, J, 0, half);
  turn_about_axis(R_WP, L_W, J, 1, half);
  turn_about_axis(R_WP, L_W, J, 2, h);
  turn_about_axis(R_WP, L_W, J, 1, half);
  turn_about_axis(R_WP, L_W, J, 0, half);
}

// Order 4: five steps of p, p, 1 - 4 p, p, p with p = 1/(4 - 4^(1/3)), for which the third-order
// errors cancel [Suzuki 1990].
template <class T>
void advance_splitting4(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> J, T h) {
  constexpr double kShare = 0.41449077179437573714;
  const T outer = T(kShare) * h, middle = T(1 - 4 * kShare) * h;
  for (const T part : {outer, outer, middle, outer, outer}) advance_splitting(R_WP, L_W, J, part);
}

}  // namespace plumb::inline PLUMB_ABI::detail
