// Proves that a step tolerance is kept: islands with fewer substeps than the world's err by less
// than they may, gain no energy when their level of detail changes, and have the same bits for any
// number of threads, with the ledger, and when restored; and that without a tolerance, or with
// substeps that cannot be halved, everything is as ever.
#include <gtest/gtest.h>

#include "support/field.h"
#include "support/measure.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr int kSteps = 150;

WorldSettings settings_with(double tolerance, int substeps) {
  WorldSettings settings;
  settings.sleeping = false;
  settings.substeps = substeps;
  settings.step_tolerance = real(tolerance);
  return settings;
}

// [m] the farthest that a body of an island is in one world from where it is in another.
double apart(const PhysicsWorld& a, const PhysicsWorld& b, const std::vector<BodyId>& island) {
  double most = 0;
  for (const BodyId body : island)
    most = std::max(most, (position(a, body) - position(b, body)).norm());
  return most;
}

// What is delivered in each step is compared with the same step with 64 substeps.
struct Delivered {
  int looks = 0, beyond = 0;  // islands looked at, and those that err by more than they may
  double coarse = 0;          // [-] share of the bodies with fewer substeps
};
Delivered deliver(double tolerance, int substeps) {
  PhysicsWorld world(settings_with(tolerance, substeps));
  PhysicsWorld fine;
  const Field field = build_field(world, 200);
  Delivered out;
  double coarse = 0, awake = 0;
  for (int i = 0; i < kSteps; ++i) {
    const bool look = i % 5 == 4;
    if (look) {
      must(fine.restore(world.save()));
      must(fine.set_settings(settings_with(0, 64)));
      fine.step(kDt);
    }
    const StepReport& report = world.step(kDt);
    coarse += report.coarse_bodies;
    awake += report.awake_bodies;
    if (!look) continue;
    for (const std::vector<BodyId>& island : field.islands) {
      ++out.looks;
      if (apart(world, fine, island) > tolerance) ++out.beyond;
    }
  }
  out.coarse = coarse / awake;
  return out;
}

TEST(StepLevels, NinetyNineOfAHundredIslandsKeepTheTolerance) {
  for (const double tolerance : {1e-3, 2e-4}) {
    const Delivered delivered = deliver(tolerance, 32);
    EXPECT_LE(100 * delivered.beyond, delivered.looks) << tolerance;
    EXPECT_GT(delivered.coarse, 0.9) << tolerance;
  }
}

// [m] of height that the energy of an island is worth.
double energy_height(const PhysicsWorld& world, const std::vector<BodyId>& island) {
  double energy = 0, weight = 0;
  for (const BodyId body : island) {
    const MassProperties mass = world.mass_properties(body);
    const Eigen::Vector3d v = velocity(world, body);
    const Eigen::Vector3d w = orientation(world, body).conjugate() * spin(world, body);
    weight += mass.mass * kGravity;
    energy += 0.5 * mass.mass * v.squaredNorm() + 0.5 * w.dot(mass.I_Bcm_B * w) +
              mass.mass * kGravity * position(world, body).y();
  }
  return energy / weight;
}
// The most that each island gains in a step.
std::vector<double> gains(double tolerance) {
  PhysicsWorld world(settings_with(tolerance, 16));
  const Field field = build_field(world, 100);
  std::vector<double> most(field.islands.size()), before(field.islands.size());
  const auto each = [&](auto&& task) {
    for (std::size_t k = 0; k < field.islands.size(); ++k)
      task(k, energy_height(world, field.islands[k]));
  };
  each([&](std::size_t k, double height) { before[k] = height; });
  for (int i = 0; i < 240; ++i) {
    world.step(kDt);
    each([&](std::size_t k, double height) {
      most[k] = std::max(most[k], height - before[k]);
      before[k] = height;
    });
  }
  return most;
}

TEST(StepLevels, ChangingThemGainsNoEnergy) {
  const std::vector<double> uniform = gains(0);
  for (const double tolerance : {1e-3, 1e-4}) {
    const std::vector<double> levels = gains(tolerance);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      // What gains energy as it begins, because it overlaps or lies unevenly, does so anyway.
      EXPECT_LT(levels[k], 1.2 * uniform[k] + 0.5 * tolerance) << "island " << k;
      if (k % 10 < 4) {
        EXPECT_LT(levels[k], 1e-7) << "stack " << k;
      }
    }
  }
}

// No contact gets softer for having longer substeps.
TEST(StepLevels, ColumnsSinkNoDeeper) {
  for (const int count : {3, 10, 20}) {
    std::vector<double> tops;
    for (const double tolerance : {0.0, 1e-2}) {
      WorldSettings settings = settings_with(tolerance, 16);
      settings.contact_solver = ContactSolver::SoftStep;
      PhysicsWorld world(settings);
      const Built column = build_stack(world, {.count = count});
      run(world, 10, kDt);
      tops.push_back(position(world, column.bodies.back()).y());
      EXPECT_EQ(world.last_report().coarse_bodies,
                tolerance > 0 ? static_cast<std::uint32_t>(count) : 0u);
    }
    EXPECT_NEAR(tops[1], tops[0], 1e-4) << count << " boxes";
  }
}

