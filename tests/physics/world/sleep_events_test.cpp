// Proves that islands at rest stop and wake again for every cause, that sleeping bodies cost no
// step, and that events tell all of it: every begin has its end, every enter its exit, nothing is
// lost.
#include <gtest/gtest.h>

#include <map>

#include "support/measure.h"
#include "support/recorder.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// Two stacks apart from each other, both asleep.
class Asleep : public ::testing::Test {
 protected:
  Asleep() {
    floor_ = add_floor(world_);
    for (int i = 0; i < 3; ++i) {
      left_.push_back(add(world_, body_at(at(-5, 0.5 + i, 0)), with(cube(0.5))));
      right_.push_back(add(world_, body_at(at(5, 0.5 + i, 0)), with(cube(0.5))));
    }
    world_.attach(&events_);
    run(world_, 4);
  }
  void SetUp() override {
    ASSERT_EQ(world_.last_report().awake_bodies, 0u);
    for (BodyId b : left_) ASSERT_FALSE(world_.is_awake(b));
    for (BodyId b : right_) ASSERT_FALSE(world_.is_awake(b));
  }
  void expect_left_awake_right_asleep() const {
    for (BodyId b : left_) EXPECT_EQ(world_.is_awake(b), world_.is_valid(b));
    for (BodyId b : right_) EXPECT_FALSE(world_.is_awake(b));
  }
  PhysicsWorld world_;
  EventRecorder events_;
  BodyId floor_;
  std::vector<BodyId> left_, right_;
};

TEST_F(Asleep, AreAtRest) {
  for (BodyId b : left_) {
    EXPECT_EQ(velocity(world_, b).norm(), 0);
    EXPECT_EQ(spin(world_, b).norm(), 0);
  }
  EXPECT_EQ(events_.sleep.size(), 6u);
  for (const SleepEvent& e : events_.sleep) EXPECT_TRUE(e.fell_asleep);
}

TEST_F(Asleep, AnImpulseWakesTheIslandAndNoOther) {
  must(world_.apply_impulse(left_[1], vec(200, 0, 0)));
  EXPECT_TRUE(world_.is_awake(left_[1]));
  world_.step(kDt);
  expect_left_awake_right_asleep();
  EXPECT_EQ(world_.last_report().awake_bodies, 3u);
  EXPECT_EQ(events_.sleep.size(), 9u);
}

TEST_F(Asleep, AForceWakesTheIsland) {
  must(world_.apply_force(left_[0], vec(1, 0, 0)));
  world_.step(kDt);
  expect_left_awake_right_asleep();
}

TEST_F(Asleep, SetAwakeWakesAndPutsToSleepTheWholeIsland) {
  must(world_.set_awake(left_[2], true));
  world_.step(kDt);
  expect_left_awake_right_asleep();
  must(world_.set_awake(left_[0], false));
  world_.step(kDt);
  for (BodyId b : left_) EXPECT_FALSE(world_.is_awake(b));
}

TEST_F(Asleep, RemovingTheSupportWakesWhatRestedOnIt) {
  must(world_.destroy_body(left_[0]));
  run(world_, 0.2);
  expect_left_awake_right_asleep();
  EXPECT_LT(velocity(world_, left_[1]).y(), -1);
  EXPECT_LT(velocity(world_, left_[2]).y(), -1);
}

TEST_F(Asleep, RemovingTheFloorWakesAll) {
  must(world_.destroy_collider(world_.colliders_of(floor_)[0]));
  run(world_, 0.2);
  for (BodyId b : left_) EXPECT_LT(velocity(world_, b).y(), -1);
  for (BodyId b : right_) EXPECT_LT(velocity(world_, b).y(), -1);
}

TEST_F(Asleep, MovingTheSupportAwayWakesWhatRestedOnIt) {
  Pose away = world_.pose(left_[0]);
  away.position.z() += 20;
  must(world_.set_pose(left_[0], away));
  run(world_, 0.2);
  EXPECT_LT(velocity(world_, left_[1]).y(), -1);
  EXPECT_FALSE(world_.is_awake(right_[0]));
}

