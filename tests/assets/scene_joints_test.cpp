// Invariant: a joint of a scene becomes the joint it describes: its kind with every number, its
// frames where the scene places them, its bodies and coupled joints by their names; and it is the
// same joint after writing and reading.
#include <cmath>
#include <numbers>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"
#include "support/measure.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using assets::instantiate;
using assets::parse_scene;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
// Frames are computed in double and rounded once; a few roundings of numbers of some metres.
constexpr double kRounding = 16 * static_cast<double>(std::numeric_limits<Real>::epsilon());

struct Built {
  PhysicsWorld world;
  assets::SceneInstance instance;

  explicit Built(const std::string& bodies, const std::string& joints) {
    const auto scene = parse_scene(
        R"({"plumb_scene": 1, "bodies": [)" + bodies + R"(], "joints": [)" + joints + "]}",
        "test.json");
    EXPECT_TRUE(scene.ok()) << scene.error();
    if (!scene.ok()) return;
    auto made = instantiate(*scene, world);
    EXPECT_TRUE(made.ok()) << made.error();
    if (made.ok()) instance = std::move(made).value();
  }
  [[nodiscard]] Joint joint(const char* name) const {
    EXPECT_TRUE(world.is_valid(instance.find_joint(name))) << name;
    return world.joint(instance.find_joint(name));
  }
  template <class Kind>
  [[nodiscard]] Kind kind(const char* name) const {
    const Joint found = joint(name);
    EXPECT_TRUE(std::holds_alternative<Kind>(found.kind)) << name;
    const Kind* kind = std::get_if<Kind>(&found.kind);
    return kind ? *kind : Kind{};
  }
};

const char* const kBodies = R"(
  {"name": "a", "position": [1, 2, 3], "orientation": {"axis_angle": [0, 0, 1, 90]},
   "colliders": [{"shape": "sphere", "radius": 0.5}]},
  {"name": "b", "position": [4, 5, 6], "orientation": {"axis_angle": [1, 1, 0, 50]},
   "colliders": [{"shape": "box", "half_extents": [0.5, 0.25, 0.125]}]},
  {"name": "link", "position": [0, 9, 0], "repeat": {"count": [3, 1, 1], "spacing": [2, 0, 0]},
   "colliders": [{"shape": "sphere", "radius": 0.25}]})";

