// Free rotation is exact to round-off for every inertia, spin and step length:
//   - the attitude agrees with an independent solution of the quaternion's own differential
//   equation
//   - energy and angular momentum neither drift nor decay
//   - flips of a tumbling body come at the times that elliptic functions give
#include "motion/rotation_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "free_top.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

struct Random {
  std::mt19937 engine;
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform{0, 1};
  explicit Random(unsigned seed) : engine(seed) {}

  Quat64 attitude() {
    return normalized(Quat64{normal(engine), normal(engine), normal(engine), normal(engine)});
  }
  // Moments of a real body (sums of pairs of second moments), up to about 100 : 1.
  Vec64 moments() {
    const auto second = [this] { return std::pow(100.0, uniform(engine)); };
    const double a = second(), b = second(), c = second();
    return {b + c, a + c, a + b};
  }
  Vec64 spin() { return {normal(engine), normal(engine), normal(engine)}; }
};

// What rounding alone may do in one step: each piece rounds the attitude (a product, a
// normalisation and n, a few units in the last place), and an error of that size in n is turned
// into a rate by the largest inverse moment.
template <class T>
double rounding_of_step(Quaternion<T> R, Vector3<T> L, Vector3<T> J, T h) {
  const T size = length(L);
  const T tumble =
      std::sqrt(tumble_squared(normalized_or(inverse_rotate(R, L), L), (h * size) * J));
  const T pieces = std::ceil(tumble / PieceChoice<T>::kLimit);
  const T turn = size * std::max(J.x, std::max(J.y, J.z)) * std::abs(h);
  return static_cast<double>(std::numeric_limits<T>::epsilon() * (4 + 4 * pieces + 4 * turn));
}
template <class T>
void expect_exact(Quaternion<T> R, Vector3<T> L, Vector3<T> J, T h) {
  Quaternion<T> turned = R;
  advance_rotation(turned, L, J, h);
  const double error = angle_between(turned, reference_turn(R, L, J, static_cast<Real80>(h)));
  EXPECT_LE(error, rounding_of_step(R, L, J, h))
      << "J " << J.x << ' ' << J.y << ' ' << J.z << ", h " << h;
}
template <class T>
Quaternion<T> cast_quaternion(Quat64 q) {
  return normalized(Quaternion<T>{static_cast<T>(q.x), static_cast<T>(q.y), static_cast<T>(q.z),
                                  static_cast<T>(q.w)});
}

// --- One step against the reference
// ----------------------------------------------------------------

template <class T>
class RotationFlow : public ::testing::Test {};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(RotationFlow, Numbers);

TYPED_TEST(RotationFlow, IsExactForRandomBodiesAtAnyStepLength) {
  using T = TypeParam;
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vec64 I = random.moments(), spin = random.spin();
    const Top top = top_of(I, spin, random.attitude());
    const double h =
        std::pow(10.0, -3 + 3.5 * random.uniform(random.engine)) / length(top.body_spin());
    expect_exact(cast_quaternion<T>(top.R), cast<T>(top.L), cast<T>(top.J),
                 static_cast<T>(i % 2 == 0 ? h : -h));
  }
}

// Middle axis 2; on the separatrix n1^2 (J1 - J2) = n3^2 (J2 - J3). The worst case for the series.
Top top_near_the_separatrix(Random& random) {
  const Vec64 any = random.moments();
  std::array<double, 3> I{any.x, any.y, any.z};
  std::sort(I.begin(), I.end());
  const double slope = std::sqrt((1 / I[0] - 1 / I[1]) / (1 / I[1] - 1 / I[2]));
  const double n2 = 2 * random.uniform(random.engine) - 1;
  const double n1 = std::sqrt((1 - n2 * n2) / (1 + slope * slope));
  const double off = std::pow(10.0, -1 - 9 * random.uniform(random.engine));
  Top top;
  top.J = {1 / I[0], 1 / I[1], 1 / I[2]};
  top.R = random.attitude();
  top.L = rotate(top.R, I[0] * Vec64{n1 * (1 + off), n2, n1 * slope});
  return top;
}
TYPED_TEST(RotationFlow, IsExactNextToTheSeparatrix) {
  using T = TypeParam;
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Top top = top_near_the_separatrix(random);
    const double h = 0.05 + 2 * random.uniform(random.engine);
    expect_exact(cast_quaternion<T>(top.R), cast<T>(top.L), cast<T>(top.J), static_cast<T>(h));
  }
}

