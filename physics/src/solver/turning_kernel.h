// The arithmetic of rolling and torsional friction (turning_row.h), for any number type T.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/contact_kernel.h"
#include "solver/turning_row.h"

namespace plumb::inline PLUMB_ABI::detail {

template <class T>
inline TurningRow<T> make_turning_row(const ContactRow<T>& row, T rolling, T torsional) {
  const Vector3<T> i1 = row.inverse_inertia_a * row.t1 + row.inverse_inertia_b * row.t1;
  const Vector3<T> i2 = row.inverse_inertia_a * row.t2 + row.inverse_inertia_b * row.t2;
  const Vector3<T> i3 = row.inverse_inertia_a * row.n + row.inverse_inertia_b * row.n;
  TurningRow<T> turning;
  turning.rolling = rolling;
  turning.torsional = torsional;
  turning.k11 = dot(row.t1, i1);
  turning.k12 = dot(row.t2, i1);
  turning.k22 = dot(row.t2, i2);
  turning.k33 = dot(row.n, i3);
  return turning;
}

// One pass. Returns whether the contact turns although all of a limit is used up.
template <class T>
inline bool solve_turning(const ContactRow<T>& row, TurningRow<T>& turning, RowVelocities<T>& u) {
  const Vector3<T> no_force{};
  T load = T(0);
  for (int i = 0; i < row.count; ++i) load += row.points[i].impulse;
  bool turns = false;
  if (turning.torsional > T(0) && turning.k33 > T(0)) {
    const T limit = turning.torsional * load;
    const T z = dot(row.n, u.wb - u.wa) + row.drive.z;
    const T wanted = turning.impulse3 - z / turning.k33;
    const T total = std::clamp(wanted, -limit, limit);
    turns |= total != wanted;
    const T change = total - turning.impulse3;
    turning.impulse3 = total;
    apply_wrench(row, no_force, change * row.n, u);
  }
  if (turning.rolling > T(0)) {
    const T limit = turning.rolling * load;
    const Vector3<T> w = u.wb - u.wa;
    const T w1 = dot(row.t1, w), w2 = dot(row.t2, w);
    const T half_difference = T(0.5) * (turning.k11 - turning.k22);
    const T k = T(0.5) * (turning.k11 + turning.k22) +
                std::sqrt(half_difference * half_difference + turning.k12 * turning.k12);
    const T determinant = turning.k11 * turning.k22 - turning.k12 * turning.k12;
    if (!(k > T(0))) return turns;
    T m1 = turning.impulse1 - w1 / k, m2 = turning.impulse2 - w2 / k;
    if (determinant > kSingular * k * k) {
      const T s1 = turning.impulse1 - (turning.k22 * w1 - turning.k12 * w2) / determinant;
      const T s2 = turning.impulse2 - (turning.k11 * w2 - turning.k12 * w1) / determinant;
      if (s1 * s1 + s2 * s2 <= limit * limit) m1 = s1, m2 = s2;
    }
    const T size = std::sqrt(m1 * m1 + m2 * m2);
    if (size > limit) {
      m1 *= limit / size;
      m2 *= limit / size;
      turns = true;
    }
    const Vector3<T> change = (m1 - turning.impulse1) * row.t1 + (m2 - turning.impulse2) * row.t2;
    turning.impulse1 = m1;
    turning.impulse2 = m2;
    apply_wrench(row, no_force, change, u);
  }
  return turns;
}

}  // namespace plumb::inline PLUMB_ABI::detail
