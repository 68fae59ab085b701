// A torque-free top for tests, and an independent solution of its motion.
#pragma once

#include <algorithm>
#include <array>

#include "motion/rotation_flow.h"

namespace plumb::inline PLUMB_ABI::detail {

using Real80 = long double;
using Vec64 = Vector3<double>;
using Quat64 = Quaternion<double>;
inline constexpr double kTick = 1.0 / 60;  // [s]

// --- An independent solution --------------------------------------------------------------------

// R' = (1/2) R (J R^T L) by the Taylor series of the quaternion itself, order 18, in pieces of at
// most 0.2 rad of turn and of tumble, in 64-bit mantissas. Nothing is shared with the code under
// test.
template <class T>
Quaternion<Real80> reference_turn(Quaternion<T> R0, Vector3<T> L0, Vector3<T> J0, Real80 time) {
  constexpr int kOrder = 18;
  constexpr Real80 kPiece = 0.2L;
  const auto L = cast<Real80>(L0), J = cast<Real80>(J0);
  Quaternion<Real80> R = normalized(Quaternion<Real80>{R0.x, R0.y, R0.z, R0.w});
  std::array<Real80, 3> sorted{J.x, J.y, J.z};
  std::sort(sorted.begin(), sorted.end());
  // Real bodies tumble no faster than |w| + |L| J_middle; with locked axes |L| J_largest is safe.
  const Real80 slow = length(L) * (sorted[0] > 0 ? sorted[1] : sorted[2]);
  for (Real80 left = std::abs(time); left > 0;) {
    const Real80 rate = slow + length(multiply_each(J, inverse_rotate(R, L)));
    const Real80 piece = rate * left > kPiece ? kPiece / rate : left;
    const Real80 h = time < 0 ? -piece : piece;
    left -= piece;
    std::array<Vector3<Real80>, kOrder + 1> m, w;
    std::array<Quaternion<Real80>, kOrder + 1> q;
    m[0] = inverse_rotate(R, L);
    q[0] = R;
    for (std::size_t k = 0; k < kOrder; ++k) {
      w[k] = multiply_each(J, m[k]);
      m[k + 1] = {0, 0, 0};
      q[k + 1] = {0, 0, 0, 0};
      for (std::size_t j = 0; j <= k; ++j) {
        m[k + 1] += cross(m[j], w[k - j]);
        const auto p = q[j] * Quaternion<Real80>{w[k - j].x, w[k - j].y, w[k - j].z, 0};
        q[k + 1] = {q[k + 1].x + p.x, q[k + 1].y + p.y, q[k + 1].z + p.z, q[k + 1].w + p.w};
      }
      const Real80 f = h / static_cast<Real80>(k + 1);
      m[k + 1] = f * m[k + 1];
      q[k + 1] = {f / 2 * q[k + 1].x, f / 2 * q[k + 1].y, f / 2 * q[k + 1].z, f / 2 * q[k + 1].w};
    }
    R = {0, 0, 0, 0};
    for (std::size_t k = kOrder + 1; k-- > 0;) {
      R = {R.x + q[k].x, R.y + q[k].y, R.z + q[k].z, R.w + q[k].w};
    }
    R = normalized(R);
  }
  return R;
}

// Angle of the rotation between two attitudes [rad].
template <class T>
double angle_between(Quaternion<T> a, Quaternion<Real80> b) {
  const auto d = conjugate(normalized(Quaternion<Real80>{a.x, a.y, a.z, a.w})) * b;
  return static_cast<double>(2 * length(Vector3<Real80>{d.x, d.y, d.z}));
}

struct Top {
  Quat64 R{0, 0, 0, 1};
  Vec64 L{0, 0, 0}, J{1, 1, 1};

  [[nodiscard]] Vec64 body_spin() const { return multiply_each(J, inverse_rotate(R, L)); }
  [[nodiscard]] double energy() const { return 0.5 * dot(body_spin(), inverse_rotate(R, L)); }
  void advance(double h) { advance_rotation(R, L, J, h); }
};
inline Top top_of(Vec64 I, Vec64 body_spin, Quat64 R = {0, 0, 0, 1}) {
  R = normalized(R);
  return {R, rotate(R, multiply_each(I, body_spin)), {1 / I.x, 1 / I.y, 1 / I.z}};
}

}  // namespace plumb::inline PLUMB_ABI::detail
