// Invariant: the recording has the ledger of every step in which it was kept, bit by bit, under
// names with units; its entries add up to what the bodies gained, to round-off; and there is
// nothing of it while it is off.
#include <cmath>
#include <functional>
#include <numeric>

#include "drawn_rows.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using replay_test::kDt;
using replay_test::rows_of;
using replay_test::TemporaryFolder;

constexpr int kSteps = 60;
const std::string kMomentum[] = {"plots/ledger/momentum_x", "plots/ledger/momentum_y",
                                 "plots/ledger/momentum_z"};

// Boxes that land, bounce and slide under a steady push, one of them damped, and a pendulum.
// before_step(world, step number).
void record(const std::string& path,
            const std::function<void(PhysicsWorld&, std::uint64_t)>& before_step,
            const std::function<void(const PhysicsWorld&)>& after_step) {
  PhysicsWorld world(no_sleep());
  const Built stack =
      build_stack(world, {.count = 3, .gap = 0.05, .shift = 0.02, .surface = material(0.5, 0.3)});
  RigidBody body = body_at(at(4, 3, 0));
  body.linear_damping = real(0.2);
  const BodyId bob = add(world, body, with(sphere(0.25)));
  Joint joint;
  joint.body_b = bob;
  joint.frame_a.position = vec(3, 3, 0);
  joint.frame_b.position = vec(-1, 0, 0);
  joint.kind = BallJoint{};
  must(world.create_joint(joint));
  replay::Recorder recorder;
  ASSERT_TRUE(recorder.open({.path = path}).ok());
  world.attach(&recorder);
  for (std::uint64_t step = 1; step <= kSteps; ++step) {
    before_step(world, step);
    must(world.apply_force(stack.bodies[0], vec(9000, 0, 500)));
    ASSERT_TRUE(world.step(kDt).status.ok());
    after_step(world);
  }
  world.detach(&recorder);
  ASSERT_TRUE(recorder.close().ok());
}

void keep_ledger(PhysicsWorld& world) {
  StepDiagnostics diagnostics;
  diagnostics.ledger = true;
  world.set_diagnostics(diagnostics);
}

std::vector<std::string> names_of(const std::string& path, const std::string& entity) {
  std::vector<std::string> names;
  const auto read = rrd::read(path, entity, [&](const rrd::Cell& cell) {
    if (cell.entity() == entity && cell.component() == "SeriesLines:names") {
      names.clear();
      for (std::size_t i = 0; i < cell.instances(); ++i) names.emplace_back(cell.text(i));
    }
    return true;
  });
  EXPECT_TRUE(read.outcome.ok()) << read.outcome.error;
  return names;
}

// The last three numbers: all entries but these add up to the first of them, and the last is what
// is missing.
void expect_closed(const std::vector<double>& row) {
  ASSERT_GT(row.size(), 2u);
  const auto change = row.end() - 2;
  const double size = std::accumulate(row.begin(), row.end(), 0.0,
                                      [](double sum, double x) { return sum + std::abs(x); });
  EXPECT_NEAR(std::accumulate(row.begin(), change, 0.0), *change, 1e-12 * size);
  EXPECT_NEAR(row.back(), 0, 1e-12 * size);
}

TEST(RecordedLedger, IsThatOfTheStepsAndCloses) {
  const TemporaryFolder folder;
  const std::string path = folder.file("ledger.rrd");
  std::map<std::uint64_t, EnergyLedger> energies;
  std::map<std::uint64_t, MomentumLedger> momenta;
  record(
      path,
      [](PhysicsWorld& world, std::uint64_t step) {
        if (step == 1) keep_ledger(world);
      },
      [&](const PhysicsWorld& world) {
        energies[world.step_count()] = world.last_report().energy;
        momenta[world.step_count()] = world.last_report().momentum;
      });
  const auto rows = rows_of<double>(path, "plots/ledger/energy", "Scalars:scalars");
  ASSERT_EQ(rows.size(), std::size_t{kSteps});
  EnergyLedger seen;
  for (const auto& [step, row] : rows) {
    const EnergyLedger& e = energies.at(step);
    const std::vector<double> expected{e.gravity,
                                       e.forces,
                                       e.damping,
                                       e.normal,
                                       e.friction,
                                       e.restitution,
                                       e.recovery,
                                       e.joints,
                                       e.integrator,
                                       e.kinetic_change,
                                       e.kinetic_change - e.sum()};
    EXPECT_EQ(row, expected) << step;
    expect_closed(row);
    seen.forces += std::abs(e.forces);
    seen.damping += std::abs(e.damping);
    seen.friction += std::abs(e.friction);
    seen.restitution += std::abs(e.restitution);
    seen.joints += std::abs(e.joints);
  }
  // The scene has something of each.
  for (const double entry :
       {seen.forces, seen.damping, seen.friction, seen.restitution, seen.joints})
    EXPECT_GT(entry, 0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string& entity = kMomentum[axis];
    const auto along = rows_of<double>(path, entity, "Scalars:scalars");
    ASSERT_EQ(along.size(), std::size_t{kSteps}) << entity;
    for (const auto& [step, row] : along) {
      const MomentumLedger& m = momenta.at(step);
      ASSERT_EQ(row.size(), 7u);
      EXPECT_EQ(row[0], m.gravity[axis]);
      EXPECT_EQ(row[3], m.contacts[axis]);
      EXPECT_EQ(row[5], m.change[axis]);
      expect_closed(row);
    }
  }
}

TEST(RecordedLedger, NamesEveryCurveWithItsUnit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("names.rrd");
  record(
      path,
      [](PhysicsWorld& world, std::uint64_t step) {
        if (step == 1) keep_ledger(world);
      },
      [](const PhysicsWorld&) {});
  const std::vector<std::string> energy{"gravity [J]",        "forces [J]",   "damping [J]",
                                        "normal [J]",         "friction [J]", "restitution [J]",
                                        "recovery [J]",       "joints [J]",   "integrator [J]",
                                        "kinetic change [J]", "residual [J]"};
  EXPECT_EQ(names_of(path, "plots/ledger/energy"), energy);
  const std::vector<std::string> momentum{
      "gravity [kg m/s]", "forces [kg m/s]", "damping [kg m/s]", "contacts [kg m/s]",
      "joints [kg m/s]",  "change [kg m/s]", "residual [kg m/s]"};
  for (const std::string& entity : kMomentum) EXPECT_EQ(names_of(path, entity), momentum) << entity;
}

TEST(RecordedLedger, IsThereFromTheStepOnInWhichItIsSwitchedOn) {
  const TemporaryFolder folder;
  const std::string path = folder.file("late.rrd"), none = folder.file("none.rrd");
  constexpr std::uint64_t kOn = 40;
  record(
      path,
      [](PhysicsWorld& world, std::uint64_t step) {
        if (step == kOn) keep_ledger(world);
      },
      [](const PhysicsWorld&) {});
  const auto rows = rows_of<double>(path, "plots/ledger/energy", "Scalars:scalars");
  ASSERT_EQ(rows.size(), kSteps - kOn + 1);
  EXPECT_EQ(rows.begin()->first, kOn);
  record(
      none, [](PhysicsWorld&, std::uint64_t) {}, [](const PhysicsWorld&) {});
  EXPECT_TRUE(rows_of<double>(none, "plots/ledger", "Scalars:scalars").empty());
  EXPECT_TRUE(names_of(none, "plots/ledger/energy").empty());
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