// Every kind with every key that it has.
const char* const kJoints = R"(
  {"name": "ball", "kind": "ball", "body_a": "a", "body_b": "b", "anchor": [1, 3, 5],
   "friction": 0.5, "collide_connected": true, "break_force": 100, "break_torque": 200,
   "softness": {"frequency": 3, "damping_ratio": 0.25}},
  {"name": "hinge", "kind": "hinge", "body_b": "a", "anchor": [0, 0, 0], "axis": [0, 3, 0],
   "limit": {"range": [-1.5, null], "restitution": 0.5, "softness": {"frequency": 2}},
   "motor": {"mode": "position", "target": 0.75, "max_effort": 40,
             "softness": {"frequency": 8, "damping_ratio": 0.5}},
   "spring": {"rest": 0.25, "stiffness": 7, "damping": 0.125}, "friction": 2},
  {"name": "slider", "kind": "slider", "body_a": "world", "body_b": "b",
   "frame_a": {"position": [4, 5, 6], "axis": [0, 0, 1]},
   "frame_b": {"position": [0.5, 0, 0], "orientation": {"quaternion": [0, 0, 0, 1]}},
   "limit": {"range": [-2, 3]}, "motor": {"target": -1}},
  {"name": "fixed", "kind": "fixed", "body_a": "a", "body_b": "link[1]", "anchor": [2, 2, 2]},
  {"name": "rod", "kind": "distance", "body_a": "a", "body_b": "link[2]", "anchor": [0, 0, 0],
   "length": 1.25},
  {"name": "rope", "kind": "rope", "body_b": "link[0]", "anchor_a": [0, 0, 0],
   "anchor_b": [0, 9, 0], "max_length": 10},
  {"name": "spring", "kind": "spring", "body_a": "b", "body_b": "link[0]", "anchor": [0, 0, 0],
   "rest_length": 0.5, "stiffness": 300, "damping": 4, "pulls_only": true},
  {"name": "shoulder", "kind": "cone_twist", "body_a": "link[0]", "body_b": "link[1]",
   "anchor": [1, 9, 0], "cone": 0.5, "twist": [-0.25, 0.75], "friction": 3,
   "limit_softness": {"frequency": 6, "damping_ratio": 0.5}},
  {"name": "six", "kind": "six_dof", "body_a": "link[1]", "body_b": "link[2]",
   "anchor": [3, 9, 0],
   "coordinates": {"y": {"limit": {"range": [-0.5, 0.5]}}, "twist": {"friction": 2},
                   "swing_z": {"motor": {"target": 1, "max_effort": 5}}}},
  {"name": "second hinge", "kind": "hinge", "body_b": "b", "anchor": [4, 5, 6]},
  {"name": "gear", "kind": "gear", "first": "hinge", "second": "second hinge", "ratio": -2.5},
  {"name": "rack", "kind": "rack_pinion", "pinion": "hinge", "rack": "slider", "radius": 0.5},
  {"name": "pulley", "kind": "pulley", "body_a": "link[0]", "body_b": "link[2]",
   "anchor_a": [0, 9, 0], "anchor_b": [4, 9, 0], "over_a": [0, 12, 0], "over_b": [4, 13, 0],
   "ratio": 2, "length": 12, "stiff": true},
  {"name": "motor", "kind": "motor", "body_b": "link[1]", "anchor": [2, 9, 0],
   "mode": "position", "linear": [1, 2, 3], "angular": [0.25, 0.5, 0.75], "max_force": 50,
   "max_torque": 60, "softness": {"frequency": 2, "damping_ratio": 0.75}})";

