// Invariant: what the user forces off does not happen, what is forced on happens everywhere, the
// plan says so with a bound that the motion keeps to, and snapshots and recorded inputs carry it.
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using namespace testing_support;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

WorldSettings forcing(PlanItem item, Choice choice, WorldSettings settings = {}) {
  settings.forced.set(item, choice);
  return settings;
}
PlanDecision decision(const PhysicsWorld& world, PlanItem item) {
  return world.plan().decisions[static_cast<std::size_t>(item)];
}
// The number that follows `words` in a text.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t found = text.find(words);
  if (found == std::string::npos) throw std::runtime_error("no '" + words + "' in: " + text);
  return std::stod(text.substr(found + words.size()));
}

TEST(ForcedPlan, EveryItemHasANameByWhichItIsFoundAndAnAutomaticChoice) {
  for (std::size_t k = 0; k < kPlanItemCount; ++k) {
    const PlanItem item = static_cast<PlanItem>(k);
    std::string name = name_of(item);
    ASSERT_FALSE(name.empty()) << k;
    EXPECT_EQ(plan_item_of(name), item) << name;
    std::replace(name.begin(), name.end(), ' ', '_');
    EXPECT_EQ(plan_item_of(name), item) << name;
    EXPECT_TRUE(may_force(item, Choice::Automatic)) << name;
  }
  EXPECT_EQ(plan_item_of(""), std::nullopt);
  EXPECT_EQ(plan_item_of("gyro"), std::nullopt);
}

TEST(ForcedPlan, RefusesWhatCannotBeForcedAndChangesNothing) {
  PhysicsWorld world(forcing(PlanItem::Continuous, Choice::Off));
  const PlanChoices before = world.settings().forced;
  for (const WorldSettings& bad :
       {forcing(PlanItem::Gravity, Choice::Off), forcing(PlanItem::Joints, Choice::Off),
        forcing(PlanItem::Friction, Choice::On), forcing(PlanItem::Drag, Choice::On),
        forcing(PlanItem::KeptManifolds, Choice::On)}) {
    EXPECT_EQ(world.set_settings(bad).code, StatusCode::OutOfRange);
    EXPECT_EQ(world.settings().forced, before);
  }
  WorldSettings both;
  both.forced = PlanChoices(bit_of(PlanItem::Gyroscopic), bit_of(PlanItem::Gyroscopic));
  EXPECT_EQ(world.set_settings(both).code, StatusCode::OutOfRange);
  both.forced = PlanChoices(std::uint64_t{1} << 63, 0);
  EXPECT_EQ(world.set_settings(both).code, StatusCode::OutOfRange);
}

// Without the term w stands still; L leaves its place as fast as the plan says, no faster.
TEST(ForcedPlan, WithoutGyroscopicTermMomentumTurnsByWhatThePlanSays) {
  WorldSettings settings = forcing(PlanItem::Gyroscopic, Choice::Off, no_gravity());
  PhysicsWorld world(settings);
  RigidBody body = moving(at(0, 0, 0), Vec3::Zero(), vec(1, 2, 0.5));
  const BodyId id = add(world, body, with(box(0.5, 0.2, 0.1)));
  world.step(kDt);
  const PlanDecision told = decision(world, PlanItem::Gyroscopic);
  EXPECT_FALSE(told.active);
  EXPECT_EQ(told.choice, Choice::Off);
  const double bound = number_after(told.loss, "|L| = ");  // [rad] a step
  const Vector3d L = world.angular_momentum(id).cast<double>();
  world.step(kDt);
  const Vector3d after = world.angular_momentum(id).cast<double>();
  const double turned = (after - L).norm() / L.norm();
  EXPECT_LE(turned, 1.01 * bound);
  EXPECT_GE(turned, 0.9 * bound);
  EXPECT_LE((spin(world, id) - Vector3d(1, 2, 0.5)).norm(), 1e-5);
  // With it L stands still and w does not.
  must(world.set_settings(forcing(PlanItem::Gyroscopic, Choice::On, no_gravity())));
  for (int i = 0; i < 60; ++i) world.step(kDt);
  EXPECT_LE((world.angular_momentum(id).cast<double>() - after).norm(), 1e-5 * after.norm());
  EXPECT_GE((spin(world, id) - Vector3d(1, 2, 0.5)).norm(), 0.1);
}

