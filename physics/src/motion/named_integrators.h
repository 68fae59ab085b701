// Rotation integrators of other engines and of textbooks, for comparison only: they keep neither
// energy nor angular momentum, and the accuracy charts show by how much. The engine's own flow is
// rotation_flow.h.
//
// All take the attitude R (principal axes to world) and the angular velocity w in world axes;
// moments I [kg m^2], inverse moments J [1/(kg m^2)], a time h [s].
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

// Euler's equations from the start of the step, w += h J (I w x w) in body axes, then the
// first-order quaternion. First order; feeds energy into whatever tumbles, until it is infinite.
template <class T>
void advance_explicit_gyro(Quaternion<T>& R_WP, Vector3<T>& w_W, Vector3<T> moments,
                           Vector3<T> inverse_moments, T h) {
  const Vector3<T> w = inverse_rotate(R_WP, w_W);
  const Vector3<T> rate = multiply_each(inverse_moments, cross(multiply_each(moments, w), w));
  w_W = rotate(R_WP, w + h * rate);
  R_WP = turned_first_order(R_WP, w_W, h);
}

// The classical fourth-order Runge-Kutta method on the seven numbers
//   R' = (1/2) R w,   w' = J (I w x w)      w in body axes,
// with R made unit afterwards [Hairer 1993, II.1].
template <class T>
void advance_rk4(Quaternion<T>& R_WP, Vector3<T>& w_W, Vector3<T> moments,
                 Vector3<T> inverse_moments, T h) {
  struct State {
    Quaternion<T> R;
    Vector3<T> w;
  };
  const auto moved = [](const State& y, T s, const State& rate) {
    return State{
        {y.R.x + s * rate.R.x, y.R.y + s * rate.R.y, y.R.z + s * rate.R.z, y.R.w + s * rate.R.w},
        y.w + s * rate.w};
  };
  const auto rate_at = [&](const State& y) {
    const Quaternion<T> turn = y.R * Quaternion<T>{y.w.x, y.w.y, y.w.z, T(0)};
    const T half = T(0.5);
    return State{{half * turn.x, half * turn.y, half * turn.z, half * turn.w},
                 multiply_each(inverse_moments, cross(multiply_each(moments, y.w), y.w))};
  };
  const State start{R_WP, inverse_rotate(R_WP, w_W)};
  const State k1 = rate_at(start);
  const State k2 = rate_at(moved(start, T(0.5) * h, k1));
  const State k3 = rate_at(moved(start, T(0.5) * h, k2));
  const State k4 = rate_at(moved(start, h, k3));
  State end = moved(start, h / T(6), k1);
  end = moved(end, h / T(3), k2);
  end = moved(end, h / T(3), k3);
  end = moved(end, h / T(6), k4);
  R_WP = normalized(end.R);
  w_W = rotate(R_WP, end.w);
}

}  // namespace plumb::inline PLUMB_ABI::detail
