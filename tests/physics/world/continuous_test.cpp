// Proves that nothing fast passes anything: random shots of balls, boxes, hulls and rods, straight
// and spinning, at resting and moving plates; that being stopped gains no energy and keeps
// momentum; that what rolls or slides fast on a floor is not held up; and that threads change no
// bit.
#include <gtest/gtest.h>

#include "support/collision_oracle.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr double kPlate = 20;     // [m] half edges of the plate
// Energy that rounding may add [-]: a few hundred roundings of sums over a hundred bodies.
const double kRounding = 1e3 * static_cast<double>(std::numeric_limits<Real>::epsilon());

struct Shots {
  Shape shape;
  double size;         // [m] farthest point
  double speed, spin;  // [m/s], [rad/s] largest
  double plate;        // [m] half thickness
  double plate_speed;  // [m/s] along x; 0: static
  double restitution;
  int count;
};

struct Outcome {
  int passed = 0;
  unsigned stops = 0;
  double gain = 0;  // largest relative growth of energy
};

Collider projectile(const Shape& shape, double restitution) {
  Collider collider = with(shape, material(0.3, restitution));
  collider.filter.layers = 2;  // they do not meet one another
  collider.filter.collides_with = 1;
  return collider;
}

// Shots come from -x, from every phase of the step and up to 45 degrees aside.
Outcome shoot(const Shots& s, unsigned seed) {
  constexpr int kBatch = 100;
  Random random(seed);
  Outcome outcome;
  for (int first = 0; first < s.count; first += kBatch) {
    PhysicsWorld world(no_gravity());
    RigidBody wall =
        body_at(at(0, 0, 0), s.plate_speed == 0 ? MotionType::Static : MotionType::Kinematic);
    wall.linear_velocity = vec(s.plate_speed, 0, 0);
    const BodyId plate = add(world, wall, with(box(s.plate, kPlate, kPlate)));
    std::vector<BodyId> flying;
    for (int i = 0; i < kBatch; ++i) {
      const double slant = random.uniform(-0.8, 0.8), turn = random.uniform(0, 2 * kPi);
      const Vector3d v = s.speed * Vector3d(std::cos(slant), std::sin(slant) * std::cos(turn),
                                            std::sin(slant) * std::sin(turn));
      const double near = std::abs(v.x() - s.plate_speed) * kDt;
      const double distance = random.uniform(0.1, 1) * near + 2 * s.size + s.plate;
      const Quat attitude = random.rotation(3);
      const Vector3d spin = random.uniform(0, s.spin) * random.direction();
      flying.push_back(add(world,
                           moving(at(Vector3d(-distance, 0, 0), attitude), vec(v), vec(spin)),
                           projectile(s.shape, s.restitution)));
    }
    const double E0 = world.energy().total();
    for (int i = 0; i < 10; ++i) {
      world.step(kDt);
      outcome.stops += world.last_report().continuous;
      if (s.plate_speed == 0)
        outcome.gain = std::max(outcome.gain, world.energy().total() / E0 - 1);
      const double x = position(world, plate).x();
      std::erase_if(flying, [&](BodyId body) {
        const Vector3d p = position(world, body);
        if (std::hypot(p.y(), p.z()) > kPlate - 1 - s.size) return true;  // round the plate's edge
        if (p.x() < x) return false;
        ++outcome.passed;
        return true;
      });
    }
  }
  return outcome;
}

Shape brick() { return box(0.1, 0.2, 0.3); }
Shape lump() {
  oracle::Random random(5);
  return ConvexHull{oracle::random_hull(random, 10, 0.3)};
}

// Reference case H12: a 1 cm ball at 1000 m/s against a plate of 1 mm.
TEST(Continuous, BulletsDoNotPassAPlate) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const Outcome fast = shoot({sphere(0.005), 0.005, 1000, 100, 0.0005, 0, e, 15000}, 1);
    EXPECT_EQ(fast.passed, 0) << "restitution " << e;
    EXPECT_LE(fast.gain, kRounding) << "restitution " << e;
    const Outcome slower = shoot({sphere(0.05), 0.05, 300, 100, 0.01, 0, e, 5000}, 2);
    EXPECT_EQ(slower.passed, 0) << "restitution " << e;
    EXPECT_LE(slower.gain, kRounding) << "restitution " << e;
    if (e == 0) {
      EXPECT_GT(fast.stops, 1000u);  // the contacts alone let a quarter of them through
    }
  }
}

