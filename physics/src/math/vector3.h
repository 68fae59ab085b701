// Vectors and matrices of the engine's inside: plain, templated on the number type, every operation
// spelled out in one order, so that scalar, vector-width and compiler variants round alike.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/choose.h"

namespace plumb::inline PLUMB_ABI::detail {

template <class T>
struct Vector3 {
  T x, y, z;
};

template <class T>
constexpr Vector3<T> operator+(Vector3<T> a, Vector3<T> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
constexpr Vector3<T> operator-(Vector3<T> a, Vector3<T> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
constexpr Vector3<T> operator-(Vector3<T> a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
constexpr Vector3<T> operator*(T s, Vector3<T> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
constexpr Vector3<T>& operator+=(Vector3<T>& a, Vector3<T> b) {
  return a = a + b;
}
template <class T>
constexpr Vector3<T>& operator-=(Vector3<T>& a, Vector3<T> b) {
  return a = a - b;
}
template <class T>
constexpr T dot(Vector3<T> a, Vector3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vector3<T> cross(Vector3<T> a, Vector3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
constexpr Vector3<T> multiply_each(Vector3<T> a, Vector3<T> b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class T>
constexpr T length_squared(Vector3<T> a) {
  return dot(a, a);
}
template <class T>
T length(Vector3<T> a) {
  return root_of(dot(a, a));
}
// a / |a|, or `fallback` when |a| is zero (or too small to divide by). The division by the largest
// component first keeps it right for vectors whose squares under- or overflow.
template <class T>
Vector3<T> normalized_or(Vector3<T> a, Vector3<T> fallback) {
  const T largest = std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
  if (!(largest > T(0))) return fallback;
  const Vector3<T> scaled{a.x / largest, a.y / largest, a.z / largest};
  const T inverse = T(1) / length(scaled);
  return inverse * scaled;
}
template <class T>
constexpr T component(Vector3<T> a, int i) {
  return i == 0 ? a.x : (i == 1 ? a.y : a.z);
}
template <class T>
constexpr void set_component(Vector3<T>& a, int i, T value) {
  (i == 0 ? a.x : (i == 1 ? a.y : a.z)) = value;
}
template <class T>
Vector3<T> absolute(Vector3<T> a) {
  return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}
template <class T>
constexpr Vector3<T> min_each(Vector3<T> a, Vector3<T> b) {
  return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
template <class T>
constexpr Vector3<T> max_each(Vector3<T> a, Vector3<T> b) {
  return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}
template <class T>
bool is_finite(Vector3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
template <class To, class T>
constexpr Vector3<To> cast(Vector3<T> a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

// Two unit vectors that complete a unit normal to a right-handed orthonormal frame (n, t1, t2).
// Branch on sign only: continuous on each half-sphere, exact to round-off for every n [Duff 2017].
template <class T>
void tangent_frame(Vector3<T> n, Vector3<T>& t1, Vector3<T>& t2) {
  const T sign = n.z < T(0) ? T(-1) : T(1);
  const T a = T(-1) / (sign + n.z);
  const T b = n.x * n.y * a;
  t1 = {T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t2 = {b, sign + n.y * n.y * a, -n.y};
}

// Full 3x3, by rows.
template <class T>
struct Matrix3 {
  Vector3<T> row0, row1, row2;
};
template <class T>
constexpr Vector3<T> operator*(const Matrix3<T>& m, Vector3<T> a) {
  return {dot(m.row0, a), dot(m.row1, a), dot(m.row2, a)};
}
template <class T>
constexpr Vector3<T> transpose_times(const Matrix3<T>& m, Vector3<T> a) {
  return {m.row0.x * a.x + m.row1.x * a.y + m.row2.x * a.z,
          m.row0.y * a.x + m.row1.y * a.y + m.row2.y * a.z,
          m.row0.z * a.x + m.row1.z * a.y + m.row2.z * a.z};
}

// Symmetric 3x3, six numbers.
template <class T>
struct Symmetric3 {
  T xx, yy, zz, xy, xz, yz;
};
template <class T>
constexpr Vector3<T> operator*(const Symmetric3<T>& m, Vector3<T> a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}
// R diag(d) R^T.
template <class T>
constexpr Symmetric3<T> rotate_diagonal(const Matrix3<T>& R, Vector3<T> d) {
  const Vector3<T> a = multiply_each(R.row0, d), b = multiply_each(R.row1, d),
                   c = multiply_each(R.row2, d);
  return {dot(a, R.row0), dot(b, R.row1), dot(c, R.row2),
          dot(a, R.row1), dot(a, R.row2), dot(b, R.row2)};
}

using Vec = Vector3<Real>;
using PosVec = Vector3<PosReal>;

}  // namespace plumb::inline PLUMB_ABI::detail
