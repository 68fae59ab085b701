// The torque-free turn over one piece of a step, exact to round-off, from functions of the
// invariants of the motion alone. Notation of rotation_flow.h; the unit of time is half the piece,
// b the rate of n in it:   n_i' = b_i n_j n_k,   2 b = (g3 - g2, g1 - g3, g2 - g1),   (i, j, k)
// cyclic.
//
// Direction. y_i = b_j b_k n_i^2 differ by constants among themselves, and p = (y1 + y2 + y3)/3 is
// Weierstrass's elliptic function of time with p - e_i = y_i, e1 + e2 + e3 = 0 [DLMF 23.3]. The
// addition theorem of his sigma functions [DLMF 23.10] moves n by a time t without having to find
// the phase, and for every inertia alike (t s = sigma(t), s_i = sigma_i(t)):
//      n_i(t) D = n_i(0) s_j s_k + t b_i n_j(0) n_k(0) s s_i,    D = s_i^2 - t^2 y_i(0) s^2  (any
//      i).
// The sigma functions are entire, even but for the factor t, and polynomials in e_i, g2 = 2 sum
// e^2, g3 = 4 e1 e2 e3; with e_i^3 = (g2 e_i + g3)/4,
//      s_i = 1 + A + e_i t^2 (B + e_i t^2 C)   with A, B, C, s the same for all three axes.
//
// Attitude. Seen from the middle n of the piece (t = 0), the turn of rotation_flow.h is
//      Shortest(n -> n(-1)) Rot(n, 2 c - enclosed) Shortest(n(1) -> n),
// enclosed = the integral of W = (c n.n(t) - n.(g * n(t))) / (1 + n.n(t)) from -1 to 1. Only the
// even part of W counts; by the formula above it is a rational function of t^2 that begins as
// t^2. Gauss's rule for that (nodes t^2, weight t^2) is exact to t^(4 nodes).
//
// What cancels is cancelled in the formulas: s_i - 1 is had, not s_i, and sums that vanish by
// sum b = sum b g = sum (c - g) n^2 = 0 are left out. The turn is good to its own last digits
// however small it is.
#pragma once

#include "math/quaternion.h"