TEST_F(Asleep, MovingTheFloorAwayWakesAll) {
  must(world_.set_pose(floor_, at(0, -3, 0)));
  run(world_, 0.2);
  for (BodyId b : left_) EXPECT_LT(velocity(world_, b).y(), -1);
  for (BodyId b : right_) EXPECT_LT(velocity(world_, b).y(), -1);
}

TEST_F(Asleep, ABodyThatLandsWakesTheIsland) {
  add(world_, body_at(at(-5, 4.5, 0)), with(sphere(0.5)));
  run(world_, 0.6);
  expect_left_awake_right_asleep();
}

TEST_F(Asleep, ABodyBornInContactWakesTheIsland) {
  add(world_, body_at(at(-5, 3.4, 0)), with(cube(0.5)));
  run(world_, 2 * kDt);
  expect_left_awake_right_asleep();
}

TEST_F(Asleep, AKinematicBodyThatArrivesWakesTheIsland) {
  RigidBody pusher = body_at(at(-8, 0.5, 0), MotionType::Kinematic);
  pusher.linear_velocity = vec(1, 0, 0);
  add(world_, pusher, with(box(0.5, 0.4, 0.4)));
  const double x0 = position(world_, left_[0]).x();
  run(world_, 2.5);  // it arrives after 2 s
  expect_left_awake_right_asleep();
  EXPECT_GT(position(world_, left_[0]).x(), x0 + 0.3);
}

TEST_F(Asleep, ChangedGravityWakesAll) {
  WorldSettings settings = world_.settings();
  settings.gravity = vec(5, -9.81, 0);
  must(world_.set_settings(settings));
  run(world_, 0.3);
  for (BodyId b : left_) EXPECT_TRUE(world_.is_awake(b));
  for (BodyId b : right_) EXPECT_TRUE(world_.is_awake(b));
}

TEST_F(Asleep, SwitchingSleepOffWakesAll) {
  WorldSettings settings = world_.settings();
  settings.sleeping = false;
  must(world_.set_settings(settings));
  world_.step(kDt);
  EXPECT_EQ(world_.last_report().awake_bodies, 6u);
}

TEST_F(Asleep, ThoseThatWereWokenSleepAgain) {
  must(world_.set_awake(left_[0], true));
  run(world_, 2);
  EXPECT_EQ(world_.last_report().awake_bodies, 0u);
  std::map<std::uint64_t, int> asleep;  // +1 asleep, back to 0 awake: alternating for each body
  for (const SleepEvent& e : events_.sleep) {
    int& state = asleep[e.body.value()];
    EXPECT_EQ(state, e.fell_asleep ? 0 : 1);
    state = e.fell_asleep ? 1 : 0;
  }
  for (const auto& [body, state] : asleep) EXPECT_EQ(state, 1);
  EXPECT_EQ(asleep.size(), 6u);
}

TEST(Sleep, ABodyThatMayNotSleepKeepsItsIslandAwake) {
  PhysicsWorld world;
  add_floor(world);
  RigidBody insomniac = body_at(at(0, 1.5, 0));
  insomniac.can_sleep = false;
  const BodyId below = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  const BodyId above = add(world, insomniac, with(cube(0.5)));
  run(world, 5);
  EXPECT_TRUE(world.is_awake(above));
  EXPECT_TRUE(world.is_awake(below));
}

TEST(Sleep, ABodyMayStartAsleepAndStaysUntilTouched) {
  PhysicsWorld world;
  RigidBody spec = body_at(at(0, 5, 0));
  spec.starts_awake = false;
  const BodyId hovering = add(world, spec, with(sphere(0.5)));
  run(world, 1);
  EXPECT_EQ(position(world, hovering).y(), 5);
  must(world.apply_impulse(hovering, vec(1, 0, 0)));
  run(world, 0.5);
  EXPECT_LT(position(world, hovering).y(), 4);
}

// Overlap is worked off by moving bodies, not by throwing them: they have no velocity meanwhile.
TEST(Sleep, NothingFallsAsleepWhileItIsPushedOut) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId sunk = add(world, body_at(at(0, -1.9, 0)), with(cube(2)));
  run(world, 10);
  EXPECT_FALSE(world.is_awake(sunk));
  EXPECT_NEAR(position(world, sunk).y(), 2, 0.01 * 4);
}

