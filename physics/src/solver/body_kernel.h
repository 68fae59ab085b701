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
  Vector3<T> v, w, L;   // [m/s], [rad/s], [kg m^2/s]
  Vector3<T> dp;        // [m] since the step began
  Quaternion<T> dq;     // ... world axes
  Quaternion<T> start;  // R_WP when the step began
  Vector3<T> J;         // [1/(kg m^2)] about the principal axes
};

template <class T>
Vector3<T> turn_rate_of(Vector3<T> J, Quaternion<T> q, Vector3<T> L) {
  return rotate(q, multiply_each(J, inverse_rotate(q, L)));
}

inline constexpr Real kHuge = std::numeric_limits<Real>::max();
// A smaller turn leaves no trace in a unit quaternion [rad]. What rests is not turned by it: its
// powers would be denormal numbers, which take processors many times as long.
inline constexpr Real kNoTurn = std::numeric_limits<Real>::epsilon() / Real(64);

// Turns q by the torque-free flow, where one piece does; elsewhere q is left as it is. Returns
// where it was turned (midpoint_turn.h has the limit).
template <class T>
MaskOf<T> turn_by_one_piece(Quaternion<T>& q, Vector3<T> L, Vector3<T> J, T h) {
  constexpr Real kLimit = PieceChoice<Real>::kLimit;
  // [rad]: L scaled so that its square is far from under- and overflow where it turns the body. A
  // step backwards is one forwards about -L.
  const T J_largest = larger_of(J.x, larger_of(J.y, J.z));
  const Vector3<T> scaled = (J_largest * h) * L;
  const T largest = larger_of(size_of(scaled.x), larger_of(size_of(scaled.y), size_of(scaled.z)));
  const MaskOf<T> turns = largest > T(kNoTurn);
  const MaskOf<T> rests = negate(turns) & (largest < T(kHuge));
  if (!any(turns)) return rests;
  const T turn = length(scaled);
  const Vector3<T> direction = (T(Real(1)) / select(turns, turn, T(Real(1)))) * scaled;
  const Vector3<T> g = ((T(Real(0.5)) * turn) / select(turns, J_largest, T(Real(1)))) * J;
  const Vector3<T> n = inverse_rotate(q, direction);
  // The enclosed angle is small against the turn itself: a tenth is room enough.
  MaskOf<T> takes = turns;
  takes &= dot(n, multiply_each(g, n)) < T(Real(0.9) * kSmallAngle);
  takes &= tumble_squared(n, g) < T(kLimit * kLimit / Real(4));
  const Quaternion<T> turned = normalized(q * midpoint_turn<Real>(n, g, sin_cos_of_small<T>));
  q = {select(takes, turned.x, q.x), select(takes, turned.y, q.y), select(takes, turned.z, q.z),
       select(takes, turned.w, q.w)};
  return rests | takes;
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
  const MaskOf<T> done = turn_by_one_piece(q, b.L, b.J, h);
  b.dp += h * b.v;
  b.dq = normalized(q * conjugate(b.start));
  b.w = turn_rate_of(b.J, q, b.L);
  return done;
}

// dq turned further by a correction [rad], in world axes; by 1.6 rad at most.
template <class T>
Quaternion<T> turned_further(Quaternion<T> dq, Vector3<T> turn) {
  const T largest = larger_of(size_of(turn.x), larger_of(size_of(turn.y), size_of(turn.z)));
  const MaskOf<T> turns = largest > T(kNoTurn);
  if (!any(turns)) return dq;
  const T angle = length(turn);
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
  const MaskOf<T> done = turn_by_one_piece(q, b.L, b.J, dt);
  b.L += half * torque;
  b.w = turn_rate_of(b.J, q, b.L);
  b.dq = q * conjugate(b.start);
  return done & (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w < T(2));
}

}  // namespace plumb::inline PLUMB_ABI::detail
