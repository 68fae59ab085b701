// Proves that the default, ContactSolver::Auto, takes what weighs and leaves what strikes: towers
// and mass ratios that fall in every soft solver stand out of the box, falling piles keep the bits
// of soft steps, joints keep their own solver, and what an island costs is bounded.
#include <gtest/gtest.h>

#include "../joints/joint_scenes.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;
using namespace scenes;
using Eigen::Vector3d;

TEST(AutoChoice, TowersAndMassRatiosStandWithTheDefaults) {
  for (const Column& column :
       {Column{30}, Column{50, 1, 0.01}, Column{100}, Column{10, 4}, Column{2, 1e4}}) {
    PhysicsWorld world;
    const Built built = build_column(world, column);
    const BodyId top = built.bodies.back();
    const Vector3d start = position(world, top);
    run(world, 10);
    EXPECT_LE((position(world, top) - start).norm(), 0.05)
        << column.count << " boxes, each " << column.growth << " times the one below";
  }
}

// Ten boxes, each four times heavier than the one below, and fifty equal ones: every second box
// shifted by 1 cm, or the whole tower leaning when it is let go, which rocks then. The top stays
// near where it was.
TEST(AutoChoice, TowersStandThoughShiftedOrLeaning) {
  struct Case {
    Column column;
    double shift, lean;  // [m], [rad]
  };
  const Column heavy_top{10, 4}, tall{50};
  for (const Case& c : {Case{heavy_top, 0.01, 0}, Case{heavy_top, 0, 1e-3},
                        Case{heavy_top, 0, 1e-2}, Case{tall, 0.01, 0}, Case{tall, 0, 1e-3}}) {
    PhysicsWorld world;
    const Built built = build_column(world, c.column);
    const Quat leaning = turn(c.lean, Vector3d::UnitZ());
    for (std::size_t i = 0; i < built.bodies.size(); ++i) {
      Vector3d p = position(world, built.bodies[i]);
      p.x() += i % 2 == 0 ? c.shift : -c.shift;
      p = leaning.cast<double>() * p + Vector3d(0, 0.5 * c.lean, 0);
      must(world.set_pose(built.bodies[i], at(p, leaning)));
    }
    const BodyId top = built.bodies.back();
    const Vector3d start = position(world, top);
    double farthest = 0;
    run(world, 10, 1.0 / 60,
        [&] { farthest = std::max(farthest, (position(world, top) - start).norm()); });
    EXPECT_LE(farthest, 0.2) << c.column.count << " boxes, shifted by " << c.shift
                             << " m, leaning by " << c.lean;
  }
}

// Runs a scene with a solver; returns its hash, and what the accurate solver did.
struct Outcome {
  std::uint64_t hash = 0;
  std::uint64_t factorizations = 0;
  std::uint32_t steps_with_islands = 0;
};
template <class Build>
Outcome play(ContactSolver solver, double seconds, const Build& build) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = solver;
  PhysicsWorld world(settings);
  build(world);
  Outcome out;
  run(world, seconds, 1.0 / 60, [&] {
    out.factorizations += world.last_report().newton_factorizations;
    out.steps_with_islands += world.last_report().newton_islands > 0 ? 1 : 0;
  });
  out.hash = world.state_hash();
  return out;
}

// Boxes and balls of one kind of matter that drop onto each other by up to six meters: blows of a
// hundred weights, and nothing that carries more than a few bodies.
TEST(AutoChoice, DoesNotHearBlows) {
  const auto rain = [](PhysicsWorld& world) {
    add_floor(world);
    Random random(6);  // nothing is buried; with most seeds some box ends under others
    for (int i = 0; i < 60; ++i) {
      const Vector3d p(random.uniform(-4, 4), 0.6 + 0.1 * i, random.uniform(-4, 4));
      add(world, body_at(at(p, random.rotation(3))),
          with(i % 2 == 0 ? Shape(cube(0.4)) : Shape(sphere(0.4))));
    }
  };
  const Outcome chosen = play(ContactSolver::Auto, 5, rain);
  EXPECT_EQ(chosen.steps_with_islands, 0u);
  EXPECT_EQ(chosen.hash, play(ContactSolver::SoftStep, 5, rain).hash);
}

TEST(AutoChoice, LeavesWhatJointsHoldToTheirOwnSolver) {
  const auto loaded_bridge = [](PhysicsWorld& world) {
    const BodyId left = add(world, body_at(at(-0.6, 0, 0), MotionType::Static), with(cube(0.1)));
    BodyId last = left;
    for (int i = 0; i < 6; ++i) {
      const BodyId plank = add(world, body_at(at(0.4 * i, 0, 0)), with(box(0.19, 0.05, 0.3)));
      must(world.create_joint(joint_at(world, last, plank, BallJoint{}, {0.4 * i - 0.2, 0, 0})));
      last = plank;
    }
    const BodyId right = add(world, body_at(at(2.6, 0, 0), MotionType::Static), with(cube(0.1)));
    must(world.create_joint(joint_at(world, last, right, BallJoint{}, {2.2, 0, 0})));
    add(world, body_at(at(1, 0.4, 0)), with(cube(0.3), {}, 20000));
  };
  const Outcome chosen = play(ContactSolver::Auto, 3, loaded_bridge);
  EXPECT_EQ(chosen.steps_with_islands, 0u);
  EXPECT_EQ(chosen.hash, play(ContactSolver::SoftStep, 3, loaded_bridge).hash);
}

// A dense pile of 216 bodies under a block of a hundred times their weight: far too much for a
// step, so that it is tried now and then and otherwise left to soft steps, which the plan says.
TEST(AutoChoice, BoundsWhatAnIslandCosts) {
  const auto pressed_pile = [](PhysicsWorld& world) {
    add_floor(world);
    for (int i = 0; i < 216; ++i)
      add(world, body_at(at(0.52 * (i % 6), 0.26 + 0.51 * (i / 36), 0.52 * (i / 6 % 6))),
          with(cube(0.25)));
    add(world, body_at(at(1.3, 3.8, 1.3)), with(box(1.5, 0.3, 1.5), {}, 20000));
  };
  const Outcome chosen = play(ContactSolver::Auto, 5, pressed_pile);
  const Outcome always = play(ContactSolver::Newton, 0.05, pressed_pile);
  EXPECT_GT(always.steps_with_islands, 0u);
  EXPECT_LE(chosen.steps_with_islands, 5u);  // of 300

  PhysicsWorld world(no_sleep());
  pressed_pile(world);
  run(world, 1);
  const PlanDecision decision =
      world.plan().decisions[static_cast<std::size_t>(PlanItem::AccurateContacts)];
  EXPECT_FALSE(decision.active);
  EXPECT_NE(decision.reason.find("go on in soft steps"), std::string::npos) << decision.reason;
}

// What was called, and for how long, is part of a world's state.
TEST(AutoChoice, IsSavedWithTheWorld) {
  for (const double saved_after : {0.05, 0.1, 0.5}) {
    PhysicsWorld world(no_sleep());
    build_column(world, {20, 1, 0.01});
    run(world, saved_after);
    PhysicsWorld other;
    must(other.restore(world.save()));
    run(world, 0.5);
    run(other, 0.5);
    EXPECT_EQ(world.state_hash(), other.state_hash()) << saved_after;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
