// Proves that an image tells, bit for bit, what the world told when it was taken: through piles,
// sleep, quarantine and restored snapshots, whatever was done to the world between its steps, and
// however far the world has gone on since.
#include "plumb/world_image.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

// All that an image can be asked for.
struct Told {
  std::vector<BodyState> bodies;
  std::vector<ContactPoint> points;
  EnergyReport energy;
  std::uint64_t hash = 0;
};

template <class Source>
Told told_by(const Source& source) {
  Told told;
  source.copy_body_states(told.bodies);
  source.copy_contact_points(told.points);
  told.energy = source.energy();
  told.hash = source.motion_hash();
  return told;
}

void expect_same(const Told& image, const Told& world) {
  ASSERT_EQ(image.bodies.size(), world.bodies.size());
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const BodyState &a = image.bodies[i], &b = world.bodies[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.type, b.type);
    EXPECT_EQ(a.awake, b.awake);
    EXPECT_EQ(a.user_data, b.user_data);
    EXPECT_EQ(a.pose.position, b.pose.position);
    EXPECT_EQ(a.pose.orientation.coeffs(), b.pose.orientation.coeffs());
    EXPECT_EQ(a.linear_velocity, b.linear_velocity);
    EXPECT_EQ(a.angular_velocity, b.angular_velocity);
  }
  ASSERT_EQ(image.points.size(), world.points.size());
  for (std::size_t i = 0; i < world.points.size(); ++i) {
    EXPECT_EQ(image.points[i].position, world.points[i].position);
    EXPECT_EQ(image.points[i].normal, world.points[i].normal);
    EXPECT_EQ(image.points[i].normal_impulse, world.points[i].normal_impulse);
  }
  EXPECT_EQ(image.energy.kinetic_linear, world.energy.kinetic_linear);
  EXPECT_EQ(image.energy.kinetic_angular, world.energy.kinetic_angular);
  EXPECT_EQ(image.energy.potential, world.energy.potential);
  EXPECT_EQ(image.energy.momentum, world.energy.momentum);
  EXPECT_EQ(image.energy.angular_momentum, world.energy.angular_momentum);
  EXPECT_EQ(image.hash, world.hash);
}

void expect_faithful(const PhysicsWorld& world) {
  WorldImage image;
  world.copy_image(image);
  expect_same(told_by(image), told_by(world));
}

TEST(WorldImage, TellsWhatTheWorldTellsInEveryStep) {
  PhysicsWorld world;
  const Built built = build_pile(world, {.side = 4});
  for (int i = 0; i < 3; ++i)  // apart from the pile, and soon asleep
    add(world, body_at(at(40, 0.5 + i, 0)), with(cube(0.5)));
  WorldImage image;  // used again and again, as a recorder does
  bool touched = false, slept = false;
  for (int step = 0; step < 400; ++step) {
    world.step(1.0 / 60);
    world.copy_image(image);
    const Told told = told_by(image);
    expect_same(told, told_by(world));
    if (HasFatalFailure()) return;
    touched = touched || !told.points.empty();
    slept = slept || world.last_report().awake_bodies < built.bodies.size() + 3;
  }
  EXPECT_TRUE(touched);
  EXPECT_TRUE(slept);  // else the contacts of sleeping islands were not seen
}

TEST(WorldImage, FollowsWhatIsDoneBetweenSteps) {
  PhysicsWorld world;
  const Built built = build_pile(world, {.side = 4});
  for (int i = 0; i < 90; ++i) world.step(1.0 / 60);
  expect_faithful(world);

  must(world.destroy_body(built.bodies[5]));  // places of pairs and bodies move
  expect_faithful(world);
  must(world.destroy_body(built.bodies[40]));
  RigidBody marked = body_at(at(0, 20, 0));
  marked.user_data = 77;
  marked.gravity_scale = real(0.5);
  const BodyId added = add(world, marked, with(cube(0.3)));  // in one of the empty places
  expect_faithful(world);
  must(world.set_mass(added, inertia_of::box(3, Eigen::Vector3d(1, 2, 1))));
  expect_faithful(world);
  must(world.set_pose(built.bodies[7], at(3, 9, 1)));
  must(world.set_linear_velocity(built.bodies[8], vec(1, 2, 3)));
  must(world.set_angular_velocity(built.bodies[8], vec(3, 2, 1)));
  expect_faithful(world);
  must(world.set_awake(built.bodies[20], false));
  expect_faithful(world);
  must(world.set_motion_type(built.bodies[9], MotionType::Static));
  expect_faithful(world);
  must(world.set_gravity_scale(built.bodies[10], real(-0.25)));
  expect_faithful(world);
  must(world.set_user_data(built.bodies[11], 4711));
  expect_faithful(world);
  WorldSettings settings = world.settings();
  settings.gravity = vec(0, -1.6, 0);
  must(world.set_settings(settings));
  expect_faithful(world);
  Collider offset = with(sphere(0.2));
  offset.pose.position = vec(0.4, 0, 0);  // the centre of mass moves
  EXPECT_TRUE(world.create_collider(added, offset).ok());
  expect_faithful(world);
  world.step(1.0 / 60);
  expect_faithful(world);
}

TEST(WorldImage, FollowsARestoredWorldAndAQuarantinedBody) {
  PhysicsWorld world;
  const Built built = build_pile(world, {.side = 3});
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  const Snapshot snapshot = world.save();
  must(world.destroy_body(built.bodies[2]));
  expect_faithful(world);
  must(world.restore(snapshot));
  expect_faithful(world);
  // So light that a finite force gives it an acceleration that is not.
  const BodyId doomed = add(world, body_at(at(50, 10, 0)), with(sphere(0.5), {}, 1e-3));
  const Real huge = std::numeric_limits<Real>::max() / 2;
  must(world.apply_force(doomed, Vec3(huge, huge, 0)));
  expect_faithful(world);
  world.step(1.0 / 60);
  ASSERT_EQ(world.last_report().quarantined, 1u);
  expect_faithful(world);
}

TEST(WorldImage, KeepsWhatItSawAndCanBeReadOnAnotherThread) {
  PhysicsWorld world;
  const Built built = build_pile(world, {.side = 3});
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  WorldImage image;
  world.copy_image(image);
  const Told then = told_by(world);
  Told read;
  std::thread reader([&] { read = told_by(image); });
  must(world.destroy_body(built.bodies[3]));
  for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
  reader.join();
  expect_same(read, then);
}

TEST(WorldImage, OfNoWorldHoldsNothing) {
  const WorldImage none;
  std::vector<BodyState> bodies(3);
  std::vector<ContactPoint> points(3);
  none.copy_body_states(bodies);
  none.copy_contact_points(points);
  EXPECT_TRUE(bodies.empty());
  EXPECT_TRUE(points.empty());
  EXPECT_EQ(none.energy().total(), 0);
  PhysicsWorld empty;
  expect_faithful(empty);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
