// How a contact row's bodies respond to its impulses: K, the effective masses of its points, and
// the block that solves all of them at once.
//
// Written once for one number and for W of them side by side, as the contact kernel is.
#pragma once

#include "math/symmetric_inverse.h"
#include "math/wide.h"
#include "solver/contact_row.h"

namespace plumb::inline PLUMB_ABI::detail {

// x^T M y
template <class T>
inline T bilinear(const Symmetric3<T>& M, Vector3<T> x, Vector3<T> y) {
  return dot(x, M * y);
}
template <class T>
inline T bilinear(Vector3<T> diagonal, Vector3<T> x, Vector3<T> y) {
  return dot(x, multiply_each(diagonal, y));
}

// K of the normal space (u0, u1, u2) and of the friction space (x, y, z): the velocity change per
// unit generalised impulse, summed over both bodies.
template <class Row, class T>
inline void add_response(Row& row, Vector3<T> arm, Vector3<T> inverse_mass,
                         const Symmetric3<T>& I) {
  const Vector3<T> rn = cross(arm, row.n), r1 = cross(arm, row.t1), r2 = cross(arm, row.t2);
  row.K_normal.xx += bilinear(inverse_mass, row.n, row.n) + bilinear(I, rn, rn);
  row.K_normal.xy += bilinear(I, rn, row.t1);
  row.K_normal.xz += bilinear(I, rn, row.t2);
  row.K_normal.yy += bilinear(I, row.t1, row.t1);
  row.K_normal.yz += bilinear(I, row.t1, row.t2);
  row.K_normal.zz += bilinear(I, row.t2, row.t2);
  row.K_friction.xx += bilinear(inverse_mass, row.t1, row.t1) + bilinear(I, r1, r1);
  row.K_friction.yy += bilinear(inverse_mass, row.t2, row.t2) + bilinear(I, r2, r2);
  row.K_friction.xy += bilinear(inverse_mass, row.t1, row.t2) + bilinear(I, r1, r2);
  row.K_friction.xz += bilinear(I, r1, row.n);
  row.K_friction.yz += bilinear(I, r2, row.n);
  row.K_friction.zz += bilinear(I, row.n, row.n);
}

// Smallest relative determinant at which a 3x3 system counts as solvable [-]; below it the points
// lie nearly on a line, or a locked axis leaves nothing to solve for.
inline constexpr Real kSolvable = Real(1e-5);

// The response of the points to their impulses is A = G K G^T with the rows (1, b_i, -a_i) of G.
// Its pseudo-inverse is H K^-1 H^T, H = G (G^T G)^-1; for two points A itself is inverted.
template <class Row>
inline void make_block(Row& row) {
  using T = std::remove_cvref_t<decltype(row.friction)>;
  constexpr int kStride[4] = {0, 4, 7, 9};  // where each row of the upper triangle begins
  row.has_block = T(0);
  if (row.count < 2) return;
  const auto row_of = [&](int i) { return Vector3<T>{T(1), row.points[i].b, -row.points[i].a}; };
  if (row.count == 2) {
    const Vector3<T> g0 = row_of(0), g1 = row_of(1);
    const T a00 = dot(g0, row.K_normal * g0), a01 = dot(g0, row.K_normal * g1),
            a11 = dot(g1, row.K_normal * g1);
    const T determinant = a00 * a11 - a01 * a01;
    const MaskOf<T> solvable = determinant > T(kSolvable) * a00 * a11;
    row.block[0] = select(solvable, a11 / determinant, T(0));
    row.block[1] = select(solvable, -a01 / determinant, T(0));
    row.block[kStride[1]] = select(solvable, a00 / determinant, T(0));
    row.has_block = select(solvable, T(1), T(0));
    return;
  }
  Symmetric3<T> gram{T(0), T(0), T(0), T(0), T(0), T(0)}, gram_inverse, K_inverse;
  for (int i = 0; i < row.count; ++i) {
    const T a = row.points[i].a, b = row.points[i].b;
    gram.xx += T(1);
    gram.yy += b * b;
    gram.zz += a * a;
    gram.xy += b;
    gram.xz -= a;
    gram.yz -= a * b;
  }
  MaskOf<T> solvable = invert(gram, T(kSolvable), gram_inverse);
  solvable &= invert(row.K_normal, T(kSolvable), K_inverse);
  if (!any(solvable)) return;
  Vector3<T> h[4];
  for (int i = 0; i < row.count; ++i) h[i] = gram_inverse * row_of(i);
  for (int i = 0; i < row.count; ++i)
    for (int j = i; j < row.count; ++j)
      row.block[kStride[i] + j - i] = select(solvable, dot(h[i], K_inverse * h[j]), T(0));
  row.has_block = select(solvable, T(1), T(0));
}

// From the row's frame, arms, points and what its bodies' inertia is.
template <class Row>
inline void make_responses(Row& row) {
  using T = std::remove_cvref_t<decltype(row.friction)>;
  row.K_normal = row.K_friction = {T(0), T(0), T(0), T(0), T(0), T(0)};
  add_response(row, row.arm_a, row.inverse_mass_a, row.inverse_inertia_a);
  add_response(row, row.arm_b, row.inverse_mass_b, row.inverse_inertia_b);
  const auto &K = row.K_normal, &F = row.K_friction;
  for (int i = 0; i < row.count; ++i) {
    auto& point = row.points[i];
    const T a = point.a, b = point.b;
    const T response =
        K.xx + b * b * K.yy + a * a * K.zz + T(2) * (b * K.xy - a * K.xz - a * b * K.yz);
    point.normal_mass = select(response > T(0), T(1) / response, T(0));
    point.k11 = F.xx - T(2) * b * F.xz + b * b * F.zz;
    point.k12 = F.xy + a * F.xz - b * F.yz - a * b * F.zz;
    point.k22 = F.yy + T(2) * a * F.yz + a * a * F.zz;
  }
  make_block(row);
}

// Once, before the first pass: points that take turns are a spring each, and stiff enough.
template <class Row>
inline void choose_softness(Row& row) {
  using T = std::remove_cvref_t<decltype(row.friction)>;
  if (row.count < 2) return;
  const MaskOf<T> at_once = row.has_block > T(0);
  row.mass_scale = select(at_once, row.mass_scale, row.mass_scale_in_turn);
  row.impulse_scale = select(at_once, row.impulse_scale, row.impulse_scale_in_turn);
}

}  // namespace plumb::inline PLUMB_ABI::detail