TEST(SceneJoints, CarryEveryNumberOfEveryKind) {
  const Built built(kBodies, kJoints);
  ASSERT_EQ(built.instance.joints.size(), 14u);
  ASSERT_EQ(built.world.joint_count(), 14u);

  const Joint ball = built.joint("ball");
  EXPECT_EQ(built.kind<BallJoint>("ball").friction, Real(0.5));
  EXPECT_EQ(ball.body_a, built.instance.find("a"));
  EXPECT_EQ(ball.body_b, built.instance.find("b"));
  EXPECT_TRUE(ball.collide_connected);
  EXPECT_EQ(ball.break_force, Real(100));
  EXPECT_EQ(ball.break_torque, Real(200));
  EXPECT_EQ(ball.softness.frequency, Real(3));
  EXPECT_EQ(ball.softness.damping_ratio, Real(0.25));

  const JointAxis hinge = built.kind<HingeJoint>("hinge").axis;
  ASSERT_TRUE(hinge.limit && hinge.motor && hinge.spring);
  EXPECT_EQ(hinge.limit->lower, Real(-1.5));
  EXPECT_EQ(hinge.limit->upper, kUnlimited);
  EXPECT_EQ(hinge.limit->restitution, Real(0.5));
  EXPECT_EQ(hinge.limit->softness.frequency, Real(2));
  EXPECT_EQ(hinge.limit->softness.damping_ratio, Real(1));
  EXPECT_EQ(hinge.motor->mode, JointMotor::Mode::Position);
  EXPECT_EQ(hinge.motor->target, Real(0.75));
  EXPECT_EQ(hinge.motor->max_effort, Real(40));
  EXPECT_EQ(hinge.motor->softness.frequency, Real(8));
  EXPECT_EQ(hinge.motor->softness.damping_ratio, Real(0.5));
  EXPECT_EQ(hinge.spring->rest, Real(0.25));
  EXPECT_EQ(hinge.spring->stiffness, Real(7));
  EXPECT_EQ(hinge.spring->damping, Real(0.125));
  EXPECT_EQ(hinge.friction, Real(2));
  EXPECT_TRUE(built.joint("hinge").body_a.is_null());
  EXPECT_FALSE(built.joint("hinge").collide_connected);
  EXPECT_EQ(built.joint("hinge").break_force, kUnlimited);

  const JointAxis slider = built.kind<SliderJoint>("slider").axis;
  ASSERT_TRUE(slider.limit && slider.motor && !slider.spring);
  EXPECT_EQ(slider.limit->lower, Real(-2));
  EXPECT_EQ(slider.limit->upper, Real(3));
  EXPECT_EQ(slider.motor->mode, JointMotor::Mode::Velocity);
  EXPECT_EQ(slider.motor->target, Real(-1));
  EXPECT_EQ(slider.motor->max_effort, kUnlimited);
  EXPECT_EQ(slider.motor->softness.frequency, JointMotor{}.softness.frequency);

  EXPECT_EQ(built.joint("fixed").body_b, built.instance.find("link[1]"));
  (void)built.kind<FixedJoint>("fixed");
  EXPECT_EQ(built.kind<DistanceJoint>("rod").length, Real(1.25));
  EXPECT_EQ(built.kind<RopeJoint>("rope").max_length, Real(10));
  const auto spring = built.kind<SpringJoint>("spring");
  EXPECT_EQ(spring.rest_length, Real(0.5));
  EXPECT_EQ(spring.stiffness, Real(300));
  EXPECT_EQ(spring.damping, Real(4));
  EXPECT_TRUE(spring.pulls_only);
  const auto shoulder = built.kind<ConeTwistJoint>("shoulder");
  EXPECT_EQ(shoulder.cone, Real(0.5));
  EXPECT_EQ(shoulder.twist_lower, Real(-0.25));
  EXPECT_EQ(shoulder.twist_upper, Real(0.75));
  EXPECT_EQ(shoulder.friction, Real(3));
  EXPECT_EQ(shoulder.softness.frequency, Real(6));
  EXPECT_EQ(shoulder.softness.damping_ratio, Real(0.5));

  const auto six = built.kind<SixDofJoint>("six").coordinates;
  using Freedom = SixDofJoint::Freedom;
  const Freedom expected[] = {Freedom::Locked, Freedom::Limited, Freedom::Locked,
                              Freedom::Free,   Freedom::Locked,  Freedom::Free};
  for (std::size_t k = 0; k < six.size(); ++k) EXPECT_EQ(six[k].freedom, expected[k]) << k;
  EXPECT_EQ(six[1].axis.limit->lower, Real(-0.5));
  EXPECT_EQ(six[3].axis.friction, Real(2));
  EXPECT_EQ(six[5].axis.motor->max_effort, Real(5));

  const auto gear = built.kind<GearJoint>("gear");
  EXPECT_EQ(gear.first, built.instance.find_joint("hinge"));
  EXPECT_EQ(gear.second, built.instance.find_joint("second hinge"));
  EXPECT_EQ(gear.ratio, Real(-2.5));
  const auto rack = built.kind<RackPinionJoint>("rack");
  EXPECT_EQ(rack.pinion, built.instance.find_joint("hinge"));
  EXPECT_EQ(rack.rack, built.instance.find_joint("slider"));
  EXPECT_EQ(rack.radius, Real(0.5));
  const auto pulley = built.kind<PulleyJoint>("pulley");
  EXPECT_EQ(pulley.over_a, Pos3(0, 12, 0));
  EXPECT_EQ(pulley.over_b, Pos3(4, 13, 0));
  EXPECT_EQ(pulley.ratio, Real(2));
  EXPECT_EQ(pulley.length, Real(12));
  EXPECT_TRUE(pulley.stiff);
  const auto motor = built.kind<MotorJoint>("motor");
  EXPECT_EQ(motor.mode, JointMotor::Mode::Position);
  EXPECT_EQ(motor.linear, Vec3(1, 2, 3));
  EXPECT_EQ(motor.angular, Vec3(Real(0.25), Real(0.5), Real(0.75)));
  EXPECT_EQ(motor.max_force, Real(50));
  EXPECT_EQ(motor.max_torque, Real(60));
  EXPECT_EQ(motor.softness.frequency, Real(2));
  EXPECT_EQ(motor.softness.damping_ratio, Real(0.75));
}

