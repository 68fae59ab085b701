// Invariant: ContactSolver::WorstFirst does what the textbook says. One impact ends by the closed
// form; several at once end as a list of one-dimensional impacts does that always takes the fastest
// next; what rests, rests; its impulses are reported, its books close, and it is the same with any
// number of threads. And it is no more than the textbook: heavy on light falls, tall columns too.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/replay_checks.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

WorldSettings worst_first(bool gravity = true, int substeps = 4) {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::WorstFirst;
  settings.substeps = substeps;
  if (!gravity) settings.gravity = Vec3::Zero();
  return settings;
}

// --- one impact ---

TEST(WorstFirst, TwoBallsPartByTheClosedForm) {
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double ratio : {0.1, 1.0, 20.0}) {
      PhysicsWorld world(worst_first(false));
      const auto ball = [&](double x, double v, double density) {
        return add(world, moving(at(x, 0, 0), vec(v, 0, 0)),
                   with(sphere(0.5), material(0, e), density));
      };
      const BodyId a = ball(0, 3, 1000), b = ball(1.1, -1, 1000 * ratio);
      run(world, 1);
      // m_a = 1, m_b = ratio: v = (momentum -+ other mass * e * closing speed) / mass
      const double momentum = 3 - ratio, mass = 1 + ratio, closing = 4;
      EXPECT_NEAR(velocity(world, a).x(), (momentum - ratio * e * closing) / mass, 1e-5);
      EXPECT_NEAR(velocity(world, b).x(), (momentum + e * closing) / mass, 1e-5);
    }
  }
}

// A ball falls on a rough floor with 2 m/s sideways: where friction suffices it leaves rolling, at
// 5/7 of the speed; where not, slower by mu (1 + e) times the speed of the impact.
TEST(WorstFirst, ARoughBounceTurnsTheBall) {
  for (const double mu : {0.02, 0.6}) {
    const double e = 0.5, v0 = 2, down = 4;
    PhysicsWorld world(worst_first(false));
    add_floor(world, material(mu, e));
    const BodyId ball =
        add(world, moving(at(0, 0.6, 0), vec(v0, -down, 0)), with(sphere(0.5), material(mu, e)));
    run(world, 0.2);
    const double slides = v0 - mu * (1 + e) * down, rolls = v0 * 5 / 7;
    EXPECT_NEAR(velocity(world, ball).x(), std::max(slides, rolls), 1e-4) << mu;
    EXPECT_NEAR(velocity(world, ball).y(), e * down, 1e-4) << mu;
  }
}

// A rod struck at its end: both momenta are kept, and energy is lost, not made.
TEST(WorstFirst, AnOffCentreImpactKeepsBothMomenta) {
  PhysicsWorld world(worst_first(false));
  const Material surface = material(0.4, 0.6);
  add(world, body_at(at(0, 0, 0)), with(box(0.2, 0.2, 2), surface));
  add(world, moving(at(1, 0.05, 1.7), vec(-5, 0, 0)), with(cube(0.3), surface));
  const EnergyReport before = world.energy();
  run(world, 0.5);
  const EnergyReport after = world.energy();
  EXPECT_GT((after.momentum - before.momentum).norm() + before.total() - after.total(), 1);
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e-5 * before.momentum.norm());
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(),
            2e-3 * before.angular_momentum.norm());
  EXPECT_LT(after.total(), before.total());
}

// --- the order ---

// Balls in a row that all touch, by the rule alone: of the impacts that close, one by one, by which
// `before(closing speed, of the best so far)` chooses.
template <class Before>
std::vector<double> resolve_in_order(std::vector<double> v, const std::vector<double>& m, double e,
                                     const Before& before) {
  for (int k = 0; k < 1000; ++k) {
    std::size_t next = 0;
    double closing = 0;
    for (std::size_t i = 0; i + 1 < v.size(); ++i) {
      const double c = v[i] - v[i + 1];
      if (c > 1e-9 && (closing == 0 || before(c, closing))) next = i, closing = c;
    }
    if (closing == 0) break;
    const double impulse = (1 + e) * closing * m[next] * m[next + 1] / (m[next] + m[next + 1]);
    v[next] -= impulse / m[next];
    v[next + 1] += impulse / m[next + 1];
  }
  return v;
}

