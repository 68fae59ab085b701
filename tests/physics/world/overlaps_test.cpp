// Proves that the list of sensor overlaps is what the enter and exit events add up to and what an
// overlap query finds, asleep or awake, in order; and that the walk over contacts tells which began
// in the last step and which persist.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/measure.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

BodyId add_sensor(PhysicsWorld& world, const Vector3d& place, const Shape& shape,
                  MotionType type = MotionType::Static) {
  Collider sensor = with(shape);
  sensor.is_sensor = true;
  return add(world, body_at(at(place, Quat::Identity()), type), sensor);
}
// A ball that comes to rest.
Collider ball(double radius) {
  Collider collider = with(sphere(radius));
  collider.material.rolling_friction = collider.material.torsional_friction = real(0.1 * radius);
  return collider;
}
ColliderId collider_of(const PhysicsWorld& world, BodyId body) {
  return world.colliders_of(body)[0];
}
std::vector<SensorOverlap> listed(const PhysicsWorld& world) {
  const auto overlaps = world.events().overlaps;
  return {overlaps.begin(), overlaps.end()};
}

// A rain of bodies through several sensors, with some destroyed on the way.
TEST(Overlaps, AreWhatTheEventsAddUpTo) {
  Random random(3);
  PhysicsWorld world;
  add_floor(world);
  for (int i = 0; i < 4; ++i) add_sensor(world, {i - 1.5, 0.5 + i, 0}, box(1.5, 0.7, 3));
  std::vector<BodyId> bodies;
  for (int i = 0; i < 60; ++i) {
    const Vector3d place{random.uniform(-3, 3), random.uniform(1, 12), random.uniform(-3, 3)};
    bodies.push_back(add(world, body_at(at(place, Quat::Identity())), ball(0.2)));
  }
  std::set<SensorOverlap> inside;
  std::size_t most = 0;
  for (int step = 0; step < 900; ++step) {
    if (step < 360 && step % 20 == 10)
      must(world.destroy_body(bodies[static_cast<std::size_t>(step / 20)]));
    world.step(kDt);
    for (const SensorEvent& event : world.events().sensors) {
      const SensorOverlap overlap{event.sensor, event.other};
      if (event.kind == SensorEvent::Kind::Enter) {
        EXPECT_TRUE(inside.insert(overlap).second);
      } else {
        EXPECT_EQ(inside.erase(overlap), 1u);
      }
    }
    EXPECT_EQ(listed(world), std::vector(inside.begin(), inside.end())) << "step " << step;
    most = std::max(most, inside.size());
  }
  EXPECT_GT(most, 20u);
  EXPECT_EQ(world.last_report().awake_bodies, 0u);  // and those that sleep are still listed
  EXPECT_GT(inside.size(), 5u);
}

// At rest, where the list and a query look at the same poses, they find the same.
TEST(Overlaps, AreWhatAQueryFinds) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId zone = add_sensor(world, {0, 0.5, 0}, cube(1));
  add_sensor(world, {20, 0.5, 0}, cube(1));  // sees nothing
  for (int i = -6; i <= 6; ++i) add(world, body_at(at(0.4 * i, 0.15, 0)), with(cube(0.15)));
  run(world, 3);
  std::vector<ColliderId> found;
  world.overlap_shape(cube(1), at(0, 0.5, 0), found);
  const auto seen = world.overlaps_of(collider_of(world, zone));
  ASSERT_GT(seen.size(), 3u);
  std::vector<ColliderId> others;
  for (const SensorOverlap& overlap : seen) others.push_back(overlap.other);
  std::erase_if(found, [&](ColliderId id) {
    return world.state(world.body_of(id)).type == MotionType::Static;
  });
  EXPECT_EQ(others, found);
  EXPECT_TRUE(world.overlaps_of({}).empty());
}

// Whatever stays is told without an event, through sleep and waking, saving and restoring.
TEST(Overlaps, StayThroughSleepAndRestore) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId zone = add_sensor(world, {0, 0.5, 0}, cube(1));
  const BodyId inner = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(inner));
  const std::vector<SensorOverlap> expected{{collider_of(world, zone), collider_of(world, inner)}};
  EXPECT_EQ(listed(world), expected);
  PhysicsWorld other;
  must(other.restore(world.save()));
  EXPECT_EQ(listed(other), expected);
  for (PhysicsWorld* w : {&world, &other}) {
    must(w->set_awake(inner, true));
    run(*w, 0.1, kDt, [&] { EXPECT_TRUE(w->events().sensors.empty()); });
    EXPECT_EQ(listed(*w), expected);
    must(w->set_pose(inner, at(10, 0.5, 0)));
    w->step(kDt);
    EXPECT_TRUE(listed(*w).empty());
    EXPECT_EQ(w->events().sensors.size(), 1u);
  }
}

