// Proves that the motion type of a living body can change: its motion goes on, what it carries and
// what hangs on it stays, what it can meet no more ends with its events, and what it cannot be is
// refused.
#include <gtest/gtest.h>

#include <limits>

#include "support/measure.h"
#include "support/recorder.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

int count(const std::vector<ContactEvent>& events, ContactEvent::Kind kind, BodyId a, BodyId b) {
  return static_cast<int>(std::count_if(events.begin(), events.end(), [&](const ContactEvent& e) {
    return e.kind == kind && ((e.body_a == a && e.body_b == b) || (e.body_a == b && e.body_b == a));
  }));
}

// A body whose centre of mass is not its origin moves on as the rigid body that it is.
TEST(MotionType, AKinematicBodyThatBecomesDynamicKeepsItsMotion) {
  PhysicsWorld world(no_gravity());
  RigidBody lift = moving(at({1, 2, 3}, turn(0.7, {1, 1, 0})), vec(1, 2, 3), vec(0.3, -0.5, 1));
  lift.type = MotionType::Kinematic;
  Collider collider = with(box(0.2, 0.3, 0.5));
  collider.pose.position = vec(0.4, -0.1, 0.2);
  const BodyId body = add(world, lift, collider);
  run(world, 0.5);
  const Pose pose = world.pose(body);
  must(world.set_motion_type(body, MotionType::Dynamic));
  EXPECT_EQ(world.state(body).type, MotionType::Dynamic);
  EXPECT_LT((wide(world.pose(body).position) - wide(pose.position)).norm(), 16 * kPosEps);
  EXPECT_LT(angle_between(wide(world.pose(body).orientation), wide(pose.orientation)), 16 * kEps);
  EXPECT_LT((wide(world.velocity_at(body, pose.position)) - Vector3d(1, 2, 3)).norm(), 16 * kEps);
  EXPECT_LT((spin(world, body) - Vector3d(0.3, -0.5, 1)).norm(), 16 * kEps);
  EXPECT_NEAR(world.mass_properties(body).mass, 240, 240 * 8 * kEps);
  // From here on it flies: the centre of mass goes straight, the angular momentum stays.
  const Vector3d centre = position(world, body), v = velocity(world, body);
  const Vector3d L = wide(world.angular_momentum(body));
  run(world, 1);
  EXPECT_LT((position(world, body) - (centre + v)).norm(), bar(1e-12, 1e-4));
  EXPECT_EQ(wide(world.angular_momentum(body)), L);
}

TEST(MotionType, AStaticBodyThatBecomesDynamicFallsWithWhatLiesOnIt) {
  PhysicsWorld world;
  const BodyId shelf = add(world, body_at(at(0, 50, 0), MotionType::Static), with(box(1, 0.1, 1)));
  const BodyId top = add(world, body_at(at(0, 50.35, 0)), with(cube(0.25)));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(top));
  must(world.set_motion_type(shelf, MotionType::Dynamic));
  EXPECT_TRUE(world.is_awake(shelf));
  EXPECT_TRUE(world.is_awake(top));
  run(world, 1);
  const double fallen = 0.5 * kGravity;  // [m]
  EXPECT_NEAR(position(world, shelf).y(), 50 - fallen, 0.02);
  EXPECT_NEAR(position(world, top).y(), 50.35 - fallen, 0.02);
}

// The stack stands on it when its foot is gone, and what hangs on a joint goes on swinging.
TEST(MotionType, ADynamicBodyThatBecomesStaticHoldsItsStackAndItsJoints) {
  PhysicsWorld world;
  const Built stack = build_stack(world, {.count = 3});
  const BodyId held = stack.bodies[1], top = stack.bodies[2];
  const BodyId bob = add(world, body_at(at(2, 1.5, 0)), with(sphere(0.2)));
  Joint joint;
  joint.body_a = held;
  joint.body_b = bob;
  joint.kind = BallJoint{};
  joint.frame_b.position = vec(-2, 0, 0);
  const JointId rope = must(world.create_joint(joint));
  run(world, 0.1);
  must(world.set_motion_type(held, MotionType::Static));
  EXPECT_EQ(velocity(world, held), Vector3d::Zero());
  EXPECT_EQ(world.mass_properties(held).mass, 0);
  must(world.destroy_body(stack.bodies[0]));
  EventRecorder events;
  world.attach(&events);
  const Pose pose = world.pose(held);
  run(world, 2, kDt,
      [&] { ASSERT_NEAR((position(world, bob) - position(world, held)).norm(), 2, 1e-3); });
  EXPECT_EQ(world.pose(held).position, pose.position);
  EXPECT_EQ(world.pose(held).orientation.coeffs(), pose.orientation.coeffs());
  EXPECT_TRUE(world.is_valid(rope));
  EXPECT_NEAR(position(world, top).y(), 2.5, 0.01);
  EXPECT_EQ(count(events.contacts, ContactEvent::Kind::End, held, top), 0);
  EXPECT_NE(find_contact(contacts(world), held, top), nullptr);
}

