// A running sum that carries its rounding error along [Neumaier 1974]: the result is as good as one
// made in twice the precision, so that a million faces cost no digits.
#pragma once

#include <cmath>

#include "plumb/precision.h"

namespace plumb::inline PLUMB_ABI::assets::detail {

class CompensatedSum {
 public:
  void add(double value) {
    const double total = sum_ + value;
    carry_ += std::abs(sum_) >= std::abs(value) ? (sum_ - total) + value : (value - total) + sum_;
    sum_ = total;
    size_ += std::abs(value);
  }
  [[nodiscard]] double value() const { return sum_ + carry_; }
  [[nodiscard]] double size() const { return size_; }  // sum of the absolute values

 private:
  double sum_ = 0, carry_ = 0, size_ = 0;
};

}  // namespace plumb::inline PLUMB_ABI::assets::detail