TEST(Sleep, NothingFallsAsleepWhileAJointDrawsItBack) {
  PhysicsWorld world;
  const BodyId post = must(world.create_body(body_at(at(0, 5, 0), MotionType::Static)));
  const BodyId weight = add(world, body_at(at(0, 2, 0)), with(sphere(0.25)));
  Joint rope;
  rope.body_a = post;
  rope.body_b = weight;
  rope.kind = RopeJoint{1};
  must(world.create_joint(rope));
  run(world, 10);
  EXPECT_FALSE(world.is_awake(weight));
  EXPECT_NEAR(position(world, weight).y(), 4, 0.01);
}

TEST(Sleep, TimeToSleepIsObeyed) {
  for (double wait : {0.25, 2.0}) {
    WorldSettings settings;
    settings.time_to_sleep = real(wait);
    PhysicsWorld world(settings);
    add_floor(world);
    const BodyId body = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
    double slept = -1;
    run(world, 4, kDt, [&] {
      if (slept < 0 && !world.is_awake(body)) slept = world.time();
    });
    // It is at rest from the start but for the settling of its contact.
    EXPECT_GE(slept, wait - kDt);
    EXPECT_LE(slept, wait + 0.3);
  }
}

TEST(Sleep, TenThousandSleepingBodiesAreNotStepped) {
  PhysicsWorld world;
  const Built scene = build_spread(world, 10000);
  run(world, 1.5);
  EXPECT_EQ(world.last_report().bodies, 10001u);
  EXPECT_EQ(world.last_report().awake_bodies, 0u);
  EXPECT_EQ(world.last_report().islands, 0u);
  std::vector<BodyState> moved;
  world.copy_moved_body_states(moved);
  EXPECT_TRUE(moved.empty());
  // One that wakes wakes no other.
  must(world.apply_impulse(scene.bodies[5000], vec(0, 2000, 0)));
  world.step(kDt);
  EXPECT_EQ(world.last_report().awake_bodies, 1u);
  world.copy_moved_body_states(moved);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].id, scene.bodies[5000]);
}

// --- events
// ------------------------------------------------------------------------------------------
TEST(Events, EveryBeginHasItsEnd) {
  PhysicsWorld world;
  EventRecorder events;
  world.attach(&events);
  const Built pile = build_pile(world, {.side = 4});
  std::map<std::pair<std::uint64_t, std::uint64_t>, int> open;
  std::size_t seen = 0;
  run(world, 4, kDt, [&] {
    for (; seen < events.contacts.size(); ++seen) {
      const ContactEvent& e = events.contacts[seen];
      const auto key = std::minmax({e.a.value(), e.b.value()});
      int& count = open[key];
      count += e.kind == ContactEvent::Kind::Begin ? 1 : -1;
      ASSERT_TRUE(count == 0 || count == 1);
    }
    // What is open is what touches now.
    std::size_t touching = 0;
    for (const auto& [pair, count] : open) touching += static_cast<std::size_t>(count);
    ASSERT_EQ(touching, contacts(world).size()) << "t " << world.time();
  });
  EXPECT_GT(events.contacts.size(), 100u);
  for (BodyId b : pile.bodies) must(world.destroy_body(b));
  world.step(kDt);
  for (; seen < events.contacts.size(); ++seen) {
    const ContactEvent& e = events.contacts[seen];
    open[std::minmax({e.a.value(), e.b.value()})] += e.kind == ContactEvent::Kind::Begin ? 1 : -1;
  }
  for (const auto& [pair, count] : open) EXPECT_EQ(count, 0);
}

TEST(Events, ContactEventsNameTheBodies) {
  PhysicsWorld world;
  const BodyId floor = add_floor(world);
  const BodyId ball = add(world, body_at(at(0, 0.52, 0)), with(sphere(0.5)));
  int begins = 0;
  run(world, 0.5, kDt, [&] {
    for (const ContactEvent& e : world.events().contacts) {
      EXPECT_EQ(e.kind, ContactEvent::Kind::Begin);
      EXPECT_EQ(world.body_of(e.a), e.body_a);
      EXPECT_EQ(world.body_of(e.b), e.body_b);
      EXPECT_TRUE((e.body_a == floor && e.body_b == ball) ||
                  (e.body_a == ball && e.body_b == floor));
      ++begins;
    }
  });
  EXPECT_EQ(begins, 1);
}

