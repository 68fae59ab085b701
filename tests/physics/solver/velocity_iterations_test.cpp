// Invariant: WorldSettings::velocity_iterations repeats both passes over the contacts, for loose
// rows and for those side by side alike: it brings impulses nearer to the law, changes no account
// of energy, and is checked, saved and the same on every kernel and number of threads.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/replay_checks.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

WorldSettings passes(int count, int substeps = 4) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::SoftStep;
  settings.velocity_iterations = count;
  settings.substeps = substeps;
  return settings;
}

// [-] How far the contacts of a column that has just been set down are from carrying what lies on
// them, each against the weight above it.
double force_error(int count, int iterations) {
  PhysicsWorld world(passes(iterations, 1));
  const Built column = build_column(world, {count});
  world.step(kDt);
  const double weight = world.mass_properties(column.bodies[0]).mass * kGravity;
  double square = 0;
  world.each_contact([&](const ContactState& contact) {
    double impulse = 0;
    for (int i = 0; i < contact.point_count; ++i)
      impulse += static_cast<double>(contact.points[i].normal_impulse);
    const double height = static_cast<double>(contact.points[0].position.y());
    const double above = count - std::round(height);
    square += std::pow(impulse / kDt / (above * weight) - 1, 2);
  });
  return std::sqrt(square / count);
}

TEST(VelocityIterations, BringForcesNearerToTheWeights) {
  double last = force_error(10, 1);
  for (const int iterations : {4, 16, 64}) {
    const double now = force_error(10, iterations);
    EXPECT_LT(now, last) << iterations;
    last = now;
  }
  EXPECT_LT(last, 0.1 * force_error(10, 1));
}

TEST(VelocityIterations, AreTheSameBitsOnEveryKernelAndWithThreads) {
  std::vector<std::uint64_t> hashes;
  const auto run_with = [&](int bits, int threads) {
    const std::unique_ptr<JobSystem> pool = threads > 1 ? make_thread_pool(threads) : nullptr;
    PhysicsWorld world(passes(3));
    world.set_job_system(pool.get());
    StepDiagnostics diagnostics;
    diagnostics.kernel_bits = bits;
    world.set_diagnostics(diagnostics);
    build_pile(world, {.side = 4});
    run(world, 2);
    hashes.push_back(world.state_hash());
  };
  for (const int bits : {1, 128, 256, 0}) run_with(bits, 1);
  run_with(0, 4);
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TEST(VelocityIterations, LeaveTheLedgerClosed) {
  PhysicsWorld world(passes(4));
  StepDiagnostics diagnostics;
  diagnostics.ledger = true;
  world.set_diagnostics(diagnostics);
  build_pile(world, {.side = 3});
  run(world, 1, kDt, [&] {
    const EnergyLedger& e = world.last_report().energy;
    const MomentumLedger& m = world.last_report().momentum;
    const EnergyReport energy = world.energy();
    const double size = std::abs(e.gravity) + std::abs(e.normal) + std::abs(e.friction) +
                        energy.kinetic_linear + energy.kinetic_angular;
    ASSERT_NEAR(e.sum(), e.kinetic_change, 1e-12 * size);
    ASSERT_LE((m.sum() - m.change).norm(), 1e-12 * (m.gravity.norm() + m.contacts.norm() + 1));
  });
}

// Resistance to rolling forgets its impulses at the first pass of a substep only: a ball that rolls
// comes to rest where one pass brings it to rest.
TEST(VelocityIterations, LetRollingFrictionStopABallWhereItShould) {
  double ways[2];
  for (const int k : {0, 1}) {
    PhysicsWorld world(passes(k == 0 ? 1 : 8));
    Material surface = material(0.8);
    surface.rolling_friction = real(0.02);
    add_floor(world, surface);
    RigidBody ball = moving(at(0, 0.5, 0), vec(2, 0, 0));
    ball.angular_velocity = vec(0, 0, -4);
    const BodyId body = add(world, ball, with(sphere(0.5), surface));
    run(world, 10);
    ways[k] = position(world, body).x();
  }
  EXPECT_GT(ways[0], 1);
  EXPECT_NEAR(ways[1], ways[0], 0.01 * ways[0]);
}

TEST(VelocityIterations, AreCheckedAndSaved) {
  PhysicsWorld world;
  EXPECT_EQ(world.settings().velocity_iterations, 1);
  for (const int wrong : {0, -1, 65}) {
    EXPECT_EQ(world.set_settings(passes(wrong)).code, StatusCode::OutOfRange) << wrong;
    EXPECT_EQ(world.settings().velocity_iterations, 1);
  }
  must(world.set_settings(passes(64)));
  PhysicsWorld other;
  must(other.restore(world.save()));
  EXPECT_EQ(other.settings().velocity_iterations, 64);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
