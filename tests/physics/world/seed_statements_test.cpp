// Proves the statements of rigid-body mechanics on which everything else rests, each through the
// public interface: what force, torque and impulse do to a body, that momentum and angular momentum
// are kept, how rotations compose, and what one impulse at one contact does to both bodies.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Steps of the longer runs here, times substeps: what round-off is counted in.
constexpr double kSubsteps = 4;

TEST(SeedStatements, S01_ForceIsTheRateOfChangeOfMomentum) {
  PhysicsWorld world(no_gravity());
  const BodyId body = must(world.create_body(free_body(3, {1, 2, 3})));
  const Vector3d force(2, -5, 7);
  const double dt = 1.0 / 60;
  for (int i = 0; i < 60; ++i) {
    must(world.apply_force(body, vec(force)));
    world.step(dt);
  }
  const Vector3d expected = force * 1.0;
  EXPECT_LE((world.energy().momentum - expected).norm(),
            sum_error(60 * kSubsteps, expected.norm()));
  // A force lasts one step only.
  const Vector3d before = velocity(world, body);
  world.step(dt);
  EXPECT_EQ((velocity(world, body) - before).norm(), 0);
}

// tau = I alpha alone would keep w, and turn L with the body.
TEST(SeedStatements, S02_TorqueFreeMotionKeepsAngularMomentumFixedInSizeAndDirection) {
  PhysicsWorld world(no_gravity());
  RigidBody top = free_body(1, {1, 2, 3});
  top.angular_velocity = vec(1, 1, 1);
  const BodyId body = must(world.create_body(top));
  const Vector3d L0 = wide(world.angular_momentum(body));
  const Vector3d w0 = spin(world, body);
  EXPECT_LE((L0 - Vector3d(1, 2, 3)).norm(), 4 * kEps * L0.norm());
  run(world, 10);
  EXPECT_LE((wide(world.angular_momentum(body)) - L0).norm(), bar(1e-12, 4 * kEps) * L0.norm());
  EXPECT_GT((spin(world, body) - w0).norm(), 0.1);  // while w itself does change
}

TEST(SeedStatements, S03_RotationsDoNotCommute) {
  const auto turned = [](const Vector3d& first, const Vector3d& second) {
    PhysicsWorld world(no_gravity());
    const BodyId body = must(world.create_body(free_body(1, {1, 1, 1})));
    for (const Vector3d& axis : {first, second}) {
      must(world.set_angular_velocity(body, vec(kPi / 2 * axis)));
      run(world, 1);
    }
    return orientation(world, body);
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY();
  const Quaterniond qx(Eigen::AngleAxisd(kPi / 2, x)), qy(Eigen::AngleAxisd(kPi / 2, y));
  const double round_off = sum_error(60 * kSubsteps * 2, 1);
  EXPECT_LE(angle_between(turned(x, y), qy * qx), round_off);
  EXPECT_LE(angle_between(turned(y, x), qx * qy), round_off);
  // The two differ by a third of a turn.
  EXPECT_NEAR(angle_between(turned(x, y), turned(y, x)), 2 * kPi / 3, 2 * round_off);
}

TEST(SeedStatements, S04_AnOffsetForceMovesAndTurns) {
  PhysicsWorld world(no_gravity());
  RigidBody spec = free_body(2, {1, 2, 3});
  spec.pose = at({1, 2, 3}, turn(0.7, {1, 2, -1}));
  const BodyId body = must(world.create_body(spec));
  const Vector3d force(3, -2, 1), r(0.2, 0.5, -0.4);
  const double h = 1e-3;  // [s] short: the body turns by less than 1e-6 rad meanwhile
  must(world.apply_force_at(body, vec(force), pos(Vector3d(1, 2, 3) + r)));
  world.step(h);
  const Matrix3d R = orientation(world, body).toRotationMatrix();
  const Matrix3d inverse_inertia = R * Vector3d(1, 1.0 / 2, 1.0 / 3).asDiagonal() * R.transpose();
  const Vector3d dv = force * h / 2, dL = r.cross(force) * h;
  EXPECT_LE((velocity(world, body) - dv).norm(), 16 * kEps * dv.norm());
  // In single precision the lever arm is a difference of positions near 4 m.
  const double lever = kPosEps * 4 * force.norm() * h + 16 * kEps * dL.norm();
  EXPECT_LE((wide(world.angular_momentum(body)) - dL).norm(), lever);
  EXPECT_LE((spin(world, body) - inverse_inertia * dL).norm(), 2 * lever);
}

TEST(SeedStatements, S05_InertiaAboutAnyAxisIsTheSumOverParticles) {
  const std::vector<double> masses = {1, 2, 0.5, 3};
  const std::vector<Vector3d> points = {{1, 0, 0}, {0, 1, 2}, {-1, 2, 0.5}, {0.3, -1, 1}};
  RigidBody spec;
  spec.mass = inertia_of::particles(masses, points);
  PhysicsWorld world(no_gravity());
  const BodyId body = must(world.create_body(spec));
  const MassProperties p = world.mass_properties(body);
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Vector3d a = random.direction();
    double sum = 0;
    for (std::size_t k = 0; k < masses.size(); ++k)
      sum += masses[k] * (points[k] - p.center).cross(a).squaredNorm();
    EXPECT_NEAR(a.dot(p.I_Bcm_B * a), sum, 1e-12 * sum);
    // The world turns the body by the same inertia: kinetic energy (1/2) w^2 sum m d^2.
    must(world.set_angular_velocity(body, vec(3 * a)));
    EXPECT_NEAR(world.energy().kinetic_angular, 4.5 * sum, 32 * kEps * 4.5 * sum);
  }
}

