// Proves the laws of the accurate contact solver: Coulomb friction as the closed forms say,
// momentum kept, belts, rolling friction, no adhesion, and the parts it is made of.
#include <gtest/gtest.h>

#include "solver/newton/body_matrix.h"
#include "solver/newton/contact_law.h"
#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

WorldSettings newton() {
  WorldSettings settings = no_sleep();
  settings.contact_solver = ContactSolver::Newton;
  return settings;
}
RigidBody slider(const Pose& pose, const Vector3d& v) {
  RigidBody body = moving(pose, vec(v));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  return body;
}

TEST(NewtonFriction, C1_SlidesToAStop) {
  const double mu = 0.5, v0 = 10, d = v0 * v0 / (2 * mu * kGravity);
  for (const bool block : {false, true}) {
    PhysicsWorld world(newton());
    add_floor(world, material(mu));
    const BodyId body =
        block ? add(world, moving(at(0, 0.1, 0), vec(v0, 0, 0)),
                    with(box(0.5, 0.1, 0.5), material(mu)))
              : add(world, slider(at(0, 0.5, 0), {v0, 0, 0}), with(sphere(0.5), material(mu)));
    run(world, 3);
    EXPECT_NEAR(position(world, body).x(), d, bar(block ? 5e-6 : 1e-6, 1e-4) * d) << block;
    EXPECT_LE(velocity(world, body).norm(), bar(1e-9, 1e-5)) << block;
  }
}

TEST(NewtonFriction, C2_IsTheSameInEveryDirection) {
  const double mu = 0.6, v0 = 25;
  double shortest = 1e9, longest = 0, sideways = 0;
  for (int k = 0; k < 48; ++k) {
    const double angle = k * 7.5 * kPi / 180;
    const Vector3d along(std::cos(angle), 0, std::sin(angle));
    PhysicsWorld world(newton());
    add_floor(world, material(mu));
    const BodyId body =
        add(world, slider(at(0, 0.5, 0), v0 * along), with(sphere(0.5), material(mu)));
    run(world, 5);
    const Vector3d p = position(world, body) - Vector3d(0, 0.5, 0);
    shortest = std::min(shortest, p.dot(along));
    longest = std::max(longest, p.dot(along));
    sideways = std::max(sideways, (p - p.dot(along) * along).norm());
  }
  // Single precision reached 1.2e-5 with double positions, below 1e-5 without.
  EXPECT_LE((longest - shortest) / longest, bar(1e-6, 2e-5));
  EXPECT_LE(sideways, bar(1e-6, 1e-3));
}

TEST(NewtonFriction, C3_TheSlopeSeparatesStickingFromSliding) {
  const double angle = kPi / 6, tangent = std::tan(angle);
  for (const double share : {1.001, 0.999}) {
    PhysicsWorld world(newton());
    const OnSlope slope = build_slope(world, {.friction = tangent * share});
    run(world, 2);
    const double a = kGravity * (std::sin(angle) - tangent * share * std::cos(angle));
    const double speed = velocity(world, slope.body).norm();
    if (share > 1) {
      EXPECT_LE(speed, bar(1e-9, 1e-5));
    } else {
      EXPECT_NEAR(speed, 2 * a, bar(1e-6, 2e-3) + bar(1e-3, 0) * 2 * a);
    }
  }
}

TEST(NewtonFriction, C5_ASlidingBallComesToRoll) {
  PhysicsWorld world(newton());
  add_floor(world, material(0.3));
  const BodyId ball =
      add(world, moving(at(0, 0.5, 0), vec(7, 0, 0)), with(sphere(0.5), material(0.3)));
  run(world, 2);
  EXPECT_NEAR(velocity(world, ball).x(), 5, bar(1e-5, 1e-3) * 5);
  EXPECT_NEAR(spin(world, ball).z(), -10, bar(1e-5, 1e-3) * 10);
}