// Both frames of a joint with an anchor stand there in the world, their x axes along its axis, in
// bodies that are turned and moved; frames given in a body are taken as they are.
TEST(SceneJoints, StandWhereTheyArePlaced) {
  const Built built(kBodies, kJoints);
  const auto in_world = [&](BodyId body, const LocalPose& frame) {
    const Pose pose = built.world.pose(body);
    const Quaterniond R_WB(pose.orientation.cast<double>());
    return std::pair(Vector3d(pose.position.cast<double>() + R_WB * frame.position.cast<double>()),
                     Quaterniond(R_WB * frame.orientation.cast<double>()));
  };
  const struct {
    const char* name;
    Vector3d place, axis;
  } placed[] = {{"ball", {1, 3, 5}, Vector3d::UnitX()},
                {"hinge", {0, 0, 0}, Vector3d::UnitY()},
                {"fixed", {2, 2, 2}, Vector3d::UnitX()},
                {"shoulder", {1, 9, 0}, Vector3d::UnitX()}};
  for (const auto& expected : placed) {
    const Joint joint = built.joint(expected.name);
    const auto [p_a, R_a] = in_world(joint.body_a, joint.frame_a);
    const auto [p_b, R_b] = in_world(joint.body_b, joint.frame_b);
    const double near = 10 * kRounding;  // places up to 10 m from the origin
    EXPECT_LT((p_a - expected.place).norm(), near) << expected.name;
    EXPECT_LT((p_b - expected.place).norm(), near) << expected.name;
    EXPECT_LT((R_a * Vector3d::UnitX() - expected.axis).norm(), kRounding) << expected.name;
    EXPECT_LT((R_b * Vector3d::UnitX() - expected.axis).norm(), kRounding) << expected.name;
    EXPECT_LT(R_a.angularDistance(R_b), std::sqrt(kRounding)) << expected.name;
  }
  const Joint slider = built.joint("slider");
  EXPECT_EQ(slider.frame_a.position, Vec3(4, 5, 6));
  EXPECT_EQ(slider.frame_b.position, Vec3(Real(0.5), 0, 0));
  EXPECT_LT((slider.frame_a.orientation * Vec3::UnitX() - Vec3::UnitZ()).norm(), kRounding);
  EXPECT_EQ(slider.frame_b.orientation.coeffs(), Quat::Identity().coeffs());
}

// A length that is not given is the distance at which the scene begins.
TEST(SceneJoints, TakeLengthsAsPlaced) {
  const Built built(R"({"name": "bob", "position": [3, 4, 0],
                        "colliders": [{"shape": "sphere", "radius": 0.5}]})",
                    R"({"name": "rod", "kind": "distance", "body_b": "bob",
                        "anchor_a": [0, 0, 0], "anchor_b": [3, 4, 0]},
                       {"name": "rope", "kind": "rope", "body_a": "bob",
                        "anchor_b": [0, 0, 0], "frame_a": {"position": [0, 0, 1]}},
                       {"name": "spring", "kind": "spring", "body_b": "bob", "stiffness": 1,
                        "anchor_a": [3, 1, 0], "anchor_b": [3, 4, 0]})");
  EXPECT_NEAR(built.kind<DistanceJoint>("rod").length, 5, 5 * kRounding);
  EXPECT_NEAR(built.kind<RopeJoint>("rope").max_length, std::sqrt(26), 6 * kRounding);
  EXPECT_NEAR(built.kind<SpringJoint>("spring").rest_length, 3, 3 * kRounding);
}

