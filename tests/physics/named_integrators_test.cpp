// The comparison integrators have the faults they are kept for: the book's is slow at speed and
// loses angular momentum, the implicit gyroscopic step takes energy out; both are right at small
// steps.
#include "motion/named_integrators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "free_top.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

TEST(NamedIntegrators, BookTurnsTooSlowlyAtSpeed) {
  for (const auto& [spin, share] : {std::pair{30.0, 0.9799}, std::pair{100.0, 0.8337}}) {
    Quat64 R{0, 0, 0, 1};
    advance_book(R, {0, 0, spin}, kTick);
    EXPECT_NEAR(2 * std::atan2(R.z, R.w) / (spin * kTick), share, 1e-4);
  }
}

// The quaternion update for a world w is (1/2) w q: after 90 degrees about x, spin about world y.
TEST(NamedIntegrators, BookTakesTheAngularVelocityInWorldAxes) {
  const double half = std::numbers::sqrt2 / 2;
  Quat64 R{half, 0, 0, half};
  for (int i = 0; i < 1000; ++i) advance_book(R, {0, std::numbers::pi / 2, 0}, 1e-3);
  const Vec64 z = rotate(R, Vec64{0, 0, 1});  // z -> -y by the turn about x; -y stays under y
  EXPECT_NEAR(z.y, -1, 1e-6);
  const Vec64 x = rotate(R, Vec64{1, 0, 0});  // x stays x, then goes to -z
  EXPECT_NEAR(x.z, -1, 1e-6);                 // (|w| h)^2/12 = 2e-7 short
}

TEST(NamedIntegrators, BookLosesAngularMomentumAndTheFlowDoesNot) {
  const Vec64 I{1, 2, 3}, w{1, 1, 1};
  const Top exact = top_of(I, w);
  Quat64 R = exact.R;
  double worst = 0;
  for (int i = 0; i < 600; ++i) {
    advance_book(R, w, kTick);
    const Vec64 L = rotate(R, multiply_each(I, inverse_rotate(R, w)));
    worst = std::max(worst, length(L - exact.L) / length(exact.L));
  }
  EXPECT_NEAR(worst, 0.756, 0.001);
}

TEST(NamedIntegrators, ImplicitGyroscopicStepTakesEnergyOut) {
  const Vec64 I{1, 2, 3};
  Quat64 R{0, 0, 0, 1};
  Vec64 w{0.1, 10, 0};
  const auto energy = [&] {
    const Vec64 b = inverse_rotate(R, w);
    return 0.5 * dot(b, multiply_each(I, b));
  };
  const double before = energy();
  for (int i = 0; i < 600; ++i) advance_implicit_gyro(R, w, I, kTick);
  EXPECT_NEAR(energy() / before - 1, -0.54, 0.01);
}

TEST(NamedIntegrators, ImplicitGyroscopicStepConvergesToTheFlow) {
  const Vec64 I{1, 2, 3};
  std::array<double, 2> error{};
  for (std::size_t k = 0; k < 2; ++k) {
    const int steps = k == 0 ? 2000 : 4000;
    Top top = top_of(I, {1, 2, 3});
    Quat64 R = top.R;
    Vec64 w = rotate(R, top.body_spin());
    for (int i = 0; i < steps; ++i) advance_implicit_gyro(R, w, I, 1.0 / steps);
    top.advance(1);
    error[k] = angle_between(R, {top.R.x, top.R.y, top.R.z, top.R.w});
  }
  EXPECT_LE(error[0], 1e-2);
  EXPECT_NEAR(error[0] / error[1], 2, 0.05);  // first order
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI::detail
