// Proves that a living collider can become a sensor and solid again: contacts end and overlaps
// begin when it starts to sense, the other way round when it stops, asleep or awake.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

constexpr double kDt = 1.0 / 60;  // [s]

class Platform : public ::testing::Test {
 protected:
  Platform() {
    floor_ = add_floor(world_);
    const BodyId platform =
        add(world_, body_at(at(0, 1, 0), MotionType::Static), with(box(1, 0.5, 1)));
    platform_ = world_.colliders_of(platform)[0];
    body_ = add(world_, body_at(at(0, 1.75, 0)), with(cube(0.25)));
    box_ = world_.colliders_of(body_)[0];
    run(world_, 3);
  }
  void SetUp() override { ASSERT_FALSE(world_.is_awake(body_)); }
  [[nodiscard]] int sensed(SensorEvent::Kind kind, ColliderId sensor, ColliderId other) const {
    int n = 0;
    for (const SensorEvent& e : world_.events().sensors)
      n += e.kind == kind && e.sensor == sensor && e.other == other ? 1 : 0;
    return n;
  }
  [[nodiscard]] int met(ContactEvent::Kind kind, ColliderId a, ColliderId b) const {
    int n = 0;
    for (const ContactEvent& e : world_.events().contacts)
      n += e.kind == kind && ((e.a == a && e.b == b) || (e.a == b && e.b == a)) ? 1 : 0;
    return n;
  }
  PhysicsWorld world_;
  BodyId floor_, body_;
  ColliderId platform_, box_;
};

TEST_F(Platform, SensesWhatFallsThroughItAndCatchesItAgain) {
  must(world_.set_sensor(platform_, true));
  EXPECT_TRUE(world_.collider(platform_).is_sensor);
  EXPECT_TRUE(world_.is_awake(body_));
  world_.step(kDt);
  EXPECT_EQ(met(ContactEvent::Kind::End, platform_, box_), 1);
  int entered = sensed(SensorEvent::Kind::Enter, platform_, box_);
  run(world_, 0.1, kDt, [&] { entered += sensed(SensorEvent::Kind::Enter, platform_, box_); });
  EXPECT_EQ(entered, 1);
  ASSERT_EQ(world_.overlaps_of(platform_).size(), 1u);
  must(world_.set_sensor(platform_, false));
  world_.step(kDt);
  EXPECT_EQ(sensed(SensorEvent::Kind::Exit, platform_, box_), 1);
  EXPECT_EQ(met(ContactEvent::Kind::Begin, platform_, box_), 1);
  EXPECT_TRUE(world_.events().overlaps.empty());
  run(world_, 3);
  EXPECT_NEAR(position(world_, body_).y(), 1.75, 0.01);  // pushed out the way it came
}

// What sleeps in a sensor that becomes solid is woken and pushed out of it.
TEST_F(Platform, WakesWhatSleepsInItWhenItBecomesSolid) {
  must(world_.set_sensor(platform_, true));
  must(world_.set_pose(body_, at(0.8, 0.25, 0)));
  run(world_, 3);
  ASSERT_FALSE(world_.is_awake(body_));
  ASSERT_EQ(world_.events().overlaps.size(), 0u);
  must(world_.set_local_pose(platform_, {vec(0, -0.4, 0), Quat::Identity()}));
  run(world_, 3);
  ASSERT_FALSE(world_.is_awake(body_));
  ASSERT_EQ(world_.overlaps_of(platform_).size(), 1u);
  must(world_.set_sensor(platform_, false));
  EXPECT_TRUE(world_.is_awake(body_));
  world_.step(kDt);
  EXPECT_EQ(sensed(SensorEvent::Kind::Exit, platform_, box_), 1);
  EXPECT_EQ(met(ContactEvent::Kind::Begin, platform_, box_), 1);
}

// A sensor adds no mass and is held up by nothing.
TEST_F(Platform, ADynamicColliderThatSensesWeighsNothing) {
  must(world_.set_sensor(box_, true));
  EXPECT_EQ(world_.mass_properties(body_).mass, 1);  // a point mass
  run(world_, 1);
  EXPECT_LT(position(world_, body_).y(), -1);
  must(world_.set_sensor(box_, false));
  EXPECT_NEAR(world_.mass_properties(body_).mass, 125, 1e-9);
}

TEST_F(Platform, AskingForWhatItIsDoesNothing) {
  const Snapshot before = world_.save();
  must(world_.set_sensor(platform_, false));
  EXPECT_TRUE(world_.save() == before);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
