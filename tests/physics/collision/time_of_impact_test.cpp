// Invariant: two shapes that move and turn do not come nearer than the sought separation before the
// reported time, and are that near, to the tolerance, when it is reported; however fast they spin.
#include "collision/time_of_impact.h"

#include <gtest/gtest.h>

#include "support/collision_oracle.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;
using oracle::Random;
using oracle::Solid;
using oracle::V;

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());
constexpr double kPi = 3.14159265358979323846;

NumVec num(const V& v) { return {v.x(), v.y(), v.z()}; }
V eigen(NumVec v) { return {v.x, v.y, v.z}; }

CollisionShape shape_of(Random& random, int kind, double size) {
  return make_collision_shape(oracle::random_shape(random, kind, size, 0.05));
}

NumRotation rotation(Random& random) {
  const Rotation q = random.rotation();
  return normalized(NumRotation{static_cast<Num>(q.x), static_cast<Num>(q.y), static_cast<Num>(q.z),
                                static_cast<Num>(q.w)});
}

// The shape as its sweep places it, from the solid in its own frame.
Solid placed(const Solid& local, const SweptShape& swept, double t) {
  const NumRotation body = swept.sweep.rotation_at(t);
  const NumRotation q = normalized(body * swept.q);
  const NumVec p = swept.sweep.centre_at(t) + rotate(body, swept.p);
  Solid s = local;
  for (V& v : s.vertices) v = eigen(rotate(q, num(v)) + p);
  for (V& n : s.normals) n = eigen(rotate(q, num(n)));
  return s;
}
Solid local_solid(const CollisionShape& shape) {
  return oracle::solid_of(shape, {{0, 0, 0}, {0, 0, 0, 1}});
}

struct Motion {
  double spin;      // [rad] largest turn of each
  bool tumbles;     // free tops instead of steady turns
  bool bent;        // parabolas
  bool offset;      // shapes away from the centres
  double distance;  // [sizes] at most, at the beginning
  double travel;    // [sizes] at most
};

Sweep sweep_of(Random& random, const Motion& m, double size) {
  Sweep s;
  s.centre = num(m.distance * size * random.uniform(0, 1) * random.direction());
  s.travel = num(m.travel * size * random.uniform(0, 1) * random.direction());
  if (m.bent) s.bend = num(m.travel * size * random.uniform(0, 1) * random.direction());
  s.start = rotation(random);
  s.turn = num(m.spin * random.uniform(0, 1) * random.direction());
  if (m.tumbles) {
    s.tumbles = true;
    s.inverse_moments = {1 / random.uniform(1, 2), 1 / random.uniform(1.5, 2), 1 / 2.5};
    s.momentum = num(2 * m.spin * random.uniform(0, 1) * random.direction());
  }
  return s;
}

struct Tally {
  int met = 0, apart = 0, touching = 0, unfinished = 0, looks = 0, advances = 0, most_looks = 0;
};

