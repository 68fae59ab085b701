// Proves how joints come and go: bad input is refused and changes nothing, a body takes its joints
// with it, joined bodies collide only when told, sleep and wake together, and every world with
// joints steps on bit for bit after a snapshot, in a replay, and on any number of threads.
#include <limits>

#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;
constexpr double kDt = 1.0 / 60;
const Real kNaN = std::numeric_limits<Real>::quiet_NaN();

// A chain of links hung from the world, a gear train and a servo: some of everything.
void build_mixture(PhysicsWorld& world) {
  add_floor(world, material(0.5), Vector3d::UnitY(), -4);
  BodyId last;
  for (int i = 0; i < 12; ++i) {
    const Vector3d p(0.5 * (i + 0.5), 0, 0.02 * i);
    const BodyId link = add(world, body_at(at(p, Quat::Identity())), with(capsule(0.15, 0.05)));
    const JointKind kind =
        i % 3 == 0 ? JointKind(HingeJoint{{.friction = real(0.01)}})
                   : (i % 3 == 1 ? JointKind(BallJoint{})
                                 : JointKind(ConeTwistJoint{real(0.6), real(-0.4), real(0.4)}));
    must(world.create_joint(
        joint_at(world, last, link, kind, {0.5 * i, 0, 0.02 * i}, Vector3d::UnitZ())));
    last = link;
  }
  JointAxis driven;
  driven.motor = JointMotor{JointMotor::Mode::Velocity, real(3), real(20)};
  driven.limit = JointLimit{real(-4), real(5)};
  const BodyId a = add_body(world, {0, 3, 0}, 1, {1, 1, 2});
  const BodyId b = add_body(world, {2, 3, 0}, 2, {1, 1, 1});
  const JointId first = must(
      world.create_joint(joint_at(world, {}, a, HingeJoint{driven}, {0, 3, 0}, Vector3d::UnitZ())));
  const JointId second =
      must(world.create_joint(joint_at(world, {}, b, HingeJoint{}, {2, 3, 0}, Vector3d::UnitZ())));
  Joint gear;
  gear.kind = GearJoint{first, second, real(2)};
  must(world.create_joint(gear));
}

class JointInput : public ::testing::Test {
 protected:
  void refused(const Joint& joint, StatusCode code, const char* what) {
    const std::uint64_t before = world_.state_hash();
    const Created<JointId> made = world_.create_joint(joint);
    EXPECT_EQ(made.status.code, code) << what << ": " << made.status.message;
    EXPECT_TRUE(made.id.is_null()) << what;
    EXPECT_EQ(world_.state_hash(), before) << what;
    EXPECT_EQ(world_.joint_count(), 0u) << what;
  }
  PhysicsWorld world_;
  BodyId a_ = add_body(world_, {0, 0, 0}, 1, {1, 1, 1});
  BodyId b_ = add_body(world_, {1, 0, 0}, 1, {1, 1, 1});
};

TEST_F(JointInput, IsRefusedWithAStatusAndChangesNothing) {
  const Joint good = joint_at(world_, a_, b_, HingeJoint{}, {0.5, 0, 0});
  Joint bad = good;
  bad.body_b = a_;
  refused(bad, StatusCode::OutOfRange, "joint to itself");
  bad = good;
  bad.body_a = bad.body_b = {};
  refused(bad, StatusCode::OutOfRange, "world to world");
  bad = good;
  bad.body_b = {77, 1};
  refused(bad, StatusCode::StaleHandle, "no such body");
  bad = good;
  bad.frame_a.position.x() = kNaN;
  refused(bad, StatusCode::NotFinite, "frame");
  bad = good;
  bad.frame_b.orientation.coeffs().setZero();
  refused(bad, StatusCode::OutOfRange, "zero quaternion");
  bad = good;
  bad.break_force = 0;
  refused(bad, StatusCode::OutOfRange, "break force");
  bad = good;
  bad.softness.frequency = -1;
  refused(bad, StatusCode::OutOfRange, "negative frequency");
  bad = good;
  bad.kind = HingeJoint{{.limit = JointLimit{1, -1}}};
  refused(bad, StatusCode::OutOfRange, "limits crossed");
  bad.kind = HingeJoint{{.limit = JointLimit{kNaN, 1}}};
  refused(bad, StatusCode::NotFinite, "limit NaN");
  bad.kind = SliderJoint{{.motor = JointMotor{JointMotor::Mode::Velocity, kNaN}}};
  refused(bad, StatusCode::NotFinite, "motor NaN");
  bad.kind = SliderJoint{{.motor = JointMotor{JointMotor::Mode::Velocity, 1, -1}}};
  refused(bad, StatusCode::OutOfRange, "negative effort");
  bad.kind = BallJoint{-1};
  refused(bad, StatusCode::OutOfRange, "negative friction");
  bad.kind = DistanceJoint{0};
  refused(bad, StatusCode::OutOfRange, "rod of no length");
  bad.kind = SpringJoint{1, -5, 0};
  refused(bad, StatusCode::OutOfRange, "negative stiffness");
  bad.kind = ConeTwistJoint{4};
  refused(bad, StatusCode::OutOfRange, "cone too wide");
  bad.kind = PulleyJoint{Pos3::Zero(), Pos3::Zero(), 0};
  refused(bad, StatusCode::OutOfRange, "pulley ratio");
  bad.kind = GearJoint{{}, {}, 1};
  refused(bad, StatusCode::StaleHandle, "gear of nothing");
  RigidBody fixed;
  fixed.type = MotionType::Static;
  const BodyId wall = must(world_.create_body(fixed));
  bad = good;
  bad.body_b = wall;
  bad.body_a = {};
  refused(bad, StatusCode::WrongMotionType, "nothing that moves");

  const JointId joint = must(world_.create_joint(good));
  EXPECT_EQ(world_.set_joint_motor(joint, JointMotor{}, 3).code, StatusCode::OutOfRange);
  EXPECT_EQ(world_.set_joint_limit(joint, JointLimit{2, 1}).code, StatusCode::OutOfRange);
  EXPECT_EQ(world_.set_joint_limit({}, std::nullopt).code, StatusCode::StaleHandle);
  must(world_.destroy_joint(joint));
  EXPECT_EQ(world_.destroy_joint(joint).code, StatusCode::StaleHandle);
  EXPECT_FALSE(world_.is_valid(joint));
}

