// The arithmetic of one contact row: warm start, one pass over its points, and what a pass needs.
//
// Written once for one number and for W of them side by side (math/wide.h): Row is a ContactRow or
// a RowBlock, T its number. Where one row would branch, both sides are computed and one is chosen,
// so that a row has the same bits alone and in any lane.
#pragma once

#include <cmath>

#include "math/wide.h"
#include "solver/contact_row.h"

namespace plumb::inline PLUMB_ABI::detail {

// Velocities of the two bodies of a row while it is being solved, and the arms at which it acts.
template <class T>
struct RowVelocities {
  Vector3<T> va, wa, vb, wb;
  Vector3<T> arm_a, arm_b;
};

// Motion of one body within the step, as lanes see it.
template <class T>
struct DeltaOf {
  Vector3<T> dp;
  Quaternion<T> dq;
};

// The arms now. Two dynamic bodies act on each other at one common point, between where each has
// carried its own: only so do they keep their angular momentum, whatever they slid meanwhile.
template <class Row, class T>
inline void place_arms(const Row& row, Vector3<T> dp_a, Vector3<T> dp_b, RowVelocities<T>& u) {
  // Arms much longer than those that the responses were computed with would make energy without
  // end: where bodies fly past each other within a step, their angular momentum is not kept.
  const auto within = [&](T x) {
    return select(x > row.path_room, row.path_room, select(x < -row.path_room, -row.path_room, x));
  };
  const Vector3<T> moved = dp_b - dp_a - row.advance;
  const Vector3<T> path{within(moved.x), within(moved.y), within(moved.z)};
  u.arm_a = row.arm_a + row.follow_a * path;
  u.arm_b = row.arm_b - row.follow_b * path;
}

// Applies the wrench (force impulse P at c, torque impulse M) to B and its opposite to A.
template <class Row, class T>
inline void apply_wrench(const Row& row, Vector3<T> P, Vector3<T> M, RowVelocities<T>& u) {
  u.va -= multiply_each(row.inverse_mass_a, P);
  u.wa -= row.inverse_inertia_a * (cross(u.arm_a, P) + M);
  u.vb += multiply_each(row.inverse_mass_b, P);
  u.wb += row.inverse_inertia_b * (cross(u.arm_b, P) + M);
}
template <class T>
inline Vector3<T> relative_velocity(const RowVelocities<T>& u) {
  return u.vb + cross(u.wb, u.arm_b) - u.va - cross(u.wa, u.arm_a);
}

// The wrench of the row's present impulses, normal and friction.
template <class Row, class T>
inline void row_wrench(const Row& row, Vector3<T>& P, Vector3<T>& M) {
  T p0 = T(0), p1 = T(0), p2 = T(0), f1 = T(0), f2 = T(0), f3 = T(0);
  for (int i = 0; i < row.count; ++i) {
    const auto& point = row.points[i];
    p0 += point.impulse;
    p1 += point.b * point.impulse;
    p2 -= point.a * point.impulse;
    f1 += point.friction1;
    f2 += point.friction2;
    f3 += point.a * point.friction2 - point.b * point.friction1;
  }
  P = p0 * row.n + f1 * row.t1 + f2 * row.t2;
  M = p1 * row.t1 + p2 * row.t2 + f3 * row.n;
}

template <class Row, class T>
inline void warm_start(const Row& row, RowVelocities<T>& u) {
  Vector3<T> P, M;
  row_wrench(row, P, M);
  apply_wrench(row, P, M, u);
}

// How far the separations have changed since the step began: point i by D0 + a_i E1 + b_i E2. Exact
// for any rotation about the moving centres (the normal stays that of the step's start).
template <class T>
struct SeparationChange {
  T D0, E1, E2;
};
template <class Row, class T>
inline SeparationChange<T> separation_change(const Row& row, const DeltaOf<T>& da,
                                             const DeltaOf<T>& db) {
  // n . (rotate(q, t) - t) = 2 (n.u)(t.u) + 2 w n.(u x t) for the delta rotation q = (u, w).
  const auto tilt = [&](const Quaternion<T>& q, Vector3<T> t) {
    const Vector3<T> u{q.x, q.y, q.z};
    return T(2) *
           (dot(row.n, u) * dot(t, u) + q.w * dot(row.n, cross(u, t)) - dot(u, u) * dot(row.n, t));
  };
  return {dot(row.n, db.dp - da.dp) + tilt(db.dq, row.core_b) - tilt(da.dq, row.core_a),
          tilt(db.dq, row.t1) - tilt(da.dq, row.t1), tilt(db.dq, row.t2) - tilt(da.dq, row.t2)};
}
inline DeltaOf<Real> as_lanes(const BodyDelta& d) { return {d.dp, d.dq}; }
inline SeparationChange<Real> separation_change(const ContactRow<Real>& row, const BodyDelta& da,
                                                const BodyDelta& db) {
  return separation_change(row, as_lanes(da), as_lanes(db));
}

// What each point is to do in a pass, and what a soft row grants it.
template <class T>
struct PointTargets {
  T bias[4];           // [m/s]
  T mass_scale[4];     // [-]
  T impulse_scale[4];  // [-]
  T wanted[4];         // [m/s] change of the normal speed
};

// All points at once, where every one of them presses: the impulses nearest to the present ones
// that give every point its wanted velocity. Sequential impulses depend on the order of the points,
// which tips a symmetric stack; this does not. Returns where no point would pull.
template <class Row, class T>
inline MaskOf<T> solve_block(const Row& row, const PointTargets<T>& to, T* total) {
  int k = 0;
  T change[4] = {};
  for (int i = 0; i < row.count; ++i) {
    for (int j = i; j < row.count; ++j) {
      const T m = row.block[k + j - i];
      change[i] += m * to.wanted[j];
      if (j != i) change[j] += m * to.wanted[i];
    }
    k += 4 - i;
  }
  MaskOf<T> presses = negate(T(0) < T(0));
  for (int i = 0; i < row.count; ++i) {
    const T impulse = row.points[i].impulse;
    total[i] = impulse + to.mass_scale[0] * change[i] - to.impulse_scale[0] * impulse;
    presses &= negate(total[i] < T(0));
  }
  return presses;
}

// Sweeps of sequential impulses over the points where they cannot be solved at once [-].
inline constexpr int kPointSweeps = 2;

// One pass over the normal rows. With `use_bias` overlap is worked off softly; without, the
// velocities are only made not to approach (the relaxing pass) [Catto 2024].
template <class Row, class T>
inline void solve_normal(Row& row, const SeparationChange<T>& change, T inverse_h, bool use_bias,
                         RowVelocities<T>& u) {
  T u0 = dot(row.n, relative_velocity(u));
  const Vector3<T> w = u.wb - u.wa;
  T u1 = dot(row.t1, w), u2 = dot(row.t2, w);
  PointTargets<T> to;
  MaskOf<T> at_once = T(0) < row.has_block;
  for (int i = 0; i < row.count; ++i) {
    const auto& point = row.points[i];
    const T s = point.separation + change.D0 + point.a * change.E1 + point.b * change.E2;
    const MaskOf<T> open = s > T(0);
    at_once &= negate(open);
    const T close_gap = s * inverse_h;  // may close the gap, not more
    if (use_bias) {
      const T push_out = larger_of(row.bias_rate * s, -row.push_speed_now);
      to.bias[i] = select(open, close_gap, push_out);
      to.mass_scale[i] = select(open, T(1), row.mass_scale);
      to.impulse_scale[i] = select(open, T(0), row.impulse_scale);
    } else {
      to.bias[i] = select(open, close_gap, T(0));
      to.mass_scale[i] = T(1);
      to.impulse_scale[i] = T(0);
    }
    to.wanted[i] = -(u0 + point.b * u1 - point.a * u2 + to.bias[i]);
  }
  T total[4];  // the new impulses
  if (any(at_once)) {
    T together[4];
    at_once &= solve_block(row, to, together);
    for (int i = 0; i < row.count; ++i) total[i] = together[i];
  }
  if (!all(at_once)) {
    T one_by_one[4];
    for (int i = 0; i < row.count; ++i) one_by_one[i] = row.points[i].impulse;
    // A soft row is a compromise between its target and its impulse: one sweep of it, more of the
    // others.
    const int sweeps = use_bias || row.count == 1 ? 1 : kPointSweeps;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (int i = 0; i < row.count; ++i) {
        const auto& point = row.points[i];
        const T vn = u0 + point.b * u1 - point.a * u2;
        const T step = -point.normal_mass * to.mass_scale[i] * (vn + to.bias[i]) -
                       to.impulse_scale[i] * one_by_one[i];
        const T now = larger_of(one_by_one[i] + step, T(0));
        const T l = now - one_by_one[i];
        one_by_one[i] = now;
        const T l1 = point.b * l, l2 = -point.a * l;
        u0 += row.K_normal.xx * l + row.K_normal.xy * l1 + row.K_normal.xz * l2;
        u1 += row.K_normal.xy * l + row.K_normal.yy * l1 + row.K_normal.yz * l2;
        u2 += row.K_normal.xz * l + row.K_normal.yz * l1 + row.K_normal.zz * l2;
      }
    }
    if (any(at_once)) {
      for (int i = 0; i < row.count; ++i) total[i] = select(at_once, total[i], one_by_one[i]);
    } else {
      for (int i = 0; i < row.count; ++i) total[i] = one_by_one[i];
    }
  }
  T p0 = T(0), p1 = T(0), p2 = T(0);
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    const T l = total[i] - point.impulse;
    point.impulse = total[i];
    p0 += l;
    p1 += point.b * l;
    p2 -= point.a * l;
  }
  apply_wrench(row, p0 * row.n, p1 * row.t1 + p2 * row.t2, u);
}

