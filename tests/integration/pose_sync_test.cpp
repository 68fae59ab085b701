// Invariant: an engine's transforms follow the bodies, between the last two steps, and only those
// of bodies that moved are touched.
#include "plumb/integration/pose_sync.h"

#include <limits>
#include <map>
#include <vector>

#include "gtest/gtest.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using integration::FixedStepLoop;
using integration::PoseSync;
using integration::SyncedPose;

class PoseSyncTest : public testing::Test {
 protected:
  PoseSyncTest() : loop_(world_, {.dt = 1.0 / 64}), sync_(loop_) {}

  BodyId add(std::uint64_t entity, MotionType type, const Pos3& at,
             const Vec3& velocity = Vec3::Zero()) {
    RigidBody body;
    body.type = type;
    body.pose.position = at;
    body.linear_velocity = velocity;
    body.gravity_scale = 0;
    body.user_data = entity;
    const auto created = world_.create_body(body);
    EXPECT_TRUE(created.ok()) << created.status.message;
    EXPECT_TRUE(world_.create_collider(created.id, Collider{}).ok());
    return created.id;
  }
  // What the engine would see in this frame.
  std::map<std::uint64_t, Pose> frame() {
    std::map<std::uint64_t, Pose> out;
    const std::size_t written =
        sync_.write(world_, loop_.alpha(), [&](const SyncedPose& p) { out[p.entity] = p.pose; });
    EXPECT_EQ(written, out.size());
    return out;
  }

  PhysicsWorld world_;
  FixedStepLoop loop_;
  PoseSync sync_;
};

TEST_F(PoseSyncTest, TouchesOnlyWhatMoved) {
  constexpr std::uint64_t kMovers = 3, kStill = 100;
  for (std::uint64_t k = 0; k < kStill; ++k)
    add(1000 + k, MotionType::Static, Pos3(static_cast<PosReal>(2 * k), -50, 0));
  for (std::uint64_t k = 0; k < kMovers; ++k)
    add(k, MotionType::Dynamic, Pos3(static_cast<PosReal>(4 * k), 0, 0), Vec3(0, 1, 0));
  for (int k = 0; k < 10; ++k) {
    loop_.tick(1.0 / 64);
    EXPECT_EQ(frame().size(), kMovers);
  }
}

TEST_F(PoseSyncTest, InterpolatesBetweenTheLastTwoSteps) {
  const BodyId body = add(7, MotionType::Dynamic, Pos3(0, 0, 0), Vec3(64, 0, 0));
  sync_.place(world_, body);
  EXPECT_EQ(frame().at(7).position, Pos3(0, 0, 0));  // placed: written once, where it stands
  EXPECT_EQ(frame().size(), 0u);

  // One step of 1 m and half of the next: half-way between the poses before and after the step.
  loop_.tick(1.5 / 64);
  EXPECT_EQ(frame().at(7).position, Pos3(PosReal(0.5), 0, 0));
  // Three quarters on: still the same two steps.
  loop_.tick(0.25 / 64);
  EXPECT_EQ(frame().at(7).position, Pos3(PosReal(0.75), 0, 0));
  loop_.tick(1.0 / 64);
  EXPECT_EQ(frame().at(7).position, Pos3(PosReal(1.75), 0, 0));
}

TEST_F(PoseSyncTest, TurnsAlongTheShorterArcAtEvenSpeed) {
  Pose from, to;
  to.orientation = Quat(Eigen::AngleAxis<Real>(Real(1.2), Vec3::UnitY()));
  Pose negated = to;
  negated.orientation.coeffs() = -negated.orientation.coeffs();  // the same rotation
  const Quat expected(Eigen::AngleAxis<Real>(Real(0.3), Vec3::UnitY()));
  // A few roundings of the number type.
  const Real rounding = 8 * std::numeric_limits<Real>::epsilon();
  for (const Pose& target : {to, negated}) {
    const Pose between = integration::interpolated(from, target, 0.25);
    EXPECT_LT(between.orientation.angularDistance(expected), 4 * rounding);
    EXPECT_NEAR(between.orientation.norm(), 1, rounding);
  }
}

// A body that comes to rest gets its last pose once, and is then left alone.
TEST_F(PoseSyncTest, WritesTheLastPoseOnceMore) {
  const BodyId body = add(7, MotionType::Kinematic, Pos3(0, 0, 0), Vec3(64, 0, 0));
  loop_.tick(2.5 / 64);
  EXPECT_EQ(frame().size(), 1u);
  ASSERT_TRUE(world_.set_linear_velocity(body, Vec3::Zero()).ok());
  loop_.tick(1.0 / 64);
  loop_.tick(1.0 / 64);
  std::map<std::uint64_t, Pose> seen = frame();
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen.at(7).position, world_.pose(body).position);
  loop_.tick(1.0 / 64);
  EXPECT_EQ(frame().size(), 0u);
}

TEST_F(PoseSyncTest, ATeleportIsNotSmeared) {
  const BodyId body = add(7, MotionType::Dynamic, Pos3(0, 0, 0), Vec3(1, 0, 0));
  loop_.tick(1.0 / 64);
  ASSERT_TRUE(world_.set_pose(body, {Pos3(100, 0, 0), Quat::Identity()}).ok());
  sync_.place(world_, body);
  EXPECT_EQ(frame().at(7).position, Pos3(100, 0, 0));
  loop_.tick(0.5 / 64);
  loop_.tick(1.0 / 64);
  EXPECT_GE(frame().at(7).position.x(), 100);
}

// A handle's place that is taken over by a new body does not carry the old one's pose along.
TEST_F(PoseSyncTest, ANewBodyInAnOldPlaceStartsAfresh) {
  const BodyId old = add(7, MotionType::Dynamic, Pos3(0, 0, 0), Vec3(64, 0, 0));
  loop_.tick(1.5 / 64);
  ASSERT_TRUE(world_.destroy_body(old).ok());
  EXPECT_EQ(frame().size(), 0u);
  const BodyId fresh = add(8, MotionType::Dynamic, Pos3(500, 0, 0), Vec3(64, 0, 0));
  sync_.place(world_, fresh);
  loop_.tick(1.0 / 64);
  const auto seen = frame();
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen.at(8).position, Pos3(PosReal(500.5), 0, 0));
}

}  // namespace