TEST(SeedStatements, S06_ProductOfInertiaEntersTheTensorWithAMinusSign) {
  const double m = 1.5;
  const std::vector<double> masses = {m, m};
  const std::vector<Vector3d> points = {{1, 1, 0}, {-1, -1, 0}};
  const MassProperties p = inertia_of::particles(masses, points);
  EXPECT_NEAR(p.I_Bcm_B(0, 1), -2 * m, 1e-15);
  EXPECT_NEAR(p.I_Bcm_B(1, 0), -2 * m, 1e-15);
}

TEST(SeedStatements, S07_ProductsVanishOnlyInPrincipalAxesThroughTheCentre) {
  const MassProperties block = inertia_of::box(2, {0.3, 0.5, 0.9});
  const auto product = [](const Matrix3d& I) {
    return std::abs(I(0, 1)) + std::abs(I(0, 2)) + std::abs(I(1, 2));
  };
  const Quaterniond tilt(Eigen::AngleAxisd(0.5, Vector3d(1, 2, 3).normalized()));
  const MassProperties tilted = block.placed(Vector3d::Zero(), tilt);
  EXPECT_EQ(product(block.I_Bcm_B), 0);
  EXPECT_GT(product(tilted.I_Bcm_B), 0.01);                        // other axes
  EXPECT_GT(product(block.inertia_about({0.3, 0.5, 0.9})), 0.01);  // another point
  const MassProperties::Principal principal = tilted.principal();
  const Matrix3d back = principal.R_BP.transpose() * tilted.I_Bcm_B * principal.R_BP;
  EXPECT_LE(product(back), 1e-14 * tilted.I_Bcm_B.norm());
}

TEST(SeedStatements, S08_DampingIsPerSecondAndTerminalSpeedConverges) {
  const double kept = 0.5;           // [-] of the velocity after one second
  const double c = -std::log(kept);  // [1/s]
  for (double dt : {1.0 / 10, 1.0 / 60, 1.0 / 240}) {
    PhysicsWorld free(no_gravity());
    RigidBody spec = free_body(1, {1, 1, 1});
    spec.linear_damping = real(c);
    spec.linear_velocity = vec(8, 0, 0);
    const BodyId body = must(free.create_body(spec));
    run(free, 2, dt);
    EXPECT_NEAR(velocity(free, body).x(), 8 * kept * kept, sum_error(2 / dt * kSubsteps, 8))
        << "dt " << dt;

    PhysicsWorld falling;
    spec.linear_velocity = Vec3::Zero();
    const BodyId drop = must(falling.create_body(spec));
    run(falling, 60, dt);  // 2^-60 of the way left
    // Round-off of each substep decays at the rate c h, so eps/(c h) of the speed remains.
    const double remains = 2 * kEps / (c * dt / kSubsteps);
    EXPECT_NEAR(velocity(falling, drop).y(), -kGravity / c, remains * kGravity / c) << "dt " << dt;
  }
}

