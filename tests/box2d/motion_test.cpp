// Proves, against Box2D 2.4.1, that planar motion without resting contacts is the same in both
// engines wherever both are exact, and that where they differ the closed form is on this side.
#include <gtest/gtest.h>

#include "box2d/planar_pair.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace box2d_comparison;

// Box2D's semi-implicit Euler falls g h t/2 too far; here the parabola is exact.
TEST(Box2dMotion, FreeFall) {
  PlanarPair pair;
  const auto body = pair.add_box(0.5, 0.5, {.x = 1, .y = 100, .vx = 3, .vy = 4, .spin = 2});
  const double t = 2;
  pair.run_both(t);
  const Planar a = PlanarPair::theirs(body), b = pair.ours(body);
  const double y = 100 + 4 * t - kGravity * t * t / 2, vy = 4 - kGravity * t;
  const double round_off = sum_error(480, 100);
  EXPECT_NEAR(b.y, y, round_off);
  EXPECT_NEAR(a.y, y - kGravity * kDt * t / 2, 1e-3);  // single precision near 100 m
  EXPECT_NEAR(a.vy, vy, 1e-3);
  EXPECT_NEAR(b.vy, vy, round_off);
  EXPECT_NEAR(a.x, b.x, 1e-3);
  EXPECT_NEAR(a.spin, b.spin, 1e-5);
  // 4 rad turned, shown between -pi and pi here.
  EXPECT_NEAR(std::remainder(a.angle - b.angle, 2 * kPi), 0, 1e-4);
}

TEST(Box2dMotion, ImpulsesAtPoints) {
  PlanarPair pair(0);
  const auto body = pair.add_box(0.3, 0.6, {.angle = 0.4});
  body.theirs->ApplyLinearImpulse(b2Vec2(100, 200), b2Vec2(0.2f, -0.3f), true);
  body.theirs->ApplyAngularImpulse(7, true);
  must(pair.world().apply_impulse_at(body.ours, vec(100, 200, 0), pos(0.2, -0.3, 0)));
  must(pair.world().apply_angular_impulse(body.ours, vec(0, 0, 7)));
  pair.run_both(1);
  const Planar a = PlanarPair::theirs(body), b = pair.ours(body);
  EXPECT_NEAR(a.vx, b.vx, 1e-5);
  EXPECT_NEAR(a.vy, b.vy, 1e-5);
  // Box2D derives the moment from the polygon without its skin, as here.
  EXPECT_NEAR(a.spin, b.spin, 1e-5 * std::abs(a.spin) + 1e-6);
  EXPECT_NEAR(a.x, b.x, 1e-5);
  EXPECT_NEAR(a.angle, b.angle, 1e-4);
}

// Closed form: v1' = (m1 - m2)/(m1 + m2) v, v2' = 2 m1/(m1 + m2) v.
TEST(Box2dMotion, ElasticHitOfUnequalDiscs) {
  PlanarPair pair(0);
  const Surface elastic{0, 1};
  const auto first = pair.add_disc(0.5, {.x = -2, .vx = 3}, elastic, 1000);
  const auto second = pair.add_disc(0.5, {.x = 1}, elastic, 2000);
  pair.run_both(2);
  for (const auto& [body, expected] : {std::pair(first, -1.0), std::pair(second, 2.0)}) {
    EXPECT_NEAR(PlanarPair::theirs(body).vx, expected, 1e-4);
    EXPECT_NEAR(pair.ours(body).vx, expected, 1e-5);
  }
}

// Apexes e^2 h, e^4 h. Box2D bounces at the end of the step in which it touches, with the speed it
// has then: off by up to g h of 6.3 m/s, 5 % of the height; here the bounce has its own time.
TEST(Box2dMotion, BouncingDisc) {
  PlanarPair pair;
  const Surface bouncy{0, 0.8};
  pair.add_ground(bouncy);
  const auto disc = pair.add_disc(0.25, {.y = 2.25}, bouncy);
  std::vector<double> theirs, ours;
  double last_a = 0, last_b = 0;
  for (int i = 0; i < 180; ++i) {
    pair.step();
    const Planar a = PlanarPair::theirs(disc), b = pair.ours(disc);
    const auto apex = [](const Planar& p) { return p.y - 0.25 + p.vy * p.vy / (2 * kGravity); };
    if (last_a > 0 && a.vy <= 0) theirs.push_back(apex(a));
    if (last_b > 0 && b.vy <= 0) ours.push_back(apex(b));
    last_a = a.vy;
    last_b = b.vy;
  }
  ASSERT_GE(theirs.size(), 2u);
  ASSERT_GE(ours.size(), 2u);
  EXPECT_NEAR(ours[0], 1.28, 1e-3);
  EXPECT_NEAR(ours[1], 0.8192, 1e-3);
  EXPECT_NEAR(theirs[0], 1.28, 0.06 * 1.28);
  EXPECT_NEAR(theirs[1], 0.8192, 0.12 * 0.8192);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
