// Proves that the world's table of material pairs has the last word on friction and restitution,
// that what it leaves empty is combined as ever, and that changing it reaches pairs that touch.
#include <gtest/gtest.h>

#include <limits>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr std::uint32_t kIce = 7, kRubber = 3, kSteel = 4;

Material of_kind(std::uint32_t kind, double friction, double restitution = 0) {
  Material m = material(friction, restitution);
  m.kind = kind;
  return m;
}
RigidBody slider(const Vector3d& place, const Vector3d& v = Vector3d::Zero()) {
  RigidBody body = moving(at(place, Quat::Identity()), vec(v));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  return body;
}
// Deceleration over g of a ball that slides on a floor: the friction of the pair.
double friction_of(PhysicsWorld& world, const Material& floor, const Material& ball) {
  add_floor(world, floor);
  const BodyId body = add(world, slider({0, 0.5, 0}, {10, 0, 0}), with(sphere(0.5), ball));
  run(world, 0.5);
  return (10 - velocity(world, body).x()) / (kGravity * 0.5);
}

TEST(MaterialPairs, TheTableDecidesWhateverTheOrder) {
  for (const bool swapped : {false, true}) {
    PhysicsWorld world(no_sleep());
    must(swapped ? world.set_material_pair(kRubber, kIce, MaterialPair{.friction = real(0.1)})
                 : world.set_material_pair(kIce, kRubber, MaterialPair{.friction = real(0.1)}));
    EXPECT_NEAR(friction_of(world, of_kind(kIce, 0.9), of_kind(kRubber, 0.9)), 0.1,
                bar(1e-6, 1e-4));
  }
}

TEST(MaterialPairs, OtherPairsCombineAsEver) {
  const struct {
    std::uint32_t a, b;
  } others[] = {{kIce, kIce}, {kIce, kSteel}, {kIce, 0}, {0, kRubber}, {0, 0}};
  for (const auto& pair : others) {
    PhysicsWorld world(no_sleep());
    must(world.set_material_pair(kIce, kRubber, MaterialPair{.friction = real(0.05)}));
    must(world.set_material_pair(kRubber, kSteel, MaterialPair{.friction = real(0.02)}));
    EXPECT_NEAR(friction_of(world, of_kind(pair.a, 0.8), of_kind(pair.b, 0.2)), 0.4,
                bar(1e-6, 1e-4))
        << pair.a << " on " << pair.b;
  }
}

// An entry for restitution alone leaves friction to the rules, and a kind may meet itself.
TEST(MaterialPairs, EmptyFieldsAreCombined) {
  PhysicsWorld world(no_sleep());
  must(world.set_material_pair(kSteel, kSteel, MaterialPair{.restitution = real(1)}));
  EXPECT_NEAR(friction_of(world, of_kind(kSteel, 0.3), of_kind(kSteel, 0.3)), 0.3, bar(1e-6, 1e-4));
  const BodyId ball = add(world, slider({50, 2, 0}), with(sphere(0.5), of_kind(kSteel, 0.3)));
  double highest = 0;
  run(world, 2, kDt, [&] {
    if (velocity(world, ball).y() > 0) highest = std::max(highest, position(world, ball).y());
  });
  EXPECT_NEAR(highest, 2, 0.01);  // seen at step ends only
}

// A table entry of 0 is not an empty one.
TEST(MaterialPairs, ZeroOverridesToo) {
  PhysicsWorld world(no_sleep());
  must(world.set_material_pair(kSteel, kSteel,
                               MaterialPair{.friction = real(0), .restitution = real(0)}));
  EXPECT_EQ(friction_of(world, of_kind(kSteel, 1, 1), of_kind(kSteel, 1, 1)), 0);
}

// What sleeps on a slope by its friction wakes and slides when the table takes that away, and the
// table reaches a pair that touches already.
TEST(MaterialPairs, ChangingTheTableWakesAndReachesWhatTouches) {
  PhysicsWorld world;
  const double slope = 0.3;  // [rad]
  add_floor(world, of_kind(kRubber, 0.9), {std::sin(slope), std::cos(slope), 0});
  const Vector3d normal(std::sin(slope), std::cos(slope), 0);
  const BodyId steel = add(world, body_at(at(0.5 * normal, turn(-slope, Vector3d::UnitZ()))),
                           with(cube(0.5), of_kind(kSteel, 0.9)));
  const BodyId other =
      add(world, body_at(at(0.5 * normal + Vector3d(0, 0, 5), turn(-slope, Vector3d::UnitZ()))),
          with(cube(0.5), of_kind(kRubber, 0.9)));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(steel));
  ASSERT_FALSE(world.is_awake(other));
  must(world.set_material_pair(kSteel, kRubber, MaterialPair{.friction = real(0.1)}));
  EXPECT_TRUE(world.is_awake(steel));
  EXPECT_FALSE(world.is_awake(other));
  run(world, 1);
  const double a = kGravity * (std::sin(slope) - 0.1 * std::cos(slope));
  EXPECT_NEAR(velocity(world, steel).norm(), a, 0.01 * a);
  must(world.set_material_pair(kSteel, kRubber, std::nullopt));
  run(world, 3);
  EXPECT_FALSE(world.is_awake(steel));
}

TEST(MaterialPairs, CanBeReadAndTakenBack) {
  PhysicsWorld world;
  EXPECT_FALSE(world.material_pair(kIce, kSteel).has_value());
  const MaterialPair values{.friction = real(0.2), .rolling_friction = real(0.01)};
  must(world.set_material_pair(kIce, kSteel, values));
  EXPECT_EQ(world.material_pair(kSteel, kIce), values);
  must(world.set_material_pair(kSteel, kIce, std::nullopt));
  EXPECT_FALSE(world.material_pair(kIce, kSteel).has_value());
}

TEST(MaterialPairs, BadValuesAreRefusedAndChangeNothing) {
  PhysicsWorld world;
  const MaterialPair good{.friction = real(0.5)};
  must(world.set_material_pair(kIce, kSteel, good));
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_FALSE(world.set_material_pair(0, kSteel, good).ok());
  EXPECT_FALSE(world.set_material_pair(kSteel, 0, good).ok());
  EXPECT_FALSE(world.set_material_pair(kIce, kSteel, MaterialPair{.friction = real(-1)}).ok());
  EXPECT_FALSE(world.set_material_pair(kIce, kSteel, MaterialPair{.friction = nan}).ok());
  EXPECT_FALSE(world.set_material_pair(kIce, kSteel, MaterialPair{.restitution = real(1.5)}).ok());
  EXPECT_FALSE(world.set_material_pair(kIce, kSteel, MaterialPair{.rolling_friction = nan}).ok());
  EXPECT_FALSE(
      world.set_material_pair(kIce, kSteel, MaterialPair{.torsional_friction = real(-1)}).ok());
  EXPECT_EQ(world.material_pair(kIce, kSteel), good);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
