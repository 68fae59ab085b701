// A symmetric positive definite matrix with a 6x6 block for every body, and for every two bodies
// that a contact or a joint connects: its sparse Cholesky factor [Davis 2006].
//
// Bodies are eliminated in the order of least degree, so that columns, chains and trees fill
// nothing: n bodies cost n. All sums are taken in one fixed order.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::detail::newton {

struct Block6 {
  double at[6][6];
};

class BodyMatrix {
 public:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // smaller index first

  // Finds the order and the pattern of the factor for bodies 0..count-1; edges sorted, each once.
  // Returns false where it would have more than `most_blocks` blocks: nothing else may be called.
  // The same edges as last time cost a comparison.
  bool analyse(std::uint32_t count, std::span<const Edge> edges, std::size_t most_blocks);

  // Of 6x6 blocks, by which factor() grows [-]; 3 a body in a column.
  [[nodiscard]] std::size_t products() const { return products_; }

  void clear();  // all zero
  [[nodiscard]] Block6& diagonal(std::uint32_t body) { return diagonal_[place_[body]]; }
  // Adds m, of which rows belong to body i and columns to body j.
  void add(std::uint32_t i, std::uint32_t j, const Block6& m);
  // Pivots that rounding has eaten are replaced by small ones.
  void factor();
  // x = A^-1 x, six numbers a body.
  void solve(double* x);

 private:
  [[nodiscard]] std::size_t find(std::uint32_t row, std::uint32_t column) const;
  bool find_pattern(std::span<const Edge> edges, std::size_t most_blocks);

  std::uint32_t count_ = 0;
  bool fits_ = false;
  std::size_t products_ = 0;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> order_, place_;  // place -> body, body -> place
  std::vector<std::size_t> column_;           // blocks of column k: [column_[k], column_[k + 1])
  std::vector<std::uint32_t> row_;            // place of each block's row, ascending
  std::vector<Block6> diagonal_, below_;      // A, then L
  std::vector<double> work_;
};

}  // namespace plumb::inline PLUMB_ABI::detail::newton
