// Proves that a joint made between frames that disagree, by metres and by up to half a turn, draws
// its bodies together without giving them speed, whatever limits it has, and is closed in the time
// that its push allows.
#include <random>

#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;

constexpr double kRadius = 0.5;  // [m] of the bodies
constexpr double kApart = 2;     // [m] at most, between origins
constexpr double kMostTime = 4;  // [s]; half a turn at 8 rad/s, ten times

std::vector<JointKind> limited_kinds() {
  JointAxis angle, path;
  angle.limit = JointLimit{real(-0.4), real(0.7)};
  path.limit = JointLimit{real(-0.2), real(0.3)};
  SixDofJoint six;
  using Freedom = SixDofJoint::Freedom;
  for (const std::size_t i : {0, 3, 4, 5})
    six.coordinates[i] = {Freedom::Limited, {.limit = JointLimit{real(-0.2), real(0.3)}}};
  SixDofJoint hinge_about_z;
  hinge_about_z.coordinates[5] = {Freedom::Limited, angle};
  SixDofJoint swings_about_z;
  swings_about_z.coordinates[3].freedom = Freedom::Free;
  swings_about_z.coordinates[5] = {Freedom::Limited, angle};
  return {BallJoint{},
          HingeJoint{angle},
          SliderJoint{path},
          FixedJoint{},
          ConeTwistJoint{real(0.5), real(-0.6), real(0.4)},
          six,
          hinge_about_z,
          swings_about_z};
}

Quat any_turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return Quat(q.normalized().cast<Real>());
}
Vector3d any_point(std::mt19937& random, double most) {
  std::uniform_real_distribution<double> within(-most, most);
  return {within(random), within(random), within(random)};
}

void expect_gentle(const Joint& joint, PhysicsWorld& world, const std::string& label) {
  const JointId id = must(world.create_joint(joint));
  double fastest = 0;
  run(world, kMostTime, 1.0 / 60, [&] { fastest = std::max(fastest, max_speed(world)); });
  const JointState state = world.joint_state(id);
  EXPECT_LE(fastest, 0.05) << label;  // [m/s], of pushes of 4 m/s
  EXPECT_LE(static_cast<double>(state.linear_error), 1e-3) << label;
  EXPECT_LE(static_cast<double>(state.angular_error), 1e-3) << label;
  EXPECT_EQ(world.last_report().quarantined, 0u) << label;
}

TEST(JointMismatch, DrawsTogetherWithoutSpeed) {
  std::mt19937 random(1);
  const std::vector<JointKind> kinds = limited_kinds();
  for (int i = 0; i < 20; ++i) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      PhysicsWorld world(no_gravity());
      const double I = 0.4 * kRadius * kRadius;
      Joint joint;
      if (i % 2 == 0)
        joint.body_a = add_body(world, Vector3d::Zero(), 3, Vector3d(3 * I, 2 * I, 3 * I));
      joint.body_b = add_body(world, any_point(random, 0.5 * kApart), 1, Vector3d(I, I, 0.5 * I),
                              any_turn(random));
      joint.frame_a = {vec(any_point(random, 0.5 * kRadius)), any_turn(random)};
      joint.frame_b = {vec(any_point(random, 0.5 * kRadius)), any_turn(random)};
      joint.kind = kinds[k];
      expect_gentle(joint, world, std::to_string(i) + " kind " + std::to_string(k));
    }
  }
}

// The frames of one body are given the wrong way round: the axes must not be taken for aligned.
TEST(JointMismatch, TurnsAHingeThatWasMadeBackToFront) {
  for (const double angle : {kPi, kPi - 1e-4, 3.0, 2.0}) {
    PhysicsWorld world(no_gravity());
    Joint joint;
    joint.body_b = add_body(world, {0, 0, 0}, 1, {0.1, 0.2, 0.3}, turn(angle, {0, 1, 2}));
    joint.kind = HingeJoint{};
    const JointId id = must(world.create_joint(joint));
    run(world, kMostTime);
    const Vector3d x = wide(world.pose(joint.body_b).orientation) * Vector3d::UnitX();
    EXPECT_LE(std::acos(std::min(1.0, x.x())), 1e-3) << angle;
    EXPECT_LE(static_cast<double>(world.joint_state(id).angular_error), 1e-3) << angle;
    EXPECT_LE(max_speed(world), 1e-3) << angle;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
