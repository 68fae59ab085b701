// Invariant: what slides over flush pieces slides as over one: nothing is lost and nothing hops at
// the seams of tiles, whether they are bodies, colliders of one body or children of a compound, at
// any speed and heading; but a curb, a wall and a step still stop what runs into them.
#include <gtest/gtest.h>

#include "plumb/compound.h"
#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr double kThick = 0.25;   // [m] half of a tile's thickness

enum class Laid { AsBodies, AsColliders, AsCompound };
constexpr Laid kLaid[] = {Laid::AsBodies, Laid::AsColliders, Laid::AsCompound};

// Frictionless tiles of `size` m over [-2, length] x [-2, 2], their upper side at y = 0.
void lay_tiles(PhysicsWorld& world, Laid laid, double length, double size) {
  const Shape tile = box(size / 2, kThick, size / 2);
  std::vector<Eigen::Vector3d> places;
  for (double x = -2; x < length; x += size)
    for (double z = -2; z < 2; z += size) places.push_back({x + size / 2, -kThick, z + size / 2});
  if (laid == Laid::AsBodies) {
    for (const Eigen::Vector3d& p : places)
      add(world, body_at(at(p, Quat::Identity()), MotionType::Static), with(tile, material(0)));
    return;
  }
  const BodyId floor = must(world.create_body(body_at(at(0, 0, 0), MotionType::Static)));
  if (laid == Laid::AsColliders) {
    for (const Eigen::Vector3d& p : places) {
      Collider collider = with(tile, material(0));
      collider.pose.position = vec(p);
      must(world.create_collider(floor, collider).status);
    }
    return;
  }
  std::vector<CompoundGeometry::Child> children;
  for (const Eigen::Vector3d& p : places) {
    CompoundGeometry::Child child{box(size / 2, kThick, size / 2)};
    child.pose.position = vec(p);
    children.push_back(child);
  }
  const auto made = CompoundGeometry::create(children);
  must(made.status);
  must(world.create_collider(floor, with(Compound{made.compound}, material(0))).status);
}

struct Mover {
  const char* name;
  Shape shape;
  double height;  // [m] of its centre
  Quat attitude;
};
std::vector<Mover> movers() {
  return {{"box", cube(0.2), 0.2, Quat::Identity()},
          {"flat box", box(0.8, 0.05, 0.6), 0.05, Quat::Identity()},
          {"sphere", sphere(0.2), 0.2, Quat::Identity()},
          {"upright capsule", capsule(0.3, 0.2), 0.5, Quat::Identity()},
          {"lying cylinder", cylinder(0.4, 0.2), 0.2, turn(kPi / 2, Eigen::Vector3d::UnitX())}};
}

// Adds a mover that does not turn.
BodyId add_sliding(PhysicsWorld& world, const Mover& mover, const Eigen::Vector3d& place,
                   const Eigen::Vector3d& velocity, const Quat& turned = Quat::Identity(),
                   double friction = 0) {
  RigidBody body = moving(at(place, turned * mover.attitude), vec(velocity));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  return add(world, body, with(mover.shape, material(friction)));
}

TEST(Tiles, HundredOfThemTakeNothing) {
  for (const Laid laid : kLaid)
    for (const Mover& mover : movers())
      for (const double speed : {0.7, 5.0, 31.0}) {
        PhysicsWorld world(no_sleep());
        lay_tiles(world, laid, 100, 1);
        RigidBody body = moving(at(0, mover.height, 0.13), vec(speed, 0, 0));
        body.pose.orientation = mover.attitude;
        if (std::holds_alternative<Capsule>(mover.shape))
          body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
        const BodyId id = add(world, body, with(mover.shape, material(0)));
        double highest = 0;
        const int steps = static_cast<int>(std::min(97 / speed, 20.0) / kDt);
        for (int i = 0; i < steps; ++i) {
          world.step(kDt);
          highest = std::max(highest, static_cast<double>(world.center_of_mass(id).y()));
        }
        const double v = static_cast<double>(world.linear_velocity(id).x());
        // Lying on eight tiles it rocks by 1e-5 rad, and what carries it leans by as much.
        const bool rocks = mover.height < 0.1;
        EXPECT_LE(std::abs(v / speed - 1), rocks ? 5e-3 : 1e-4)
            << mover.name << " at " << speed << ", laid " << static_cast<int>(laid);
        EXPECT_LE(highest - mover.height, 1e-4)
            << mover.name << " at " << speed << ", laid " << static_cast<int>(laid);
      }
}

