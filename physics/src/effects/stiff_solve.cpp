#include "effects/stiff_solve.h"

#include <algorithm>

namespace plumb::inline PLUMB_ABI::detail {
namespace {

// B M^-1, column by column.
Matrix6 times_inverse(const Matrix6& B, const InverseMass& inverse) {
  Matrix6 out;
  for (int j = 0; j < 6; ++j) {
    Wrench unit;
    set_component(j < 3 ? unit.force : unit.torque, j % 3, 1.0);
    const Wrench column = B.times(inverse.times(unit));
    for (int i = 0; i < 6; ++i)
      out.m[i][j] = component(i < 3 ? column.force : column.torque, i % 3);
  }
  return out;
}

}  // namespace

Wrench solve_stiff(const Matrix6& B, const InverseMass& inverse, const Wrench& right) {
  Matrix6 A = times_inverse(B, inverse);
  for (int i = 0; i < 6; ++i) A.m[i][i] += 1;
  double x[6] = {right.force.x,  right.force.y,  right.force.z,
                 right.torque.x, right.torque.y, right.torque.z};
  for (int k = 0; k < 6; ++k) {  // Gauss
    int pivot = k;
    for (int i = k + 1; i < 6; ++i)
      if (std::abs(A.m[i][k]) > std::abs(A.m[pivot][k])) pivot = i;
    if (!(std::abs(A.m[pivot][k]) > 0)) return right;
    if (pivot != k) {
      std::swap(A.m[k], A.m[pivot]);
      std::swap(x[k], x[pivot]);
    }
    for (int i = k + 1; i < 6; ++i) {
      const double s = A.m[i][k] / A.m[k][k];
      if (s == 0) continue;
      for (int j = k + 1; j < 6; ++j) A.m[i][j] -= s * A.m[k][j];
      x[i] -= s * x[k];
    }
  }
  for (int k = 5; k >= 0; --k) {
    for (int j = k + 1; j < 6; ++j) x[k] -= A.m[k][j] * x[j];
    x[k] /= A.m[k][k];
  }
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

double fastest_rate(const Matrix6& D, const InverseMass& inverse) {
  const Matrix6 rates = times_inverse(D, inverse);
  double fastest = 0;
  for (int i = 0; i < 6; ++i) fastest = std::max(fastest, rates.m[i][i]);
  return fastest;
}

}  // namespace plumb::inline PLUMB_ABI::detail