// What the sigma functions and the quadrature leave out, seen in wider numbers: at the limit of a
// piece less than the round-off of the type that they are cut for.
TYPED_TEST(RotationFlow, OnePieceLeavesOutLessThanRoundOff) {
  using T = TypeParam;
  Random random(6);
  const auto sine_and_cosine = [](Real80 a, Real80& s, Real80& c) {
    s = std::sin(a);
    c = std::cos(a);
  };
  double worst = 0;
  int looked_at = 0;
  for (int i = 0; i < 400; ++i) {
    const Top top = i % 2 == 0 ? top_near_the_separatrix(random)
                               : top_of(random.moments(), random.spin(), random.attitude());
    const auto L = cast<Real80>(inverse_rotate(top.R, top.L));
    const Vector3<Real80> n = (1 / length(L)) * L, J = cast<Real80>(top.J);
    const Real80 tumble = std::sqrt(tumble_squared(n, J));
    const Vector3<Real80> g = (static_cast<Real80>(PieceChoice<T>::kLimit) / tumble) * J;
    if (length(multiply_each(g, n)) > 10) continue;  // [rad] what hardly tumbles turns too far
    ++looked_at;
    const auto turn = midpoint_turn<T>(n, Real80(0.5) * g, sine_and_cosine);
    const Quaternion<Real80> start{0, 0, 0, 1};
    worst = std::max(worst, angle_between(turn, reference_turn(start, n, g, 1)));
  }
  EXPECT_GT(looked_at, 300);
  EXPECT_LE(worst, static_cast<double>(std::numeric_limits<T>::epsilon()));
}

// An axis about which the body cannot turn has J = 0, and the rest may be no real body's moments.
TYPED_TEST(RotationFlow, IsExactWithLockedAxes) {
  using T = TypeParam;
  Random random(3);
  for (int i = 0; i < 70; ++i) {
    Vec64 J{std::exp(random.normal(random.engine)), std::exp(random.normal(random.engine)),
            std::exp(random.normal(random.engine))};
    for (int axis = 0; axis < 3; ++axis) {
      if ((i % 7 + 1) >> axis & 1) set_component(J, axis, 0.0);
    }
    const Quaternion<T> R = cast_quaternion<T>(random.attitude());
    const Vector3<T> L = cast<T>(random.spin());
    expect_exact(R, L, cast<T>(J), static_cast<T>(0.3 + i % 5));
  }
}

TYPED_TEST(RotationFlow, HoldsStillWithoutMomentumOrTime) {
  using T = TypeParam;
  const Quaternion<T> R = cast_quaternion<T>({1, 2, 3, 4});
  for (const Vector3<T> J : {Vector3<T>{1, 2, 3}, Vector3<T>{1, 1, 2}, Vector3<T>{1, 1, 1}}) {
    for (const T L : {T(0), std::numeric_limits<T>::min(), T(1)}) {
      Quaternion<T> turned = R;
      advance_rotation(turned, {L, L, L}, J, L == T(1) ? T(0) : T(1));
      EXPECT_LE(angle_between(turned, {R.x, R.y, R.z, R.w}), 4 * std::numeric_limits<T>::epsilon());
    }
  }
}

// Sizes whose squares leave the range of the type: the turn depends on |L| J h alone.
TYPED_TEST(RotationFlow, DependsOnTheProductOfMomentumAndInverseInertiaOnly) {
  using T = TypeParam;
  const T tiny = std::ldexp(T(1), std::numeric_limits<T>::min_exponent * 3 / 4);
  const Quaternion<T> R = cast_quaternion<T>({1, 2, 3, 4});
  Quaternion<T> one = R, small = R, large = R;
  advance_rotation(one, Vector3<T>{1, 2, 3}, Vector3<T>{T(0.5), T(0.2), T(0.1)}, T(1));
  advance_rotation(small, tiny * Vector3<T>{1, 2, 3},
                   (1 / tiny) * Vector3<T>{T(0.5), T(0.2), T(0.1)}, T(1));
  advance_rotation(large, (1 / tiny) * Vector3<T>{1, 2, 3},
                   tiny * Vector3<T>{T(0.5), T(0.2), T(0.1)}, T(1));
  for (const Quaternion<T>& q : {small, large}) {
    EXPECT_LE(angle_between(q, {one.x, one.y, one.z, one.w}),
              8 * std::numeric_limits<T>::epsilon());
  }
}

TEST(RotationFlow, SpinsTooFastToResolveKeepEnergyAndStayFinite) {
  Top top = top_of({1, 2, 3}, {1e6, 2e6, 3e6});  // 6e4 rad of tumbling a tick
  const double energy = top.energy();
  for (int i = 0; i < 10; ++i) top.advance(kTick);
  ASSERT_TRUE(is_finite(top.R));
  EXPECT_NEAR(top.energy() / energy, 1, 1e-12);
}