TEST(Continuous, BulletsDoNotPassAMovingPlate) {
  for (const double e : {0.0, 0.5}) {
    for (const double speed : {50.0, -50.0}) {
      EXPECT_EQ(shoot({sphere(0.005), 0.005, 1000, 100, 0.0005, speed, e, 5000}, 3).passed, 0)
          << "restitution " << e << " plate at " << speed;
    }
    // A plate that overtakes what is slow: the plate is the fast one.
    EXPECT_EQ(shoot({sphere(0.05), 0.05, 1, 30, 0.01, -200, e, 2000}, 4).passed, 0) << e;
    EXPECT_EQ(shoot({brick(), 0.4, 1, 10, 0.005, -200, e, 1000}, 5).passed, 0) << e;
  }
}

TEST(Continuous, SpinningBoxesAndHullsDoNotPassAPlate) {
  for (const double e : {0.0, 0.5}) {
    EXPECT_EQ(shoot({brick(), 0.4, 180, 30, 0.1, 0, e, 4000}, 6).passed, 0) << e;
    EXPECT_EQ(shoot({brick(), 0.4, 180, 100, 0.005, 0, e, 4000}, 7).passed, 0) << e;
    EXPECT_EQ(shoot({lump(), 0.3, 250, 60, 0.01, 0, e, 4000}, 8).passed, 0) << e;
    EXPECT_EQ(shoot({brick(), 0.4, 180, 100, 0.005, -50, e, 2000}, 9).passed, 0) << e;
  }
}

TEST(Continuous, TumblingRodsDoNotPassAPlate) {
  for (const double e : {0.0, 0.5}) {
    EXPECT_EQ(shoot({box(1, 0.01, 0.01), 1, 50, 100, 0.005, 0, e, 500}, 10).passed, 0) << e;
    EXPECT_EQ(shoot({capsule(1, 0.01), 1.01, 20, 300, 0.005, 0, e, 500}, 11).passed, 0) << e;
  }
}

// How far the farthest corner of a rod reaches beyond the plane x = 0 [m].
double reach_beyond(const PhysicsWorld& world, BodyId body, const Vector3d& half) {
  const Pose pose = world.pose(body);
  const Eigen::Matrix3d R = pose.orientation.cast<double>().normalized().toRotationMatrix();
  return pose.position.cast<double>().x() + R.row(0).cwiseAbs().dot(half);
}

// A rod that turns beside a wall which only its ends can reach: they stop at the wall's face.
TEST(Continuous, ARodTurningIntoAWallStopsAtItsFace) {
  Random random(14);
  const Vector3d half(1, 0.01, 0.01);
  for (int i = 0; i < 200; ++i) {
    PhysicsWorld world(no_gravity());
    add(world, body_at(at(0.005, 0, 0), MotionType::Static), with(box(0.005, 20, 20)));
    const double spin = (i % 2 == 0 ? 1 : -1) * random.uniform(10, 60);
    // At rest along y, its middle nearer to the wall than its ends are to the middle.
    const BodyId rod =
        add(world,
            moving(at(Vector3d(-random.uniform(0.1, 0.9), 0, 0), turn(kPi / 2, Vector3d::UnitZ())),
                   vec(0, 0, 0), vec(0, 0, spin)),
            with(box(1, 0.01, 0.01)));
    unsigned stops = 0;
    for (int k = 0; k < 10; ++k) {
      world.step(kDt);
      stops += world.last_report().continuous;
      // Half of the plate and of the rod: neither is passed. Contacts at work push back what is in.
      ASSERT_LE(reach_beyond(world, rod, half), 0.005)
          << "shot " << i << " spin " << spin << " step " << k << " stops " << stops;
    }
  }
}