TEST_F(JointInput, LockedAxesAndPointMassesGiveNothingSingular) {
  for (int k = 0; k < 2; ++k) {
    PhysicsWorld world;
    RigidBody body = free_body(1, {1, 1, 1});
    if (k == 0) body.mass.reset();  // a point mass that does not turn
    if (k == 1) body.locks = MotionLocks::planar();
    body.can_sleep = false;
    const BodyId p = must(world.create_body(body));
    body.pose = at(1, 0, 0);
    const BodyId q = must(world.create_body(body));
    for (const JointKind& kind : {JointKind(FixedJoint{}), JointKind(HingeJoint{}),
                                  JointKind(SliderJoint{}), JointKind(BallJoint{})}) {
      const JointId id = must(world.create_joint(joint_at(world, p, q, kind, {0.5, 0.2, 0.1})));
      run(world, 1);
      must(world.destroy_joint(id));
    }
    EXPECT_TRUE(all_finite(world));
    EXPECT_EQ(world.last_report().quarantined, 0u);
    EXPECT_LE((position(world, p) - position(world, q)).norm(), 1.0 + 1e-2);
  }
}

TEST(JointLife, ABodyTakesItsJointsAndTheirCouplingsWithIt) {
  PhysicsWorld world;
  const BodyId a = add_body(world, {0, 0, 0}, 1, {1, 1, 1});
  const BodyId b = add_body(world, {1, 0, 0}, 1, {1, 1, 1});
  const JointId first = must(world.create_joint(joint_at(world, {}, a, HingeJoint{}, {0, 0, 0})));
  const JointId second = must(world.create_joint(joint_at(world, {}, b, HingeJoint{}, {1, 0, 0})));
  Joint gear;
  gear.kind = GearJoint{first, second, 1};
  const JointId coupling = must(world.create_joint(gear));
  run(world, 0.1);
  must(world.destroy_body(a));
  EXPECT_FALSE(world.is_valid(first));
  EXPECT_FALSE(world.is_valid(coupling));
  EXPECT_TRUE(world.is_valid(second));
  run(world, 0.1);
  EXPECT_TRUE(all_finite(world));
  EXPECT_EQ(world.joint_count(), 1u);
}

TEST(JointLife, JoinedBodiesCollideOnlyWhenTold) {
  for (const bool collide : {false, true}) {
    PhysicsWorld world(no_gravity());
    const BodyId a = add(world, body_at(at(0, 0, 0)), with(sphere(0.5)));
    const BodyId b = add(world, body_at(at(0.8, 0, 0)), with(sphere(0.5)));  // overlapping
    Joint joint;
    joint.body_a = a;
    joint.body_b = b;
    joint.kind = RopeJoint{2};
    joint.collide_connected = collide;
    const JointId id = must(world.create_joint(joint));
    run(world, 1);
    const double apart = (position(world, b) - position(world, a)).norm();
    if (collide) {
      EXPECT_GT(apart, 0.99);
      continue;
    }
    EXPECT_NEAR(apart, 0.8, 1e-6);
    must(world.destroy_joint(id));  // now they may
    run(world, 1);
    EXPECT_GT((position(world, b) - position(world, a)).norm(), 0.99);
  }
}