TEST(SeedStatements, S09_AngularVelocityIsInWorldAxes) {
  PhysicsWorld world(no_gravity());
  RigidBody spec = free_body(1, {1, 1, 1});
  spec.pose = at({0, 0, 0}, turn(kPi / 2, Vector3d::UnitX()));
  const BodyId body = must(world.create_body(spec));
  must(world.set_angular_velocity(body, vec(0, 1.25, 0)));
  run(world, 1);
  const Quaterniond qx(Eigen::AngleAxisd(kPi / 2, Vector3d::UnitX()));
  const Quaterniond qy(Eigen::AngleAxisd(1.25, Vector3d::UnitY()));
  EXPECT_LE(angle_between(orientation(world, body), qy * qx), sum_error(60 * kSubsteps, 1));
}

TEST(SeedStatements, S10_ContactsKeepMomentumAndAngularMomentumAboutAnyPoint) {
  PhysicsWorld world(no_gravity());
  const Built cluster = build_cluster(world);
  double p_scale = 0, L_scale = 0;  // sums of sizes: what cancels in the totals
  for (BodyId b : cluster.bodies) {
    const double m = world.mass_properties(b).mass;
    const double p = m * velocity(world, b).norm();
    p_scale += p;
    L_scale += p * position(world, b).norm() + wide(world.angular_momentum(b)).norm();
  }
  const EnergyReport before = world.energy();
  std::uint32_t touched = 0;
  const double steps = 90;
  run(world, 1.5, 1.0 / 60, [&] { touched += world.last_report().touching_pairs; });
  EXPECT_GT(touched, 100u);  // they did meet
  const EnergyReport after = world.energy();
  const double round_off = sum_error(steps * kSubsteps, 1);
  EXPECT_LE((after.momentum - before.momentum).norm(), round_off * p_scale);
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), round_off * L_scale);
  // About another point: L' = L - a x P.
  const Vector3d a(10, -7, 3);
  const Vector3d moved = (after.angular_momentum - a.cross(after.momentum)) -
                         (before.angular_momentum - a.cross(before.momentum));
  EXPECT_LE(moved.norm(), round_off * (L_scale + a.norm() * p_scale));
}

// --- one impact: a ball hits the top of a free box off its centre, without friction
// -----------------
struct OffCentreHit {
  double ball_mass = 2, box_mass = 5, speed = 3, restitution = 0.6;
  Vector3d half = {0.5, 0.3, 0.7}, r_box = {0.3, 0.3, -0.4}, n = {0, 1, 0};
  Vector3d ball_before, ball_after, box_after, box_spin, box_L;
  Vector3d box_moments;

  OffCentreHit() {
    PhysicsWorld world(no_gravity());
    const double radius = 0.2;
    const Material surface = material(0, restitution);
    RigidBody target;
    target.mass = inertia_of::box(box_mass, half);
    box_moments = target.mass->I_Bcm_B.diagonal();
    const BodyId box_id = add(world, target, with(Box{vec(half)}, surface));
    RigidBody ball = moving(at(r_box.x(), half.y() + radius + 0.1, r_box.z()), vec(0, -speed, 0));
    ball.mass = inertia_of::solid_sphere(ball_mass, radius);
    const BodyId ball_id = add(world, ball, with(sphere(radius), surface));
    ball_before = velocity(world, ball_id);
    run(world, 0.1);
    ball_after = velocity(world, ball_id);
    box_after = velocity(world, box_id);
    box_spin = spin(world, box_id);
    box_L = wide(world.angular_momentum(box_id));
  }
  // Impulse on the box [N s].
  [[nodiscard]] Vector3d impulse() const { return -ball_mass * (ball_after - ball_before); }
};
// Geometry before the hit is exact, so only the arithmetic of one impact is left.
const double kImpact = bar(1e-9, 2e-5);