TEST(NewtonFriction, ABeltCarriesAndABallWithRollingFrictionStops) {
  PhysicsWorld world(newton());
  Collider belt = with(HalfSpace{vec(0, 1, 0), real(0)}, material(0.5));
  belt.surface_velocity.linear = vec(2, 0, 0);
  add(world, body_at(Pose{}, MotionType::Static), belt);
  const BodyId body = add(world, body_at(at(0, 0.1, 0)), with(box(0.5, 0.1, 0.5), material(0.5)));
  run(world, 0.2);
  EXPECT_NEAR(velocity(world, body).x(), 0.5 * kGravity * 0.2, 1e-3);
  run(world, 1);
  EXPECT_NEAR(velocity(world, body).x(), 2, bar(1e-6, 1e-4));

  PhysicsWorld level(newton());
  Material rough = material(0.8);
  rough.rolling_friction = real(0.05);
  add_floor(level, rough);
  const double r = 0.5, v = 2, e = 0.05;
  const BodyId ball =
      add(level, moving(at(0, r, 0), vec(v, 0, 0), vec(0, 0, -v / r)), with(sphere(r), rough));
  run(level, 8);
  const double way = 7 * v * v * r / (10 * e * kGravity);
  EXPECT_NEAR(position(level, ball).x(), way, 0.01 * way);
  EXPECT_LE(velocity(level, ball).norm(), 1e-4);
}

TEST(NewtonContacts, FreeBodiesKeepTheirMomentum) {
  WorldSettings settings = newton();
  settings.gravity = Vec3::Zero();
  PhysicsWorld world(settings);
  const Material surface = material(0.5);
  add(world, moving(at(-1, 0, 0), vec(2, 0.1, 0), vec(0, 1, 0)), with(cube(0.4), surface));
  add(world, moving(at(1, 0.3, 0.1), vec(-1, 0, 0.2), vec(1, 0, 2)), with(sphere(0.5), surface));
  const EnergyReport before = world.energy();
  run(world, 2);
  const EnergyReport after = world.energy();
  EXPECT_LE((after.momentum - before.momentum).norm(), bar(1e-9, 1e-5) * before.momentum.norm());
  // Overlap is worked off while the two slide over each other, which turns their paths a little:
  // measured 1.0e-3 (the fast solver: 5.4e-3; wanted: round-off).
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(),
            2e-3 * before.angular_momentum.norm());
  EXPECT_LE(after.total(), before.total() * (1 + 1e-6));
  EXPECT_LT(after.total(), 0.9 * before.total()) << "they have not met";
}

// The impulses of a rest do not hold back what is thrown up.
TEST(NewtonContacts, LetGo) {
  PhysicsWorld world(newton());
  add_floor(world, material(0.5));
  const BodyId body = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5), material(0.5)));
  run(world, 0.5);
  must(world.set_linear_velocity(body, vec(0, 3, 0)));
  world.step(kDt);
  EXPECT_NEAR(velocity(world, body).y(), 3 - kGravity * kDt, bar(1e-9, 1e-5));
}

// Locked axes stay locked, a body that does not turn does not, and the world answers for both.
TEST(NewtonContacts, LocksHold) {
  PhysicsWorld world(newton());
  add_floor(world, material(0.5));
  RigidBody locked = moving(at(0, 0.5, 0), vec(0, 0, 1));
  locked.locks = MotionLocks::planar();
  const BodyId body = add(world, locked, with(cube(0.5), material(0.5)));
  const BodyId above = add(world, body_at(at(0.2, 1.6, 0.3)), with(cube(0.5), material(0.5)));
  run(world, 2);
  EXPECT_EQ(position(world, body).z(), 0);
  EXPECT_EQ(spin(world, body).x(), 0);
  EXPECT_NEAR(position(world, above).y(), 1.5, 1e-3);
}

// --- its parts ---