TEST(SceneJoints, TakeAnglesInDegreesWhereTheKeySaysSo) {
  const Built built(kBodies, R"(
    {"name": "hinge", "kind": "hinge", "body_b": "a", "anchor": [0, 0, 0],
     "limit": {"range_degrees": [-90, 45]}, "motor": {"target_degrees": 180},
     "spring": {"rest_degrees": 30, "stiffness": 1}},
    {"name": "shoulder", "kind": "cone_twist", "body_b": "b", "anchor": [0, 0, 0],
     "cone_degrees": 60, "twist_degrees": [-180, 180]},
    {"name": "six", "kind": "six_dof", "body_b": "b", "anchor": [0, 0, 0],
     "coordinates": {"swing_y": {"limit": {"range_degrees": [-20, 20]}}}},
    {"name": "motor", "kind": "motor", "body_b": "b", "anchor": [0, 0, 0],
     "angular_degrees": [90, 0, -45]})");
  const JointAxis hinge = built.kind<HingeJoint>("hinge").axis;
  EXPECT_NEAR(hinge.limit->lower, -kPi / 2, kRounding);
  EXPECT_NEAR(hinge.limit->upper, kPi / 4, kRounding);
  EXPECT_NEAR(hinge.motor->target, kPi, kRounding);
  EXPECT_NEAR(hinge.spring->rest, kPi / 6, kRounding);
  const auto shoulder = built.kind<ConeTwistJoint>("shoulder");
  EXPECT_NEAR(shoulder.cone, kPi / 3, kRounding);
  EXPECT_NEAR(shoulder.twist_lower, -kPi, kRounding);
  EXPECT_NEAR(shoulder.twist_upper, kPi, kRounding);
  EXPECT_NEAR(built.kind<SixDofJoint>("six").coordinates[4].axis.limit->upper, kPi / 9, kRounding);
  const Vec3 angular = built.kind<MotorJoint>("motor").angular;
  EXPECT_NEAR(angular.x(), kPi / 2, kRounding);
  EXPECT_NEAR(angular.z(), -kPi / 4, kRounding);
}

// Written and read again, the scene is the same text and its world has the same bits.
TEST(SceneJoints, SurviveWriting) {
  const auto scene = parse_scene(R"({"plumb_scene": 1, "bodies": [)" + std::string(kBodies) +
                                     R"(], "joints": [)" + kJoints + "]}",
                                 "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  const std::string once = assets::scene_to_json(*scene);
  const auto again = parse_scene(once, "written.json");
  ASSERT_TRUE(again.ok()) << again.error();
  EXPECT_EQ(assets::scene_to_json(*again), once);
  PhysicsWorld first, second;
  ASSERT_TRUE(instantiate(*scene, first).ok());
  ASSERT_TRUE(instantiate(*again, second).ok());
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(first.state_hash(), second.state_hash()) << "step " << k;
    ASSERT_TRUE(first.step(1.0 / 60).status.ok());
    ASSERT_TRUE(second.step(1.0 / 60).status.ok());
  }
}

// What only the world can refuse still names the line, and leaves the world as it was.
TEST(SceneJoints, RefusedByTheWorldNameTheirLine) {
  const auto scene = parse_scene(R"({"plumb_scene": 1,
    "bodies": [{"name": "wall", "type": "static"}, {"name": "free"}], "joints": [
    {"kind": "ball", "body_b": "free", "anchor": [0, 0, 0]},
    {"name": "stuck", "kind": "ball", "body_b": "wall", "anchor": [0, 0, 0]}]})",
                                 "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_FALSE(instance.ok());
  EXPECT_EQ(instance.error().rfind("test.json:4: joint 'stuck': ", 0), 0u) << instance.error();
  EXPECT_EQ(world.body_count(), 0u);
  EXPECT_EQ(world.joint_count(), 0u);
}

}  // namespace
