// The laws of one contact point, of a bounded row, and of a bounded vector, in proximal form.
//
// With u the velocity plus bias of a contact in its frame (n, t1, t2) and l its impulse, Coulomb's
// law with a gap that must not close is, for any step length rho > 0 [De Saxce, Feng 1998],
//
//   l = P_K( l - rho (u + mu |u_t| n) )        K: |l_t| <= mu l_n, the circular cone
//
// The shift mu |u_t| n is kept from the last outer iteration, and so is the l on the right, called
// the centre c: y = c - rho (u + shift), l = P(y). P is the gradient of a convex function, and
// rho D = -dl/du, D = dP/dy, is symmetric: what Newton's method needs.
//
// Where a point slides, the same fixed point is reached sooner with the normal and a disc of fixed
// radius mu l_n in place of the cone (Tresca's law): the contraction of the shift is only
// mu^2/(1 + mu^2).
#pragma once

#include <cmath>

#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

using Vec3d = Vector3<double>;
using Sym3d = Symmetric3<double>;

struct Projected {
  Vec3d g{0, 0, 0};  // P(y)
  Sym3d D{};         // dP/dy
};

inline constexpr Sym3d kWhole{1, 1, 1, 0, 0, 0};

// y, g: (normal, t1, t2).
inline Projected project_cone(double mu, Vec3d y) {
  if (mu == 0) {
    if (y.x < 0) return {};
    return {{y.x, 0, 0}, {1, 0, 0, 0, 0, 0}};
  }
  const double size = std::sqrt(y.y * y.y + y.z * y.z);
  // At the tip the point counts as pressing: a cold start would take them one by one otherwise.
  if (y.x >= 0 && size <= mu * y.x) return {y, kWhole};
  if (mu * size <= -y.x) return {};
  const double s = (y.x + mu * size) / (1 + mu * mu);
  const double c1 = y.y / size, c2 = y.z / size;
  const double d1 = mu * c1, d2 = mu * c2;  // d = (1, mu t)
  const double k = 1 / (1 + mu * mu), q = mu * s / size;
  return {{s, s * d1, s * d2},
          {k, k * d1 * d1 + q * c2 * c2, k * d2 * d2 + q * c1 * c1, k * d1, k * d2,
           k * d1 * d2 - q * c1 * c2}};
}

// Two components within a disc; what is inside moves freely.
inline void project_disc(double radius, double y1, double y2, double& g1, double& g2, double& d11,
                         double& d22, double& d12) {
  const double size = std::sqrt(y1 * y1 + y2 * y2);
  g1 = y1;
  g2 = y2;
  d11 = d22 = 1;
  d12 = 0;
  if (size <= radius) return;
  const double c1 = y1 / size, c2 = y2 / size, k = radius / size;
  g1 = radius * c1;
  g2 = radius * c2;
  d11 = k * c2 * c2;
  d22 = k * c1 * c1;
  d12 = -k * c1 * c2;
}

// A normal that only pushes, and friction on a disc of fixed radius.
inline Projected project_column(double radius, Vec3d y) {
  Projected p;
  if (y.x >= 0) {
    p.g.x = y.x;
    p.D.xx = 1;
  }
  project_disc(radius, y.y, y.z, p.g.y, p.g.z, p.D.yy, p.D.zz, p.D.yz);
  return p;
}

// Three components within a ball.
inline Projected project_ball(double radius, Vec3d y) {
  const double size = length(y);
  if (size <= radius) return {y, kWhole};
  const Vec3d c = (1 / size) * y;
  const double k = radius / size;
  return {radius * c,
          {k * (1 - c.x * c.x), k * (1 - c.y * c.y), k * (1 - c.z * c.z), -k * c.x * c.y,
           -k * c.x * c.z, -k * c.y * c.z}};
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