// A bullet at a thin wall: both ways of stopping it off, it passes, by what the plan says; either
// of them holds it.
TEST(ForcedPlan, WithoutLookAheadAndContinuousABulletPassesTheWall) {
  for (const bool look_ahead : {false, true})
    for (const bool continuous : {false, true}) {
      WorldSettings settings = no_gravity();
      if (!look_ahead) settings.forced.set(PlanItem::LookAhead, Choice::Off);
      if (!continuous) settings.forced.set(PlanItem::Continuous, Choice::Off);
      PhysicsWorld world(settings);
      add(world, body_at(at(0, 0, 0), MotionType::Static), with(box(0.01, 2, 2)));
      const BodyId bullet = add(world, moving(at(-2.5, 0, 0), vec(60, 0, 0)), with(sphere(0.05)));
      for (int i = 0; i < 2; ++i) world.step(kDt);
      for (const PlanItem item : {PlanItem::LookAhead, PlanItem::Continuous}) {
        const PlanDecision told = decision(world, item);
        EXPECT_EQ(told.choice == Choice::Off, !told.loss.empty()) << told.loss;
      }
      for (int i = 0; i < 4; ++i) world.step(kDt);
      EXPECT_EQ(position(world, bullet).x() > 0, !look_ahead && !continuous)
          << look_ahead << continuous;
    }
}

TEST(ForcedPlan, WithoutContinuousThePathOfAStepIsTheBound) {
  PhysicsWorld world(forcing(PlanItem::Continuous, Choice::Off, no_gravity()));
  add(world, moving(at(0, 0, 0), vec(60, 0, 0)), with(sphere(0.05)));
  add(world, moving(at(0, 9, 0), vec(30, 0, 0)), with(sphere(0.05)));
  world.step(kDt);
  EXPECT_NEAR(number_after(decision(world, PlanItem::Continuous).loss, "up to "), 1, 1e-3);
}

TEST(ForcedPlan, ContactTermsAreLeftOutOfPairsThatTouchAlready) {
  PhysicsWorld world;
  Material surface = material(0.5);
  surface.rolling_friction = real(0.05);
  add_floor(world, surface);
  const BodyId ball =
      add(world, moving(at(0, 0.5, 0), vec(2, 0, 0), vec(0, 0, -4)), with(sphere(0.5), surface));
  for (int i = 0; i < 10; ++i) world.step(kDt);
  EXPECT_TRUE(world.plan().active(PlanItem::RollingFriction));
  must(world.set_settings(forcing(PlanItem::RollingFriction, Choice::Off)));
  world.step(kDt);  // the impulses of the step before still brake
  const double before = velocity(world, ball).norm();
  for (int i = 0; i < 30; ++i) world.step(kDt);
  EXPECT_NEAR(velocity(world, ball).norm(), before, 1e-3 * before);
  const PlanDecision told = decision(world, PlanItem::RollingFriction);
  EXPECT_FALSE(told.active);
  // Coefficient times weight: 0.05 m of 1000 kg/m^3 (4/3) pi (0.5 m)^3 g.
  const double weight = 1000 * 4.0 / 3 * kPi * 0.125 * kGravity;
  EXPECT_NEAR(number_after(told.loss, "up to "), 0.05 * weight, 0.05 * 0.05 * weight);
  must(world.set_settings({}));
  for (int i = 0; i < 30; ++i) world.step(kDt);
  EXPECT_LE(velocity(world, ball).norm(), 0.95 * before);
}

TEST(ForcedPlan, SleepingGoesBeforeTheSetting) {
  for (const Choice choice : {Choice::Off, Choice::On}) {
    WorldSettings settings = choice == Choice::Off ? WorldSettings{} : no_sleep();
    PhysicsWorld world(forcing(PlanItem::Sleeping, choice, settings));
    add_floor(world);
    const BodyId body = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
    for (int i = 0; i < 120; ++i) world.step(kDt);
    EXPECT_EQ(world.is_awake(body), choice == Choice::Off);
  }
}

