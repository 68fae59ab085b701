// Free rotation by Jacobi's elliptic functions, for comparison with rotation_flow.h, whose
// notation this file shares (n, g, b in units of the step).
//
// Direction. n' = n x (g * n) is solved by sn, cn, dn [DLMF 22.13]. No phase has to be found: by
// their addition theorems [DLMF 22.8], with c the axis about which n circulates, b the middle one
// and a the third,
//   C = n_c^2 - (b_c/b_b) n_b^2,   lambda^2 = -b_a b_b C,   k'^2 = (|b_a| n_c^2 - |b_c|
//   n_a^2)/(|b_a| C) D = 1 + (b_c/b_b) n_b^2 s^2/C                              (s, c, d) = (sn,
//   cn, dn)(lambda t, k) n_a(t) = (n_a c + b_a n_b n_c s d/lambda)/D n_b(t) = (n_b c d + b_b n_a
//   n_c s/lambda)/D n_c(t) = (n_c d + b_c n_a n_b s c/lambda)/D.
//
// Attitude. The closed form is an elliptic integral of the third kind [van Zon 2007]. It is had
// here by quadrature instead: the solid angle of rotation_flow.h, with the direction above at the
// nodes of a Gauss-Legendre rule of ten points, in pieces of at most one radian of tumbling. Its
// error is below 1e-15 rad a piece; it is the accurate but dear way that it is named for.
#pragma once

#include "motion/rotation_flow.h"

namespace plumb::inline PLUMB_ABI::detail {

// sn, cn, dn of u with the complementary parameter k'^2 in [0, 1], by descending Landen steps
// [Bulirsch 1965].
template <class T>
void elliptic_functions(T u, T complement, T& sn, T& cn, T& dn) {
  constexpr int kMost = 16;
  constexpr T kTiny = std::numeric_limits<T>::epsilon() * std::numeric_limits<T>::epsilon();
  const T close = std::sqrt(std::numeric_limits<T>::epsilon()) / T(4);
  T means[kMost], roots[kMost];
  T a = T(1), b = std::max(complement, kTiny), c = T(1);
  int steps = 0;
  for (; steps < kMost; ++steps) {
    b = std::sqrt(b);
    means[steps] = a;
    roots[steps] = b;
    c = T(0.5) * (a + b);
    if (std::abs(a - b) <= close * a) {
      ++steps;
      break;
    }
    b *= a;
    a = c;
  }
  sin_cos(c * u, sn, cn);
  dn = T(1);
  if (sn == T(0)) return;
  a = cn / sn;
  c *= a;
  for (int i = steps - 1; i >= 0; --i) {
    a *= c;
    c *= dn;
    dn = (roots[i] + a) / (means[i] + a);
    a = c / means[i];
  }
  const T size = T(1) / std::sqrt(c * c + T(1));
  sn = sn >= T(0) ? size : -size;
  cn = c * sn;
}

// n(t) for three different g, from n(0).
template <class T>
class JacobiDirection {
 public:
  JacobiDirection(Vector3<T> n0, Vector3<T> g) {
    const Vector3<T> rates{g.z - g.y, g.x - g.z, g.y - g.x};
    const auto between = [](T p, T x, T q) { return (p < x && x < q) || (q < x && x < p); };
    b_ = between(g.y, g.x, g.z) ? 0 : (between(g.x, g.y, g.z) ? 1 : 2);
    a_ = (b_ + 1) % 3;
    c_ = (b_ + 2) % 3;
    const auto excess = [&](int a, int c) {
      const T na = component(n0, a), nc = component(n0, c);
      return std::abs(component(rates, a)) * nc * nc - std::abs(component(rates, c)) * na * na;
    };
    if (excess(a_, c_) < T(0)) std::swap(a_, c_);
    na_ = component(n0, a_);
    nb_ = component(n0, b_);
    nc_ = component(n0, c_);
    rate_a_ = component(rates, a_);
    rate_b_ = component(rates, b_);
    rate_c_ = component(rates, c_);
    const T across = rate_c_ / rate_b_ * nb_ * nb_;  // <= 0
    const T C = nc_ * nc_ - across;
    lambda_ = std::sqrt(-rate_a_ * rate_b_ * C);
    if (!(lambda_ > T(0))) return;
    complement_ = std::min(T(1), excess(a_, c_) / (std::abs(rate_a_) * C));
    across_ = across / C;
  }

