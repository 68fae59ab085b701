// The arithmetic of one contact row: warm start, one pass over its points, and what a pass needs.
// Written once for any number type T; nothing here branches on the scene.
#pragma once

#include "solver/contact_row.h"

namespace plumb::inline PLUMB_ABI::detail {

// Velocities of the two bodies of a row while it is being solved, and the arms at which it acts.
template <class T>
struct RowVelocities {
  Vector3<T> va, wa, vb, wb;
  Vector3<T> arm_a, arm_b;
};

// The arms now. Two dynamic bodies act on each other at one common point, half-way between where
// each has carried its own: only so do they keep their angular momentum, whatever they slid
// meanwhile.
template <class T>
inline void place_arms(const ContactRow<T>& row, const BodyDelta& da, const BodyDelta& db,
                       RowVelocities<T>& u) {
  const Vector3<T> half = (row.both_dynamic ? T(0.5) : T(0)) * (db.dp - da.dp - row.advance);
  u.arm_a = row.arm_a + half;
  u.arm_b = row.arm_b - half;
}

// Applies the wrench (force impulse P at c, torque impulse M) to B and its opposite to A.
template <class T>
inline void apply_wrench(const ContactRow<T>& row, Vector3<T> P, Vector3<T> M,
                         RowVelocities<T>& u) {
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
template <class T>
inline void row_wrench(const ContactRow<T>& row, Vector3<T>& P, Vector3<T>& M) {
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

template <class T>
inline void warm_start(const ContactRow<T>& row, RowVelocities<T>& u) {
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
template <class T>
inline SeparationChange<T> separation_change(const ContactRow<T>& row, const BodyDelta& da,
                                             const BodyDelta& db) {
  // n . (rotate(q, t) - t) = 2 (n.u)(t.u) + 2 w n.(u x t) for the delta rotation q = (u, w).
  const auto tilt = [&](const Rotation& q, Vector3<T> t) {
    const Vector3<T> u{q.x, q.y, q.z};
    return T(2) *
           (dot(row.n, u) * dot(t, u) + q.w * dot(row.n, cross(u, t)) - dot(u, u) * dot(row.n, t));
  };
  return {dot(row.n, db.dp - da.dp) + tilt(db.dq, row.core_b) - tilt(da.dq, row.core_a),
          tilt(db.dq, row.t1) - tilt(da.dq, row.t1), tilt(db.dq, row.t2) - tilt(da.dq, row.t2)};
}

// All points at once, when every one of them presses: the impulses nearest to the present ones that
// give every point its wanted velocity. Sequential impulses depend on the order of the points,
// which tips a symmetric stack; this does not. Returns false, having changed nothing, when a point
// would pull.
template <class T>
inline bool solve_block(ContactRow<T>& row, const T* wanted, T mass_scale, T impulse_scale, T& p0,
                        T& p1, T& p2) {
  T total[ContactRow<T>::kMaxPoints] = {};
  int k = 0;
  T change[ContactRow<T>::kMaxPoints] = {};
  for (int i = 0; i < row.count; ++i) {
    for (int j = i; j < row.count; ++j) {
      const T m = row.block[k + j - i];
      change[i] += m * wanted[j];
      if (j != i) change[j] += m * wanted[i];
    }
    k += ContactRow<T>::kMaxPoints - i;
  }
  for (int i = 0; i < row.count; ++i) {
    total[i] =
        row.points[i].impulse + mass_scale * change[i] - impulse_scale * row.points[i].impulse;
    if (total[i] < T(0)) return false;
  }
  for (int i = 0; i < row.count; ++i) {
    const T l = total[i] - row.points[i].impulse;
    row.points[i].impulse = total[i];
    p0 += l;
    p1 += row.points[i].b * l;
    p2 -= row.points[i].a * l;
  }
  return true;
}

// Sweeps of sequential impulses over the points where they cannot be solved at once [-].
inline constexpr int kPointSweeps = 2;

// One pass over the normal rows. With `use_bias` overlap is worked off softly; without, the
// velocities are only made not to approach (the relaxing pass) [Catto 2024].
template <class T>
inline void solve_normal(ContactRow<T>& row, const SeparationChange<T>& change, T inverse_h,
                         bool use_bias, RowVelocities<T>& u) {
  T u0 = dot(row.n, relative_velocity(u));
  const Vector3<T> w = u.wb - u.wa;
  T u1 = dot(row.t1, w), u2 = dot(row.t2, w);
  T p0 = T(0), p1 = T(0), p2 = T(0);
  T bias[ContactRow<T>::kMaxPoints] = {};
  T mass_scale[ContactRow<T>::kMaxPoints] = {}, impulse_scale[ContactRow<T>::kMaxPoints] = {};
  T wanted[ContactRow<T>::kMaxPoints] = {};
  bool all_overlap = true;
  for (int i = 0; i < row.count; ++i) {
    const auto& point = row.points[i];
    const T s = point.separation + change.D0 + point.a * change.E1 + point.b * change.E2;
    mass_scale[i] = T(1);
    if (s > T(0)) {
      bias[i] = s * inverse_h;  // may close the gap, not more
      all_overlap = false;
    } else if (use_bias) {
      bias[i] = std::max(row.bias_rate * s, -row.push_speed_now);
      mass_scale[i] = row.mass_scale;
      impulse_scale[i] = row.impulse_scale;
    }
    wanted[i] = -(u0 + point.b * u1 - point.a * u2 + bias[i]);
  }
  if (row.has_block && all_overlap &&
      solve_block(row, wanted, mass_scale[0], impulse_scale[0], p0, p1, p2)) {
    apply_wrench(row, p0 * row.n, p1 * row.t1 + p2 * row.t2, u);
    return;
  }
  // A soft row is a compromise between its target and its impulse: one sweep of it, more of the
  // others.
  const int sweeps = use_bias || row.count == 1 ? 1 : kPointSweeps;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int i = 0; i < row.count; ++i) {
      auto& point = row.points[i];
      const T vn = u0 + point.b * u1 - point.a * u2;
      const T step =
          -point.normal_mass * mass_scale[i] * (vn + bias[i]) - impulse_scale[i] * point.impulse;
      const T total = std::max(point.impulse + step, T(0));
      const T l = total - point.impulse;
      point.impulse = total;
      const T l1 = point.b * l, l2 = -point.a * l;
      p0 += l;
      p1 += l1;
      p2 += l2;
      u0 += row.K_normal.xx * l + row.K_normal.xy * l1 + row.K_normal.xz * l2;
      u1 += row.K_normal.xy * l + row.K_normal.yy * l1 + row.K_normal.yz * l2;
      u2 += row.K_normal.xz * l + row.K_normal.yz * l1 + row.K_normal.zz * l2;
    }
  }
  apply_wrench(row, p0 * row.n, p1 * row.t1 + p2 * row.t2, u);
}

// Smallest determinant, relative to the square of the larger eigenvalue, at which the two
// tangential directions can be solved together [-].
template <class T>
inline constexpr T kSingularFor = T(1e-6);

// Coulomb friction on the true circular cone, point by point: if the impulse that stops the slip
// lies inside the disc of radius mu * normal impulse it is taken (stick). Otherwise a projected
// step with the larger eigenvalue of the response follows, whose fixed point opposes the slip
// exactly, in every direction alike. Returns the normal impulse that slides in `sliding`, and all
// of it in `load`.
template <class T>
inline void solve_friction(ContactRow<T>& row, RowVelocities<T>& u, T& load, T& sliding) {
  const Vector3<T> v = relative_velocity(u);
  T x = dot(row.t1, v) + row.drive.x, y = dot(row.t2, v) + row.drive.y,
    z = dot(row.n, u.wb - u.wa) + row.drive.z;
  T p0 = T(0), p1 = T(0), p2 = T(0);
  load = T(0);
  sliding = T(0);
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    const T limit = row.friction * point.impulse;
    const T v1 = x - point.b * z, v2 = y + point.a * z;
    const T half_trace = T(0.5) * (point.k11 + point.k22);
    const T half_difference = T(0.5) * (point.k11 - point.k22);
    const T k = half_trace + std::sqrt(half_difference * half_difference + point.k12 * point.k12);
    const T determinant = point.k11 * point.k22 - point.k12 * point.k12;
    // Motion locks may leave one direction only: there is nothing to stop in the other.
    const bool regular = determinant > kSingularFor<T> * k * k;
    T f1 = T(0), f2 = T(0);
    T share = T(1);
    if (limit > T(0) && k > T(0)) {
      if (regular) {
        f1 = point.friction1 - (point.k22 * v1 - point.k12 * v2) / determinant;
        f2 = point.friction2 - (point.k11 * v2 - point.k12 * v1) / determinant;
      }
      T size = std::sqrt(f1 * f1 + f2 * f2);
      if (!regular || size > limit) {
        f1 = point.friction1 - v1 / k;
        f2 = point.friction2 - v2 / k;
        size = std::sqrt(f1 * f1 + f2 * f2);
        const T scale = size > limit ? limit / size : T(1);
        f1 *= scale;
        f2 *= scale;
        if (!regular && size < limit) share = size / limit;
      } else {
        share = size / limit;
      }
    }
    load += point.impulse;
    sliding += share * point.impulse;
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

}  // namespace plumb::inline PLUMB_ABI::detail
