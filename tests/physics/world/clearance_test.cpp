// Invariant: what pairs remember of the gap between them changes no bit of a run. Beside a world
// that goes on, another one is restored from it before every step, which remembers nothing; both
// end every step with the same state, whatever is done to bodies and shapes between steps.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/random_changes.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace testing_support;
using namespace scenes;
using Eigen::Vector3d;

void expect_as_if_looked_at_anew(PhysicsWorld& world, PhysicsWorld& forgetful, double dt,
                                 int step) {
  must(forgetful.restore(world.save()));
  world.step(dt);
  forgetful.step(dt);
  ASSERT_EQ(world.state_hash(), forgetful.state_hash()) << step;
  EXPECT_EQ(world.last_report().touching_pairs, forgetful.last_report().touching_pairs) << step;
}

class Clearance : public testing::TestWithParam<std::uint32_t> {};

TEST_P(Clearance, OfRandomWorldsIsNeverStale) {
  PhysicsWorld world, forgetful;
  add_floor(world);
  RandomChanges changes(world, 100 + GetParam());
  for (int step = 0; step < 250; ++step) {
    ASSERT_EQ(changes.act(), "");
    const double dt = step % 50 < 40 ? 1.0 / 60 : 1.0 / 20;  // boxes reach ahead for one of them
    ASSERT_NO_FATAL_FAILURE(expect_as_if_looked_at_anew(world, forgetful, dt, step));
  }
}

// Bodies close to one another that do not touch: what moves one of them, or reshapes it, or turns a
// long one about, must be noticed.
TEST_P(Clearance, OfCloseBodiesIsNeverStale) {
  Random random(GetParam());
  PhysicsWorld world(no_gravity()), forgetful;
  std::vector<BodyId> bodies;
  std::vector<ColliderId> colliders;
  const Shape shapes[] = {box(0.45, 0.45, 0.45), sphere(0.45), capsule(0.2, 0.25),
                          cylinder(0.45, 0.45), box(0.45, 0.1, 0.45)};
  for (int i = 0; i < 64; ++i) {
    const Vector3d p(i % 4, i / 4 % 4, i / 16);
    const MotionType type = i % 7 == 3   ? MotionType::Kinematic
                            : i % 7 == 5 ? MotionType::Static
                                         : MotionType::Dynamic;
    RigidBody body = moving(at(p, random.rotation(kPi)), Vec3::Zero(), Vec3::Zero());
    body.type = type;
    bodies.push_back(world.create_body(body).id);
    colliders.push_back(
        world.create_collider(bodies.back(), with(shapes[i % 5], material(0.4, 0.3))).id);
  }
  const auto any = [&] { return static_cast<std::size_t>(random.uniform(0, 64)); };
  for (int step = 0; step < 200; ++step) {
    const std::size_t i = any();
    switch (step % 5) {
      case 0:
        must(world.set_pose(bodies[i], at(position(world, bodies[any()]) + 0.6 * random.direction(),
                                          random.rotation(kPi))));
        break;
      case 1:
        must(world.set_shape(colliders[i], shapes[any() % 5]));
        break;
      case 2:
        if (i % 7 != 5) must(world.set_angular_velocity(bodies[i], vec(6 * random.direction())));
        break;
      case 3:
        if (i % 7 != 5) must(world.set_linear_velocity(bodies[i], vec(3 * random.direction())));
        break;
      default:
        break;
    }
    ASSERT_NO_FATAL_FAILURE(expect_as_if_looked_at_anew(world, forgetful, 1.0 / 60, step));
  }
}

// 313: a body falls asleep as another one comes near. 644: gravity grows where boxes are close.
// 2802, 4294, 7474: what fell asleep or stands reaches no farther, when the time step changes
// either.
INSTANTIATE_TEST_SUITE_P(, Clearance,
                         testing::Values(1u, 2u, 3u, 4u, 8u, 313u, 644u, 2802u, 3872u, 4294u, 4408u,
                                         7474u));

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