TEST(WorstFirst, TakesTheContactThatClosesFastestNext) {
  const std::vector<double> start{3, 0.5, 0, -2.2, -2.5}, masses{1, 3, 2, 0.5, 1.5};
  const double e = 0.5;
  PhysicsWorld world(worst_first(false, 1));
  std::vector<BodyId> balls;
  const double overlap = 2e-4;  // [m] all touch, by less than is corrected
  for (std::size_t i = 0; i < start.size(); ++i)
    balls.push_back(
        add(world, moving(at((1 - overlap) * static_cast<double>(i), 0, 0), vec(start[i], 0, 0)),
            with(sphere(0.5), material(0, e), 1000 * masses[i])));
  world.step(1e-5);
  const auto fastest = [](double c, double best) { return c > best; };
  const auto slowest = [](double c, double best) { return c < best; };
  const auto first = [](double, double) { return false; };
  const std::vector<double> wanted = resolve_in_order(start, masses, e, fastest);
  double from_slowest = 0, from_first = 0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double v = velocity(world, balls[i]).x();
    EXPECT_NEAR(v, wanted[i], 1e-4) << i;
    from_slowest += std::abs(v - resolve_in_order(start, masses, e, slowest)[i]);
    from_first += std::abs(v - resolve_in_order(start, masses, e, first)[i]);
  }
  // Other orders end elsewhere.
  EXPECT_GT(from_slowest, 0.05);
  EXPECT_GT(from_first, 0.05);
}

// Newton's cradle, the textbook's success: one ball in, one ball out.
TEST(WorstFirst, ACradlePassesOneBallOn) {
  PhysicsWorld world(worst_first(false));
  const std::vector<BodyId> balls = build_cradle(world, {});
  run(world, 1);
  for (std::size_t i = 0; i < balls.size(); ++i)
    EXPECT_NEAR(velocity(world, balls[i]).x(), i + 1 == balls.size() ? 1 : 0, 1e-4) << i;
}

// --- rest ---

TEST(WorstFirst, ABoxRestsWithinTheToleranceOfItsPositions) {
  PhysicsWorld world(worst_first());
  const Built column = build_column(world, {1});
  const Vector3d start = position(world, column.bodies[0]);
  const double weight = world.mass_properties(column.bodies[0]).mass * kGravity;
  double worst = 0, impulse = 0;
  run(world, 5, kDt, [&] {
    worst = std::max(worst, (position(world, column.bodies[0]) - start).norm());
    if (world.time() <= 1) return;
    world.each_contact([&](const ContactState& contact) {
      for (int i = 0; i < contact.point_count; ++i)
        impulse += static_cast<double>(contact.points[i].normal_impulse);
    });
  });
  EXPECT_LE(worst, 0.004);  // [m] two slops of a box of 1 m
  EXPECT_NEAR(impulse / (4 * weight), 1, 0.05);
}

// 17 degrees, mu 0.5: it sticks, but for a creep of a centimetre a second, as nothing is
// remembered.
TEST(WorstFirst, ASlopeHoldsABox) {
  PhysicsWorld world(worst_first());
  const OnSlope on = build_slope(world, {.angle = 0.3, .friction = 0.5});
  const Vector3d start = position(world, on.body);
  run(world, 2);
  EXPECT_LE((position(world, on.body) - start).norm(), 0.04);
}

// 40 degrees: a body on one point slides as it should. A box slides a fifth too far: while it rocks
// from corner to corner, one of them may stick by turning the box, with less friction than it could
// have.
TEST(WorstFirst, ASlopeLetsSlide) {
  const double angle = 0.7, mu = 0.5;
  const double wanted = 0.5 * (std::sin(angle) - mu * std::cos(angle)) * kGravity * 4;
  const auto way = [&](bool box) {
    PhysicsWorld world(worst_first());
    OnSlope on = build_slope(world, {.angle = angle, .friction = mu});
    if (!box) {
      must(world.destroy_body(on.body));
      RigidBody body = body_at(at(Vector3d(0.5 * on.normal), Quat::Identity()));
      body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
      on.body = add(world, body, with(sphere(0.5), material(mu)));
    }
    const Vector3d start = position(world, on.body);
    run(world, 2);
    return (position(world, on.body) - start).dot(on.down) / wanted;
  };
  EXPECT_NEAR(way(false), 1, 0.01);
  EXPECT_GT(way(true), 1.1);
  EXPECT_LT(way(true), 1.3);
}

