// Invariant: the line through repeated measurements is the one that they lie on, and its confidence
// interval holds the truth as often as it says: a fixed cost of zero is not told from zero in
// nineteen cases of twenty, and one that is there is seen.
#include "cli/line_fit.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace plumb::cli {
namespace {

const std::vector<double> kX = {1, 10, 100, 1000};

// Repeats of y = a + b x. Each x has noise of its own size, and a repeat a shift that all of its
// points have: they are measured against one and the same.
std::vector<std::vector<double>> measured(double a, double b, double shift, double noise,
                                          testing_support::Random& random, int repeats = 20) {
  const auto normal = [&] {  // nearly: twelve uniform numbers
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
    return sum;
  };
  std::vector<std::vector<double>> y;
  for (int r = 0; r < repeats; ++r) {
    const double common = shift * normal();
    y.emplace_back();
    for (const double x : kX)
      y.back().push_back(a + b * x + common + noise * (1 + x / 50) * normal());
  }
  return y;
}

TEST(LineFit, FindsTheLineThatPointsLieOn) {
  testing_support::Random random(1);
  const RepeatedLine line = fit_repeats(kX, measured(-3, 0.25, 0, 0, random));
  EXPECT_NEAR(line.a.mean, -3, 1e-12);
  EXPECT_NEAR(line.b.mean, 0.25, 1e-14);
  EXPECT_LT(line.a.half_width, 1e-12);
  EXPECT_FALSE(line.a.may_be_zero());
  EXPECT_NEAR(line.points[2].mean, 22, 1e-12);
}

// [Abramowitz and Stegun, table 26.10]
TEST(LineFit, KnowsStudentsQuantiles) {
  EXPECT_NEAR(student_975(3), 3.182, 0.015 * 3.182);
  EXPECT_NEAR(student_975(7), 2.365, 0.001 * 2.365);
  EXPECT_NEAR(student_975(19), 2.093, 0.001);
  EXPECT_NEAR(student_975(120), 1.980, 0.001);
}

// Of 2000 intervals of 95 % between 93 % and 97 % hold the truth (four standard deviations of the
// count are 1.9 %); points do not count less than they should, nor more.
TEST(LineFit, IntervalsHoldTheTruthAsOftenAsTheySay) {
  testing_support::Random random(2);
  int zero = 0, slope = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RepeatedLine line = fit_repeats(kX, measured(0, 0.2, 0.3, 0.5, random));
    zero += line.a.may_be_zero() ? 1 : 0;
    slope += std::abs(line.b.mean - 0.2) <= line.b.half_width ? 1 : 0;
  }
  EXPECT_GT(zero, 0.93 * kTrials);
  EXPECT_LT(zero, 0.97 * kTrials);
  EXPECT_GT(slope, 0.93 * kTrials);
  EXPECT_LT(slope, 0.97 * kTrials);
}

// The point of a thousand is as noisy as a hundred bodies cost; what one body costs is seen all the
// same, because it is weighed by its own noise.
TEST(LineFit, SeesAFixedCostBesideNoisyLargeOnes) {
  testing_support::Random random(3);
  int seen = 0;
  for (int trial = 0; trial < 200; ++trial)
    seen += fit_repeats(kX, measured(1, 0.2, 0.1, 0.5, random)).a.may_be_zero() ? 0 : 1;
  EXPECT_EQ(seen, 200);
}

}  // namespace
}  // namespace plumb::cli
