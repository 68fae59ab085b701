// Straight lines through measurements that were repeated, and how sure of them one may be.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace plumb::cli {

// A mean and the half width of its 95 % confidence interval [unit of the values].
struct Estimate {
  double mean = 0, half_width = 0;
  [[nodiscard]] bool may_be_zero() const { return std::abs(mean) <= half_width; }
};

// The 97.5 % quantile of Student's t for n >= 3 degrees of freedom, to 1.5 % (n = 3), 0.1 % (n >=
// 7) [Abramowitz and Stegun 26.7.5].
inline double student_975(double n) {
  constexpr double x = 1.959963985;  // of the normal distribution
  constexpr double x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x, x9 = x7 * x * x;
  return x + (x3 + x) / (4 * n) + (5 * x5 + 16 * x3 + 3 * x) / (96 * n * n) +
         (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * n * n * n) +
         (79 * x9 + 776 * x7 + 1482 * x5 - 1920 * x3 - 945 * x) / (92160 * n * n * n * n);
}

inline double variance_of(const std::vector<double>& values) {  // of one of them
  double mean = 0, sum = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size() - 1);
}

inline Estimate estimate(const std::vector<double>& values) {  // at least four
  const double n = static_cast<double>(values.size());
  Estimate out;
  for (const double value : values) out.mean += value / n;
  out.half_width = student_975(n - 1) * std::sqrt(variance_of(values) / n);
  return out;
}

struct Line {
  double a = 0, b = 0;  // y = a + b x
};

// By least squares of sum weight (y - a - b x)^2.
inline Line line_through(const std::vector<double>& x, const std::vector<double>& y,
                         const std::vector<double>& weight) {
  double w = 0, mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    w += weight[i];
    mx += weight[i] * x[i];
    my += weight[i] * y[i];
  }
  mx /= w;
  my /= w;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += weight[i] * (x[i] - mx) * (x[i] - mx);
    xy += weight[i] * (x[i] - mx) * (y[i] - my);
  }
  const double b = xy / xx;
  return {my - b * mx, b};
}

struct RepeatedLine {
  Estimate a, b;
  std::vector<Estimate> points;  // by x
};

// y[repeat][i] at x[i]. Each repeat gets a line of its own; the spread of these lines is the
// uncertainty, whatever the repeats have in common within themselves. A point counts by the inverse
// of its variance over the repeats, so that noisy ones do not decide.
inline RepeatedLine fit_repeats(const std::vector<double>& x,
                                const std::vector<std::vector<double>>& y) {
  RepeatedLine out;
  std::vector<double> weight(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::vector<double> column;
    for (const auto& repeat : y) column.push_back(repeat[i]);
    out.points.push_back(estimate(column));
    const double variance = variance_of(column);
    weight[i] = variance > 0 ? 1 / variance : 1;
  }
  std::vector<double> a, b;
  for (const auto& repeat : y) {
    const Line line = line_through(x, repeat, weight);
    a.push_back(line.a);
    b.push_back(line.b);
  }
  out.a = estimate(a);
  out.b = estimate(b);
  return out;
}

}  // namespace plumb::cli