// One that is asleep wakes its island first, and lets it sleep again.
TEST(MotionType, ASleepingStackWakesAndSleepsAgain) {
  PhysicsWorld world;
  const Built stack = build_stack(world, {.count = 3});
  run(world, 3);
  ASSERT_FALSE(world.is_awake(stack.bodies[0]));
  must(world.set_motion_type(stack.bodies[1], MotionType::Static));
  EXPECT_TRUE(world.is_awake(stack.bodies[0]));
  EXPECT_FALSE(world.is_awake(stack.bodies[1]));
  EXPECT_TRUE(world.is_awake(stack.bodies[2]));
  run(world, 3);
  EXPECT_FALSE(world.is_awake(stack.bodies[0]));
  EXPECT_FALSE(world.is_awake(stack.bodies[2]));
  must(world.set_motion_type(stack.bodies[1], MotionType::Dynamic));
  for (const BodyId body : stack.bodies) EXPECT_TRUE(world.is_awake(body));
  run(world, 3);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(position(world, stack.bodies[i]).y(), 0.5 + static_cast<double>(i), 0.01);
}

TEST(MotionType, WhatCanMeetNoMoreEndsWithItsEvents) {
  PhysicsWorld world;
  const BodyId slab = add_slab(world, 5, 5);
  const BodyId body = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  Collider zone = with(cube(1));
  zone.is_sensor = true;
  add(world, body_at(Pose{}, MotionType::Static), zone);
  run(world, 0.5);
  ASSERT_EQ(world.events().overlaps.size(), 1u);
  EventRecorder events;
  world.attach(&events);
  must(world.set_motion_type(body, MotionType::Kinematic));
  world.step(kDt);
  EXPECT_EQ(count(events.contacts, ContactEvent::Kind::End, body, slab), 1);
  EXPECT_TRUE(contacts(world).empty());
  EXPECT_TRUE(events.sensors.empty());  // a trigger sees what is moved as well
  EXPECT_EQ(world.events().overlaps.size(), 1u);
  must(world.set_motion_type(body, MotionType::Static));
  world.step(kDt);
  ASSERT_EQ(events.sensors.size(), 1u);
  EXPECT_EQ(events.sensors[0].kind, SensorEvent::Kind::Exit);
  EXPECT_TRUE(world.events().overlaps.empty());
  must(world.set_motion_type(body, MotionType::Dynamic));
  world.step(kDt);
  EXPECT_EQ(count(events.contacts, ContactEvent::Kind::Begin, body, slab), 1);
  EXPECT_EQ(world.events().overlaps.size(), 1u);
}

// What becomes kinematic goes on by itself, nothing holds it up, and it carries.
TEST(MotionType, AKinematicBodyIsPushedByNothingAndCarries) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId lift = add(world, body_at(at(0, 0.1, 0)), with(box(1, 0.1, 1)));
  const BodyId load = add(world, body_at(at(0, 0.45, 0)), with(cube(0.25)));
  run(world, 3);
  ASSERT_FALSE(world.is_awake(load));
  must(world.set_motion_type(lift, MotionType::Kinematic));
  must(world.set_linear_velocity(lift, vec(0, 0.5, 0)));
  run(world, 2);
  EXPECT_NEAR(position(world, lift).y(), 1.1, 0.01);
  EXPECT_NEAR(position(world, load).y(), 1.45, 0.01);
  EXPECT_EQ(velocity(world, lift), Vector3d(0, 0.5, 0));
}

// The contacts that are read between the change and the next step lie where they lay.
TEST(MotionType, ContactsStayWhereTheyAreInTheWorld) {
  PhysicsWorld world;
  Collider collider = with(box(0.5, 0.25, 0.5));
  collider.pose.position = vec(0, 0.75, 0);  // the centre of mass is above the origin
  const BodyId foot = add(world, body_at(at(0, -0.5, 0)), collider);
  add_floor(world);
  add(world, body_at(at(0, 0.75, 0)), with(cube(0.25)));
  run(world, 0.5);
  const std::vector<ContactState> before = contacts(world);
  ASSERT_EQ(before.size(), 2u);
  must(world.set_motion_type(foot, MotionType::Kinematic));
  const std::vector<ContactState> after = contacts(world);
  ASSERT_EQ(after.size(), 1u);  // that with the floor is gone
  const ContactState* same = find_contact(before, after[0].body_a, after[0].body_b);
  ASSERT_NE(same, nullptr);
  ASSERT_EQ(same->point_count, after[0].point_count);
  for (int i = 0; i < same->point_count; ++i)
    EXPECT_LT((wide(same->points[i].position) - wide(after[0].points[i].position)).norm(),
              bar(1e-14, 1e-6));
}