// Every answer against the signed distance at many times, by brute force over all features.
Tally compare_with_samples(unsigned seed, int cases, int samples, const Motion& m) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < cases; ++i) {
    const double size = random.scale(1e-2, 1e2);
    const CollisionShape a = shape_of(random, random.below(4), size),
                         b = shape_of(random, random.below(4), size * random.scale(0.2, 5));
    const Sweep sweep_a = sweep_of(random, m, size);
    Sweep sweep_b = sweep_of(random, m, size);
    // Half of them are aimed, to pass near A's centre at some time.
    if (m.travel > 1 && random.below(2) == 0) {
      const double t = random.uniform(0.1, 1);
      const NumVec target = sweep_a.centre_at(t) + num(size * random.direction());
      sweep_b.travel = (1 / t) * (target - sweep_b.centre) - t * sweep_b.bend;
    }
    const auto offset = [&] {
      return m.offset ? num(size * random.uniform(0, 1) * random.direction()) : NumVec{0, 0, 0};
    };
    const SweptShape in_a{a, offset(), rotation(random), sweep_a},
        in_b{b, offset(), rotation(random), sweep_b};
    const double thickness =
        static_cast<double>(std::min(smallest_thickness(a), smallest_thickness(b)));
    ImpactSearch search;
    search.separation = random.below(2) == 0 ? 0 : -0.008 * thickness;
    search.tolerance = 0.001 * thickness;
    const Impact impact = time_of_impact(in_a, in_b, search);
    tally.looks += impact.looks;
    tally.most_looks = std::max(tally.most_looks, impact.looks);
    tally.advances += impact.advances;

    const Solid solid_a = local_solid(a), solid_b = local_solid(b);
    const auto truth = [&](double t) {
      return signed_distance(placed(solid_a, in_a, t), placed(solid_b, in_b, t));
    };
    // Planes and depths of single precision, on coordinates of the shapes alone.
    const double rounding =
        32 * kEps * static_cast<double>(bounding_radius(a) + bounding_radius(b)) +
        1e-11 * size * (m.distance + 2 * m.travel);
    SCOPED_TRACE(testing::Message() << "case " << i << " size " << size << " time " << impact.time);
    const double first = truth(0);
    if (impact.status == ImpactStatus::Unfinished) {
      ++tally.unfinished;
    } else if (impact.status == ImpactStatus::Meets) {
      ++(impact.time > 0 ? tally.met : tally.touching);
      const double there = truth(impact.time);
      EXPECT_LE(there, search.separation + search.tolerance + rounding);
      if (impact.time > 0) {
        EXPECT_GE(there, search.separation - rounding);
      } else {
        EXPECT_LE(first, search.separation + search.tolerance + rounding);
      }
      EXPECT_NEAR(impact.distance, there, rounding);
    } else {
      ++tally.apart;
      EXPECT_EQ(impact.time, 1);
    }
    if (impact.time > 0) {
      EXPECT_NEAR(eigen(impact.normal).norm(), 1, 2 * kEps);
    }
    for (int k = 0; k <= samples; ++k) {
      const double t = impact.time * k / samples;
      if (impact.time == 0) break;
      const bool seen = truth(t) >= search.separation - rounding;
      EXPECT_TRUE(seen) << "passed unseen at " << t;
      if (!seen) break;
    }
  }
  return tally;
}

TEST(TimeOfImpact, NothingIsPassedOnStraightPaths) {
  const Tally t = compare_with_samples(1, 800, 150, {0, false, false, false, 6, 12});
  EXPECT_GT(t.met, 150);
  EXPECT_GT(t.apart, 150);
  EXPECT_EQ(t.unfinished, 0);
  EXPECT_LE(t.looks, 800 * 4);
}

TEST(TimeOfImpact, NothingIsPassedWhileTurning) {
  const Tally t = compare_with_samples(2, 800, 150, {kPi, false, false, true, 6, 12});
  EXPECT_GT(t.met, 150);
  EXPECT_GT(t.apart, 150);
  EXPECT_EQ(t.unfinished, 0);
}

TEST(TimeOfImpact, NothingIsPassedOnParabolasByFreeTops) {
  const Tally t = compare_with_samples(3, 600, 150, {2 * kPi, true, true, true, 6, 12});
  EXPECT_GT(t.met, 100);
  EXPECT_GT(t.apart, 100);
  EXPECT_EQ(t.unfinished, 0);
}

// A hundred turns within the span: far more between two of the samples than a look at the end
// shows.
TEST(TimeOfImpact, NothingIsPassedWhileSpinningFast) {
  const Tally t = compare_with_samples(4, 150, 2000, {200 * kPi, false, false, true, 5, 3});
  EXPECT_GT(t.met, 50);
  EXPECT_GT(t.apart, 20);
  EXPECT_LE(t.unfinished, 15);
}

// Shapes that turn in place, near one another: many just graze.
TEST(TimeOfImpact, GrazingTurnsAreDecided) {
  const Tally t = compare_with_samples(5, 600, 200, {kPi, false, false, false, 2.6, 0.02});
  EXPECT_GT(t.met, 25);
  EXPECT_GT(t.apart, 50);
  EXPECT_EQ(t.unfinished, 0);
}