// Stopped on its way down, a body keeps no speed that it would have gained on the rest of the way.
TEST(Continuous, AFallStoppedAtAPlateGainsNoEnergy) {
  Random random(15);
  for (int i = 0; i < 200; ++i) {
    WorldSettings heavy;
    heavy.gravity = vec(0, -1000, 0);  // a tenth of the speed comes within the step
    PhysicsWorld world(heavy);
    add(world, body_at(at(0, 0, 0), MotionType::Static), with(box(20, 0.005, 20)));
    const double height = random.uniform(1, 8);
    add(world,
        moving(at(Vector3d(0, height, 0), random.rotation(3)), vec(0, -180, 0),
               vec(random.uniform(0, 60) * random.direction())),
        with(i % 2 == 0 ? brick() : Shape(sphere(0.1)), material(0.3)));
    const double E0 = world.energy().total();
    for (int k = 0; k < 6; ++k) {
      world.step(kDt);
      // Pushing out what overlaps lifts it by a few hundredths of its thickness.
      ASSERT_LE(world.energy().total(), E0 * (1 + 1e-3)) << "shot " << i << " step " << k;
    }
  }
}

// Two bodies that ask for it stop at one another; momentum stays to rounding.
TEST(Continuous, FlaggedBodiesDoNotPassOneAnother) {
  Random random(16);
  for (int i = 0; i < 300; ++i) {
    PhysicsWorld world(no_gravity());
    RigidBody panel =
        moving(at(Vector3d(random.uniform(1, 4), 0, 0), Quat::Identity()),
               vec(-random.uniform(0, 300), 0, 0), vec(random.uniform(-20, 20), 0, 0));
    RigidBody bullet =
        moving(at(Vector3d(-random.uniform(1, 4), random.uniform(-0.5, 0.5), 0), Quat::Identity()),
               vec(random.uniform(300, 900), 0, 0));
    panel.continuous = bullet.continuous = i % 3 != 0;
    if (i % 3 == 0) bullet.continuous = true;  // one of the two is enough
    const BodyId a = add(world, panel, with(box(0.005, 2, 2)));
    const BodyId b = add(world, bullet, with(sphere(0.01)));
    const Vector3d P0 = world.energy().momentum;
    const double E0 = world.energy().total();
    for (int k = 0; k < 8; ++k) {
      world.step(kDt);
      const Vector3d out = world.pose(a).orientation.cast<double>() * Vector3d::UnitX();
      ASSERT_LT((position(world, b) - position(world, a)).dot(out), 0) << "shot " << i;
      ASSERT_LE((world.energy().momentum - P0).norm(), kRounding * P0.norm());
      ASSERT_LE(world.energy().total(), E0 * (1 + kRounding));
    }
  }
}

// What sleeps lies in a tree of its own; a flagged body is stopped by it, and wakes it.
TEST(Continuous, AFlaggedBulletIsStoppedByASleeper) {
  Random random(17);
  for (int i = 0; i < 100; ++i) {
    PhysicsWorld world;
    add_floor(world);
    const BodyId panel = add(world, body_at(at(0, 0.5, 0)), with(box(0.02, 0.5, 2)));
    run(world, 2);
    ASSERT_FALSE(world.is_awake(panel));
    RigidBody bullet =
        moving(at(-random.uniform(1, 20), random.uniform(0.1, 0.9), 0),
               vec(random.uniform(200, 900), 0, 0), vec(random.uniform(0, 50), 0, 0));
    bullet.continuous = true;
    bullet.gravity_scale = 0;
    const BodyId b = add(world, bullet, with(sphere(0.01)));
    for (int k = 0; k < 12 && !world.is_awake(panel); ++k) {
      world.step(kDt);
      ASSERT_LT(position(world, b).x(), 0) << "shot " << i;
    }
    EXPECT_TRUE(world.is_awake(panel)) << "shot " << i;
  }
}

// A train of flagged bullets: the first stops at the wall, the others at those before them.
TEST(Continuous, ATrainOfFlaggedBulletsKeepsItsOrder) {
  PhysicsWorld world(no_gravity());
  add(world, body_at(at(0.005, 0, 0), MotionType::Static), with(box(0.005, 20, 20)));
  std::vector<BodyId> train;
  for (int i = 0; i < 12; ++i) {
    RigidBody bullet = moving(at(-1 - 0.1 * i, 0, 0), vec(400 + 20 * i, 0, 0));
    bullet.continuous = true;
    train.push_back(add(world, bullet, with(sphere(0.02))));
  }
  for (int k = 0; k < 20; ++k) {
    world.step(kDt);
    ASSERT_LT(position(world, train[0]).x(), 0.0);
    for (std::size_t i = 1; i < train.size(); ++i)
      ASSERT_LT(position(world, train[i]).x(), position(world, train[i - 1]).x()) << "step " << k;
  }
}

