// Invariant: what slides off a slope gathers speed however slowly it starts, g (sin a - mu cos a)
// t, and does not fall asleep on the way; what friction holds or stops sleeps as soon as it may.
#include <gtest/gtest.h>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr double kDt = 1.0 / 60;       // [s]
constexpr double kDegree = kPi / 180;  // [rad]
constexpr double kLong = 20;           // [s]
constexpr int kSleepy = 30 + 3;        // [steps] half a second, and some to settle

constexpr double kBetween = 0.9;  // [-] friction between boxes: they slide off as one

// Flat boxes, one on the other, on a slope along +x that is `steeper` rad too steep for their
// friction.
struct Slope {
  PhysicsWorld world;
  double angle;  // [rad]
  Quat turned;
  std::vector<BodyId> boxes;

  Slope(double friction, double steeper, double half, int count = 1)
      : angle(std::atan(friction) + steeper), turned(turn(-angle, Eigen::Vector3d::UnitZ())) {
    add(world, body_at(at({0, 0, 0}, turned), MotionType::Static),
        with(box(60, 1, 5), material(friction * friction / kBetween)));
    for (int i = 0; i < count; ++i) {
      const Vec3 place = turned * vec(0, 1 + (2 * i + 1) * half / 5, 0);
      boxes.push_back(add(world, body_at(at(place.cast<double>(), turned)),
                          with(box(half, half / 5, half), material(kBetween))));
    }
  }
  [[nodiscard]] double speed(BodyId id) const {  // [m/s] down the slope
    return static_cast<double>((turned.conjugate() * world.linear_velocity(id)).x());
  }
};

TEST(Sleep, DoesNotTakeWhatSlidesOffSlowly) {
  for (const double friction : {0.0, 0.3, 0.6})
    for (const double steeper : {0.05, 0.3})
      for (const double half : {0.05, 0.5}) {
        Slope slope(friction, steeper * kDegree, half);
        for (int i = 0; i < kLong / kDt; ++i) slope.world.step(kDt);
        const double pull = kGravity * (std::sin(slope.angle) - friction * std::cos(slope.angle));
        const double reached = pull * kLong;
        EXPECT_NEAR(slope.speed(slope.boxes[0]), reached, 0.02 * reached)
            << friction << ", too steep by " << steeper << " degrees, half size " << half;
      }
}

TEST(Sleep, DoesNotTakeAStackThatSlidesOffSlowly) {
  Slope slope(0.3, 0.05 * kDegree, 0.5, 3);
  for (int i = 0; i < kLong / kDt; ++i) slope.world.step(kDt);
  const double reached = kGravity * (std::sin(slope.angle) - 0.3 * std::cos(slope.angle)) * kLong;
  for (const BodyId id : slope.boxes) EXPECT_NEAR(slope.speed(id), reached, 0.05 * reached);
}

TEST(Sleep, TakesWhatASlopeJustHolds) {
  for (const double friction : {0.1, 0.3})
    for (const double spare : {0.05, 0.3})
      for (const int count : {1, 3}) {
        Slope slope(friction, -spare * kDegree, 0.5, count);
        for (int i = 0; i < kSleepy; ++i) slope.world.step(kDt);
        for (const BodyId id : slope.boxes)
          EXPECT_FALSE(slope.world.is_awake(id))
              << friction << ", " << spare << " degrees to spare, " << count;
      }
}

TEST(Sleep, TakesWhatFrictionStops) {
  Slope slope(0.1, -0.1 * kDegree, 0.5);
  ASSERT_TRUE(slope.world.set_linear_velocity(slope.boxes[0], slope.turned * vec(0.02, 0, 0)).ok());
  for (int i = 0; i < 240; ++i) slope.world.step(kDt);
  EXPECT_FALSE(slope.world.is_awake(slope.boxes[0]));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