// A joint between two bodies neither of which is dynamic rests; it is saved, restored, and holds
// again as soon as one is.
TEST(MotionType, AJointRestsWhileItHoldsNoDynamicBody) {
  PhysicsWorld world;
  const BodyId a = add(world, body_at(at(0, 5, 0)), with(cube(0.2)));
  const BodyId b = add(world, body_at(at(1, 5, 0)), with(cube(0.2)));
  Joint joint;
  joint.body_a = a;
  joint.body_b = b;
  joint.kind = HingeJoint{};
  joint.frame_a.orientation = joint.frame_b.orientation = turn(kPi / 2, Vector3d::UnitY());
  joint.frame_b.position = vec(-1, 0, 0);
  const JointId hinge = must(world.create_joint(joint));
  must(world.set_motion_type(a, MotionType::Static));
  run(world, 0.3);
  EXPECT_GT(world.joint_reaction(hinge).force.norm(), 1);
  must(world.set_motion_type(b, MotionType::Kinematic));
  EXPECT_EQ(wide(world.joint_reaction(hinge).force), Vector3d::Zero());
  must(world.set_linear_velocity(b, Vec3::Zero()));
  must(world.set_angular_velocity(b, Vec3::Zero()));
  const Vector3d stands = position(world, b);
  run(world, 0.5);
  EXPECT_EQ(position(world, b), stands);
  ASSERT_TRUE(world.is_valid(hinge));
  PhysicsWorld restored;
  must(restored.restore(world.save()));
  for (PhysicsWorld* w : {&world, &restored}) {
    must(w->set_motion_type(b, MotionType::Dynamic));
    run(*w, 1, kDt, [&] { ASSERT_NEAR((position(*w, b) - position(*w, a)).norm(), 1, 1e-3); });
    EXPECT_LT(position(*w, b).y(), 4.9);
  }
  EXPECT_EQ(world.state_hash(), restored.state_hash());
}

// A gear between the hinges of two wheels rests and comes back like its hinges.
TEST(MotionType, ACouplingRestsWithItsJoints) {
  PhysicsWorld world(no_gravity());
  BodyId wheels[2];
  JointId hinges[2];
  for (int i = 0; i < 2; ++i) {
    wheels[i] = add(world, body_at(at(3.0 * i, 0, 0)), with(cylinder(0.1, 1)));
    Joint hinge;
    hinge.body_a = wheels[i];
    hinge.kind = HingeJoint{};
    hinge.frame_a.orientation = hinge.frame_b.orientation = turn(kPi / 2, Vector3d::UnitZ());
    hinge.frame_b.position = vec(3.0 * i, 0, 0);
    hinges[i] = must(world.create_joint(hinge));
  }
  Joint gear;
  gear.kind = GearJoint{hinges[0], hinges[1], real(1)};
  must(world.create_joint(gear));
  must(world.apply_angular_impulse(wheels[0], vec(0, 100, 0)));
  run(world, 0.2);
  const double turning = spin(world, wheels[0]).y();
  ASSERT_GT(turning, 0.01);
  EXPECT_NEAR(spin(world, wheels[1]).y(), -turning, 1e-3 * turning);
  for (const BodyId wheel : wheels) must(world.set_motion_type(wheel, MotionType::Kinematic));
  for (const BodyId wheel : wheels) must(world.set_angular_velocity(wheel, Vec3::Zero()));
  run(world, 0.2);
  for (const BodyId wheel : wheels) must(world.set_motion_type(wheel, MotionType::Dynamic));
  run(world, 0.2);
  for (const BodyId wheel : wheels) EXPECT_LT(spin(world, wheel).norm(), bar(1e-9, 1e-6));
  must(world.apply_angular_impulse(wheels[1], vec(0, 100, 0)));
  run(world, 0.2);
  EXPECT_GT(spin(world, wheels[1]).y(), 0.01);
  EXPECT_NEAR(spin(world, wheels[0]).y(), -spin(world, wheels[1]).y(), 1e-3 * turning);
}

TEST(MotionType, WhatTheCollidersCannotBeIsRefused) {
  PhysicsWorld world;
  const BodyId floor = add_floor(world);
  const std::vector<Vec3> corners = {vec(-1, 0, -1), vec(1, 0, -1), vec(0, 0, 1)};
  const std::vector<std::uint32_t> triangle = {0, 2, 1};
  const auto mesh = TriangleMeshGeometry::create(corners, triangle);
  must(mesh.status);
  SurfaceMesh surface;
  surface.geometry = mesh.mesh;
  const BodyId ground = add(world, body_at(Pose{}, MotionType::Static), with(surface));
  const BodyId dust = add(world, body_at(at(0, 9, 0), MotionType::Static),
                          with(sphere(1), {}, std::numeric_limits<double>::max()));
  const Snapshot before = world.save();
  EXPECT_EQ(world.set_motion_type(floor, MotionType::Dynamic).code, StatusCode::BadShape);
  EXPECT_EQ(world.set_motion_type(floor, MotionType::Kinematic).code, StatusCode::BadShape);
  EXPECT_EQ(world.set_motion_type(ground, MotionType::Dynamic).code, StatusCode::BadShape);
  EXPECT_FALSE(world.set_motion_type(dust, MotionType::Dynamic).ok());  // a mass beyond the numbers
  must(world.set_motion_type(floor, MotionType::Static));               // as it is: nothing happens
  EXPECT_TRUE(world.save() == before);
  must(world.set_motion_type(ground, MotionType::Kinematic));
  EXPECT_EQ(world.state(ground).type, MotionType::Kinematic);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
