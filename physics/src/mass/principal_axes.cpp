// Principal moments and axes of a symmetric tensor by Jacobi's rotations [Jacobi 1846].
//
// Each rotation in the plane of two axes makes one off-diagonal entry zero; a few sweeps over the
// three entries leave none. Chosen before a library solver for three reasons: a diagonal tensor
// comes out as it went in, to the last bit and with no needless turn of the axes; small moments of
// thin bodies keep their relative accuracy [Demmel 1992]; and with nothing but + - * / and sqrt the
// axes, which every later step depends on, have the same bits under every compiler.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plumb/mass_properties.h"

namespace plumb::inline PLUMB_ABI {
namespace {

// Convergence is quadratic: positive tensors need 4 to 6 sweeps. The limit ends the loop for input
// that is not a number.
constexpr int kMaxSweeps = 32;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Entries that sums over parts leave where symmetry says zero, as a share of the largest moment.
// Turning a cube by 45 degrees because of its rounding would help nobody.
constexpr double kRoundOffEntry = 16 * kEpsilon;

// Makes A(p, q) zero by a turn in the plane (p, q) of at most 45 degrees, and turns V's columns.
void turn(Eigen::Matrix3d& A, Eigen::Matrix3d& V, int p, int q) {
  const double theta = (A(q, q) - A(p, p)) / (2 * A(p, q));
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const int r = 3 - p - q;
  A(p, p) -= t * A(p, q);
  A(q, q) += t * A(p, q);
  const double a_rp = A(r, p), a_rq = A(r, q);
  A(r, p) = A(p, r) = c * a_rp - s * a_rq;
  A(r, q) = A(q, r) = s * a_rp + c * a_rq;
  A(p, q) = A(q, p) = 0;
  for (int k = 0; k < 3; ++k) {
    const double v_kp = V(k, p), v_kq = V(k, q);
    V(k, p) = c * v_kp - s * v_kq;
    V(k, q) = s * v_kp + c * v_kq;
  }
}

}  // namespace

MassProperties::Principal MassProperties::principal() const {
  Eigen::Matrix3d A = I_Bcm_B;
  for (int p = 0; p < 3; ++p) {
    for (int q = p + 1; q < 3; ++q) A(p, q) = A(q, p) = 0.5 * (I_Bcm_B(p, q) + I_Bcm_B(q, p));
  }
  Eigen::Matrix3d V = Eigen::Matrix3d::Identity();
  const double off_diagonal =
      std::max(std::abs(A(0, 1)), std::max(std::abs(A(0, 2)), std::abs(A(1, 2))));
  bool turned = off_diagonal > kRoundOffEntry * A.diagonal().cwiseAbs().maxCoeff();
  for (int sweep = 0; turned && sweep < kMaxSweeps; ++sweep) {
    turned = false;
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        const double negligible =
            kEpsilon * std::sqrt(std::abs(A(p, p))) * std::sqrt(std::abs(A(q, q)));
        if (!(std::abs(A(p, q)) > negligible)) continue;
        turn(A, V, p, q);
        turned = true;
      }
    }
  }
  // Ascending; equal moments keep their order, so that nothing moves without need.
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&A](int a, int b) { return A(a, a) < A(b, b); });
  Principal result;
  for (int k = 0; k < 3; ++k) {
    const int from = order[static_cast<std::size_t>(k)];
    result.moments[k] = A(from, from);
    result.R_BP.col(k) = V.col(from);
  }
  if (result.R_BP.determinant() < 0) result.R_BP.col(2) = -result.R_BP.col(2);
  return result;
}

}  // namespace plumb::inline PLUMB_ABI
