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

enum class Laid { AsBodies, AsHulls, AsColliders, AsCompound };
constexpr Laid kLaid[] = {Laid::AsBodies, Laid::AsHulls, Laid::AsColliders, Laid::AsCompound};

Shape hull_box(double x, double y, double z) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(vec((i & 1) != 0 ? x : -x, (i & 2) != 0 ? y : -y, (i & 4) != 0 ? z : -z));
  const std::uint32_t sizes[] = {4, 4, 4, 4, 4, 4};
  const std::uint32_t loops[] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4,
                                 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  const HullGeometry::Result made = HullGeometry::create(corners, sizes, loops);
  must(made.status);
  return ConvexHull{made.hull};
}

// Frictionless tiles of `size` m over [-2, length] x [-2, 2], their upper side at y = 0.
void lay_tiles(PhysicsWorld& world, Laid laid, double length, double size) {
  const Shape tile = laid == Laid::AsHulls ? hull_box(size / 2, kThick, size / 2)
                                           : Shape(box(size / 2, kThick, size / 2));
  std::vector<Eigen::Vector3d> places;
  for (double x = -2; x < length; x += size)
    for (double z = -2; z < 2; z += size) places.push_back({x + size / 2, -kThick, z + size / 2});
  if (laid == Laid::AsBodies || laid == Laid::AsHulls) {
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
        EXPECT_LE(std::abs(v / speed - 1), 1e-4)
            << mover.name << " at " << speed << ", laid " << static_cast<int>(laid);
        EXPECT_LE(highest - mover.height, 1e-4)
            << mover.name << " at " << speed << ", laid " << static_cast<int>(laid);
      }
}

// What lies on many tiles rocks as it passes from one to the next, and what carries it must not
// lean with it.
struct Plank {
  Vec3 half;        // [m]
  double load = 0;  // [-] densities of a block on its end in its own
};
const Plank kPlanks[] = {{vec(0.8, 0.05, 0.6)},
                         {vec(0.8, 0.05, 0.6), 40},
                         {vec(1.25, 0.05, 0.3)},
                         {vec(1.65, 0.025, 0.25)},
                         {vec(0.2, 0.2, 0.2)}};
std::string name_of(const Plank& p) {
  return std::to_string(p.half.x()) + " x " + std::to_string(p.half.y()) + " x " +
         std::to_string(p.half.z()) + (p.load > 0 ? ", loaded" : "");
}

BodyId add_plank(PhysicsWorld& world, const Plank& plank, const Vec3& velocity, double yaw) {
  const Eigen::Vector3d half = plank.half.cast<double>();
  const BodyId id =
      add(world, moving(at({0, half.y(), 0.13}, turn(yaw, Eigen::Vector3d::UnitY())), velocity),
          with(Box{plank.half}, material(0)));
  if (plank.load > 0) {
    Collider load = with(cube(0.1), material(0), 1000 * plank.load);
    load.pose.position = vec(half.x() - 0.1, half.y() + 0.1, 0);
    must(world.create_collider(id, load).status);
  }
  return id;
}

void expect_unhindered(Laid laid, const Plank& plank, double yaw, double speed, double size) {
  PhysicsWorld world(no_sleep());
  lay_tiles(world, laid, 102, size);
  const BodyId id = add_plank(world, plank, vec(speed, 0, 0), yaw);
  const double start = static_cast<double>(world.center_of_mass(id).y());
  double highest = start;
  const int steps = static_cast<int>(std::min(100 / speed, 20.0) / kDt);
  for (int i = 0; i < steps; ++i) {
    world.step(kDt);
    highest = std::max(highest, static_cast<double>(world.center_of_mass(id).y()));
  }
  const Vec3 v = world.linear_velocity(id);
  const std::string what = name_of(plank) + " at " + std::to_string(speed) + " m/s, yaw " +
                           std::to_string(yaw) + ", tiles of " + std::to_string(size) + ", laid " +
                           std::to_string(static_cast<int>(laid));
  EXPECT_NEAR(static_cast<double>(v.x()), speed, 1e-4 * speed) << what;
  EXPECT_NEAR(static_cast<double>(v.z()), 0, 1e-4 * speed) << what;
  EXPECT_LE(highest - start, 1e-4) << what;
}

