// Proves that what a step tells about itself is right and free of side effects:
//   - the ledger's entries add up to the change of kinetic energy and of momentum, to round-off, in
//     scenes with contacts, bounces, friction, damping, joints, forces and locks
//   - entries have the sign and the size of what they stand for, by closed forms
//   - the estimate by step doubling is zero for free flight, and shrinks with the substeps
//   - neither changes a bit of the motion
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

PhysicsWorld ledger_world(WorldSettings settings = no_sleep()) {
  PhysicsWorld world(settings);
  world.set_diagnostics({.error_every = 0, .ledger = true});
  return world;
}

double size_of(const EnergyLedger& e) {
  return std::abs(e.gravity) + std::abs(e.forces) + std::abs(e.damping) + std::abs(e.normal) +
         std::abs(e.friction) + std::abs(e.restitution) + std::abs(e.recovery) +
         std::abs(e.joints) + std::abs(e.integrator) + std::abs(e.kinetic_change);
}

// Steps, and checks after every step that the books balance. `kinetic`: the world's own sum agrees.
void run_balanced(PhysicsWorld& world, double seconds, double dt = kDt) {
  double before = world.energy().kinetic_linear + world.energy().kinetic_angular;
  Vector3d momentum = world.energy().momentum;
  run(world, seconds, dt, [&] {
    const StepReport& report = world.last_report();
    const EnergyReport energy = world.energy();
    const double after = energy.kinetic_linear + energy.kinetic_angular;
    const double size = size_of(report.energy) + before + after;
    // Sums in double of numbers of at most this size; a few thousand of them.
    ASSERT_NEAR(report.energy.sum(), report.energy.kinetic_change, 1e-12 * size);
    // The world sums the same energies, from the rounded state.
    ASSERT_NEAR(report.energy.kinetic_change, after - before, 64 * kEps * size);
    const double moved = report.momentum.change.norm() + momentum.norm() +
                         report.momentum.gravity.norm() + report.momentum.contacts.norm();
    ASSERT_LE((report.momentum.sum() - report.momentum.change).norm(), 1e-12 * moved);
    ASSERT_LE((report.momentum.change - (energy.momentum - momentum)).norm(), 64 * kEps * moved);
    before = after;
    momentum = energy.momentum;
  });
}

TEST(Ledger, ClosesInAStackThatSettles) {
  PhysicsWorld world = ledger_world();
  build_stack(world, {.count = 5, .gap = 0.05, .shift = 0.01, .surface = material(0.6, 0.3)});
  run_balanced(world, 3);
}
TEST(Ledger, ClosesInAPile) {
  PhysicsWorld world = ledger_world();
  build_pile(world, {.side = 3});
  run_balanced(world, 2);
}
// The accurate solver keeps no account of friction: all of its contacts' work is under `normal`.
TEST(Ledger, ClosesUnderTheAccurateSolver) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::Newton;
  PhysicsWorld world = ledger_world(settings);
  build_pile(world, {.side = 3});
  run_balanced(world, 1);
}
TEST(Ledger, ClosesAmongBodiesThatMeetInFlight) {
  WorldSettings settings = no_sleep();
  settings.gravity = Vec3::Zero();
  PhysicsWorld world = ledger_world(settings);
  build_cluster(world, {});
  run_balanced(world, 2);
  EXPECT_LE(world.last_report().momentum.gravity.norm(), 0);
}
TEST(Ledger, ClosesWithDampingForcesLocksAndJoints) {
  PhysicsWorld world = ledger_world();
  add_floor(world, material(0.5));
  RigidBody slow = body_at(at(0, 3, 0));
  slow.linear_damping = real(0.3);
  slow.angular_damping = real(0.2);
  slow.angular_velocity = vec(1, 2, 3);
  const BodyId a = add(world, slow, with(box(0.5, 0.3, 0.2)));
  RigidBody locked = body_at(at(1, 3, 0));
  locked.locks.linear_z = locked.locks.angular_x = true;
  const BodyId b = add(world, locked, with(cube(0.3)));
  Joint joint;
  joint.body_a = a;
  joint.body_b = b;
  joint.frame_a.position = vec(0.5, 0, 0);
  joint.frame_b.position = vec(-0.5, 0, 0);
  joint.kind = BallJoint{};
  must(world.create_joint(joint));
  const BodyId pushed = add(world, body_at(at(5, 0.5, 0)), with(cube(0.5)));
  for (int i = 0; i < 90; ++i) {
    must(world.apply_force(pushed, vec(9000, 0, 300)));
    run_balanced(world, kDt);
    if (HasFatalFailure()) return;
  }
}

TEST(Ledger, FallAndDragAreWhatTheyAre) {
  PhysicsWorld world = ledger_world();
  RigidBody body = free_body(2, {1, 2, 3});
  body.linear_velocity = vec(0, -3, 0);
  must(world.create_body(body));
  world.step(kDt);
  const double path = 3 * kDt + 0.5 * kGravity * kDt * kDt;
  EXPECT_NEAR(world.last_report().energy.gravity, 2 * kGravity * path, 1e-5);
  EXPECT_NEAR(world.last_report().momentum.gravity.y(), -2 * kGravity * kDt, 1e-6);
  EXPECT_LE(std::abs(world.last_report().energy.integrator), bar(1e-12, 1e-4));
}