// A sensor that is carried to a sleeper and stops there goes on seeing it.
TEST(Overlaps, AMovingSensorThatStopsKeepsSeeingASleeper) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId sleeper = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  const BodyId zone = add_sensor(world, {-3, 0.6, 0}, cube(0.5), MotionType::Kinematic);
  run(world, 3);
  ASSERT_FALSE(world.is_awake(sleeper));
  must(world.set_linear_velocity(zone, vec(3, 0, 0)));
  run(world, 1);
  must(world.set_linear_velocity(zone, Vec3::Zero()));
  run(world, 1);
  EXPECT_FALSE(world.is_awake(sleeper));
  EXPECT_EQ(world.overlaps_of(collider_of(world, zone)).size(), 1u);
  must(world.set_linear_velocity(zone, vec(3, 0, 0)));
  run(world, 1);
  EXPECT_TRUE(listed(world).empty());
}

// A lift that is moved into a trigger, stands there, and is moved on.
TEST(Overlaps, ATriggerSeesAKinematicBodyThatComesStandsAndGoes) {
  PhysicsWorld world;
  const BodyId lift = add(world, body_at(at(-3, 0.5, 0), MotionType::Kinematic), with(cube(0.5)));
  const BodyId zone = add_sensor(world, {0, 0.5, 0}, cube(0.5));
  const SensorOverlap expected{collider_of(world, zone), collider_of(world, lift)};
  const auto moved = [&](double speed, double seconds) {
    must(world.set_linear_velocity(lift, vec(speed, 0, 0)));
    std::vector<SensorEvent> seen;
    run(world, seconds, kDt, [&] {
      seen.insert(seen.end(), world.events().sensors.begin(), world.events().sensors.end());
    });
    return seen;
  };
  EXPECT_TRUE(moved(0, 1).empty());
  const auto came = moved(3, 1);
  ASSERT_EQ(came.size(), 1u);
  EXPECT_EQ(came[0].kind, SensorEvent::Kind::Enter);
  EXPECT_TRUE(moved(0, 1).empty());
  EXPECT_FALSE(world.is_awake(lift));
  EXPECT_EQ(listed(world), std::vector{expected});
  // One that is built around it while it stands sees it as well.
  const BodyId later = add_sensor(world, {0, 0.5, 0.2}, cube(0.5));
  EXPECT_EQ(moved(0, 1).size(), 1u);
  EXPECT_EQ(world.overlaps_of(collider_of(world, later)).size(), 1u);
  const auto went = moved(3, 1);
  ASSERT_EQ(went.size(), 2u);
  EXPECT_EQ(went[0].kind, SensorEvent::Kind::Exit);
  EXPECT_EQ(went[1].kind, SensorEvent::Kind::Exit);
  EXPECT_TRUE(listed(world).empty());
}

// What a kinematic body carries to see the ground with.
TEST(Overlaps, AMovedSensorSeesStaticBodies) {
  PhysicsWorld world;
  const BodyId wall = add(world, body_at(at(0, 0, 0), MotionType::Static), with(cube(0.5)));
  const BodyId feeler = add_sensor(world, {-3, 0, 0}, cube(0.4), MotionType::Kinematic);
  const BodyId fixed = add_sensor(world, {0.1, 0, 0}, cube(0.4));  // both never move
  must(world.set_linear_velocity(feeler, vec(3, 0, 0)));
  run(world, 1);
  const SensorOverlap expected{collider_of(world, feeler), collider_of(world, wall)};
  EXPECT_EQ(listed(world), std::vector{expected});
  EXPECT_TRUE(world.overlaps_of(collider_of(world, fixed)).empty());
  run(world, 1);
  EXPECT_TRUE(listed(world).empty());
}

// The walk gives what copy_contacts gives; `began` is told in the step of the begin event only.
TEST(Contacts, TheWalkTellsWhatBeganAndWhatPersists) {
  Random random(8);
  PhysicsWorld world;
  add_floor(world);
  for (int i = 0; i < 30; ++i) {
    const Vector3d place{random.uniform(-1, 1), 0.5 + 0.5 * i, random.uniform(-1, 1)};
    add(world, body_at(at(place, Quat::Identity())), i % 2 == 0 ? with(cube(0.2)) : ball(0.2));
  }
  std::size_t began = 0, persisted = 0;
  for (int step = 0; step < 600; ++step) {
    world.step(kDt);
    std::set<std::pair<ColliderId, ColliderId>> fresh;
    for (const ContactEvent& event : world.events().contacts)
      if (event.kind == ContactEvent::Kind::Begin) fresh.insert({event.a, event.b});
    const std::vector<ContactState> copied = contacts(world);
    std::size_t i = 0;
    world.each_contact([&](const ContactState& contact) {
      ASSERT_LT(i, copied.size());
      EXPECT_EQ(contact.a, copied[i].a);
      EXPECT_EQ(contact.b, copied[i].b);
      EXPECT_EQ(contact.points[0].normal_impulse, copied[i].points[0].normal_impulse);
      EXPECT_EQ(contact.began, fresh.count({contact.a, contact.b}) == 1) << "step " << step;
      (contact.began ? began : persisted) += 1;
      ++i;
    });
    EXPECT_EQ(i, copied.size());
  }
  EXPECT_EQ(world.last_report().awake_bodies, 0u);
  EXPECT_GT(began, 30u);
  EXPECT_GT(persisted, 1000u);
  EXPECT_FALSE(contacts(world).empty());  // those that sleep
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