TEST(ForcedPlan, WhatStepsReportFollowsWhatIsForced) {
  const auto report_with = [](PlanItem item, Choice choice) {
    WorldSettings settings = no_sleep();
    settings.contact_solver = ContactSolver::SoftStep;  // the default would take the deep overlap
    settings.forced.set(item, choice);
    PhysicsWorld world(settings);
    add_floor(world);
    add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
    add(world, body_at(at(0, 1.2, 0)), with(cube(0.5)));  // 0.3 m deep in the first
    add(world, moving(at(5, 0.1, 0), Vec3::Zero(), vec(0, 40, 3)), with(box(0.3, 0.1, 0.1)));
    add(world, body_at(at(9, 0.5, 0)), with(cube(0.5)));  // at rest
    // A chain that touches nothing, with a heavy end that swings.
    BodyId before;
    for (int i = 0; i < 6; ++i) {
      RigidBody link = body_at(at(0.5 + i, 20, 0));
      if (i == 5) link.linear_velocity = vec(0, 30, 0);
      const BodyId id = add(world, link, with(box(0.5, 0.05, 0.05), {}, i == 5 ? 100000 : 1000));
      Joint joint;
      joint.body_a = before;
      joint.body_b = id;
      joint.frame_a.position = before.is_null() ? vec(0, 20, 0) : vec(0.5, 0, 0);
      joint.frame_b.position = vec(-0.5, 0, 0);
      joint.kind = BallJoint{};
      must(world.create_joint(joint));
      before = id;
    }
    StepReport sum;
    for (int i = 0; i < 20; ++i) {
      const StepReport& report = world.step(kDt);
      sum.kept_pairs += report.kept_pairs;
      sum.fast_turning += report.fast_turning;
      sum.deep_bodies += report.deep_bodies;
      sum.direct_joints += report.direct_joints;
      sum.joint_substeps += report.joint_substeps;
      sum.newton_islands += report.newton_islands;
    }
    return sum;
  };
  const StepReport usual = report_with(PlanItem::Sleeping, Choice::Automatic);
  EXPECT_GT(usual.kept_pairs, 0u);
  EXPECT_GT(usual.fast_turning, 0u);
  EXPECT_GT(usual.deep_bodies, 0u);
  EXPECT_EQ(usual.direct_joints, 20u * 6);
  EXPECT_GT(usual.joint_substeps, 0u);
  EXPECT_EQ(usual.newton_islands, 0u);
  EXPECT_EQ(report_with(PlanItem::KeptManifolds, Choice::Off).kept_pairs, 0u);
  EXPECT_EQ(report_with(PlanItem::FastTurns, Choice::Off).fast_turning, 0u);
  EXPECT_GT(report_with(PlanItem::FastTurns, Choice::On).fast_turning, usual.fast_turning);
  EXPECT_EQ(report_with(PlanItem::DeepOverlap, Choice::Off).deep_bodies, 0u);
  EXPECT_GT(report_with(PlanItem::DeepOverlap, Choice::On).deep_bodies, usual.deep_bodies);
  EXPECT_EQ(report_with(PlanItem::DirectJoints, Choice::Off).direct_joints, 0u);
  EXPECT_EQ(report_with(PlanItem::JointSubsteps, Choice::Off).joint_substeps, 0u);
  EXPECT_EQ(report_with(PlanItem::JointSubsteps, Choice::On).joint_substeps, 20u * 4 * 7);
  EXPECT_GT(report_with(PlanItem::AccurateContacts, Choice::On).newton_islands, 0u);
}

TEST(ForcedPlan, EffectsForcedOffDoNothing) {
  WorldSettings settings = forcing(PlanItem::Thrust, Choice::Off, no_gravity());
  PhysicsWorld world(settings);
  const BodyId body = add(world, body_at(at(0, 0, 0)), with(cube(0.5)));
  must(world.create_effect({.body = body, .kind = Thrust{.force = vec(1000, 0, 0)}}));
  for (int i = 0; i < 10; ++i) world.step(kDt);
  EXPECT_EQ(velocity(world, body).norm(), 0);
  EXPECT_FALSE(world.plan().active(PlanItem::Thrust));
  EXPECT_FALSE(decision(world, PlanItem::Thrust).loss.empty());
}

// What is saved goes on in the restored world with the same bits, and what is recorded is repeated.
TEST(ForcedPlan, SnapshotsAndInputsCarryIt) {
  struct Inputs : StepObserver {
    std::vector<InputRecord> seen;
    void on_attach(const PhysicsWorld&) override {}
    void on_step(const StepView& view) override {
      seen.assign(view.inputs.begin(), view.inputs.end());
    }
  } inputs;
  WorldSettings settings;
  settings.forced.set(PlanItem::Gyroscopic, Choice::Off);
  settings.forced.set(PlanItem::LookAhead, Choice::On);
  settings.forced.set(PlanItem::Spring, Choice::Off);
  PhysicsWorld world, again;
  for (PhysicsWorld* each : {&world, &again})
    add(*each, moving(at(0, 5, 0), Vec3::Zero(), vec(1, 5, 2)), with(box(0.5, 0.2, 0.1)));
  world.attach(&inputs);
  must(world.set_settings(settings));
  world.step(kDt);
  for (const InputRecord& input : inputs.seen) must(again.apply_input(input));
  again.step(kDt);
  EXPECT_EQ(again.settings().forced, settings.forced);
  EXPECT_EQ(again.state_hash(), world.state_hash());
  PhysicsWorld restored;
  must(restored.restore(world.save()));
  EXPECT_EQ(restored.settings().forced, settings.forced);
  for (int i = 0; i < 10; ++i) {
    world.step(kDt);
    restored.step(kDt);
  }
  EXPECT_EQ(restored.state_hash(), world.state_hash());
  world.detach(&inputs);
}

TEST(ForcedPlan, BitsOfThePlanAreWhatItsWordsSay) {
  PhysicsWorld world(forcing(PlanItem::Continuous, Choice::Off));
  build_stack(world, {.count = 4, .shift = 0.1});
  add(world, moving(at(5, 5, 0), vec(50, 0, 0), vec(1, 2, 3)), with(box(0.1, 0.2, 0.3)));
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = world.planned_items();
    for (const PlanDecision& told : world.plan().decisions)
      ASSERT_EQ((bits & bit_of(told.item)) != 0, told.active) << name_of(told.item) << i;
    world.step(kDt);
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