// What the textbook's resolver is compared for: a few boxes stand, heavy ones on light ones fall,
// where the other solvers hold both.
TEST(WorstFirst, StacksStandWhereTheyAreLowAndAlike) {
  const auto moved = [](ContactSolver solver, const Column& column) {
    WorldSettings settings = worst_first();
    settings.contact_solver = solver;
    PhysicsWorld world(settings);
    const Built built = build_column(world, column);
    const Vector3d start = position(world, built.bodies.back());
    run(world, 5);
    return (position(world, built.bodies.back()) - start).norm();
  };
  EXPECT_LE(moved(ContactSolver::WorstFirst, {5}), 0.03);
  EXPECT_GE(moved(ContactSolver::WorstFirst, {10, 2}), 1);
  EXPECT_LE(moved(ContactSolver::Newton, {10, 2}), 0.03);
}

// --- as a part of the engine ---

TEST(WorstFirst, LeavesTheLedgerClosed) {
  PhysicsWorld world(worst_first());
  StepDiagnostics diagnostics;
  diagnostics.ledger = true;
  world.set_diagnostics(diagnostics);
  build_pile(world, {.side = 3});
  run(world, 1.5, kDt, [&] {
    const EnergyLedger& e = world.last_report().energy;
    const MomentumLedger& m = world.last_report().momentum;
    const EnergyReport energy = world.energy();
    const double size = std::abs(e.gravity) + std::abs(e.normal) + std::abs(e.recovery) +
                        energy.kinetic_linear + energy.kinetic_angular;
    ASSERT_NEAR(e.sum(), e.kinetic_change, 1e-12 * size);
    ASSERT_LE((m.sum() - m.change).norm(), 1e-12 * (m.gravity.norm() + m.contacts.norm() + 1));
    ASSERT_LE(std::abs(e.friction) + std::abs(e.restitution), 0.0);  // all is under normal
  });
}

TEST(WorstFirst, IsTheSameWithThreadsAndAfterARestore) {
  std::set<std::uint64_t> hashes;
  for (const int threads : {1, 4}) {
    const std::unique_ptr<JobSystem> pool = threads > 1 ? make_thread_pool(threads) : nullptr;
    PhysicsWorld world(worst_first());
    world.set_job_system(pool.get());
    build_pile(world, {.side = 3});
    run(world, 1);
    PhysicsWorld restored;
    must(restored.restore(world.save()));
    EXPECT_EQ(restored.settings().contact_solver, ContactSolver::WorstFirst);
    run(world, 0.5);
    run(restored, 0.5);
    EXPECT_TRUE(all_finite(world));
    hashes.insert(world.state_hash());
    hashes.insert(restored.state_hash());
  }
  EXPECT_EQ(hashes.size(), 1u);
}

// A plan that forces the accurate contacts on or off goes before it.
TEST(WorstFirst, GivesWayToAForcedPlan) {
  const auto hash_of = [](ContactSolver solver, Choice accurate) {
    WorldSettings settings = worst_first();
    settings.contact_solver = solver;
    settings.forced.set(PlanItem::AccurateContacts, accurate);
    PhysicsWorld world(settings);
    build_pile(world, {.side = 2});
    run(world, 1);
    return world.state_hash();
  };
  EXPECT_EQ(hash_of(ContactSolver::WorstFirst, Choice::On),
            hash_of(ContactSolver::Newton, Choice::Automatic));
  EXPECT_EQ(hash_of(ContactSolver::WorstFirst, Choice::Off),
            hash_of(ContactSolver::SoftStep, Choice::Automatic));
  EXPECT_NE(hash_of(ContactSolver::WorstFirst, Choice::Automatic),
            hash_of(ContactSolver::SoftStep, Choice::Automatic));
}

// Joints meet it without harm.
TEST(WorstFirst, LivesWithJoints) {
  PhysicsWorld world(worst_first());
  add_floor(world, material(0.5, 0.4));
  BodyId last;
  for (int i = 0; i < 4; ++i) {
    const BodyId box = add(world, body_at(at(1.2 * i, 2, 0)), with(cube(0.4), material(0.5, 0.4)));
    if (last) {
      Joint joint;
      joint.body_a = last;
      joint.body_b = box;
      joint.frame_a.position = vec(0.6, 0, 0);
      joint.frame_b.position = vec(-0.6, 0, 0);
      joint.kind = BallJoint{};
      must(world.create_joint(joint));
    }
    last = box;
  }
  run(world, 4);
  EXPECT_TRUE(all_finite(world));
  EXPECT_NEAR(position(world, last).y(), 0.4, 0.05);
  EXPECT_LE(velocity(world, last).norm(), 0.3);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