const NumRotation kUpright{0, 0, 0, 1};

// Closed forms: a sphere that passes a sphere at a distance just above and just below the sum of
// radii, on a straight line.
TEST(TimeOfImpact, AGrazingSphereMeetsExactlyWhenTheRadiiReach) {
  const CollisionShape ball = make_collision_shape(Sphere{Real(0.5)});
  const Sweep still = resting_at({0, 0, 0}, kUpright);
  for (const double miss : {0.5, 0.9, 0.999, 0.9999, 1.0001, 1.001, 1.1}) {
    Sweep flight = resting_at({-10, miss, 0}, kUpright);
    flight.travel = {20, 0, 0};
    ImpactSearch search;
    search.tolerance = 1e-5;
    const Impact impact = time_of_impact({ball, {0, 0, 0}, kUpright, still},
                                         {ball, {0, 0, 0}, kUpright, flight}, search);
    const double before = 1 - miss * miss;
    if (before <= 0) {
      EXPECT_EQ(impact.status, ImpactStatus::Apart) << miss;
      continue;
    }
    ASSERT_EQ(impact.status, ImpactStatus::Meets) << miss;
    const auto time = [&](double gap) {
      return (10 - std::sqrt(std::max(0.0, (1 + gap) * (1 + gap) - miss * miss))) / 20;
    };
    EXPECT_LE(impact.time, time(0) + 1e-12) << miss;
    EXPECT_GE(impact.time, time(1.1e-5)) << miss;
  }
}

// A rod on a hinge sweeps like the hand of a clock: its end meets a plane at a known angle.
TEST(TimeOfImpact, ATurningRodMeetsAPlaneAtTheRightAngle) {
  const CollisionShape rod = make_collision_shape(Box{Vec3(2, Real(0.01), Real(0.01))});
  const CollisionShape ground = make_collision_shape(HalfSpace{Vec3::UnitY(), Real(-1)});
  const Sweep still = resting_at({0, 0, 0}, kUpright);
  for (const double turns : {0.2, 1.0, 10.0, 1000.0}) {
    Sweep clock = resting_at({0, 0, 0}, kUpright);
    clock.turn = {0, 0, -turns * 2 * kPi};
    ImpactSearch search;
    search.tolerance = 1e-6;
    const Impact impact = time_of_impact({ground, {0, 0, 0}, kUpright, still},
                                         {rod, {0, 0, 0}, kUpright, clock}, search);
    ASSERT_EQ(impact.status, ImpactStatus::Meets) << turns;
    // The lower corner (2, -0.01): 2 sin a + 0.01 cos a = 1.
    const double r = std::sqrt(4 + 1e-4), a = std::asin(1 / r) - std::asin(0.01 / r);
    const double slope = std::sqrt(3.0);  // of the depth over the angle there [m/rad]
    const double exact = a / (turns * 2 * kPi);
    EXPECT_LE(impact.time, exact * (1 + 32 * kEps)) << turns;
    EXPECT_GE(impact.time, exact * (1 - 32 * kEps) - 1.1e-6 / slope / (turns * 2 * kPi)) << turns;
    EXPECT_EQ(impact.normal.y, 1) << turns;
  }
}