// A ball and a brick at 60 m/s on the floor of a world, both without friction: nothing stops them.
void expect_nothing_holds_up(PhysicsWorld& world) {
  const BodyId ball = add(world, moving(at(0, 0.5, 3), vec(60, 0, 0), vec(0, 0, -120)),
                          with(sphere(0.5), material(0)));
  const BodyId slider =
      add(world, moving(at(0, 0.25, -3), vec(60, 0, 0)), with(box(0.5, 0.25, 0.5), material(0)));
  unsigned stops = 0;
  for (int k = 0; k < 120; ++k) {
    world.step(kDt);
    stops += world.last_report().continuous;
  }
  EXPECT_EQ(stops, 0u);
  for (const BodyId body : {ball, slider})
    EXPECT_NEAR(position(world, body).x(), 120, 120 * kRounding + 0.01);
}

// A ball and a brick at 60 m/s on a floor: their contact with it takes no time away.
TEST(Continuous, WhatRollsOrSlidesFastIsNotHeldUpByItsFloor) {
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, -0.1, 0), MotionType::Static), with(box(200, 0.1, 8), material(0)));
  expect_nothing_holds_up(world);
}

// The same over a floor of flush tiles, whose seams are met a little below their upper edges.
TEST(Continuous, TheSeamsOfAFloorOfTilesStopNothing) {
  PhysicsWorld world(no_sleep());
  for (int i = -2; i < 40; ++i)
    add(world, body_at(at(4.0 * i, -0.1, 0), MotionType::Static),
        with(box(2, 0.1, 8), material(0)));
  expect_nothing_holds_up(world);
}

// A ball on a fast lift moves with it and is not stopped by it.
TEST(Continuous, AFastLiftCarriesItsLoad) {
  PhysicsWorld world(no_sleep());
  RigidBody lift = body_at(at(0, -0.01, 0), MotionType::Kinematic);
  lift.linear_velocity = vec(0, 30, 0);
  const BodyId floor = add(world, lift, with(box(2, 0.01, 2)));
  RigidBody load = moving(at(0, 0.1, 0), vec(0, 30, 0));
  const BodyId ball = add(world, load, with(sphere(0.1)));
  unsigned stops = 0;
  for (int k = 0; k < 60; ++k) {
    world.step(kDt);
    stops += world.last_report().continuous;
  }
  EXPECT_EQ(stops, 0u);
  EXPECT_NEAR((position(world, ball) - position(world, floor)).y(), 0.11, 0.002);
}

TEST(Continuous, ThreadsAndRestoringChangeNoBit) {
  const auto build = [](PhysicsWorld& world) {
    Random random(17);
    add(world, body_at(at(0, 0, 0), MotionType::Static), with(box(0.005, 20, 20)));
    RigidBody paddle = body_at(at(-3, 0, 0), MotionType::Kinematic);
    paddle.angular_velocity = vec(0, 0, 40);
    add(world, paddle, with(box(0.01, 2, 2)));
    for (int i = 0; i < 300; ++i) {
      const Vector3d p(-random.uniform(1, 10), random.uniform(-8, 8), random.uniform(-8, 8));
      add(world,
          moving(at(p, random.rotation(3)), vec(random.uniform(50, 400), 0, 0),
                 vec(random.uniform(0, 50) * random.direction())),
          projectile(i % 2 == 0 ? brick() : Shape(sphere(0.02)), 0));
    }
  };
  const auto pool = make_thread_pool(4);
  PhysicsWorld alone, threaded, restored;
  build(alone);
  build(threaded);
  threaded.set_job_system(pool.get());
  unsigned stops = 0;
  for (int k = 0; k < 12; ++k) {
    if (k == 3) must(restored.restore(alone.save()));
    alone.step(kDt);
    threaded.step(kDt);
    stops += alone.last_report().continuous;
    ASSERT_EQ(alone.state_hash(), threaded.state_hash()) << "step " << k;
    ASSERT_EQ(alone.last_report().continuous, threaded.last_report().continuous);
    if (k < 3) continue;
    restored.step(kDt);
    ASSERT_EQ(alone.state_hash(), restored.state_hash()) << "step " << k;
  }
  EXPECT_GT(stops, 50u);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