// A block that slides at v loses mu m g v dt to friction and nothing to anything else.
TEST(Ledger, SlidingLosesItsEnergyToFriction) {
  PhysicsWorld world = ledger_world();
  add_floor(world, material(0.5));
  const BodyId block =
      add(world, moving(at(0, 0.05, 0), vec(10, 0, 0)), with(box(0.5, 0.05, 0.5), material(0.5)));
  run_balanced(world, 0.5);
  const double m = world.mass_properties(block).mass, v = velocity(world, block).x();
  world.step(kDt);
  const EnergyLedger& e = world.last_report().energy;
  const double loss = 0.5 * m * (v * v - std::pow(v - 0.5 * kGravity * kDt, 2));
  EXPECT_NEAR(e.friction, -loss, 0.01 * loss);
  EXPECT_LE(std::abs(e.normal + e.recovery + e.gravity + e.integrator), 0.01 * loss);
}

// An elastic bounce takes nothing; one with e takes 1 - e^2 of the energy of approach.
TEST(Ledger, BouncesGoUnderRestitution) {
  for (const double e : {1.0, 0.6}) {
    PhysicsWorld world = ledger_world();
    add_floor(world, material(0, e));
    const BodyId ball = add(world, body_at(at(0, 1.5, 0)), with(sphere(0.5), material(0, e)));
    const double m = world.mass_properties(ball).mass;
    double bounced = 0;
    run(world, 0.6, kDt, [&] { bounced += world.last_report().energy.restitution; });
    const double approach = m * kGravity * 1;
    EXPECT_NEAR(bounced, -(1 - e * e) * approach, 1e-3 * approach) << e;
  }
}

TEST(Diagnostics, ChangeNoBitOfTheMotion) {
  std::vector<std::uint64_t> hashes;
  for (const StepDiagnostics diagnostics :
       {StepDiagnostics{}, StepDiagnostics{.ledger = true}, StepDiagnostics{.error_every = 3}}) {
    PhysicsWorld world;
    world.set_diagnostics(diagnostics);
    build_pile(world, {.side = 3});
    run(world, 2);
    hashes.push_back(world.state_hash());
    EXPECT_EQ(world.diagnostics().error_every, diagnostics.error_every);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Diagnostics, SayNothingUnlessAsked) {
  PhysicsWorld world;
  build_stack(world, {.count = 3});
  run(world, 0.5);
  EXPECT_FALSE(world.last_report().error.measured);
  EXPECT_EQ(size_of(world.last_report().energy), 0);
}

TEST(ErrorEstimate, ComesEverySoManyStepsAndIsZeroInFreeFlight) {
  PhysicsWorld world;
  world.set_diagnostics({.error_every = 4});
  RigidBody body = free_body(1, {1, 2, 3});
  body.angular_velocity = vec(1, 2, 3);
  must(world.create_body(body));
  int measured = 0;
  run(world, 1, kDt, [&] {
    const ErrorEstimate& error = world.last_report().error;
    measured += error.measured ? 1 : 0;
    EXPECT_EQ(error.position, 0);
    EXPECT_LE(error.angle, 4 * kEps);
    EXPECT_TRUE(error.worst.is_null());
  });
  EXPECT_EQ(measured, 15);
}

// A pendulum's step is second order: four times fewer errors a step for twice the substeps, at
// least; and the estimate is as large as the error it stands for, within a factor of two.
TEST(ErrorEstimate, FallsWithTheSubstepsAndIsAsLargeAsTheError) {
  const auto swing = [](int substeps) {
    WorldSettings settings = no_sleep();
    settings.substeps = substeps;
    PhysicsWorld world(settings);
    world.set_diagnostics({.error_every = 1});
    const BodyId bob = must(world.create_body([] {
      RigidBody body = free_body(1, {0.1, 0.1, 0.1});
      body.pose = at(1, 0, 0);
      return body;
    }()));
    Joint joint;
    joint.body_b = bob;
    joint.frame_b.position = vec(-1, 0, 0);
    joint.kind = BallJoint{};
    must(world.create_joint(joint));
    run(world, 0.5);
    PhysicsWorld fine;
    must(fine.restore(world.save()));
    settings.substeps = 64;
    must(fine.set_settings(settings));
    fine.step(kDt);
    world.step(kDt);
    const double truth = (position(fine, bob) - position(world, bob)).norm();
    return std::pair{world.last_report().error.position, truth};
  };
  const auto [coarse, coarse_truth] = swing(1);
  const auto [finer, finer_truth] = swing(2);
  EXPECT_GT(coarse, 0);
  EXPECT_LE(finer, coarse);
  EXPECT_GE(coarse, 0.5 * coarse_truth);
  EXPECT_LE(coarse, 2 * coarse_truth);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