namespace plumb::inline PLUMB_ABI::detail {

// Nodes of the rule, and the tumble rate times length of the piece (rotation_flow.h) up to which
// all that is left out stays below the round-off of the type. Largest truncation error of the
// attitude [rad], the same for random bodies, next to the separatrix and with locked axes:
//   tumble [rad]     0.10     0.20     0.30     0.35     0.40     0.50     0.60     1.00
//   double, 2 nodes                    3e-17    2e-16    1e-15    2e-14    3e-13    2e-10
//   float, 1 node    1e-12    1e-11    8e-11    3e-10    7e-10    6e-9     3e-8     3e-6
template <class R>
struct PieceChoice;
template <>
struct PieceChoice<double> {
  static constexpr int kNodes = 2;
  static constexpr double kLimit = 0.3;  // [rad]
  static constexpr double kNode[kNodes] = {0.28994919792569030223, 0.82116191318542080888};
  static constexpr double kWeight[kNodes] = {0.95725734099873293608, 0.47385377011237817503};
};
template <>
struct PieceChoice<float> {
  static constexpr int kNodes = 1;
  static constexpr float kLimit = 0.5f;  // [rad]
  static constexpr float kNode[kNodes] = {0.6f};
  static constexpr float kWeight[kNodes] = {static_cast<float>(10.0 / 9.0)};
};

// s_i - 1 and s at one time.
template <class T>
struct Sigmas {
  Vector3<T> less_one;
  T s;
  // s_j s_k - 1
  [[nodiscard]] Vector3<T> products() const {
    const Vector3<T>& a = less_one;
    return {a.y + a.z + a.y * a.z, a.z + a.x + a.z * a.x, a.x + a.y + a.x * a.y};
  }
};

// What the sigma functions depend on.
template <class T>
struct Invariants {
  Vector3<T> e;
  T g2, g3, g22, g23;  // and g2^2, g2 g3
};

// At the time whose square is t2. The powers left out matter as little as the nodes that are.
template <class R, class T>
Sigmas<T> sigmas_at(const Invariants<T>& of, R t2) {
  const R t4 = t2 * t2, t6 = t2 * t4;
  T A = T(R(1.0 / 48) * t4) * of.g2 + T(R(1.0 / 960) * t6) * of.g3;
  T B = T(R(-1.0 / 960) * t6) * of.g2;
  T C = T(R(-1.0 / 8) * t4);
  T less = T(R(1.0 / 240) * t4) * of.g2 + T(R(1.0 / 840) * t6) * of.g3;  // 1 - s
  if constexpr (sizeof(R) == sizeof(double)) {
    const R t8 = t4 * t4, t10 = t4 * t6;
    A = A + (T(R(11.0 / 6451200) * t10) * of.g23 - T(R(1.0 / 161280) * t8) * of.g22);
    B = B - (T(R(13.0 / 53760) * t8) * of.g3 + T(R(1.0 / 6451200) * t10) * of.g22);
    C = C + (T(R(1.0 / 7680) * t8) * of.g2 + T(R(1.0 / 107520) * t10) * of.g3);
    less = less + (T(R(1.0 / 161280) * t8) * of.g22 + T(R(1.0 / 2217600) * t10) * of.g23);
  }
  B = B - T(R(0.5) * t2);
  const Vector3<T>& e = of.e;
  return {{A + e.x * (B + e.x * C), A + e.y * (B + e.y * C), A + e.z * (B + e.z * C)},
          T(R(1)) - less};
}

// The turn of the body over one piece, in its axes at the start: R1 = normalized(R0 * result). Not
// a unit quaternion. Free of branches, so that T may be several numbers R side by side.
//   n0  direction of L in principal axes, unit (or zero: no turn)
//   g   (h/2) |L| J [rad], half the turn; 2 sqrt(tumble_squared(n0, g)) no larger than the limit
//   sine_and_cosine  (T angle, T& s, T& c)
template <class R, class T, class SinCos>
Quaternion<T> midpoint_turn(Vector3<T> n0, Vector3<T> g, SinCos&& sine_and_cosine) {
  using Choice = PieceChoice<R>;
  const T one = T(R(1)), two = T(R(2));
  const Vector3<T> b{g.z - g.y, g.x - g.z, g.y - g.x};
  const Vector3<T> bb{b.y * b.z, b.z * b.x, b.x * b.y};
  const Vector3<T> y0 = multiply_each(bb, multiply_each(n0, n0));
  const T p0 = T(R(1.0 / 3)) * (y0.x + y0.y + y0.z);
  Invariants<T> of;
  of.e = {p0 - y0.x, p0 - y0.y, p0 - y0.z};
  const T half_g2 = dot(of.e, of.e);
  of.g2 = half_g2 + half_g2;
  of.g3 = T(R(4)) * (of.e.x * of.e.y * of.e.z);
  of.g22 = of.g2 * of.g2;
  of.g23 = of.g2 * of.g3;

  // By half the piece.
  const Sigmas<T> end = sigmas_at(of, R(1));
  const Vector3<T> end_products = end.products();
  const T square = end.less_one.x * (two + end.less_one.x), ss = end.s * end.s;
  const Vector3<T> slope =
      multiply_each(b, {end.s + end.s * end.less_one.x, end.s + end.s * end.less_one.y,
                        end.s + end.s * end.less_one.z});
  const auto moved = [&](Vector3<T> n, T yx) {  // n(1) - n
    const T d = square - yx * ss;               // D - 1
    const Vector3<T> crossed = multiply_each(slope, {n.y * n.z, n.z * n.x, n.x * n.y});
    return (one / (one + d)) * (multiply_each(n, end_products - Vector3<T>{d, d, d}) + crossed);
  };
  const Vector3<T> before = moved(n0, y0.x);
  const Vector3<T> n = n0 + before;
  const Vector3<T> nn = multiply_each(n, n);
  const T yx = bb.x * nn.x;
  const Vector3<T> after = moved(n, yx);

  const T c = dot(g, nn);
  const Vector3<T> weight{c - g.x, c - g.y, c - g.z};
  const Vector3<T> even_weight = multiply_each(weight, nn), odd_weight = multiply_each(weight, b);
  const T volume = n.x * (n.y * n.z), volume_squared = volume * volume;
  T enclosed = T(R(0));  // half of it
  for (int i = 0; i < Choice::kNodes; ++i) {
    const R t2 = Choice::kNode[i];
    const Sigmas<T> at = sigmas_at(of, t2);
    const Vector3<T>& a = at.less_one;
    const Vector3<T> products = at.products();
    const T ts2 = (T(t2) * at.s) * at.s;
    // W = (even + t odd)/(p + t q), with even and p even functions of t, and so odd and q.
    const T p = (two + (a.x * (two + a.x) - yx * ts2)) + dot(nn, products);
    const T tts = ts2 * volume_squared, q = dot(b, a), tq = tts * q;
    const T even_part = dot(even_weight, products) * p - dot(odd_weight, a) * tq;
    enclosed = enclosed + T(Choice::kWeight[i] / R(2)) * (even_part / (p * p - q * tq));
  }

  // Shortest(n(1) -> n) = (after x n, 2 n.n + n.after), and n x (after x n) = (n.n) after -
  // (n.after) n. With n.n for 1: what n0 is too long by is the same in every step and would add up.
  T sine, cosine;
  sine_and_cosine(c - enclosed, sine, cosine);
  const T size = nn.x + nn.y + nn.z, twice = size + size;
  const Vector3<T> first = cross(before, n);  // n x n(-1)
  const Vector3<T> last = cosine * cross(after, n) + (sine * size) * (after + (n + n));
  return Quaternion<T>{first.x, first.y, first.z, twice - dot(n, before)} *
         Quaternion<T>{last.x, last.y, last.z, cosine * (twice + dot(n, after))};
}

}  // namespace plumb::inline PLUMB_ABI::detail
