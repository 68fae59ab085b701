#include "solver/newton/body_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace plumb::inline PLUMB_ABI::detail::newton {
namespace {

// A pivot below this part of what stood on the diagonal is round-off [-].
constexpr double kLeastPivot = 1e-15;

// L of A = L L^T, in the lower triangle.
void factor_block(Block6& a) {
  for (int j = 0; j < 6; ++j) {
    const double whole = a.at[j][j];
    double d = whole;
    for (int k = 0; k < j; ++k) d -= a.at[j][k] * a.at[j][k];
    const double least = kLeastPivot * whole;
    if (!(d > least)) d = least > 0 ? least : 1;
    const double root = std::sqrt(d), inverse = 1 / root;
    a.at[j][j] = root;
    for (int i = j + 1; i < 6; ++i) {
      double s = a.at[i][j];
      for (int k = 0; k < j; ++k) s -= a.at[i][k] * a.at[j][k];
      a.at[i][j] = s * inverse;
    }
  }
}

// B = B L^-T.
void divide_block(const Block6& L, Block6& B) {
  for (int j = 0; j < 6; ++j) {
    const double inverse = 1 / L.at[j][j];
    for (int i = 0; i < 6; ++i) {
      double s = B.at[i][j];
      for (int k = 0; k < j; ++k) s -= B.at[i][k] * L.at[j][k];
      B.at[i][j] = s * inverse;
    }
  }
}

// C -= A B^T.
void subtract_product(const Block6& A, const Block6& B, Block6& C) {
  double turned[6][6];
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) turned[i][j] = B.at[j][i];
  for (int i = 0; i < 6; ++i) {
    double row[6];
    for (int j = 0; j < 6; ++j) row[j] = C.at[i][j];
    for (int k = 0; k < 6; ++k) {
      const double a = A.at[i][k];
      for (int j = 0; j < 6; ++j) row[j] -= a * turned[k][j];
    }
    for (int j = 0; j < 6; ++j) C.at[i][j] = row[j];
  }
}

}  // namespace

bool BodyMatrix::analyse(std::uint32_t count, std::span<const Edge> edges,
                         std::size_t most_blocks) {
  if (count == count_ && std::equal(edges.begin(), edges.end(), edges_.begin(), edges_.end()))
    return fits_;
  count_ = count;
  edges_.assign(edges.begin(), edges.end());
  fits_ = find_pattern(edges, most_blocks);
  return fits_;
}

// Least degree first, the smaller index among equals. Bodies wait in buckets by degree.
bool BodyMatrix::find_pattern(std::span<const Edge> edges, std::size_t most_blocks) {
  std::vector<std::vector<std::uint32_t>> neighbours(count_);
  for (const auto& [i, j] : edges) {
    neighbours[i].push_back(j);
    neighbours[j].push_back(i);
  }
  for (auto& list : neighbours) std::sort(list.begin(), list.end());
  order_.clear();
  place_.assign(count_, 0);
  std::vector<std::vector<std::uint32_t>> columns(count_);
  // A heap of (degree, body); entries that are out of date are thrown away when they come up.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> heap;
  const auto later = [](const auto& a, const auto& b) { return a > b; };
  const auto push = [&](std::uint32_t body) {
    heap.emplace_back(static_cast<std::uint32_t>(neighbours[body].size()), body);
    std::push_heap(heap.begin(), heap.end(), later);
  };
  for (std::uint32_t body = 0; body < count_; ++body) push(body);
  std::vector<std::uint8_t> gone(count_, 0);
  std::vector<std::uint32_t> merged;
  std::size_t blocks = 0;
  while (!heap.empty()) {
    std::pop_heap(heap.begin(), heap.end(), later);
    const auto [degree, body] = heap.back();
    heap.pop_back();
    if (gone[body] != 0 || degree != neighbours[body].size()) continue;
    gone[body] = 1;
    place_[body] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(body);
    std::vector<std::uint32_t> list = std::move(neighbours[body]);
    blocks += list.size();
    if (blocks > most_blocks) return false;
    for (const std::uint32_t i : list) {
      std::vector<std::uint32_t>& own = neighbours[i];
      merged.clear();
      std::set_union(own.begin(), own.end(), list.begin(), list.end(), std::back_inserter(merged));
      std::erase_if(merged, [&, b = body](std::uint32_t k) { return k == i || k == b; });
      const bool changed = merged.size() != own.size();
      own.swap(merged);
      if (changed) push(i);
    }
    columns[place_[body]] = std::move(list);
  }
  column_.assign(1, 0);
  row_.clear();
  products_ = 0;
  for (std::vector<std::uint32_t>& list : columns) {
    for (std::uint32_t& body : list) body = place_[body];
    std::sort(list.begin(), list.end());
    row_.insert(row_.end(), list.begin(), list.end());
    column_.push_back(row_.size());
    products_ += 1 + list.size() + list.size() * (list.size() + 1) / 2;
  }
  diagonal_.resize(count_);
  below_.resize(row_.size());
  work_.resize(std::size_t{6} * count_);
  return true;
}