TEST(RotationFlow, KindOfInertiaIsReadFromTheMoments) {
  EXPECT_EQ(classify_inertia(Vec64{2, 2, 2}), RotationKind::Isotropic);
  EXPECT_EQ(classify_inertia(Vec64{0, 0, 0}), RotationKind::Isotropic);
  EXPECT_EQ(classify_inertia(Vec64{1, 2, 2}), RotationKind::Symmetric);
  EXPECT_EQ(classify_inertia(Vec64{2, 1, 2}), RotationKind::Symmetric);
  EXPECT_EQ(classify_inertia(Vec64{2, 2, 1}), RotationKind::Symmetric);
  EXPECT_EQ(classify_inertia(Vec64{1, 2, std::nextafter(2.0, 3.0)}), RotationKind::Asymmetric);
}

// --- Many steps
// --------------------------------------------------------------------------------------

struct Motion {
  const char* name;
  Vec64 I, spin;
  double step;  // [s]
  double time;  // [s]
};
class LongMotion : public ::testing::TestWithParam<Motion> {};

TEST_P(LongMotion, KeepsEnergyAndAttitude) {
  constexpr int kAttitudes = 8;
  const Motion& motion = GetParam();
  const int steps = static_cast<int>(std::lround(motion.time / motion.step));
  const Real80 time = static_cast<Real80>(motion.step) * steps;
  Random random(7);
  double squares = 0;
  for (int k = 0; k < kAttitudes; ++k) {
    Top top =
        top_of(motion.I, motion.spin, k == 0 ? Quat64{0.1, -0.2, 0.3, 0.9} : random.attitude());
    const Top start = top;
    const double energy = start.energy();
    double worst = 0;
    for (int i = 0; i < steps; ++i) {
      top.advance(motion.step);
      worst = std::max(worst, std::abs(top.energy() / energy - 1));
    }
    EXPECT_LE(worst, 1e-12);
    EXPECT_NEAR(length_squared(Vec64{top.R.x, top.R.y, top.R.z}) + top.R.w * top.R.w, 1, 1e-15);
    const double error = angle_between(top.R, reference_turn(start.R, start.L, start.J, time));
    squares += error * error;
  }
  // Each rounding of the attitude tilts n, which the spread of moments makes into a wrong rate of
  // eps |w| I_max/I_min; they add up as a random walk over the steps and act for the whole time.
  const double spread = std::max(motion.I.x, std::max(motion.I.y, motion.I.z)) /
                        std::min(motion.I.x, std::min(motion.I.y, motion.I.z));
  const double tolerance = std::numeric_limits<double>::epsilon() * std::sqrt(steps) *
                           (1 + 4 * spread * length(motion.spin) * motion.time);
  EXPECT_LE(std::sqrt(squares / kAttitudes), tolerance);
}
INSTANTIATE_TEST_SUITE_P(
    RotationFlow, LongMotion,
    ::testing::Values(Motion{"isotropic", {2, 2, 2}, {3, 4, 5}, kTick, 10},
                      Motion{"middle axis", {1, 2, 3}, {0.1, 10, 0}, kTick, 10},
                      Motion{"tumbling", {1, 2, 3}, {5, 6, 7}, kTick, 10},
                      Motion{"tumbling, 1/15", {1, 2, 3}, {5, 6, 7}, 1.0 / 15, 10},
                      Motion{"thin rod", {1, 200.5, 200.5}, {20, 20, 0}, kTick, 10},
                      Motion{"thin rod, not round", {1, 190, 190.9}, {20, 20, 15}, kTick, 10},
                      Motion{"thin rod, 1 : 1e4", {1, 1e4, 1.00005e4}, {20, 5, 5}, kTick, 10},
                      Motion{"nearly symmetric", {1, 1 + 1e-9, 2}, {3, 4, 5}, kTick, 10},
                      Motion{"1000 rad/s", {1, 2, 3}, {400, 600, 700}, kTick, 1}),
    [](const auto& motion) {
      std::string name;
      for (const char* c = motion.param.name; *c != '\0'; ++c)
        name += std::isalnum(*c) != 0 ? *c : '_';
      return name;
    });

TEST(RotationFlow, DoesNotDependOnHowTimeIsCut) {
  Top once = top_of({1, 2, 3}, {3, 10, 1}), often = once;
  once.advance(2);
  for (int i = 0; i < 128; ++i) often.advance(2.0 / 128);
  EXPECT_LE(angle_between(once.R, {often.R.x, often.R.y, often.R.z, often.R.w}), 1e-13);
}

