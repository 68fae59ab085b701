// The scaling of Nesterov and Todd for one circular cone: W with W z = W^-1 x [Vandenberghe 2010].
// x = (mu l_n, l_t) and z = (w_n / mu, w_t) lie in x_0 >= |x_1|, the cone that is its own dual.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/newton/contact_law.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

// x J x with J = diag(1, -1, -1), without cancellation.
inline double cone_norm2(Vec3d x) {
  const double t = std::sqrt(x.y * x.y + x.z * x.z);
  return (x.x - t) * (x.x + t);
}
// The same of what lies inside, where rounding may not.
inline double inner_norm2(Vec3d x) {
  return std::max(cone_norm2(x), std::numeric_limits<double>::epsilon() * x.x * x.x);
}
// (x . z, x_0 z_1 + z_0 x_1) and the y with x o y = r.
inline Vec3d cone_product(Vec3d x, Vec3d z) {
  return {detail::dot(x, z), x.x * z.y + z.x * x.y, x.x * z.z + z.x * x.z};
}
inline Vec3d cone_quotient(Vec3d x, Vec3d r) {
  const double inner = x.y * r.y + x.z * r.z;
  const double first = (x.x * r.x - inner) / inner_norm2(x);
  return {first, (r.y - first * x.y) / x.x, (r.z - first * x.z) / x.x};
}
// Largest t for which x + t d stays in the cone.
inline double cone_room(Vec3d x, Vec3d d) {
  const double a = cone_norm2(d), b = x.x * d.x - x.y * d.y - x.z * d.z, c = inner_norm2(x);
  double room = std::numeric_limits<double>::infinity();
  if (d.x < 0) room = -x.x / d.x;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return room;
  const double root = std::sqrt(discriminant);
  // c + 2 b t + a t^2 = 0
  const double q = b > 0 ? -(b + root) : -b + root;
  for (const double t : {q != 0 ? c / q : -1.0, a != 0 ? q / a : -1.0})
    if (t > 0) room = std::min(room, t);
  return room;
}

struct ConeScaling {
  double size = 1;
  Vec3d w{1, 0, 0};

  ConeScaling(Vec3d x, Vec3d z) {
    const double nx = std::sqrt(inner_norm2(x)), nz = std::sqrt(inner_norm2(z));
    const Vec3d x1 = (1 / nx) * x, z1 = (1 / nz) * z;
    const double g = std::sqrt((1 + detail::dot(x1, z1)) / 2);
    w = (1 / (2 * g)) * Vec3d{x1.x + z1.x, x1.y - z1.y, x1.z - z1.z};
    size = std::sqrt(nx / nz);
  }
  [[nodiscard]] Vec3d apply(Vec3d a) const { return size * turn(w, a); }
  [[nodiscard]] Vec3d apply_inverse(Vec3d a) const {
    return (1 / size) * turn({w.x, -w.y, -w.z}, a);
  }
  // W^2 = size^2 (2 w w^T - J)
  [[nodiscard]] Sym3d squared() const {
    const double k = size * size;
    return {k * (2 * w.x * w.x - 1), k * (2 * w.y * w.y + 1), k * (2 * w.z * w.z + 1),
            k * 2 * w.x * w.y,       k * 2 * w.x * w.z,       k * 2 * w.y * w.z};
  }

 private:
  static Vec3d turn(Vec3d w, Vec3d a) {
    const double inner = w.y * a.y + w.z * a.z, k = a.x + inner / (1 + w.x);
    return {w.x * a.x + inner, a.y + k * w.y, a.z + k * w.z};
  }
};

}  // namespace plumb::inline PLUMB_ABI::detail::newton
