#include "geometry/exact_predicates.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plumb::inline PLUMB_ABI::assets::detail {
namespace {

constexpr double kUnitRoundoff = std::numeric_limits<double>::epsilon() / 2;
// Error bounds of the two determinants evaluated in doubles, relative to the sum of the products'
// sizes [Shewchuk 1997, section 4].
constexpr double kFilter2d = (3 + 16 * kUnitRoundoff) * kUnitRoundoff;
constexpr double kFilter3d = (7 + 56 * kUnitRoundoff) * kUnitRoundoff;

struct TwoTerms {
  double high, low;
};

TwoTerms exact_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

TwoTerms exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

// A sum of doubles that do not overlap, smallest first, zeros left out. 192 terms hold the largest
// determinant here: 3 * (2 products of 2x2 terms = 16) * 2 terms * 2.
class Expansion {
 public:
  static Expansion difference(double a, double b) {
    Expansion e;
    const TwoTerms t = exact_sum(a, -b);
    e.push(t.low);
    e.push(t.high);
    return e;
  }

  // Adds one double, keeping the terms non-overlapping.
  void add(double value) {
    std::size_t kept = 0;
    double carry = value;
    for (std::size_t i = 0; i < count_; ++i) {
      const TwoTerms t = exact_sum(carry, terms_[i]);
      carry = t.high;
      if (t.low != 0) terms_[kept++] = t.low;
    }
    count_ = kept;
    push(carry);
  }

  void add(const Expansion& other, double sign) {
    for (std::size_t i = 0; i < other.count_; ++i) add(sign * other.terms_[i]);
  }

  [[nodiscard]] Expansion times(const Expansion& other) const {
    Expansion product;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < other.count_; ++j) {
        const TwoTerms t = exact_product(terms_[i], other.terms_[j]);
        product.add(t.low);
        product.add(t.high);
      }
    }
    return product;
  }

  // Of a non-overlapping sum the largest term carries the sign.
  [[nodiscard]] int sign() const {
    if (count_ == 0) return 0;
    return terms_[count_ - 1] > 0 ? 1 : -1;
  }

 private:
  void push(double value) {
    if (value != 0) terms_[count_++] = value;
  }

  std::array<double, 192> terms_;
  std::size_t count_ = 0;
};

// a * d - b * c
Expansion minor_of(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d) {
  Expansion result = a.times(d);
  result.add(b.times(c), -1);
  return result;
}

int sign_of(double value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

}  // namespace

int orientation_2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double determinant = left - right;
  const double size = std::abs(left) + std::abs(right);
  if (std::abs(determinant) > kFilter2d * size || size == 0) return sign_of(determinant);
  return minor_of(Expansion::difference(a.x(), c.x()), Expansion::difference(a.y(), c.y()),
                  Expansion::difference(b.x(), c.x()), Expansion::difference(b.y(), c.y()))
      .sign();
}

int orientation_3d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Eigen::Vector3d& d) {
  // Rows a - d, b - d, c - d; their determinant is minus the one wanted.
  const double adx = a.x() - d.x(), ady = a.y() - d.y(), adz = a.z() - d.z();
  const double bdx = b.x() - d.x(), bdy = b.y() - d.y(), bdz = b.z() - d.z();
  const double cdx = c.x() - d.x(), cdy = c.y() - d.y(), cdz = c.z() - d.z();
  const double bxcy = bdx * cdy, cxby = cdx * bdy;
  const double cxay = cdx * ady, axcy = adx * cdy;
  const double axby = adx * bdy, bxay = bdx * ady;
  const double determinant = adz * (bxcy - cxby) + bdz * (cxay - axcy) + cdz * (axby - bxay);
  const double size = (std::abs(bxcy) + std::abs(cxby)) * std::abs(adz) +
                      (std::abs(cxay) + std::abs(axcy)) * std::abs(bdz) +
                      (std::abs(axby) + std::abs(bxay)) * std::abs(cdz);
  if (std::abs(determinant) > kFilter3d * size || size == 0) return -sign_of(determinant);

  const Expansion ax = Expansion::difference(a.x(), d.x()),
                  ay = Expansion::difference(a.y(), d.y());
  const Expansion bx = Expansion::difference(b.x(), d.x()),
                  by = Expansion::difference(b.y(), d.y());
  const Expansion cx = Expansion::difference(c.x(), d.x()),
                  cy = Expansion::difference(c.y(), d.y());
  Expansion sum = minor_of(bx, by, cx, cy).times(Expansion::difference(a.z(), d.z()));
  sum.add(minor_of(cx, cy, ax, ay).times(Expansion::difference(b.z(), d.z())), 1);
  sum.add(minor_of(ax, ay, bx, by).times(Expansion::difference(c.z(), d.z())), 1);
  return -sum.sign();
}

}  // namespace plumb::inline PLUMB_ABI::assets::detail