TEST(Tiles, TakeNothingFromPlanksThatLieOnManyOfThem) {
  for (const Plank& plank : kPlanks)
    for (const double yaw : {0.0, 0.4})
      for (const double speed : {0.7, 5.0, 30.0})
        for (const double size : {0.3, 1.0})
          expect_unhindered(Laid::AsBodies, plank, yaw, speed, size);
}

TEST(Tiles, TakeNothingFromPlanksHoweverTheyAreLaid) {
  for (const Laid laid : kLaid)
    for (const Plank& plank : kPlanks) expect_unhindered(laid, plank, 0.4, 0.7, 1);
}

TEST(Tiles, ThatMoveUnderAPlankLeaveItWhereItIs) {
  for (const Plank& plank : kPlanks) {
    PhysicsWorld world(no_sleep());
    RigidBody belt = body_at(at(0, 0, 0), MotionType::Kinematic);
    belt.linear_velocity = vec(-0.7, 0, 0);
    const BodyId floor = must(world.create_body(belt));
    for (double x = -3; x < 25; x += 0.5)
      for (double z = -2; z < 2; z += 0.5) {
        Collider tile = with(box(0.25, kThick, 0.25), material(0));
        tile.pose.position = vec(x + 0.25, -kThick, z + 0.25);
        must(world.create_collider(floor, tile).status);
      }
    const BodyId id = add_plank(world, plank, vec(0, 0, 0), 0.4);
    for (int i = 0; i < 1800; ++i) world.step(kDt);
    EXPECT_LE(world.linear_velocity(id).norm(), 7e-5) << name_of(plank);
  }
}

// On a slope it gathers speed as on one piece, g sin(alpha) t.
TEST(Tiles, OfASlopeLetPlanksDownAtFullSpeed) {
  const double alpha = 0.3;  // [rad]
  const Quat slope = turn(-alpha, Eigen::Vector3d::UnitZ());
  for (const Plank& plank : {kPlanks[0], kPlanks[3], kPlanks[4]}) {
    PhysicsWorld world(no_sleep());
    for (double x = -3; x < 40; x += 0.5)
      for (double z = -2; z < 2; z += 0.5) {
        const Vec3 middle = slope * vec(x + 0.25, -kThick, z + 0.25);
        add(world, body_at(at(middle.cast<double>(), slope), MotionType::Static),
            with(box(0.25, kThick, 0.25), material(0)));
      }
    const Vec3 start = slope * vec(0, static_cast<double>(plank.half.y()), 0.13);
    const BodyId id =
        add(world, body_at(at(start.cast<double>(), slope)), with(Box{plank.half}, material(0)));
    for (int i = 0; i < 300; ++i) world.step(kDt);
    const Vec3 v = slope.conjugate() * world.linear_velocity(id);
    const double reached = kGravity * std::sin(alpha) * 5;
    EXPECT_NEAR(static_cast<double>(v.x()), reached, 1e-4 * reached) << name_of(plank);
    EXPECT_NEAR(static_cast<double>(v.z()), 0, 1e-4 * reached) << name_of(plank);
  }
}

// Posts are no floor: what lies askew on them slides down as its own side is inclined.
TEST(Tiles, ThatDoNotMeetCarryAPlankByItsOwnSide) {
  PhysicsWorld world(no_sleep());
  const double drop = 4e-4;  // [m] from one post to the next, 1 m away
  for (const double x : {-0.5, 0.5})
    add(world, body_at(at(x, -kThick - drop * x, 0), MotionType::Static),
        with(box(0.1, kThick, 0.2), material(0)));
  const BodyId id = add(world, body_at(at({0, 0.05, 0}, turn(-drop, Eigen::Vector3d::UnitZ()))),
                        with(box(1, 0.05, 0.15), material(0)));
  for (int i = 0; i < 120; ++i) world.step(kDt);
  const double reached = kGravity * drop * 2;
  EXPECT_NEAR(static_cast<double>(world.linear_velocity(id).x()), reached, 0.1 * reached);
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