TEST(SeedStatements, S11_RestitutionHoldsAlongTheNormalAtTheContactPoint) {
  const OffCentreHit hit;
  // Velocity of the box's contact point right after the hit, from the impulse and the inertia.
  const Vector3d w = hit.box_moments.cwiseInverse().asDiagonal() * hit.box_L;
  const double after = (hit.ball_after - (hit.box_after + w.cross(hit.r_box))).dot(hit.n);
  EXPECT_NEAR(after, hit.restitution * hit.speed, kImpact * hit.speed);
}

TEST(SeedStatements, S12_ImpulseAndForceTimesTimeAgree) {
  const Vector3d J(3, -1, 2), r(0.3, 0.1, -0.2);
  const double h = 1.0 / 60;
  const auto result = [&](bool as_force) {
    PhysicsWorld world(no_gravity());
    const BodyId body = must(world.create_body(free_body(2, {1, 2, 3})));
    if (as_force) {
      must(world.apply_force_at(body, vec(J / h), pos(r)));
    } else {
      must(world.apply_impulse_at(body, vec(J), pos(r)));
    }
    world.step(h);
    return std::pair(velocity(world, body), Vector3d(wide(world.angular_momentum(body))));
  };
  const auto [v_force, L_force] = result(true);
  const auto [v_impulse, L_impulse] = result(false);
  EXPECT_LE((v_force - v_impulse).norm(), 16 * kEps * v_impulse.norm());
  EXPECT_LE((L_force - L_impulse).norm(), 16 * kEps * L_impulse.norm());
  EXPECT_LE((v_impulse - J / 2).norm(), 16 * kEps * v_impulse.norm());
  EXPECT_LE((L_impulse - r.cross(J)).norm(), 16 * kEps * L_impulse.norm());
}

TEST(SeedStatements, S13_ContactPointOfSpheresOfUnequalRadii) {
  PhysicsWorld world(no_gravity());
  const BodyId a = add(world, body_at(at(0, 0, 0)), with(sphere(2)));
  const BodyId b = add(world, body_at(at(2.4, 0, 0)), with(sphere(0.5)));
  const double dt = 1e-6;  // [s] they part by no more than a few micrometres
  world.step(dt);
  const std::vector<ContactState> all = contacts(world);
  const ContactState* contact = find_contact(all, a, b);
  ASSERT_NE(contact, nullptr);
  ASSERT_EQ(contact->point_count, 1);
  const double sign = contact->body_a == a ? 1 : -1;
  EXPECT_LE((wide(contact->normal) - Vector3d(sign, 0, 0)).norm(), 4 * kEps);
  // Midway between the surfaces at 2.0 and 1.9 m from A's centre.
  EXPECT_LE((wide(contact->points[0].position) - Vector3d(1.95, 0, 0)).norm(), 1e-4);
  EXPECT_NEAR(static_cast<double>(contact->points[0].separation), -0.1, 1e-4);
}

TEST(SeedStatements, S14_VelocityChangePerUnitImpulse) {
  const OffCentreHit hit;
  const Vector3d turned = hit.box_moments.cwiseInverse().asDiagonal() * hit.r_box.cross(hit.n);
  const double per_unit = 1 / hit.ball_mass + 1 / hit.box_mass + turned.cross(hit.r_box).dot(hit.n);
  const double expected = (1 + hit.restitution) * hit.speed / per_unit;  // [N s], downwards
  EXPECT_LE((hit.impulse() - Vector3d(0, -expected, 0)).norm(), kImpact * expected);
}

TEST(SeedStatements, S15_TheSecondBodyGetsTheExactOppositeImpulse) {
  const OffCentreHit hit;
  const double size = hit.impulse().norm();
  EXPECT_LE((hit.impulse() - hit.box_mass * hit.box_after).norm(), 16 * kEps * size);
  EXPECT_LE((hit.r_box.cross(hit.impulse()) - hit.box_L).norm(), kImpact * size);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