TEST(RotationFlow, RunsBackwardsToItsStart) {
  for (const Vec64 I : {Vec64{1, 2, 3}, Vec64{1, 1, 3}, Vec64{2, 2, 2}}) {
    Top top = top_of(I, {3, 10, 1}, {1, 2, 3, 4});
    const Quat64 R = top.R;
    for (int i = 0; i < 300; ++i) top.advance(kTick);
    for (int i = 0; i < 300; ++i) top.advance(-kTick);
    EXPECT_LE(angle_between(top.R, {R.x, R.y, R.z, R.w}), 1e-12);
  }
}

// --- Closed forms
// --------------------------------------------------------------------------------------

// Body turning about its middle axis, I = (1, 2, 3): w2 passes zero at odd quarters of the period
// 4 K(k)/lambda, with w = (d, 10, 0), T = 100 + d^2/2, |L|^2 = 400 + d^2, lambda^2 = (6 T -
// |L|^2)/6 and k^2 = (|L|^2 - 2 T)/(6 T - |L|^2); from one to the next the body flips over. The
// numbers below were computed from this by the arithmetic-geometric mean with 50 digits.
double time_of_zero(Top& top, double& clock) {
  while (true) {
    const double before = top.body_spin().y;
    Top next = top;
    next.advance(kTick);
    if ((before > 0) != (next.body_spin().y > 0)) {
      double low = 0, high = kTick;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        Top probe = top;
        probe.advance(middle);
        ((probe.body_spin().y > 0) == (before > 0) ? low : high) = middle;
      }
      const double zero = clock + low;
      top = next;
      clock += kTick;
      return zero;
    }
    top = next;
    clock += kTick;
  }
}

TEST(RotationFlow, MiddleAxisFlipsTwelveTimesOnTime) {
  constexpr double kFlip = 2.075460976466924;  // [s]
  constexpr int kAttitudes = 24;
  Random random(4);
  std::array<double, 12> mean{};
  for (int k = 0; k < kAttitudes; ++k) {
    Top top = top_of({1, 2, 3}, {0.1, 10, 0}, k == 0 ? Quat64{0, 0, 0, 1} : random.attitude());
    double clock = 0;
    for (std::size_t flip = 0; flip < mean.size(); ++flip) {
      const double late = time_of_zero(top, clock) - (static_cast<double>(flip) + 0.5) * kFlip;
      // Each step rounds the energy by 4e-17 of it, of which the perturbation is a share of 2.5e-5:
      // 6e-11 of that after 1500 steps as a random walk, with half of which over 5.8/s, twice a
      // flip, the flips are off; 6e-11 s in all. Four times that happens once in 16,000 attitudes.
      EXPECT_NEAR(late, 0, 2.5e-10) << "flip " << flip;
      mean[flip] += late / kAttitudes;
    }
  }
  // What is not by chance shows in the mean.
  for (const double late : mean) EXPECT_NEAR(late, 0, 5e-11);
}

TEST(RotationFlow, FirstFlipFollowsThePerturbation) {
  struct Case {
    double perturbation, flip;  // share of the spin; [s] half a period
  };
  for (const Case& c : {Case{1e-3, 2.873142443748133}, Case{1e-4, 3.670781941083364},
                        Case{1e-6, 5.266059697319620}}) {
    Top top = top_of({1, 2, 3}, {10 * c.perturbation, 10, 0});
    double clock = 0;
    // Roundings of 2e-16, as a share of the perturbation, over a rate of 5.8/s, for both quarters.
    EXPECT_NEAR(2 * time_of_zero(top, clock), c.flip, 1e-16 / c.perturbation + 1e-14);
  }
}

TEST(RotationFlow, FlipTimesInSinglePrecision) {
  Quaternion<float> R{0, 0, 0, 1};
  const Vector3<float> L{0.1f, 20, 0}, J{1, 0.5f, 1.0f / 3};
  const auto spin = [&] { return J.y * inverse_rotate(R, L).y; };
  double last = 0;
  for (int i = 0; i < 62; ++i) {  // 1.0333 s of a quarter of 1.0377 s
    advance_rotation(R, L, J, 1.0f / 60);
    last = static_cast<double>(spin());
  }
  // Near its zero w2 falls as a kink: w2 ~ rate (t0 - t) with the rate lambda w2_max = 57.7
  // rad/s^2.
  const double zero = 62.0 / 60 + last / 57.735;
  // eps |w|/w1 = 6e-8 100 a step, as a share of the perturbation, over a rate of 5.8/s, some steps.
  EXPECT_NEAR(zero, 1.037730488, 3e-5);
}

