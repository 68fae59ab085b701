// The force of what resists, solved for the end of the substep: six unknowns a body.
//
// With generalised velocity u = (v, w), mass M, damping D = -dF/du and stiffness K = -dF/dx, the
// mean force f over a substep of length h fulfils
//   f = f0 - (theta h D + h^2/4 K) M^-1 f,
// f0 where the body gets without it. theta = 1/2 is the implicit midpoint: energy stays where K
// alone acts. Where damping is fast it is fitted, so that pure decay is exact and nothing
// overshoots at any step [Liniger 1970]:
//   theta = 1/(1 - e^-z) - 1/z,  z = h times the fastest rate.
#pragma once

#include <cmath>

#include "collision/collision_tolerances.h"
#include "math/vector3.h"

namespace plumb::inline PLUMB_ABI::detail {

struct Wrench {
  NumVec force{0, 0, 0};   // [N]
  NumVec torque{0, 0, 0};  // [N m] about the centre of mass
};
inline Wrench operator+(Wrench a, Wrench b) { return {a.force + b.force, a.torque + b.torque}; }
inline Wrench operator-(Wrench a, Wrench b) { return {a.force - b.force, a.torque - b.torque}; }

struct Matrix6 {
  double m[6][6] = {};

  Matrix6& operator+=(const Matrix6& b) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) m[i][j] += b.m[i][j];
    return *this;
  }
  // += s a b^T.
  void add_outer(double s, const Wrench& a, const Wrench& b) {
    const double x[6] = {a.force.x, a.force.y, a.force.z, a.torque.x, a.torque.y, a.torque.z};
    const double y[6] = {b.force.x, b.force.y, b.force.z, b.torque.x, b.torque.y, b.torque.z};
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) m[i][j] += s * x[i] * y[j];
  }
  // += J^T A J for A = dF/dv of a force at `arm`, v_point = v + w x arm.
  void add_at(NumVec arm, const Matrix3<double>& A) {
    const NumVec row[3] = {A.row0, A.row1, A.row2};
    const NumVec unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (const double a = component(row[i], j); a != 0)
          add_outer(a, {unit[i], cross(arm, unit[i])}, {unit[j], cross(arm, unit[j])});
  }
  [[nodiscard]] Wrench times(const Wrench& u) const {
    const double x[6] = {u.force.x, u.force.y, u.force.z, u.torque.x, u.torque.y, u.torque.z};
    double y[6];
    for (int i = 0; i < 6; ++i) {
      y[i] = 0;
      for (int j = 0; j < 6; ++j) y[i] += m[i][j] * x[j];
    }
    return {{y[0], y[1], y[2]}, {y[3], y[4], y[5]}};
  }
};

// exp(-z), z >= 0, the same on every system: halved until it is small, Taylor, squared back.
inline double decay_of(double z) {
  if (!(z < 700)) return 0;
  int halvings = 0;
  for (; z > 0.5; z *= 0.5) ++halvings;
  double sum = 1;
  for (int n = 14; n >= 1; --n) sum = 1 - sum * z / n;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

// 1/2 for z = 0, 1 for z -> infinity.
inline double fitted_theta(double z) {
  if (!(z > 0)) return 0.5;
  if (z < 0.1) return 0.5 + z / 12 * (1 - z * z / 60 * (1 - z * z / 42));  // next: z^7/1.2e6
  return 1 / (1 - decay_of(z)) - 1 / z;
}

struct InverseMass {
  NumVec linear{0, 0, 0};        // [1/kg] by world axis
  Symmetric3<double> angular{};  // [1/(kg m^2)] world axes
  [[nodiscard]] Wrench times(const Wrench& f) const {
    return {multiply_each(linear, f.force), angular * f.torque};
  }
};

// f of (1 + B M^-1) f = right. Pivots are the largest of their column; one that is not there (a
// matrix that no effect should make) leaves `right` as it is.
Wrench solve_stiff(const Matrix6& B, const InverseMass& inverse, const Wrench& right);
// The fastest of the rates on the diagonal of M^-1 D [1/s].
double fastest_rate(const Matrix6& D, const InverseMass& inverse);

}  // namespace plumb::inline PLUMB_ABI::detail
