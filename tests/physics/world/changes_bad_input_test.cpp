// Proves that no change of a living body or collider can hurt a world: bad numbers, handles, shapes
// and moments are refused with a status and a sentence, nothing changes, and all bodies go on bit
// for bit as in a world that was never asked.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "support/measure.h"
#include "support/refusals.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

class BadChange : public Refusals {
 protected:
  BadChange() {
    for (PhysicsWorld* w : {&world_, &twin_}) {
      const Built stack = build_stack(*w, {.count = 3, .gap = 0.1});
      ground_ = stack.ground;
      body_ = stack.bodies[1];
      sleeper_ = add(*w, body_at(at(9, 0.5, 0)), with(cube(0.5)));
      must(w->set_awake(sleeper_, false));
      run(*w, 0.2);
    }
    collider_ = world_.colliders_of(body_)[0];
  }
  // Every change as a call on these handles, with numbers that are good.
  static std::vector<std::pair<const char*, Status>> all_changes(PhysicsWorld& world, BodyId body,
                                                                 ColliderId collider) {
    return {{"derive_mass", world.derive_mass(body)},
            {"set_motion_type", world.set_motion_type(body, MotionType::Static)},
            {"set_locks", world.set_locks(body, MotionLocks::planar())},
            {"set_damping", world.set_damping(body, 1, 1)},
            {"set_gravity_scale", world.set_gravity_scale(body, 2)},
            {"set_can_sleep", world.set_can_sleep(body, false)},
            {"set_continuous", world.set_continuous(body, true)},
            {"set_user_data", world.set_user_data(body, 1)},
            {"set_shape", world.set_shape(collider, sphere(2))},
            {"set_local_pose", world.set_local_pose(collider, {vec(1, 0, 0), Quat::Identity()})},
            {"set_material", world.set_material(collider, material(0.1))},
            {"set_density", world.set_density(collider, 5)},
            {"set_sensor", world.set_sensor(collider, true)},
            {"set_one_way", world.set_one_way(collider, vec(0, 1, 0))},
            {"set_user_data", world.set_user_data(collider, 1)}};
  }
  BodyId ground_, body_, sleeper_;
  ColliderId collider_;
};

TEST_F(BadChange, MotionTypes) {
  refused(world_.set_motion_type(body_, static_cast<MotionType>(3)), "a type that is none");
  refused(world_.set_motion_type(ground_, MotionType::Dynamic), "a dynamic half-space");
  refused(world_.set_motion_type(ground_, MotionType::Kinematic), "a kinematic half-space");
}

TEST_F(BadChange, DampingAndGravity) {
  for (const double bad : {kNan, kInf, -kInf, -0.1}) {
    refused(world_.set_damping(body_, real(bad), 0), "linear damping");
    refused(world_.set_damping(body_, 0, real(bad)), "angular damping");
  }
  for (const double bad : {kNan, kInf, -kInf})
    refused(world_.set_gravity_scale(body_, real(bad)), "gravity scale");
}

TEST_F(BadChange, Masses) { refused(world_.derive_mass(ground_), "the mass of a static body"); }

TEST_F(BadChange, Shapes) {
  for (const double bad : {0.0, -1.0, 1e-30, kNan, kInf}) {
    refused(world_.set_shape(collider_, sphere(bad)), "sphere");
    refused(world_.set_shape(collider_, box(1, bad, 1)), "box");
    refused(world_.set_shape(collider_, cylinder(1, bad)), "cylinder");
  }
  refused(world_.set_shape(collider_, HalfSpace{}), "a dynamic half-space");
  refused(world_.set_shape(collider_, SurfaceMesh{}), "a mesh without geometry");
  refused(world_.set_shape(collider_, ConvexHull{}), "a hull without geometry");
  refused(world_.set_shape(world_.colliders_of(ground_)[0], HalfSpace{Vec3::Zero(), 0}),
          "a plane without a normal");
}

TEST_F(BadChange, LocalPoses) {
  for (const double bad : {kNan, kInf}) {
    refused(world_.set_local_pose(collider_, {vec(0, bad, 0), Quat::Identity()}), "position");
    refused(world_.set_local_pose(collider_, {Vec3::Zero(), Quat(real(bad), 0, 0, 0)}), "turn");
  }
  refused(world_.set_local_pose(collider_, {Vec3::Zero(), Quat(0, 0, 0, 0)}), "no quaternion");
}