void BodyMatrix::clear() {
  std::fill(diagonal_.begin(), diagonal_.end(), Block6{});
  std::fill(below_.begin(), below_.end(), Block6{});
}

std::size_t BodyMatrix::find(std::uint32_t row, std::uint32_t column) const {
  const auto begin = row_.begin() + static_cast<std::ptrdiff_t>(column_[column]);
  const auto end = row_.begin() + static_cast<std::ptrdiff_t>(column_[column + 1]);
  return static_cast<std::size_t>(std::lower_bound(begin, end, row) - row_.begin());
}

void BodyMatrix::add(std::uint32_t i, std::uint32_t j, const Block6& m) {
  const std::uint32_t p = place_[i], q = place_[j];
  if (p > q) {
    Block6& to = below_[find(p, q)];
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) to.at[r][c] += m.at[r][c];
  } else {
    Block6& to = below_[find(q, p)];
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) to.at[r][c] += m.at[c][r];
  }
}

void BodyMatrix::factor() {
  for (std::uint32_t k = 0; k < count_; ++k) {
    factor_block(diagonal_[k]);
    const std::size_t begin = column_[k], end = column_[k + 1];
    for (std::size_t e = begin; e < end; ++e) divide_block(diagonal_[k], below_[e]);
    for (std::size_t a = begin; a < end; ++a) {
      const std::uint32_t c = row_[a];
      subtract_product(below_[a], below_[a], diagonal_[c]);
      std::size_t to = column_[c];
      for (std::size_t b = a + 1; b < end; ++b) {
        while (row_[to] < row_[b]) ++to;
        subtract_product(below_[b], below_[a], below_[to]);
      }
    }
  }
}

void BodyMatrix::solve(double* x) {
  double* y = work_.data();
  for (std::uint32_t k = 0; k < count_; ++k)
    std::memcpy(y + 6 * k, x + std::size_t{6} * order_[k], 6 * sizeof(double));
  for (std::uint32_t k = 0; k < count_; ++k) {
    double* z = y + std::size_t{6} * k;
    const Block6& L = diagonal_[k];
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < i; ++j) z[i] -= L.at[i][j] * z[j];
      z[i] /= L.at[i][i];
    }
    for (std::size_t e = column_[k]; e < column_[k + 1]; ++e) {
      double* to = y + std::size_t{6} * row_[e];
      for (int i = 0; i < 6; ++i) {
        double s = 0;
        for (int j = 0; j < 6; ++j) s += below_[e].at[i][j] * z[j];
        to[i] -= s;
      }
    }
  }
  for (std::uint32_t k = count_; k-- > 0;) {
    double* z = y + std::size_t{6} * k;
    for (std::size_t e = column_[k]; e < column_[k + 1]; ++e) {
      const double* from = y + std::size_t{6} * row_[e];
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) z[j] -= below_[e].at[i][j] * from[i];
    }
    const Block6& L = diagonal_[k];
    for (int i = 5; i >= 0; --i) {
      for (int j = i + 1; j < 6; ++j) z[i] -= L.at[j][i] * z[j];
      z[i] /= L.at[i][i];
    }
  }
  for (std::uint32_t k = 0; k < count_; ++k)
    std::memcpy(x + std::size_t{6} * order_[k], y + 6 * k, 6 * sizeof(double));
}

}  // namespace plumb::inline PLUMB_ABI::detail::newton
