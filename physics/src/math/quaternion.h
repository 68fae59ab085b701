// Unit quaternions as rotations: v_W = rotate(R_WB, v_B).
#pragma once

#include <array>

#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail {

template <class T>
struct Quaternion {
  T x, y, z, w;
};

template <class T>
constexpr Quaternion<T> operator*(Quaternion<T> a, Quaternion<T> b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
template <class T>
constexpr Quaternion<T> conjugate(Quaternion<T> q) {
  return {-q.x, -q.y, -q.z, q.w};
}
template <class T>
constexpr Vector3<T> rotate(Quaternion<T> q, Vector3<T> v) {
  const Vector3<T> u{q.x, q.y, q.z};
  const Vector3<T> c = cross(u, v), t = c + c;
  return v + q.w * t + cross(u, t);
}
template <class T>
constexpr Vector3<T> inverse_rotate(Quaternion<T> q, Vector3<T> v) {
  return rotate(conjugate(q), v);
}
template <class T>
Quaternion<T> normalized(Quaternion<T> q) {
  const T s = T(1) / root_of(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {s * q.x, s * q.y, s * q.z, s * q.w};
}
template <class T>
constexpr Matrix3<T> to_matrix(Quaternion<T> q) {
  const T xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const T xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const T wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{T(1) - T(2) * (yy + zz), T(2) * (xy - wz), T(2) * (xz + wy)},
          {T(2) * (xy + wz), T(1) - T(2) * (xx + zz), T(2) * (yz - wx)},
          {T(2) * (xz - wy), T(2) * (yz + wx), T(1) - T(2) * (xx + yy)}};
}
// sin and cos from the C library differ in the last bit between systems; this one does not: range
// reduction to [-pi/4, pi/4] and Taylor polynomials, correct to 1 ulp or so for |a| up to 1e4.
template <class T>
void sin_cos(T a, T& s, T& c) {
  const double x0 = static_cast<double>(a);
  constexpr double kTwoOverPi = 0.63661977236758134308;
  constexpr double kHalfPiHigh = 1.57079632679489655800, kHalfPiLow = 6.12323399573676603587e-17;
  const double turns = std::nearbyint(x0 * kTwoOverPi);
  const double x = (x0 - turns * kHalfPiHigh) - turns * kHalfPiLow;
  const double x2 = x * x;
  const double sx =
      x * (1.0 + x2 * (-1.0 / 6 +
                       x2 * (1.0 / 120 +
                             x2 * (-1.0 / 5040 +
                                   x2 * (1.0 / 362880 +
                                         x2 * (-1.0 / 39916800 + x2 * (1.0 / 6227020800.0 -
                                                                       x2 / 1307674368000.0)))))));
  const double cx =
      1.0 +
      x2 * (-0.5 + x2 * (1.0 / 24 +
                         x2 * (-1.0 / 720 +
                               x2 * (1.0 / 40320 + x2 * (-1.0 / 3628800 +
                                                         x2 * (1.0 / 479001600.0 +
                                                               x2 * (-1.0 / 87178291200.0 +
                                                                     x2 / 20922789888000.0)))))));
  const long quadrant = static_cast<long>(turns) & 3;
  const double sv = (quadrant & 1) != 0 ? cx : sx, cv = (quadrant & 1) != 0 ? sx : cx;
  s = static_cast<T>((quadrant & 2) != 0 ? -sv : sv);
  c = static_cast<T>(((quadrant + 1) & 2) != 0 ? -cv : cv);
}
// The same for |a| <= 0.8, for one number or several: Taylor polynomials, to 1 ulp or so.
inline constexpr Real kSmallAngle = Real(0.8);  // [rad]
template <class T>
void sin_cos_of_small(T a, T& s, T& c) {
  constexpr int kTerms = sizeof(Real) == 4 ? 5 : 8;  // the next one is below 1e-3 ulp
  constexpr auto kTaylor = [] {  // 1/2!, 1/3! ... with the signs of their series
    std::array<Real, 2 * kTerms> out{};
    double factor = 1;
    for (int k = 0; k < 2 * kTerms; ++k) {
      factor /= k + 2;
      out[static_cast<std::size_t>(k)] = static_cast<Real>(k / 2 % 2 == 0 ? -factor : factor);
    }
    return out;
  }();
  const T x2 = a * a, x4 = x2 * x2, x8 = x4 * x4;
  // From k = i: two by two, so that little waits for what comes before.
  const auto series = [&](std::size_t i) {
    const auto two = [&](std::size_t k) { return T(kTaylor[k]) + x2 * T(kTaylor[k + 2]); };
    if constexpr (kTerms == 5) {
      return x2 * ((two(i) + x4 * two(i + 4)) + x8 * T(kTaylor[i + 8]));
    } else {
      return x2 * ((two(i) + x4 * two(i + 4)) + x8 * (two(i + 8) + x4 * two(i + 12)));
    }
  };
  s = a + a * series(1);
  c = T(Real(1)) + series(0);
}
// The rotation by |v| radians about v (exponential map).
template <class T>
Quaternion<T> from_rotation_vector(Vector3<T> v) {
  const T angle = length(v);
  if (!(angle > T(0))) return {T(0), T(0), T(0), T(1)};
  T s, c;
  sin_cos(T(0.5) * angle, s, c);
  const Vector3<T> u = (s / angle) * v;
  return {u.x, u.y, u.z, c};
}
template <class T>
bool is_finite(Quaternion<T> q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

using Rotation = Quaternion<Real>;

// A rigid placement in single frame coordinates (a shape relative to a reference point).
struct Transform {
  Vec p;       // [m]
  Rotation q;  // unit
};
inline Vec transform_point(const Transform& x, Vec v) { return rotate(x.q, v) + x.p; }
inline Vec inverse_transform_point(const Transform& x, Vec v) {
  return inverse_rotate(x.q, v - x.p);
}
inline Transform operator*(const Transform& a, const Transform& b) {
  return {rotate(a.q, b.p) + a.p, a.q * b.q};
}

}  // namespace plumb::inline PLUMB_ABI::detail
