// Invariant: the recording shows each joint as lines between the places that it holds, from its
// making to its end, and each label beside what it belongs to.
#include <map>

#include "drawn_rows.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using replay_test::kDt;
using replay_test::rows_of;
using replay_test::TemporaryFolder;

// A ball on a rod from (1, 5, 2): made before step 3, ended before step 7.
TEST(DrawnJoints, ReachFromPlaceToPlaceWhileTheyLast) {
  const TemporaryFolder folder;
  const std::string path = folder.file("rod.rrd");
  const Eigen::Vector3d hook(1, 5, 2);
  std::map<std::uint64_t, Eigen::Vector3d> ball_at;
  {
    PhysicsWorld world;
    const BodyId ball = add(world, body_at(at(1, 3, 2)), with(sphere(0.25)));
    replay::Recorder recorder;
    ASSERT_TRUE(recorder.open({.path = path}).ok());
    world.attach(&recorder);
    JointId rod;
    for (int step = 1; step <= 10; ++step) {
      if (step == 3) {
        Joint joint;
        joint.body_b = ball;
        joint.frame_a.position = vec(hook);
        joint.kind = DistanceJoint{2};
        rod = must(world.create_joint(joint));
      }
      if (step == 7) must(world.destroy_joint(rod));
      ASSERT_TRUE(world.step(kDt).status.ok());
      ball_at[world.step_count()] = world.pose(ball).position.template cast<double>();
    }
    world.detach(&recorder);
    const auto closed = recorder.close();
    ASSERT_TRUE(closed.ok()) << closed.error;
  }
  const auto centers = rows_of<float>(path, "world/joints/lines", "Boxes3D:centers");
  const auto sizes = rows_of<float>(path, "world/joints/lines", "Boxes3D:half_sizes");
  ASSERT_EQ(centers.size(), 8u);  // from step 3 on
  for (const auto& [step, numbers] : centers) {
    ASSERT_EQ(sizes.at(step).size(), numbers.size());
    if (step >= 7) {
      EXPECT_TRUE(numbers.empty()) << step;
      continue;
    }
    // From the ball's middle to where it is held, which is the same place, and from there to the
    // hook.
    ASSERT_EQ(numbers.size(), 6u) << step;
    EXPECT_EQ(sizes.at(step)[1], 0);
    const Eigen::Vector3d middle = (hook + ball_at.at(step)) / 2;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(numbers[3 + i], middle[static_cast<Eigen::Index>(i)], 1e-6) << step;
    EXPECT_NEAR(sizes.at(step)[4], (hook - ball_at.at(step)).norm() / 2, 1e-6);
  }
}

// A ball of 0.25 m becomes one of 0.5 m before step 3, and moves aside on its body before step 5.
TEST(DrawnShapes, FollowChangesOfTheirColliders) {
  const TemporaryFolder folder;
  const std::string path = folder.file("changes.rrd");
  {
    PhysicsWorld world(no_gravity());
    const BodyId ball = add(world, body_at(at(1, 3, 2)), with(sphere(0.25)));
    const ColliderId collider = world.colliders_of(ball)[0];
    replay::Recorder recorder;
    ASSERT_TRUE(recorder.open({.path = path}).ok());
    world.attach(&recorder);
    for (int step = 1; step <= 6; ++step) {
      if (step == 3) must(world.set_shape(collider, sphere(0.5)));
      if (step == 5) must(world.set_local_pose(collider, {vec(0, 1, 0), Quat::Identity()}));
      ASSERT_TRUE(world.step(kDt).status.ok());
    }
    world.detach(&recorder);
    const auto closed = recorder.close();
    ASSERT_TRUE(closed.ok()) << closed.error;
  }
  const auto sizes = rows_of<float>(path, "world/moving/spheres", "Ellipsoids3D:half_sizes");
  const auto centers = rows_of<float>(path, "world/moving/spheres", "Ellipsoids3D:centers");
  ASSERT_TRUE(sizes.contains(0) && sizes.contains(3));
  EXPECT_EQ(sizes.at(0)[0], 0.25f);
  EXPECT_EQ(sizes.at(3)[0], 0.5f);
  ASSERT_TRUE(centers.contains(4) && centers.contains(6));
  EXPECT_EQ(centers.at(4)[1], 3.0f);
  EXPECT_EQ(centers.at(6)[1], 4.0f);
}

TEST(DrawnLabels, StandBesideTheirBodies) {
  const TemporaryFolder folder;
  const std::string path = folder.file("labels.rrd");
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  {
    PhysicsWorld world;
    const BodyId ball = add(world, body_at(at(1, 3, 2)), with(sphere(0.25)));
    const BodyId other = add(world, body_at(at(4, 3, 2)), with(sphere(0.25)));
    replay::Recorder recorder;
    ASSERT_TRUE(recorder.open({.path = path}).ok());
    recorder.label(ball, "ball");
    recorder.label(other, "other");
    world.attach(&recorder);
    for (int step = 1; step <= 5; ++step) {
      if (step == 3) must(world.destroy_body(other));
      ASSERT_TRUE(world.step(kDt).status.ok());
    }
    last = world.pose(ball).position.template cast<double>();
    world.detach(&recorder);
    const auto closed = recorder.close();
    ASSERT_TRUE(closed.ok()) << closed.error;
  }
  const auto places = rows_of<float>(path, "labels/0", "Points3D:positions");
  ASSERT_EQ(places.size(), 6u);
  EXPECT_EQ(places.at(2).size(), 6u);
  ASSERT_EQ(places.at(5).size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(places.at(5)[i], last[static_cast<Eigen::Index>(i)], 1e-6);
  std::map<std::uint64_t, std::vector<std::string>> texts;
  const auto read = rrd::read(path, "labels/0", [&](const rrd::Cell& cell) {
    if (cell.component() != "Points3D:labels") return true;
    std::vector<std::string>& row = texts[cell.frame().value_or(0)];
    for (std::size_t i = 0; i < cell.instances(); ++i) row.emplace_back(cell.text(i));
    return true;
  });
  EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_EQ(texts.at(0), (std::vector<std::string>{"ball", "other"}));
  EXPECT_EQ(texts.at(3), (std::vector<std::string>{"ball"}));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
