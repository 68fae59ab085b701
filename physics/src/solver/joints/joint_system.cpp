#include "solver/joints/joint_system.h"

#include <algorithm>

#include "solver/joints/joint_tolerances.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using Wide = Vector3<double>;
Wide wide(Vec a) { return cast<double>(a); }
Symmetric3<double> wide(const Symmetric3<Real>& m) {
  return {static_cast<double>(m.xx), static_cast<double>(m.yy), static_cast<double>(m.zz),
          static_cast<double>(m.xy), static_cast<double>(m.xz), static_cast<double>(m.yz)};
}

SystemRow* rows_of(JointSystem& system, std::uint32_t i) {
  return &system.rows[std::size_t{kMaxJointRows} * i];
}

// K += J_a M^-1 J_b^T over the bodies that a and b share: rows of a by rows of b.
void add_response(const JointBlock& a, const SystemRow* rows_a, const JointBlock& b,
                  const SystemRow* rows_b, SystemBlock& K) {
  for (int kb = 0; kb < b.bodies; ++kb) {
    if (!b.moves[kb]) continue;
    const Wide inverse_mass = wide(b.inverse_mass[kb]);
    const Symmetric3<double> inverse_inertia = wide(b.inverse_inertia[kb]);
    for (int ka = 0; ka < a.bodies; ++ka) {
      if (!a.moves[ka] || a.body[ka] != b.body[kb]) continue;
      for (int j = 0; j < b.rows; ++j) {
        if (!rows_b[j].acts) continue;
        const BodyJacobian& from = b.J[j * b.bodies + kb];
        const Wide linear = multiply_each(inverse_mass, wide(from.linear));
        const Wide angular = inverse_inertia * wide(from.angular);
        for (int i = 0; i < a.rows; ++i) {
          if (!rows_a[i].acts) continue;
          const BodyJacobian& to = a.J[i * a.bodies + ka];
          K.at[i][j] += dot(linear, wide(to.linear)) + dot(angular, wide(to.angular));
        }
      }
    }
  }
}

// What row i could move if no axis of its bodies were locked, at most.
double largest_response(const JointBlock& block, int i) {
  double sum = 0;
  for (int k = 0; k < block.bodies; ++k) {
    if (!block.moves[k]) continue;
    const BodyJacobian& J = block.J[i * block.bodies + k];
    const Vec& m = block.inverse_mass[k];
    const Symmetric3<Real>& I = block.inverse_inertia[k];
    sum += static_cast<double>(length_squared(J.linear) * std::max(m.x, std::max(m.y, m.z)) +
                               length_squared(J.angular) * (I.xx + I.yy + I.zz));
  }
  return sum;
}

// Rows that do not act, or that cannot move anything but by round-off, keep a one on the diagonal
// and no impulse.
void make_diagonal(const JointBlock& block, SystemRow* rows, double compliance, SystemBlock& K) {
  K = {};
  add_response(block, rows, block, rows, K);
  for (int i = 0; i < block.rows; ++i) {
    if (!(K.at[i][i] > joint_tolerance::kUnmoved * largest_response(block, i))) {
      rows[i].acts = false;
      for (int j = 0; j < block.rows; ++j) K.at[i][j] = K.at[j][i] = 0;
    }
    K.at[i][i] = rows[i].acts ? K.at[i][i] * (1 + compliance) + rows[i].give : 1;
    rows[i].size = K.at[i][i];
  }
}

// L D L^T in place: L below the diagonal, 1/D on it. A row of which elimination leaves only
// round-off is held by the others already: it gets no impulse.
void factor_diagonal(SystemBlock& K, const SystemRow* rows, int n) {
  double D[kMaxJointRows];
  for (int j = 0; j < n; ++j) {
    double d = K.at[j][j];
    for (int k = 0; k < j; ++k) d -= K.at[j][k] * K.at[j][k] * D[k];
    const bool acts = d > joint_tolerance::kUnmoved * rows[j].size;
    D[j] = acts ? d : 0;
    K.at[j][j] = acts ? 1 / d : 0;
    for (int i = j + 1; i < n; ++i) {
      double entry = K.at[i][j];
      for (int k = 0; k < j; ++k) entry -= K.at[i][k] * K.at[j][k] * D[k];
      K.at[i][j] = entry * K.at[j][j];
    }
  }
}
// x = (L D L^T)^-1 x.
void solve_diagonal(const SystemBlock& K, int n, double* x) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < i; ++k) x[i] -= K.at[i][k] * x[k];
  for (int i = 0; i < n; ++i) x[i] *= K.at[i][i];
  for (int i = n - 1; i >= 0; --i)
    for (int k = i + 1; k < n; ++k) x[i] -= K.at[k][i] * x[k];
}