TEST(Tiles, AskewOverTheirCornersTheyTakeNothing) {
  for (const Mover& mover : movers()) {
    PhysicsWorld world(no_sleep());
    lay_tiles(world, Laid::AsBodies, 30, 0.5);
    const BodyId id = add_sliding(world, mover, {-1.5, mover.height, -1.8}, {5, 0, 0.6});
    double highest = 0;
    for (int i = 0; i < 300; ++i) {
      world.step(kDt);
      highest = std::max(highest, static_cast<double>(world.center_of_mass(id).y()));
    }
    const Vec3 v = world.linear_velocity(id);
    EXPECT_NEAR(static_cast<double>(v.x()), 5, 5e-4) << mover.name;
    EXPECT_NEAR(static_cast<double>(v.z()), 0.6, 5e-4) << mover.name;
    EXPECT_LE(highest - mover.height, 1e-4) << mover.name;
  }
}

// The stones of a wall: pressed against it, what slides along it crosses seams of the other kind.
TEST(Tiles, OfAWallTakeNothingEither) {
  for (const Mover& mover : movers()) {
    WorldSettings settings = no_sleep();
    settings.gravity = vec(-5, 0, 0);
    PhysicsWorld world(settings);
    for (int i = 0; i < 40; ++i)
      for (int k = -1; k < 2; ++k)
        add(world, body_at(at(-0.5, i, k), MotionType::Static), with(cube(0.5), material(0)));
    const BodyId id = add_sliding(world, mover, {mover.height, 0, 0.13}, {0, 4, 0},
                                  turn(-kPi / 2, Eigen::Vector3d::UnitZ()));
    for (int i = 0; i < 500; ++i) world.step(kDt);
    EXPECT_NEAR(static_cast<double>(world.linear_velocity(id).y()), 4, 4e-4) << mover.name;
  }
}

// A raft of boxes is one body: it slides over a bump as smoothly as the bump over it.
TEST(Tiles, OfOneMovingBodyTakeNothing) {
  PhysicsWorld world(no_sleep());
  add(world, body_at(at(0, -0.5, 0), MotionType::Static), with(box(1, 0.5, 20), material(0)));
  RigidBody raft = moving(at(0, 0, 0), vec(0, 0, 3));
  raft.locks.angular_x = raft.locks.angular_y = raft.locks.angular_z = true;
  const BodyId id = must(world.create_body(raft));
  for (int i = -5; i < 6; ++i) {
    Collider plank = with(box(3, 0.2, 0.5), material(0));
    plank.pose.position = vec(0, 0.2, i);
    must(world.create_collider(id, plank).status);
  }
  for (int i = 0; i < 240; ++i) world.step(kDt);
  EXPECT_NEAR(static_cast<double>(world.linear_velocity(id).z()), 3, 3e-4);
}

TEST(Tiles, ACurbOnThemStopsWhatRunsIntoIt) {
  for (const Laid laid : kLaid)
    for (const Mover& mover : movers())
      for (const double curb : {0.03, 1.0}) {
        PhysicsWorld world(no_sleep());
        lay_tiles(world, laid, 12, 1);
        add(world, body_at(at(8, curb / 2, 0), MotionType::Static),
            with(box(0.5, curb / 2, 3), material(0)));
        const BodyId id = add_sliding(world, mover, {0, mover.height, 0.13}, {3, 0, 0});
        double farthest = 0;
        for (int i = 0; i < 240; ++i) {
          world.step(kDt);
          farthest = std::max(farthest, static_cast<double>(world.center_of_mass(id).x()));
        }
        // Round bodies may climb a low curb.
        const bool climbs = curb < 0.1 && !std::holds_alternative<Box>(mover.shape);
        if (climbs) continue;
        EXPECT_LT(farthest, 7.5) << mover.name << " at a curb of " << curb;
      }
}

TEST(Tiles, CarryWhatIsDroppedOntoTheirSeams) {
  for (const Laid laid : kLaid)
    for (const Mover& mover : movers())
      for (const double x : {0.0, 1e-4, 0.3}) {
        PhysicsWorld world(no_sleep());
        lay_tiles(world, laid, 3, 1);
        const BodyId id =
            add_sliding(world, mover, {x, mover.height + 0.4, x}, {0, 0, 0}, Quat::Identity(), 0.5);
        for (int i = 0; i < 180; ++i) world.step(kDt);
        EXPECT_NEAR(static_cast<double>(world.center_of_mass(id).y()), mover.height, 2e-3)
            << mover.name << " at " << x;
        EXPECT_LT(world.linear_velocity(id).norm(), 1e-3) << mover.name << " at " << x;
      }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