// The derivatives are those of the projections, by finite differences, away from the edges.
TEST(NewtonContactLaw, DerivativesAreThoseOfTheProjections) {
  using detail::newton::Projected;
  using detail::newton::Vec3d;
  Random random(3);
  const auto check = [](const auto& law, Vec3d y) {
    const Projected at = law(y);
    const double d = 1e-6;
    const double D[3][3] = {
        {at.D.xx, at.D.xy, at.D.xz}, {at.D.xy, at.D.yy, at.D.yz}, {at.D.xz, at.D.yz, at.D.zz}};
    for (int j = 0; j < 3; ++j) {
      Vec3d up = y, down = y;
      set_component(up, j, component(y, j) + d);
      set_component(down, j, component(y, j) - d);
      const Vec3d slope = (1 / (2 * d)) * (law(up).g - law(down).g);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(D[i][j], component(slope, i), 1e-6);
    }
  };
  for (int k = 0; k < 200; ++k) {
    const Vec3d y{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double mu = random.uniform(0.1, 2);
    const double slip = std::sqrt(y.y * y.y + y.z * y.z);
    const bool edge = std::abs(slip - mu * y.x) < 1e-4 || std::abs(mu * slip + y.x) < 1e-4 ||
                      std::abs(y.x) < 1e-4 || std::abs(slip - 0.5) < 1e-4 ||
                      std::abs(length(y) - 0.5) < 1e-4;
    if (edge) continue;
    check([&](Vec3d a) { return detail::newton::project_cone(mu, a); }, y);
    check([&](Vec3d a) { return detail::newton::project_column(0.5, a); }, y);
    check([&](Vec3d a) { return detail::newton::project_ball(0.5, a); }, y);
  }
}

// A x from the blocks, solved, is x again: columns, loops, and everything connected to everything.
TEST(NewtonBodyMatrix, SolvesWhatItWasGiven) {
  using detail::newton::Block6;
  using detail::newton::BodyMatrix;
  Random random(11);
  for (const std::uint32_t n : {1u, 2u, 7u, 30u}) {
    for (const int links : {0, 1, 3}) {
      std::vector<BodyMatrix::Edge> edges;
      for (std::uint32_t i = 0; i + 1 < n; ++i) edges.emplace_back(i, i + 1);
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(links) * n; ++k) {
        const auto i = static_cast<std::uint32_t>(random.uniform(0, n));
        const auto j = static_cast<std::uint32_t>(random.uniform(0, n));
        if (i != j) edges.emplace_back(std::min(i, j), std::max(i, j));
      }
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      BodyMatrix matrix;
      ASSERT_TRUE(matrix.analyse(n, edges, 100'000));
      matrix.clear();
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * n, 6 * n);
      for (std::uint32_t i = 0; i < n; ++i)
        for (int r = 0; r < 6; ++r) matrix.diagonal(i).at[r][r] = A(6 * i + r, 6 * i + r) = 0.5;
      for (const auto& [i, j] : edges) {  // G^T G of a row of blocks (P, -Q)
        Eigen::Matrix<double, 6, 12> G;
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 12; ++c) G(r, c) = random.uniform(-1, 1);
        const Eigen::Matrix<double, 12, 12> K = G.transpose() * G;
        Block6 ij;
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) {
            matrix.diagonal(i).at[r][c] += K(r, c);
            matrix.diagonal(j).at[r][c] += K(r + 6, c + 6);
            ij.at[r][c] = K(r, c + 6);
          }
        matrix.add(i, j, ij);
        A.block<6, 6>(6 * i, 6 * i) += K.topLeftCorner<6, 6>();
        A.block<6, 6>(6 * j, 6 * j) += K.bottomRightCorner<6, 6>();
        A.block<6, 6>(6 * i, 6 * j) += K.topRightCorner<6, 6>();
        A.block<6, 6>(6 * j, 6 * i) += K.bottomLeftCorner<6, 6>();
      }
      Eigen::VectorXd x(6 * n);
      for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = random.uniform(-1, 1);
      Eigen::VectorXd b = A * x;
      matrix.factor();
      matrix.solve(b.data());
      EXPECT_LE((b - x).norm(), 1e-9 * x.norm()) << n << " bodies";
    }
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