// Smallest determinant, relative to the square of the larger eigenvalue, at which the two
// tangential directions can be solved together [-].
inline constexpr Real kSingular = Real(1e-6);

// The friction cone is round: all directions alike.
struct RoundCone {
  template <class T>
  static void enter(T&, T&, T&, T&) {}
  template <class T>
  static void leave(T&) {}
  // [N s] the limit on whose surface an impulse lies.
  template <class T>
  static T size_of(T f1, T f2) {
    return root_of(f1 * f1 + f2 * f2);
  }
  // Replaces an impulse by the nearest one within the limit; returns the size that it had.
  template <class T>
  static T pull_in(T& f1, T& f2, T limit) {
    const T size = size_of(f1, f2);
    const T scale = select(size > limit, limit / size, T(1));
    f1 = f1 * scale;
    f2 = f2 * scale;
    return size;
  }
};
// The friction cone is an ellipse, `along` times as wide along t1 as along t2. In axes scaled by
// that, impulses by 1/along and velocities by along, it is as without grain, power stays power, and
// the impulse that takes most energy from the slip is again the one that opposes it.
template <class T, class Cone = RoundCone>
struct GrainCone : Cone {
  T along;
  void enter(T& v1, T& k11, T& k12, T& f1) const {
    v1 *= along;
    k11 *= along * along;
    k12 *= along;
    f1 = along > T(0) ? f1 / along : T(0);
  }
  void leave(T& f1) const { f1 *= along; }
};