TEST(Events, SensorsReportEnterAndExitAndNeverPush) {
  PhysicsWorld world;
  EventRecorder events;
  world.attach(&events);
  Collider zone = with(box(1, 1, 1));
  zone.is_sensor = true;
  const BodyId gate = add(world, body_at(at(0, 0, 0), MotionType::Static), zone);
  const BodyId ball = add(world, body_at(at(0, 5, 0)), with(sphere(0.25)));
  double entered = 0, left = 0;
  run(world, 2, kDt, [&] {
    for (const SensorEvent& e : world.events().sensors) {
      EXPECT_EQ(world.body_of(e.sensor), gate);
      EXPECT_EQ(world.body_of(e.other), ball);
      (e.kind == SensorEvent::Kind::Enter ? entered : left) = world.time();
    }
  });
  ASSERT_EQ(events.sensors.size(), 2u);
  EXPECT_EQ(events.sensors[0].kind, SensorEvent::Kind::Enter);
  EXPECT_EQ(events.sensors[1].kind, SensorEvent::Kind::Exit);
  EXPECT_TRUE(events.contacts.empty());
  EXPECT_NEAR(entered, std::sqrt(2 * 3.75 / kGravity), 2 * kDt);
  EXPECT_NEAR(left, std::sqrt(2 * 6.25 / kGravity), 2 * kDt);
  EXPECT_NEAR(velocity(world, ball).y(), -2 * kGravity, 1e-3);  // free fall all the way
}

TEST(Events, DestroyingWhatIsInASensorGivesAnExit) {
  PhysicsWorld world(no_gravity());
  EventRecorder events;
  world.attach(&events);
  Collider zone = with(box(1, 1, 1));
  zone.is_sensor = true;
  add(world, body_at(at(0, 0, 0), MotionType::Static), zone);
  const BodyId ball = add(world, body_at(at(0, 0, 0)), with(sphere(0.25)));
  run(world, 0.1);
  ASSERT_EQ(events.sensors.size(), 1u);
  must(world.destroy_body(ball));
  world.step(kDt);
  ASSERT_EQ(events.sensors.size(), 2u);
  EXPECT_EQ(events.sensors[1].kind, SensorEvent::Kind::Exit);
}

TEST(Events, AStayInASensorSurvivesSleep) {
  PhysicsWorld world;
  EventRecorder events;
  world.attach(&events);
  add_floor(world);
  Collider zone = with(box(2, 2, 2));
  zone.is_sensor = true;
  add(world, body_at(at(0, 0, 0), MotionType::Static), zone);
  const BodyId box_id = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  run(world, 4);
  ASSERT_FALSE(world.is_awake(box_id));
  ASSERT_EQ(events.sensors.size(), 1u);
  must(world.set_linear_velocity(box_id, vec(0, 10, 0)));
  run(world, 0.5);
  ASSERT_EQ(events.sensors.size(), 2u);
  EXPECT_EQ(events.sensors[1].kind, SensorEvent::Kind::Exit);
}

TEST(Events, FiltersDecideWhoMeets) {
  PhysicsWorld world;
  Collider floor = with(HalfSpace{}), meets = with(sphere(0.5)), passes = with(sphere(0.5));
  floor.filter = {0b01, 0xffffffffu};
  meets.filter = {0b10, 0b01};
  passes.filter = {0b10, 0b10};
  add(world, body_at(Pose{}, MotionType::Static), floor);
  const BodyId stays = add(world, body_at(at(0, 0.5, 0)), meets);
  const BodyId falls = add(world, body_at(at(3, 0.5, 0)), passes);
  run(world, 1);
  EXPECT_NEAR(position(world, stays).y(), 0.5, 0.01);
  EXPECT_LT(position(world, falls).y(), -3);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
