// Invariant: an adhesive pair that touches withstands the pull it is said to withstand and not
// more, friction feels adhesion as a load, and what does not touch does not feel it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr double kMass = 1000;    // [kg] of a cube of 1 m
constexpr double kWeight = kMass * kGravity;

Material sticky(double pull, double friction = 0.6) {
  Material m = material(friction);
  m.adhesion = real(pull);
  return m;
}

double height(const PhysicsWorld& world, BodyId body) {
  return static_cast<double>(world.center_of_mass(body).y());
}

// A ceiling whose lower side is at y = 0.
void add_ceiling(PhysicsWorld& world, const Material& surface = {}) {
  add(world, body_at(at(0, 1, 0), MotionType::Static), with(box(10, 1, 10), surface));
}

TEST(Adhesion, HoldsUnderACeilingWhatItCanCarry) {
  for (const ContactSolver solver : {ContactSolver::SoftStep, ContactSolver::Newton})
    for (const Shape& shape : {Shape{cube(0.5)}, Shape{sphere(0.5)}, Shape{capsule(0.5, 0.5)}}) {
      for (const double share : {0.97, 1.03}) {
        WorldSettings settings = no_sleep();
        settings.contact_solver = solver;
        PhysicsWorld world(settings);
        add_ceiling(world);
        const double reach = std::holds_alternative<Capsule>(shape) ? 1.0 : 0.5;
        const BodyId body = add(world, body_at(at(0, -reach, 0)), with(shape));
        const double weight = world.mass_properties(body).mass * kGravity;
        must(world.set_material(world.colliders_of(body)[0], sticky(share * weight)));
        for (int i = 0; i < 300; ++i) world.step(kDt);
        if (share > 1)
          EXPECT_NEAR(height(world, body), -reach, 3e-3);
        else
          EXPECT_LT(height(world, body), -reach - 1);
      }
    }
}

TEST(Adhesion, MustBeOvercomeToLift) {
  for (const double share : {0.98, 1.02}) {
    PhysicsWorld world(no_sleep());
    add_floor(world, sticky(2 * kWeight));
    const BodyId box = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
    for (int i = 0; i < 120; ++i) {
      must(world.apply_force(box, vec(0, share * 3 * kWeight, 0)));
      world.step(kDt);
    }
    if (share > 1)
      EXPECT_GT(height(world, box), 1);
    else
      EXPECT_NEAR(height(world, box), 0.5, 2e-3);
  }
}

// On a wall nothing but adhesion presses: mu a against the weight.
TEST(Adhesion, IsALoadForFriction) {
  for (const double share : {0.5, 0.95, 1.05}) {
    PhysicsWorld world(no_sleep());
    add(world, body_at(at(-1, 0, 0), MotionType::Static), with(box(1, 50, 50), material(0.5)));
    RigidBody body = body_at(at(0.5, 0, 0));
    body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
    const BodyId cube_id = add(world, body, with(cube(0.5), sticky(share * kWeight / 0.5, 0.5)));
    for (int i = 0; i < 60; ++i) world.step(kDt);
    const double fallen = static_cast<double>(world.linear_velocity(cube_id).y());
    if (share > 1)
      EXPECT_NEAR(fallen, 0, 1e-3);
    else
      EXPECT_NEAR(fallen, -(1 - share) * kGravity, 0.02 * kGravity);
  }
}

TEST(Adhesion, CatchesWhatIsThrown) {
  PhysicsWorld world(no_sleep());
  add_ceiling(world, sticky(3 * kWeight));
  const BodyId ball = add(world, moving(at(0, -3, 0), vec(0.2, 12, 0)), with(sphere(0.5)));
  for (int i = 0; i < 300; ++i) world.step(kDt);
  EXPECT_NEAR(height(world, ball), -0.5, 5e-3);
}

TEST(Adhesion, KeepsMomentumAndGainsNoEnergy) {
  PhysicsWorld world(no_gravity());
  add(world, moving(at(-1, 0, 0), vec(2, 0.3, 0)), with(cube(0.5), sticky(1e5)));
  add(world, moving(at(1, 0.2, 0), vec(-1, 0, 0.2), vec(0.5, 1, 0)), with(sphere(0.5)));
  const EnergyReport begin = world.energy();
  double energy = begin.total();
  for (int i = 0; i < 300; ++i) {
    world.step(kDt);
    const EnergyReport now = world.energy();
    EXPECT_LE(now.total(), energy + 1e-3 * begin.total()) << i;
    energy = now.total();
    EXPECT_LT((now.momentum - begin.momentum).norm(), 1e-4 * 3000);
    EXPECT_LT((now.angular_momentum - begin.angular_momentum).norm(), 1e-4 * 3000);
  }
  EXPECT_GT(world.last_report().touching_pairs, 0u);
}

TEST(Adhesion, IsNotFeltAtADistance) {
  const auto fall = [](const Material& surface) {
    PhysicsWorld world(no_sleep());
    add_floor(world, surface);
    const BodyId ball = add(world, body_at(at(0, 5, 0)), with(sphere(0.5), surface));
    for (int i = 0; i < 50; ++i) world.step(kDt);
    return world.linear_velocity(ball);
  };
  EXPECT_EQ(fall(sticky(1e6)), fall(material(0.6)));
}

TEST(Adhesion, OfALightBodyStaysThroughSleepAndEndsWhenTakenAway) {
  PhysicsWorld world;
  add_ceiling(world);
  const BodyId box = add(world, body_at(at(0, -0.5, 0)), with(cube(0.5), sticky(1.5 * kWeight)));
  for (int i = 0; i < 300; ++i) world.step(kDt);
  EXPECT_FALSE(world.state(box).awake);
  EXPECT_NEAR(height(world, box), -0.5, 3e-3);
  must(world.set_material(world.colliders_of(box)[0], material(0.6)));
  for (int i = 0; i < 60; ++i) world.step(kDt);
  EXPECT_LT(height(world, box), -4);
}

TEST(Adhesion, BadValuesAreRefused) {
  PhysicsWorld world;
  const BodyId body = must(world.create_body(RigidBody{}));
  for (const double pull : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(world.create_collider(body, with(cube(1), sticky(pull))).status.code,
              StatusCode::OutOfRange)
        << pull;
  EXPECT_FALSE(world.plan().active(PlanItem::Adhesion));
  must(world.create_collider(body, with(cube(1), sticky(1))).status);
  EXPECT_TRUE(world.plan().active(PlanItem::Adhesion));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