// Coulomb friction on the true circular cone, point by point: if the impulse that stops the slip
// lies inside the disc of radius mu * normal impulse it is taken (stick). Otherwise a projected
// step with the larger eigenvalue of the response follows, whose fixed point opposes the slip
// exactly, in every direction alike. Returns the normal impulse that slides in `sliding`, and all
// of it in `load`.
template <class Row, class T, class Cone = RoundCone>
inline void solve_friction(Row& row, RowVelocities<T>& u, T& load, T& sliding,
                           const Cone& cone = {}) {
  const Vector3<T> v = relative_velocity(u);
  T x = dot(row.t1, v) + row.drive.x, y = dot(row.t2, v) + row.drive.y,
    z = dot(row.n, u.wb - u.wa) + row.drive.z;
  T p0 = T(0), p1 = T(0), p2 = T(0);
  load = T(0);
  sliding = T(0);
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    const T limit = row.friction * point.impulse;
    T v1 = x - point.b * z, k11 = point.k11, k12 = point.k12, start1 = point.friction1;
    const T v2 = y + point.a * z, k22 = point.k22;
    cone.enter(v1, k11, k12, start1);
    const T half_trace = T(0.5) * (k11 + k22);
    const T half_difference = T(0.5) * (k11 - k22);
    const T k = half_trace + root_of(half_difference * half_difference + k12 * k12);
    const T determinant = k11 * k22 - k12 * k12;
    const MaskOf<T> acts = (limit > T(0)) & (k > T(0));
    // Motion locks may leave one direction only: there is nothing to stop in the other.
    const MaskOf<T> regular = determinant > T(kSingular) * k * k;
    T f1 = start1 - (k22 * v1 - k12 * v2) / determinant;
    T f2 = point.friction2 - (k11 * v2 - k12 * v1) / determinant;
    T size = cone.size_of(f1, f2);
    T share = size / limit;
    const MaskOf<T> slides = negate(regular) | (size > limit);
    if (any(slides & acts)) {
      T s1 = start1 - v1 / k, s2 = point.friction2 - v2 / k;
      size = cone.pull_in(s1, s2, limit);
      f1 = select(slides, s1, f1);
      f2 = select(slides, s2, f2);
      const T held = select(negate(regular) & (size < limit), size / limit, T(1));
      share = select(slides, held, share);
    }
    f1 = select(acts, f1, T(0));
    f2 = select(acts, f2, T(0));
    share = select(acts, share, T(1));
    load += point.impulse;
    sliding += share * point.impulse;
    cone.leave(f1);
    const T d1 = f1 - point.friction1, d2 = f2 - point.friction2;
    point.friction1 = f1;
    point.friction2 = f2;
    const T d3 = point.a * d2 - point.b * d1;
    p0 += d1;
    p1 += d2;
    p2 += d3;
    x += row.K_friction.xx * d1 + row.K_friction.xy * d2 + row.K_friction.xz * d3;
    y += row.K_friction.xy * d1 + row.K_friction.yy * d2 + row.K_friction.yz * d3;
    z += row.K_friction.xz * d1 + row.K_friction.yz * d2 + row.K_friction.zz * d3;
  }
  apply_wrench(row, p0 * row.t1 + p1 * row.t2, p2 * row.n, u);
}

// Ends a substep: sums up the impulses, and notes which points carry load now. Returns where that
// has changed.
template <class Row>
inline auto end_substep(Row& row) {
  using T = std::remove_cvref_t<decltype(row.friction)>;
  MaskOf<T> changed = T(0) < T(0);
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    point.impulse_sum += point.impulse;
    point.friction1_sum += point.friction1;
    point.friction2_sum += point.friction2;
    const T loaded = select(point.impulse > row.negligible, T(1), T(0));
    changed = changed | (loaded < point.loaded) | (loaded > point.loaded);
    point.loaded = loaded;
  }
  return changed;
}

}  // namespace plumb::inline PLUMB_ABI::detail