// K -= Y B^T.
void subtract_product(const SystemBlock& Y, int rows, const SystemBlock& B, int columns, int inner,
                      SystemBlock& K) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      double sum = 0;
      for (int k = 0; k < inner; ++k) sum += Y.at[i][k] * B.at[j][k];
      K.at[i][j] -= sum;
    }
  }
}

std::uint32_t find_entry(const JointSystem& system, std::uint32_t row, std::uint32_t column) {
  const auto first = system.entry_row.begin() + system.column[column];
  const auto last = system.entry_row.begin() + system.column[column + 1];
  return static_cast<std::uint32_t>(std::lower_bound(first, last, row) - system.entry_row.begin());
}

}  // namespace

void factor_piece(JointSystem& system, const std::vector<JointBlock>& blocks,
                  const JointPiece& piece) {
  const double compliance =
      piece.loops ? joint_tolerance::kLoopCompliance : joint_tolerance::kCompliance;
  for (std::uint32_t p = piece.begin; p < piece.end; ++p)
    make_diagonal(blocks[p], rows_of(system, p), compliance, system.diagonal[p]);
  for (std::uint32_t p = piece.begin; p < piece.end; ++p) {
    for (std::uint32_t e = system.column[p]; e < system.column[p + 1]; ++e) {
      const std::uint32_t q = system.entry_row[e];
      system.entry[e] = {};
      add_response(blocks[q], rows_of(system, q), blocks[p], rows_of(system, p), system.entry[e]);
    }
  }
  for (std::uint32_t p = piece.begin; p < piece.end; ++p) {
    const int n = blocks[p].rows;
    factor_diagonal(system.diagonal[p], rows_of(system, p), n);
    const std::uint32_t first = system.column[p], last = system.column[p + 1];
    for (std::uint32_t e = first; e < last; ++e) {
      system.work[e] = system.entry[e];
      for (int i = 0; i < blocks[system.entry_row[e]].rows; ++i)
        solve_diagonal(system.diagonal[p], n, system.entry[e].at[i]);
    }
    for (std::uint32_t e1 = first; e1 < last; ++e1) {
      const std::uint32_t q1 = system.entry_row[e1];
      subtract_product(system.entry[e1], blocks[q1].rows, system.work[e1], blocks[q1].rows, n,
                       system.diagonal[q1]);
      for (std::uint32_t e2 = e1 + 1; e2 < last; ++e2) {
        const std::uint32_t q2 = system.entry_row[e2];
        subtract_product(system.entry[e2], blocks[q2].rows, system.work[e1], blocks[q1].rows, n,
                         system.entry[find_entry(system, q2, q1)]);
      }
    }
  }
}

void solve_factored(JointSystem& system, const std::vector<JointBlock>& blocks,
                    const JointPiece& piece) {
  double x[kMaxJointRows];
  const auto read = [&](std::uint32_t p) {
    const SystemRow* rows = rows_of(system, p);
    for (int i = 0; i < blocks[p].rows; ++i) x[i] = rows[i].acts ? rows[i].value : 0;
  };
  for (std::uint32_t p = piece.begin; p < piece.end; ++p) {
    const int n = blocks[p].rows;
    read(p);
    for (std::uint32_t e = system.column[p]; e < system.column[p + 1]; ++e) {
      const std::uint32_t q = system.entry_row[e];
      for (int i = 0; i < blocks[q].rows; ++i)
        for (int k = 0; k < n; ++k) rows_of(system, q)[i].value -= system.entry[e].at[i][k] * x[k];
    }
    solve_diagonal(system.diagonal[p], n, x);
    for (int i = 0; i < n; ++i) rows_of(system, p)[i].value = x[i];
  }
  for (std::uint32_t p = piece.end; p-- > piece.begin;) {
    const int n = blocks[p].rows;
    SystemRow* rows = rows_of(system, p);
    for (std::uint32_t e = system.column[p]; e < system.column[p + 1]; ++e) {
      const std::uint32_t q = system.entry_row[e];
      for (int i = 0; i < blocks[q].rows; ++i) {
        const double l = rows_of(system, q)[i].value;
        for (int k = 0; k < n; ++k) rows[k].value -= system.entry[e].at[i][k] * l;
      }
    }
    // (round-off must not give an impulse to rows that do not act)
    for (int i = 0; i < n; ++i)
      if (!rows[i].acts) rows[i].value = 0;
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