std::vector<std::uint64_t> hashes(const WorldSettings& settings, JobSystem* jobs = nullptr,
                                  bool ledger = false) {
  PhysicsWorld world(settings);
  world.set_job_system(jobs);
  world.set_diagnostics({.ledger = ledger});
  build_field(world, 120);
  std::vector<std::uint64_t> out;
  for (int i = 0; i < 90; ++i) {
    EXPECT_TRUE(world.step(kDt).status.ok());
    out.push_back(world.state_hash());
  }
  return out;
}

TEST(StepLevels, SameBitsForAnyNumberOfThreadsAndWithTheLedger) {
  const WorldSettings settings = settings_with(1e-3, 16);
  const std::vector<std::uint64_t> serial = hashes(settings);
  EXPECT_NE(serial, hashes(settings_with(0, 16)));
  for (const int threads : {2, 4}) {
    const std::unique_ptr<JobSystem> pool = make_thread_pool(threads);
    EXPECT_EQ(serial, hashes(settings, pool.get())) << threads << " threads";
  }
  EXPECT_EQ(serial, hashes(settings, nullptr, true));
}

TEST(StepLevels, TheLedgerCloses) {
  PhysicsWorld world(settings_with(1e-3, 16));
  world.set_diagnostics({.ledger = true});
  build_field(world, 40);
  std::uint32_t coarse = 0;
  for (int i = 0; i < 90; ++i) {
    const StepReport& report = world.step(kDt);
    coarse += report.coarse_bodies;
    const EnergyLedger& e = report.energy;
    const double largest = std::abs(e.gravity) + std::abs(e.normal) + std::abs(e.friction) + 1;
    EXPECT_NEAR(e.sum(), e.kinetic_change, 1e-4 * largest) << "step " << i;
  }
  EXPECT_GT(coarse, 0u);
}

TEST(StepLevels, RestoredInAnyStepTheyGoOn) {
  PhysicsWorld world(settings_with(1e-3, 16)), other;
  build_field(world, 60);
  for (int i = 0; i < 60; ++i) {
    must(other.restore(world.save()));
    other.step(kDt);
    world.step(kDt);
    ASSERT_EQ(world.state_hash(), other.state_hash()) << "step " << i;
    ASSERT_TRUE(world.save() == other.save()) << "step " << i;
  }
  EXPECT_GT(world.last_report().coarse_bodies, 0u);
}

TEST(StepLevels, SubstepsThatCannotBeHalvedStay) {
  for (const int substeps : {1, 2, 3, 5})
    EXPECT_EQ(hashes(settings_with(0, substeps)), hashes(settings_with(1e-3, substeps)))
        << substeps << " substeps";
}

TEST(StepLevels, WhatJointsHoldHasAllSubsteps) {
  PhysicsWorld world(settings_with(1e-2, 16));
  add_slab(world, 20, 20);
  const BodyId a = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  const BodyId b = add(world, body_at(at(3, 0.5, 0)), with(cube(0.5)));
  Joint rope;
  rope.body_a = a;
  rope.body_b = b;
  rope.kind = RopeJoint{real(4)};
  must(world.create_joint(rope));
  for (int i = 0; i < 30; ++i) EXPECT_EQ(world.step(kDt).coarse_bodies, 0u);
  add(world, body_at(at(0, 0.5, 5)), with(cube(0.5)));
  for (int i = 0; i < 30; ++i) world.step(kDt);
  EXPECT_EQ(world.last_report().coarse_bodies, 1u);
}

// The plan says so from the step on in which an island has fewer, and forced off it has all.
TEST(StepLevels, StandInThePlanAndMayBeForcedOff) {
  PhysicsWorld world(settings_with(1e-2, 16));
  add_slab(world, 20, 20);
  add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  EXPECT_FALSE(world.plan().active(PlanItem::StepLevels));
  for (int i = 0; i < 30; ++i) world.step(kDt);
  ASSERT_EQ(world.last_report().coarse_bodies, 1u);
  const PlanDecision usual = world.plan().decisions[static_cast<std::size_t>(PlanItem::StepLevels)];
  EXPECT_TRUE(usual.active);
  EXPECT_NE(usual.reason.find("1 of 1 awake bodies"), std::string::npos) << usual.reason;

  WorldSettings all = world.settings();
  all.forced.set(PlanItem::StepLevels, Choice::Off);
  PhysicsWorld forced, none;
  must(forced.restore(world.save()));
  must(forced.set_settings(all));
  EXPECT_FALSE(forced.plan().active(PlanItem::StepLevels));
  // The same as without a tolerance.
  must(none.restore(world.save()));
  must(none.set_settings(settings_with(0, 16)));
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(forced.step(kDt).coarse_bodies, 0u);
    none.step(kDt);
  }
  for (const BodyState& state : states(none))
    EXPECT_EQ(position(forced, state.id), position(none, state.id));
}

TEST(StepLevels, RefuseWhatIsNoTolerance) {
  PhysicsWorld world(settings_with(1e-3, 16));
  for (const double wrong : {-1e-9, std::nan(""), double{INFINITY}}) {
    EXPECT_EQ(world.set_settings(settings_with(wrong, 16)).code, StatusCode::OutOfRange) << wrong;
    EXPECT_EQ(world.settings().step_tolerance, real(1e-3));
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