TEST(JointLife, JoinedBodiesSleepAndWakeTogether) {
  PhysicsWorld world;
  add_floor(world, material(0.8));
  const BodyId a = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  const BodyId b = add(world, body_at(at(3, 0.5, 0)), with(cube(0.5)));
  must(world.create_joint(joint_at(world, a, b, FixedJoint{}, {1.5, 0.5, 0})));
  run(world, 4);
  EXPECT_FALSE(world.is_awake(a));
  EXPECT_FALSE(world.is_awake(b));
  must(world.apply_impulse(a, vec(0, 0, 500)));
  EXPECT_TRUE(world.is_awake(b));
  run(world, 6);
  EXPECT_FALSE(world.is_awake(b));
  // While one of them is kept awake, so is the other.
  for (int i = 0; i < 120; ++i) {
    must(world.apply_force(b, vec(0, 0, 1)));
    world.step(kDt);
    ASSERT_TRUE(world.is_awake(a));
  }
}

TEST(JointLife, SnapshotsCarryEveryBitOfThem) {
  PhysicsWorld world;
  build_mixture(world);
  run(world, 1);
  const Snapshot saved = world.save();
  PhysicsWorld other;
  must(other.restore(saved));
  EXPECT_EQ(other.save(), saved);
  EXPECT_EQ(other.state_hash(), world.state_hash());
  for (int i = 0; i < 120; ++i) {
    world.step(kDt);
    other.step(kDt);
    ASSERT_EQ(other.state_hash(), world.state_hash()) << i;
  }
}

TEST(JointLife, ThreadsChangeNoBit) {
  std::vector<std::uint64_t> alone;
  for (const int threads : {1, 2, 4}) {
    const auto pool = make_thread_pool(threads);
    PhysicsWorld world;
    build_mixture(world);
    for (int i = 0; i < 40; ++i) {  // more joints than one chunk takes
      const BodyId a = add_body(world, {10.0 + i, 0, 0}, 1, {1, 1, 1});
      must(world.create_joint(
          joint_at(world, {}, a, BallJoint{}, {10.0 + i, 1, 0.3}, Vector3d::UnitZ())));
    }
    world.set_job_system(pool.get());
    for (int i = 0; i < 120; ++i) {
      world.step(kDt);
      if (threads == 1) {
        alone.push_back(world.state_hash());
      } else {
        ASSERT_EQ(world.state_hash(), alone[static_cast<std::size_t>(i)]) << threads << " " << i;
      }
    }
  }
}

class InputKeeper : public StepObserver {
 public:
  void on_step(const StepView& view) override {
    steps.emplace_back(view.inputs.begin(), view.inputs.end());
  }
  std::vector<std::vector<InputRecord>> steps;
};

TEST(JointLife, RecordedCallsDoTheSameAgain) {
  PhysicsWorld world;
  InputKeeper keeper;
  world.attach(&keeper);
  build_mixture(world);
  const JointId servo = world.joints_of({13, 1}).at(0);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 90; ++i) {
    if (i == 30) must(world.set_joint_motor(servo, JointMotor{JointMotor::Mode::Position, 1}));
    if (i == 50) must(world.set_joint_limit(servo, JointLimit{0, real(0.5)}));
    if (i == 70) must(world.destroy_joint(servo));
    world.step(kDt);
    hashes.push_back(world.state_hash());
  }
  world.detach(&keeper);
  PhysicsWorld again;
  for (std::size_t i = 0; i < keeper.steps.size(); ++i) {
    for (const InputRecord& input : keeper.steps[i]) must(again.apply_input(input));
    again.step(kDt);
    ASSERT_EQ(again.state_hash(), hashes[i]) << i;
  }
}

TEST(JointLife, AJointThatCameAndWentLeavesNoTrace) {
  PhysicsWorld with_joint, without;
  std::uint64_t last[2];
  for (PhysicsWorld* world : {&with_joint, &without}) {
    add_floor(*world, material(0.5));
    const BodyId a = add(*world, body_at(at(0, 1, 0)), with(cube(0.5)));
    const BodyId b = add(*world, body_at(at(3, 2, 0)), with(cube(0.5)));
    if (world == &with_joint)
      must(world->destroy_joint(
          must(world->create_joint(joint_at(*world, a, b, BallJoint{}, {1, 1, 0})))));
    run(*world, 2);
    last[world == &without] = world->state_hash();
  }
  EXPECT_EQ(last[0], last[1]);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