  [[nodiscard]] Vector3<T> at(T t) const {
    T sn = T(0), cn = T(1), dn = T(1), s = t;  // s: sn/lambda
    if (lambda_ > T(0)) {
      elliptic_functions(lambda_ * t, complement_, sn, cn, dn);
      s = sn / lambda_;
    }
    const T inverse = T(1) / (T(1) + across_ * sn * sn);
    Vector3<T> n{T(0), T(0), T(0)};
    set_component(n, a_, inverse * (na_ * cn + rate_a_ * nb_ * nc_ * s * dn));
    set_component(n, b_, inverse * (nb_ * cn * dn + rate_b_ * na_ * nc_ * s));
    set_component(n, c_, inverse * (nc_ * dn + rate_c_ * na_ * nb_ * s * cn));
    return n;
  }

 private:
  int a_, b_, c_;
  T na_, nb_, nc_, rate_a_, rate_b_, rate_c_;
  T lambda_ = T(0), complement_ = T(1), across_ = T(0);
};

// Nodes and weights of the ten-point Gauss-Legendre rule on [0, 1], the lower half; the upper
// mirrors it [DLMF 3.5].
struct GaussNode {
  double at, weight;
};
inline constexpr GaussNode kGauss[] = {{0.013046735741414139961, 0.033335672154344068796},
                                       {0.067468316655507744633, 0.074725674575290296573},
                                       {0.160295215850487796882, 0.109543181257991021998},
                                       {0.283302302935376404600, 0.134633359654998177546},
                                       {0.425562830509184394557, 0.147762112357376435087}};

// The turn over one piece, in the body's axes at its start; not a unit quaternion.
template <class T>
Quaternion<T> jacobi_turn(Vector3<T> n0, Vector3<T> g) {
  const JacobiDirection<T> direction(n0, g);
  const T c = dot(n0, multiply_each(g, n0));
  T enclosed = T(0);
  const auto add = [&](double t, double weight) {
    const Vector3<T> n = direction.at(T(t));
    const T along = dot(n0, n);
    enclosed += T(weight) * (c * along - dot(n0, multiply_each(g, n))) / (T(1) + along);
  };
  for (const GaussNode& node : kGauss) {
    add(node.at, node.weight);
    add(1 - node.at, node.weight);
  }
  const Vector3<T> n1 = direction.at(T(1)), chord = cross(n1, n0);
  T sine, cosine;
  sin_cos(T(0.5) * (c - enclosed), sine, cosine);
  const Vector3<T> about = sine * n0;
  return Quaternion<T>{about.x, about.y, about.z, cosine} *
         Quaternion<T>{chord.x, chord.y, chord.z, T(1) + dot(n0, n1)};
}

// Over a time h [s] of either sign. L [kg m^2/s] world axes, J [1/(kg m^2)] >= 0. Bodies with equal
// moments take the closed forms without elliptic functions that these become.
template <class T>
void advance_jacobi(Quaternion<T>& R_WP, Vector3<T> L_W, Vector3<T> J, T h) {
  constexpr T kPiece = T(1);  // [rad] of tumbling
  if (classify_inertia(J) != RotationKind::Asymmetric) {
    advance_rotation(R_WP, L_W, J, h);
    return;
  }
  T size;
  Vector3<T> direction;
  if (!flow::split(L_W, size, direction)) return;
  Vector3<T> g = (h * size) * J;
  const T tumble = std::sqrt(tumble_squared(inverse_rotate(R_WP, direction), g));
  if (!(tumble <= T(kMaxPieces) * kPiece)) {  // too fast to mean anything: as there
    advance_asymmetric(R_WP, L_W, J, h);
    return;
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil(tumble / kPiece)));
  g = (T(1) / static_cast<T>(pieces)) * g;
  for (int i = 0; i < pieces; ++i)
    R_WP = normalized(R_WP * jacobi_turn(inverse_rotate(R_WP, direction), g));
}

}  // namespace plumb::inline PLUMB_ABI::detail
