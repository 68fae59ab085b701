// How a body that rows hold goes through a substep, and how a free one flies through a step: the
// plain case, without damping or locked axes, for one number or W side by side (math/wide.h).
// Everything else takes the way of body_substep.h.
#pragma once

#include <limits>

#include "math/quaternion.h"
#include "math/wide.h"
#include "motion/rotation_flow.h"

namespace plumb::inline PLUMB_ABI::detail {

// One body, or W of them.
template <class T>
struct BodyLanes {
  Vector3<T> v, w, L;     // [m/s], [rad/s], [kg m^2/s]
  Vector3<T> dp;          // [m] since the step began
  Quaternion<T> dq;       // ... world axes
  Quaternion<T> start;    // R_WP when the step began
  Vector3<T> J;           // [1/(kg m^2)] about the principal axes
};

template <class T>
Vector3<T> turn_rate_of(Vector3<T> J, Quaternion<T> q, Vector3<T> L) {
  return rotate(q, multiply_each(J, inverse_rotate(q, L)));
}

inline constexpr Real kHuge = std::numeric_limits<Real>::max();

// Turns q by the torque-free flow, where one series does; elsewhere q is left as it is. Returns
// where it was turned (rotation_flow.h has the limits).
template <class T>
MaskOf<T> turn_by_series(Quaternion<T>& q, Vector3<T> L, Vector3<T> J, T h) {
  using Choice = SeriesChoice<Real>;
  const T largest = larger_of(size_of(L.x), larger_of(size_of(L.y), size_of(L.z)));
  const MaskOf<T> turns = largest > T(0);
  const T divisor = select(turns, largest, T(1));
  const Vector3<T> scaled{L.x / divisor, L.y / divisor, L.z / divisor};
  const T scaled_length = length(scaled);
  const T size = largest * scaled_length;
  const Vector3<T> direction = (T(1) / select(turns, scaled_length, T(1))) * scaled;
  const Vector3<T> g = (h * size) * J;
  const Vector3<T> n = inverse_rotate(q, direction);
  const T tumble = tumble_squared(n, g);
  const T half_turn = T(Real(0.5)) * size_of(dot(n, multiply_each(g, n)));
  // The enclosed angle is small against the turn itself: a tenth is room enough.
  const MaskOf<T> small = negate(half_turn > T(Real(0.9) * kSmallAngle));
  const MaskOf<T> is_short = negate(tumble > T(Choice::kShortLimit * Choice::kShortLimit));
  const MaskOf<T> is_long = negate(tumble > T(Choice::kLongLimit * Choice::kLongLimit));
  Quaternion<T> turn = series_turn<Choice::kShortOrder>(n, g, sin_cos_of_small<T>);
  if (!all(is_short | negate(small & is_long))) {
    const Quaternion<T> longer = series_turn<Choice::kLongOrder>(n, g, sin_cos_of_small<T>);
    turn = {select(is_short, turn.x, longer.x), select(is_short, turn.y, longer.y),
            select(is_short, turn.z, longer.z), select(is_short, turn.w, longer.w)};
  }
  const Quaternion<T> turned = normalized(q * turn);
  const MaskOf<T> takes = turns & small & is_long & (size_of(dot(L, L)) < T(kHuge));
  q = {select(takes, turned.x, q.x), select(takes, turned.y, q.y), select(takes, turned.z, q.z),
       select(takes, turned.w, q.w)};
  return negate(turns) | takes;
}

// Known forces act for a time h. `a` [m/s^2], `torque` [N m].
template <class T>
void kick_lanes(BodyLanes<T>& b, Vector3<T> a, Vector3<T> torque, T h) {
  b.v += h * a;
  b.L += h * torque;
  b.w = turn_rate_of(b.J, b.dq * b.start, b.L);
}

// What the rows did to w becomes angular momentum, by the inertia with which they saw the body.
template <class T>
void collect_lanes(BodyLanes<T>& b, const Symmetric3<T>& I, Vector3<T> w_in) {
  b.L += I * (b.w - w_in);
}

// Velocity to position. Returns where that was done; elsewhere nothing has changed.
template <class T>
MaskOf<T> drift_lanes(BodyLanes<T>& b, T h) {
  Quaternion<T> q = b.dq * b.start;
  const MaskOf<T> done = turn_by_series(q, b.L, b.J, h);
  b.dp += h * b.v;
  b.dq = normalized(q * conjugate(b.start));
  b.w = turn_rate_of(b.J, q, b.L);
  return done;
}

// dq turned further by a correction [rad], in world axes; by 1.6 rad at most.
template <class T>
Quaternion<T> turned_further(Quaternion<T> dq, Vector3<T> turn) {
  const T angle = length(turn);
  const MaskOf<T> turns = angle > T(0);
  T s, c;
  sin_cos_of_small(smaller_of(T(Real(0.5)) * angle, T(kSmallAngle)), s, c);
  const Vector3<T> u = (s / select(turns, angle, T(1))) * turn;
  const Quaternion<T> turned = normalized(Quaternion<T>{u.x, u.y, u.z, c} * dq);
  return {select(turns, turned.x, dq.x), select(turns, turned.y, dq.y),
          select(turns, turned.z, dq.z), select(turns, turned.w, dq.w)};
}

// The trapezoid: half of what the velocities lost to rows counts backwards, by `weight` [s]; 0
// where nothing is to be corrected.
template <class T>
void correct_lanes(BodyLanes<T>& b, Vector3<T> v_start, Vector3<T> L_start, T weight) {
  b.dp += weight * (v_start - b.v);
  b.dq = turned_further(b.dq, weight * turn_rate_of(b.J, b.dq * b.start, L_start - b.L));
}

// A whole step dt of free flight, exact: x = v t + a t^2/2; half the torque, the flow, the other
// half. `q` ends as R_WP. Returns where that was done; elsewhere nothing that is returned counts.
template <class T>
MaskOf<T> fly_lanes(BodyLanes<T>& b, Quaternion<T>& q, Vector3<T> a, Vector3<T> torque, T dt) {
  const T half = T(Real(0.5)) * dt;
  b.dp = dt * (b.v + half * a);
  b.v += dt * a;
  b.L += half * torque;
  q = b.start;
  const MaskOf<T> done = turn_by_series(q, b.L, b.J, dt);
  b.L += half * torque;
  b.w = turn_rate_of(b.J, q, b.L);
  b.dq = q * conjugate(b.start);
  return done & (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w < T(2));
}

}  // namespace plumb::inline PLUMB_ABI::detail