TEST_F(BadChange, Materials) {
  for (const double bad : {kNan, kInf, -1.0}) {
    refused(world_.set_material(collider_, material(bad)), "friction");
    refused(world_.set_material(collider_, material(0.5, bad)), "restitution");
    Material m;
    m.rolling_friction = real(bad);
    refused(world_.set_material(collider_, m), "rolling friction");
    m = {};
    m.torsional_friction = real(bad);
    refused(world_.set_material(collider_, m), "torsional friction");
  }
  refused(world_.set_material(collider_, material(0.5, 1.5)), "restitution above 1");
  Material m;
  m.friction_rule = static_cast<CombineRule>(9);
  refused(world_.set_material(collider_, m), "a rule that is none");
}

TEST_F(BadChange, DensitiesAndDirections) {
  for (const double bad : {kNan, kInf, -1.0})
    refused(world_.set_density(collider_, bad), "density");
  for (const double bad : {kNan, kInf})
    refused(world_.set_one_way(collider_, vec(0, bad, 0)), "direction");
}

TEST_F(BadChange, HandlesOfWhatIsNotThere) {
  const BodyId bodies[] = {BodyId{}, {99999, 1}, {body_.index, body_.generation + 1}};
  const ColliderId colliders[] = {
      ColliderId{}, {99999, 1}, {collider_.index, collider_.generation + 1}};
  for (std::size_t i = 0; i < 3; ++i)
    for (const auto& [what, status] : all_changes(world_, bodies[i], colliders[i]))
      EXPECT_EQ(status.code, StatusCode::StaleHandle) << what;
}

TEST_F(BadChange, InsideAStep) {
  struct Meddler : StepObserver {
    std::function<void()> meddle;
    void on_step(const StepView&) override { meddle(); }
  } meddler;
  int asked = 0;
  meddler.meddle = [&] {
    for (const auto& [what, status] : all_changes(world_, body_, collider_)) {
      EXPECT_EQ(status.code, StatusCode::InsideStep) << what;
      ++asked;
    }
  };
  world_.attach(&meddler);
  world_.step(kDt);
  world_.detach(&meddler);
  twin_.step(kDt);
  EXPECT_EQ(asked, 15);
}

TEST_F(BadChange, Records) {
  for (auto kind = InputKind::DeriveMass; kind <= InputKind::SetColliderUserData;
       kind = static_cast<InputKind>(static_cast<std::uint32_t>(kind) + 1)) {
    const bool of_body = kind <= InputKind::SetBodyUserData;
    const std::uint64_t target = of_body ? body_.value() : collider_.value();
    if (kind != InputKind::DeriveMass)
      refused(world_.apply_input({kind, target, {}}), name_of(kind));
    refused(world_.apply_input({kind, target, std::vector<double>(40, 0.5)}), name_of(kind));
    refused(world_.apply_input({kind, 0, {1}}), name_of(kind));
    EXPECT_NE(std::string(name_of(kind)), "unknown");
  }
  refused(world_.apply_input({InputKind::SetMotionType, body_.value(), {7}}), "type 7");
  refused(world_.apply_input({InputKind::SetShape, collider_.value(), {99, 1}}), "shape 99");
}

// What was quarantined stays out of the world, whatever is changed about it.
TEST(BadChangeOfTheQuarantined, StaysOut) {
  PhysicsWorld world;
  add_floor(world);
  const BodyId doomed = add(world, body_at(at(0, 5, 0)), with(cube(0.5), {}, 1e-3));
  const BodyId other = add(world, body_at(at(0.2, 7, 0)), with(cube(0.5)));
  const double huge = static_cast<double>(std::numeric_limits<Real>::max()) / 2;
  must(world.apply_force(doomed, vec(huge, huge, 0)));
  world.step(kDt);
  ASSERT_EQ(world.last_report().quarantined, 1u);
  const Pose pose = world.pose(doomed);
  EXPECT_EQ(world.set_motion_type(doomed, MotionType::Kinematic).code, StatusCode::WrongMotionType);
  const ColliderId collider = world.colliders_of(doomed)[0];
  must(world.set_shape(collider, cube(0.6)));
  must(world.set_density(collider, 10));
  must(world.set_locks(doomed, MotionLocks::planar()));
  must(world.set_gravity_scale(doomed, 2));
  must(world.set_can_sleep(doomed, false));
  must(world.derive_mass(doomed));
  run(world, 2);
  EXPECT_FALSE(world.is_awake(doomed));
  EXPECT_EQ(world.pose(doomed).position, pose.position);
  EXPECT_TRUE(all_finite(world));
  EXPECT_NEAR(position(world, other).y(), wide(pose.position).y() + 1.1, 0.05);  // lies on it
  PhysicsWorld restored;
  must(restored.restore(world.save()));
  run(world, 0.5);
  run(restored, 0.5);
  EXPECT_EQ(world.state_hash(), restored.state_hash());
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
