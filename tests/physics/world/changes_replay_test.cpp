// Proves that changes of bodies and colliders belong to the state: every kind of them gives the
// same bits for any number of threads, after restore in the middle and when recorded inputs are
// played back.
#include <gtest/gtest.h>

#include <set>

#include "support/measure.h"
#include "support/replay_checks.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

struct Scene {
  BodyId floor, shelf, zone, hub;
  std::vector<BodyId> bodies;
};

// A heap on a floor, beside a shelf, with a zone that senses and a chain that hangs on a hub.
Scene build(PhysicsWorld& world) {
  Scene scene;
  scene.floor = add_slab(world, 20, 20);
  scene.shelf = add(world, body_at(at(0, 2, 0), MotionType::Static), with(box(3, 0.1, 3)));
  Collider zone = with(cube(1.5));
  zone.is_sensor = true;
  scene.zone = add(world, body_at(at(1, 1, 0), MotionType::Static), zone);
  for (int i = 0; i < 36; ++i) {
    Collider collider = with(i % 3 == 0   ? Shape(sphere(0.25))
                             : i % 3 == 1 ? Shape(cube(0.25))
                                          : Shape(capsule(0.15, 0.2)),
                             material(0.5, i % 6 == 0 ? 0.4 : 0));
    collider.pose.position = vec(0.05 * (i % 4), 0, 0);
    scene.bodies.push_back(
        add(world, body_at(at(0.8 * (i % 6) - 2, 0.4 + 0.6 * (i / 12), 0.8 * (i / 6 % 6) - 2)),
            collider));
  }
  scene.hub = add(world, body_at(at(0, 9, 0), MotionType::Static), with(sphere(0.1)));
  BodyId last = scene.hub;
  for (int i = 0; i < 4; ++i) {
    const BodyId link = add(world, body_at(at(0.6 * (i + 1), 9, 0)), with(capsule(0.15, 0.1)));
    Joint joint;
    joint.body_a = last;
    joint.body_b = link;
    joint.kind = BallJoint{};
    joint.frame_a.position = vec(0.3, 0, 0);
    joint.frame_b.position = vec(-0.3, 0, 0);
    must(world.create_joint(joint));
    last = link;
    scene.bodies.push_back(link);
  }
  return scene;
}

void disturb(PhysicsWorld& world, const Scene& scene, int step) {
  const auto body = [&](int i) { return scene.bodies[static_cast<std::size_t>(i) % 40]; };
  const auto collider = [&](int i) { return world.colliders_of(body(i))[0]; };
  if (step % 5 != 0) return;
  const int k = step / 5;  // 0..59
  const MotionType types[3] = {MotionType::Kinematic, MotionType::Static, MotionType::Dynamic};
  for (int i = 0; i < 6; ++i) must(world.set_motion_type(body(k + 7 * i), types[(k + i) % 3]));
  if (k % 10 == 3) must(world.set_motion_type(scene.hub, types[k / 10 % 3]));
  if (k % 20 == 7) must(world.set_motion_type(scene.shelf, types[(k / 20 + 2) % 3]));
  MotionLocks locks;
  locks.linear_x = k % 3 == 0;
  locks.angular_y = k % 2 == 0;
  must(world.set_locks(body(3 * k), locks));
  must(world.set_damping(body(5 * k), real(0.1 * (k % 4)), real(0.2 * (k % 3))));
  must(world.set_gravity_scale(body(k + 11), real(1 - 0.2 * (k % 5))));
  must(world.set_can_sleep(body(k), k % 2 == 0));
  must(world.set_continuous(body(2 * k), k % 3 == 1));
  must(world.set_user_data(body(k), 1ull << (k % 60)));
  const BodyId weighed = body(4 * k + 1);
  if (world.state(weighed).type == MotionType::Dynamic) {
    MassProperties mass = world.mass_properties(weighed);
    mass.mass *= 1.5;
    if (k % 3 != 0) {
      must(world.set_mass(weighed, mass));
    } else {
      must(world.derive_mass(weighed));
    }
  }
  must(world.set_shape(collider(3 * k + 2), k % 3 == 0   ? Shape(box(0.2, 0.3, 0.25))
                                            : k % 3 == 1 ? Shape(cylinder(0.2, 0.25))
                                                         : Shape(sphere(0.3))));
  LocalPose place;
  place.position = vec(0, 0.04 * (k % 3), 0.02 * (k % 5));
  place.orientation = turn(0.2 * k, Vector3d(1, 2, 0.5));
  must(world.set_local_pose(collider(7 * k), place));
  Material surface = material(0.1 * (k % 8), 0.15 * (k % 4));
  surface.rolling_friction = real(0.01 * (k % 3));
  surface.kind = static_cast<std::uint32_t>(k % 3);
  surface.grain = vec(k % 2, 0, 1);
  surface.grain_friction = real(0.25 * (k % 5));
  surface.adhesion = real(20 * (k % 3));
  must(world.set_material(collider(9 * k), surface));
  must(world.set_density(collider(2 * k + 5), 400 + 300 * (k % 4)));
  must(world.set_sensor(collider(6 * k + 1), k % 4 == 1));
  if (k % 6 == 2) must(world.set_sensor(world.colliders_of(scene.zone)[0], k % 12 == 8));
  must(world.set_one_way(world.colliders_of(scene.shelf)[0], vec(0, k % 4 - 1, 0)));
  must(world.set_user_data(collider(k), static_cast<std::uint64_t>(k)));
}

constexpr DisturbedRun<Scene> kRun{build, disturb, 300};

TEST(ChangesReplay, AnyNumberOfThreads) { expect_same_with_threads(kRun); }

// Saved both before the changes of a step and between them and the step.
TEST(ChangesReplay, SaveAndRestoreInTheMiddle) {
  expect_same_after_restore(
      kRun, [](int step, bool disturbed) { return disturbed ? step % 45 == 20 : step % 50 == 23; });
}

TEST(ChangesReplay, RecordedInputsReplayIntoAnEmptyWorld) {
  const std::set<InputKind> kinds = expect_same_in_replay(kRun);
  for (auto kind = InputKind::DeriveMass; kind <= InputKind::SetColliderUserData;
       kind = static_cast<InputKind>(static_cast<std::uint32_t>(kind) + 1))
    EXPECT_TRUE(kinds.contains(kind)) << name_of(kind) << " was never recorded";
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
