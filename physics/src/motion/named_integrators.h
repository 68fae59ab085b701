// Rotation integrators of other engines, for comparison only: they keep neither energy nor angular
// momentum, and the accuracy charts show by how much. The engine's own flow is rotation_flow.h.
//
// Both take the attitude R (principal axes to world) and the angular velocity w in world axes.
#pragma once

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

// R' = (1/2) w R taken over the step in one go, then made unit again.
template <class T>
Quaternion<T> turned_first_order(Quaternion<T> R, Vector3<T> w, T h) {
  const Quaternion<T> rate = Quaternion<T>{w.x, w.y, w.z, T(0)} * R;
  const T s = T(0.5) * h;
  return normalized(
      Quaternion<T>{R.x + s * rate.x, R.y + s * rate.y, R.z + s * rate.z, R.w + s * rate.w});
}

// The game-physics books: w stays as it is (no w x I w), first-order quaternion [Millington 2010].
// Turns too slowly by (|w| h)^2/12 (-2 % at |w| h = 0.5), and L follows the body about.
template <class T>
void advance_book(Quaternion<T>& R_WP, Vector3<T> w_W, T h) {
  R_WP = turned_first_order(R_WP, w_W, h);
}

// The implicit gyroscopic step of several engines: one Newton step, from w, on
//   f(w1) = I (w1 - w) + h w1 x I w1 = 0      in body axes,
//   df/dw = I + h ([w]x I - [I w]x),
// then the first-order quaternion. Stable at any h because it takes energy out [Catto 2015].
template <class T>
void advance_implicit_gyro(Quaternion<T>& R_WP, Vector3<T>& w_W, Vector3<T> moments, T h) {
  const Vector3<T> w = inverse_rotate(R_WP, w_W);
  const Vector3<T> I = moments;
  const Vector3<T> f = h * cross(w, multiply_each(I, w));
  // The columns of df/dw. Off the diagonal row 1 holds I3 - I2, row 2 I1 - I3, row 3 I2 - I1, each
  // times h and the component of w that neither row nor column names.
  const Vector3<T> c0{I.x, h * w.z * (I.x - I.z), h * w.y * (I.y - I.x)};
  const Vector3<T> c1{h * w.z * (I.z - I.y), I.y, h * w.x * (I.y - I.x)};
  const Vector3<T> c2{h * w.y * (I.z - I.y), h * w.x * (I.x - I.z), I.z};
  const T determinant = dot(c0, cross(c1, c2));
  if (determinant != T(0)) {         // zero only for a body that cannot turn about some axis
    const T s = T(1) / determinant;  // Cramer's rule
    const Vector3<T> dw{s * dot(f, cross(c1, c2)), s * dot(c0, cross(f, c2)),
                        s * dot(c0, cross(c1, f))};
    w_W = rotate(R_WP, w - dw);
  }
  R_WP = turned_first_order(R_WP, w_W, h);
}

}  // namespace plumb::inline PLUMB_ABI::detail