// Symmetric top: the axis goes around L at L/I1, the spin goes around the axis at (I3/I1 - 1) w3.
TEST(RotationFlow, SymmetricTopPrecessesAndSpinsAtTheRatesOfTheTextbook) {
  for (const double I3 : {0.1, 0.9, 1.5, 2.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      Vec64 I{1, 1, 1}, w{0, 0, 0};
      set_component(I, axis, I3);
      set_component(w, axis, 7.0);
      set_component(w, a, 2.0);
      Top top = top_of(I, w, {0.3, 0.1, -0.2, 0.8});
      const Quat64 R0 = top.R;
      const double size = length(top.L), time = 10;
      Vec64 e{0, 0, 0};
      set_component(e, axis, 1.0);
      const Vec64 axis_start = rotate(top.R, e);
      for (int i = 0; i < 600; ++i) top.advance(kTick);
      // In the body.
      const double body_angle = (I3 - 1) * 7.0 * time;
      EXPECT_NEAR(component(top.body_spin(), a), 2 * std::cos(body_angle), 1e-12);
      EXPECT_NEAR(component(top.body_spin(), b), 2 * std::sin(body_angle), 1e-12);
      EXPECT_NEAR(component(top.body_spin(), axis), 7, 1e-13);
      // In space, by Rodrigues' formula; 600 roundings of 1e-16 in the attitude.
      const Vec64 l = (1 / size) * top.L;
      const double angle = size * time, s = std::sin(angle), c = std::cos(angle);
      const Vec64 expected =
          c * axis_start + s * cross(l, axis_start) + ((1 - c) * dot(l, axis_start)) * l;
      EXPECT_LE(length(rotate(top.R, e) - expected), 1e-12);
      // The way of asymmetric bodies gives the same.
      Quat64 general = R0;
      for (int i = 0; i < 600; ++i) advance_asymmetric(general, top.L, top.J, kTick);
      EXPECT_LE(angle_between(general, {top.R.x, top.R.y, top.R.z, top.R.w}), 1e-12);
    }
  }
}

// --- A vector of numbers
// ---------------------------------------------------------------------------------

// The least that a wide number type offers. Each lane must get the bits of the scalar code.
struct Lanes {
  std::array<double, 4> v{};
  Lanes() = default;
  template <class Number>
  explicit Lanes(Number a) {
    v.fill(static_cast<double>(a));
  }
  template <class Operation>
  static Lanes each(Lanes a, Lanes b, Operation operation) {
    Lanes r;
    for (std::size_t i = 0; i < 4; ++i) r.v[i] = operation(a.v[i], b.v[i]);
    return r;
  }
  friend Lanes operator+(Lanes a, Lanes b) { return each(a, b, std::plus<>()); }
  friend Lanes operator-(Lanes a, Lanes b) { return each(a, b, std::minus<>()); }
  friend Lanes operator*(Lanes a, Lanes b) { return each(a, b, std::multiplies<>()); }
  friend Lanes operator/(Lanes a, Lanes b) { return each(a, b, std::divides<>()); }
  friend void sin_cos(Lanes a, Lanes& s, Lanes& c) {
    for (std::size_t i = 0; i < 4; ++i) detail::sin_cos(a.v[i], s.v[i], c.v[i]);
  }
};

TEST(RotationFlow, OnePieceGivesTheSameBitsInEveryLane) {
  Random random(5);
  Vector3<Lanes> n{}, g{};
  std::array<Quat64, 4> expected{};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const Vec64 direction = normalized_or(random.spin(), {0, 0, 1}),
                turn = 0.2 * absolute(random.spin());
    for (int axis = 0; axis < 3; ++axis) {
      Lanes a = component(n, axis), b = component(g, axis);
      a.v[lane] = component(direction, axis);
      b.v[lane] = component(turn, axis);
      set_component(n, axis, a);
      set_component(g, axis, b);
    }
    expected[lane] = midpoint_turn<double>(direction, turn, sin_cos<double>);
  }
  const Quaternion<Lanes> q =
      midpoint_turn<double>(n, g, [](Lanes a, Lanes& s, Lanes& c) { sin_cos(a, s, c); });
  for (std::size_t lane = 0; lane < 4; ++lane) {
    EXPECT_EQ(q.x.v[lane], expected[lane].x);
    EXPECT_EQ(q.y.v[lane], expected[lane].y);
    EXPECT_EQ(q.z.v[lane], expected[lane].z);
    EXPECT_EQ(q.w.v[lane], expected[lane].w);
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI::detail
