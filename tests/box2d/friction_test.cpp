// Proves, against Box2D 2.4.1, that friction decides the same way in both engines: stick or slip on
// a slope, the sliding acceleration, the change from sliding to rolling.
#include <gtest/gtest.h>

#include "box2d/planar_pair.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace box2d_comparison;

struct Slide {
  Planar theirs, ours;
  double along_theirs, along_ours;  // [m/s] down the slope
};
// A low box for two seconds on a slope of 20 degrees falling towards +x.
Slide slide(double mu) {
  const double angle = 20 * kPi / 180;
  PlanarPair pair;
  pair.add_ground({mu, 0}, -angle);
  const double hy = 0.1;
  const auto body = pair.add_box(
      0.5, hy, {.x = hy * std::sin(angle), .y = hy * std::cos(angle), .angle = -angle}, {mu, 0});
  pair.run_both(2);
  const auto along = [&](const Planar& p) {
    return p.vx * std::cos(angle) - p.vy * std::sin(angle);
  };
  const Planar a = PlanarPair::theirs(body), b = pair.ours(body);
  return {a, b, along(a), along(b)};
}

TEST(Box2dFriction, SlopeSticksAboveTheTangent) {
  const double critical = std::tan(20 * kPi / 180);
  const Slide s = slide(1.05 * critical);
  EXPECT_NEAR(s.along_theirs, 0, 1e-3);
  EXPECT_NEAR(s.along_ours, 0, 1e-4);
  // Box2D's box is lifted by its skin first.
  EXPECT_NEAR(s.theirs.x, s.ours.x, 2 * kSkinGap);
}

// v = g (sin - mu cos) t; Box2D first lifts the box by its skin, which loads the contact for a
// moment.
TEST(Box2dFriction, SlopeSlidesBelowTheTangent) {
  const double angle = 20 * kPi / 180, critical = std::tan(angle);
  for (double part : {0.0, 0.3, 0.6, 0.95}) {
    const Slide s = slide(part * critical);
    const double exact = kGravity * (std::sin(angle) - part * critical * std::cos(angle)) * 2;
    EXPECT_NEAR(s.along_ours, exact, 1e-3 * kGravity) << part;
    EXPECT_NEAR(s.along_theirs, exact, 0.1) << part;
  }
}

// A disc rolls at 2/3 of its sliding speed, whatever the friction: angular momentum about the
// contact is kept.
TEST(Box2dFriction, SlidingDiscBeginsToRoll) {
  for (double mu : {0.1, 0.3, 0.8}) {
    PlanarPair pair;
    pair.add_ground({mu, 0});
    const auto disc = pair.add_disc(0.5, {.x = -10, .y = 0.5, .vx = 6}, {mu, 0});
    pair.run_both(4);
    const Planar a = PlanarPair::theirs(disc), b = pair.ours(disc);
    EXPECT_NEAR(b.vx, 4, 1e-3) << mu;
    EXPECT_NEAR(b.spin, -8, 2e-3) << mu;
    EXPECT_NEAR(a.vx, 4, 0.02) << mu;
    EXPECT_NEAR(a.spin, -8, 0.05) << mu;
    // Where it is: 6 t - mu g t^2/2 up to t = 2/(mu g), then 4 m/s.
    const double t = 2 / (mu * kGravity);
    const double x = -10 + 6 * t - mu * kGravity * t * t / 2 + 4 * (4 - t);
    EXPECT_NEAR(b.x, x, 0.01) << mu;
    EXPECT_NEAR(a.x, x, 0.1) << mu;
  }
}

TEST(Box2dFriction, SlidesToAStop) {
  PlanarPair pair;
  pair.add_ground({0.5, 0});
  const auto body = pair.add_box(0.5, 0.1, {.x = -5, .y = 0.1, .vx = 6}, {0.5, 0});
  pair.run_both(3);
  const double d = 36 / (2 * 0.5 * kGravity);
  EXPECT_NEAR(pair.ours(body).x, -5 + d, 1e-2 * d);
  EXPECT_NEAR(PlanarPair::theirs(body).x, -5 + d, 0.03 * d);
  EXPECT_NEAR(pair.ours(body).vx, 0, 1e-5);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