// What touches at the beginning may slide, roll, part and meet again, but not sink in.
TEST(TimeOfImpact, ATouchingPairIsFollowedUntilItDeepensOrParts) {
  const CollisionShape ball = make_collision_shape(Sphere{Real(0.5)});
  const CollisionShape slab = make_collision_shape(Box{Vec3(10, Real(0.05), 10)});
  const CollisionShape post = make_collision_shape(Box{Vec3(Real(0.05), 1, 1)});
  ImpactSearch search;
  search.tolerance = 1e-4;
  search.separation = -1e-3;
  search.touching = 1e-3;
  search.allowance = 0.0125;
  const Sweep still = resting_at({0, 0, 0}, kUpright), at_post = resting_at({5, 0, 0}, kUpright);
  Sweep roll = resting_at({0, 0.55 - 5e-4, 0}, kUpright);
  roll.travel = {8, 0, 0};
  roll.turn = {0, 0, -16};
  const auto against = [&](const CollisionShape& other, const Sweep& where, const Sweep& motion) {
    return time_of_impact({other, {0, 0, 0}, kUpright, where}, {ball, {0, 0, 0}, kUpright, motion},
                          search);
  };
  EXPECT_EQ(against(slab, still, roll).status, ImpactStatus::Apart);
  EXPECT_TRUE(against(slab, still, roll).touched);
  const Impact at_wall = against(post, at_post, roll);
  EXPECT_EQ(at_wall.status, ImpactStatus::Meets);
  EXPECT_FALSE(at_wall.touched);
  EXPECT_NEAR(at_wall.time, (5 - 0.05 - 0.5 + 1e-3) / 8, 2e-5);

  Sweep sink = roll;
  sink.travel = {8, -2, 0};
  const Impact sinking = against(slab, still, sink);
  EXPECT_EQ(sinking.status, ImpactStatus::Deepens);
  EXPECT_NEAR(sinking.time, (0.0125 + 5e-4) / 2, 1e-4);
  EXPECT_LE(sinking.time, (0.0125 + 5e-4) / 2);

  // Off the edge and down past the slab's side: nothing is met.
  Sweep off = resting_at({9, 0.55, 0}, kUpright);
  off.travel = {20, -0.02, 0};
  off.bend = {0, -3, 0};
  EXPECT_EQ(against(slab, still, off).status, ImpactStatus::Apart);

  // Up and down again: the second meeting may count as one or as deepening, within the allowance.
  Sweep bounce = resting_at({0, 0.55, 0}, kUpright);
  bounce.travel = {0, 4, 0};
  bounce.bend = {0, -8, 0};
  const Impact again = against(slab, still, bounce);
  EXPECT_TRUE(again.status == ImpactStatus::Meets || again.status == ImpactStatus::Deepens);
  EXPECT_NEAR(again.time, 0.5, 0.0135 / 4);
}

TEST(TimeOfImpact, OverlapAtTheBeginningIsToldAtOnce) {
  const CollisionShape box = make_collision_shape(Box{Vec3(1, 1, 1)});
  const Sweep still = resting_at({0, 0, 0}, kUpright);
  Sweep inside = resting_at({0.5, 0.1, 0}, kUpright);
  inside.travel = {10, 0, 0};
  ImpactSearch search;
  search.tolerance = 1e-3;
  const Impact impact =
      time_of_impact({box, {0, 0, 0}, kUpright, still}, {box, {0, 0, 0}, kUpright, inside}, search);
  EXPECT_EQ(impact.status, ImpactStatus::Meets);
  EXPECT_EQ(impact.time, 0);
  EXPECT_NEAR(impact.distance, -1.5, 8 * kEps);
  const CollisionShape ground = make_collision_shape(HalfSpace{});
  EXPECT_EQ(time_of_impact({ground, {0, 0, 0}, kUpright, still},
                           {ground, {0, 0, 0}, kUpright, still}, search)
                .status,
            ImpactStatus::Apart);
}

// The turn between two attitudes, whole turns included.
TEST(Sweep, FindsTheTurnNearestToTheOneExpected) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const NumVec turn = num(random.uniform(0, 40) * random.direction());
    const NumRotation q0 = normalized(rotation(random)),
                      q1 = normalized(from_rotation_vector(turn) * q0);
    const NumVec noise = num(random.uniform(0, 1) * random.direction());
    const NumVec found = turn_between(q0, q1, turn + noise);
    // Near whole turns the axis is lost with the sine of half the angle.
    const double sine = std::abs(std::sin(length(turn) / 2));
    EXPECT_NEAR(length(found - turn), 0, 1e-14 * length(turn) / sine + 1e-14);
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
