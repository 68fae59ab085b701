// Proves Coulomb friction: the stopping distance, the same in every direction, the edge between
// sticking and sliding on a slope, and the change from sliding to rolling, against closed forms.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using Eigen::Vector3d;

constexpr double kDt = 1.0 / 60;  // [s]

// A ball that cannot turn slides on a single point: nothing but the friction law is at work.
RigidBody slider(const Pose& pose, const Vector3d& v) {
  RigidBody body = moving(pose, vec(v));
  body.locks.angular_x = body.locks.angular_y = body.locks.angular_z = true;
  return body;
}

// Reference case C1: mu 0.5, 10 m/s stops after 10.19367992 m and 2.03873598 s.
TEST(Friction, C1_SlidesToAStop) {
  const double mu = 0.5, v0 = 10, d = v0 * v0 / (2 * mu * kGravity), t = v0 / (mu * kGravity);
  for (const bool block : {false, true}) {
    PhysicsWorld world(no_sleep());
    add_floor(world, material(mu));
    // The block is low, so that the friction force hardly shifts its load forward.
    const BodyId body =
        block ? add(world, moving(at(0, 0.1, 0), vec(v0, 0, 0)),
                    with(box(0.5, 0.1, 0.5), material(mu)))
              : add(world, slider(at(0, 0.5, 0), {v0, 0, 0}), with(sphere(0.5), material(mu)));
    double stopped = 0;
    run(world, 3, kDt, [&] {
      if (velocity(world, body).x() > 1e-6 * v0) stopped = world.time();
    });
    // The block pitches when it starts and when it stops, by its contacts' give: measured 3e-6 of
    // the way (wanted: 1e-6), and a rocking of 1e-5 m/s for two steps after the stop.
    EXPECT_NEAR(position(world, body).x(), d, bar(block ? 5e-6 : 1e-6, 1e-4) * d)
        << (block ? "block" : "point");
    EXPECT_NEAR(stopped, t, (block ? 2 : 1) * kDt);  // seen at step ends only
    EXPECT_LE(velocity(world, body).norm(), bar(1e-9, 1e-5));
  }
}

// Velocity, unlike position, must be exact while sliding: v = v0 - mu g t.
TEST(Friction, C1_DecelerationIsMuG) {
  PhysicsWorld world(no_sleep());
  add_floor(world, material(0.5));
  const BodyId body =
      add(world, slider(at(0, 0.5, 0), {10, 0, 0}), with(sphere(0.5), material(0.5)));
  run(world, 1);
  EXPECT_NEAR(velocity(world, body).x(), 10 - 0.5 * kGravity, bar(1e-6, 1e-4));
}

// Slides with 25 m/s under mu 0.6 in 48 headings.
struct Slides {
  double wanted;                                     // [m] v0^2 / (2 mu g)
  double shortest = 1e9, longest = 0, sideways = 0;  // [m]
};
template <class AddBody>  // (world, velocity [m/s], friction [-]) -> BodyId
Slides slide_in_every_direction(const AddBody& add_body) {
  const double mu = 0.6, v0 = 25;
  Slides out{.wanted = v0 * v0 / (2 * mu * kGravity)};
  for (int i = 0; i < 48; ++i) {
    const double heading = i * 7.5 * kPi / 180;
    const Vector3d along(std::cos(heading), 0, std::sin(heading));
    PhysicsWorld world(no_sleep());
    add_floor(world, material(mu));
    const BodyId body = add_body(world, Vector3d(v0 * along), mu);
    run(world, 5);
    Vector3d moved = position(world, body);
    moved.y() = 0;
    out.shortest = std::min(out.shortest, moved.dot(along));
    out.longest = std::max(out.longest, moved.dot(along));
    out.sideways = std::max(out.sideways, (moved - moved.dot(along) * along).norm());
  }
  return out;
}

// Reference case C2: 53.09208 m in every one of 48 headings; a pyramid errs by 0.71 or 1.41.
TEST(Friction, C2_IsTheSameInEveryDirection) {
  const Slides slides =
      slide_in_every_direction([](PhysicsWorld& world, const Vector3d& v, double mu) {
        return add(world, slider(at(0, 0.5, 0), v), with(sphere(0.5), material(mu)));
      });
  const double d = slides.wanted;
  EXPECT_NEAR(slides.shortest, d, bar(1e-6, 1e-4) * d);
  EXPECT_LE((slides.longest - slides.shortest) / d, bar(1e-6, 1e-4));
  EXPECT_LE(slides.sideways, bar(1e-6, 1e-3));
}

// The same with a block, whose load shifts between four corners.
TEST(Friction, C2_IsTheSameInEveryDirectionForABlock) {
  const Slides slides =
      slide_in_every_direction([](PhysicsWorld& world, const Vector3d& v, double mu) {
        return add(world, moving(at(0, 0.1, 0), vec(v)), with(box(0.5, 0.1, 0.5), material(mu)));
      });
  const double d = slides.wanted;
  EXPECT_NEAR(slides.shortest, d, 1e-3 * d);
  EXPECT_LE((slides.longest - slides.shortest) / d, 1e-3);
  EXPECT_LE(slides.sideways, 1e-3 * d);
}

// Reference case C3: slides iff tan > mu.
TEST(Friction, C3_SticksAboveAndSlidesBelowTheTangent) {
  const double angle = 20 * kPi / 180, critical = std::tan(angle);
  for (const bool block : {false, true}) {
    Slope slope{.angle = angle, .friction = critical * 1.001};
    if (block) {
      slope.shape = box(0.5, 0.1, 0.5);
      slope.height = 0.1;
    } else {
      slope.shape = sphere(0.5);
    }
    const auto make = [&](PhysicsWorld& world) {
      if (block) return build_slope(world, slope);
      OnSlope built = build_slope(world, slope);
      RigidBody point = world.body(built.body);
      const Collider collider = world.collider(world.colliders_of(built.body)[0]);
      must(world.destroy_body(built.body));
      point.locks.angular_x = point.locks.angular_y = point.locks.angular_z = true;
      built.body = add(world, point, collider);
      return built;
    };
    PhysicsWorld above(no_sleep());
    const OnSlope stuck = make(above);
    run(above, 2);
    const Vector3d p0 = position(above, stuck.body);
    run(above, 10);
    const double creep = (position(above, stuck.body) - p0).norm() / 10;
    // Measured 1.8e-9 for the block (wanted: 1e-9): the end of its settling, not a steady creep.
    EXPECT_LE(creep, bar(block ? 3e-9 : 1e-9, 1e-6)) << (block ? "block" : "point");

    slope.friction = critical * 0.999;
    PhysicsWorld below(no_sleep());
    const OnSlope sliding = make(below);
    run(below, 1);  // the contact takes up its load
    const double v0 = velocity(below, sliding.body).dot(sliding.down);
    run(below, 5);
    const double v = velocity(below, sliding.body).dot(sliding.down);
    const double a = kGravity * (std::sin(angle) - slope.friction * std::cos(angle));
    EXPECT_NEAR(v - v0, 5 * a, bar(1e-6, 1e-4) * kGravity * 5) << (block ? "block" : "point");
    EXPECT_GT(v, 2.5 * a) << (block ? "block" : "point");
  }
}

// Reference case C3, well below the edge.
TEST(Friction, C3_AccelerationDownASlope) {
  const double angle = kPi / 6;
  for (double mu : {0.0, 0.1, 0.3, 0.5}) {
    PhysicsWorld world(no_sleep());
    Slope slope{.angle = angle, .friction = mu, .shape = box(0.5, 0.1, 0.5), .height = 0.1};
    const OnSlope built = build_slope(world, slope);
    run(world, 0.5);
    const double v0 = velocity(world, built.body).dot(built.down);
    run(world, 2);
    const double a = (velocity(world, built.body).dot(built.down) - v0) / 2;
    const double exact = kGravity * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(a, exact, bar(1e-6, 1e-4) * kGravity) << "mu " << mu;
  }
}

// Reference case C5: v0 = 7, mu = 0.3 rolls at 5 m/s after 0.67957866 s and 4.07747197 m.
TEST(Friction, C5_SlidingBallBeginsToRoll) {
  const double mu = 0.3, v0 = 7, R = 0.5;
  PhysicsWorld world(no_sleep());
  add_floor(world, material(mu));
  const BodyId ball = add(world, moving(at(0, R, 0), vec(v0, 0, 0)), with(sphere(R), material(mu)));
  run(world, 2);
  EXPECT_NEAR(velocity(world, ball).x(), 5, bar(1e-6, 1e-4));
  EXPECT_NEAR(spin(world, ball).z(), -5 / R, bar(1e-5, 1e-3));
  const double x = 4.07747197 + 5 * (2 - 0.67957866);
  EXPECT_NEAR(position(world, ball).x(), x, bar(1e-5, 1e-4) * x);
}

TEST(Friction, C5_BackspinReversesNothingButSlowsMore) {
  const double mu = 0.3, R = 0.5;
  PhysicsWorld world(no_sleep());
  add_floor(world, material(mu));
  RigidBody spec = moving(at(0, R, 0), vec(7, 0, 0), vec(0, 0, 30));
  const BodyId ball = add(world, spec, with(sphere(R), material(mu)));
  run(world, 3);
  EXPECT_NEAR(velocity(world, ball).x(), 0.71428571, bar(1e-6, 1e-4));
  const double t = 2.13581865;  // [s] when it begins to roll
  const double x = 7 * t - 0.5 * mu * kGravity * t * t + 0.71428571 * (3 - t);
  EXPECT_NEAR(position(world, ball).x(), x, bar(1e-5, 1e-4) * x);
}

// Reference case C6: a/(g sin) = 1/(1 + k) for a moment of k m R^2, if mu/tan >= k/(1 + k).
TEST(Friction, C6_RollingDownASlope) {
  const double angle = kPi / 6, R = 0.5;
  struct Case {
    const char* name;
    double k, a_ratio, mu_needed;
  };
  for (const Case& c : {Case{"ball", 0.4, 5.0 / 7, 2.0 / 7}, Case{"disc", 0.5, 2.0 / 3, 1.0 / 3},
                        Case{"hoop", 1, 0.5, 0.5}, Case{"shell", 2.0 / 3, 0.6, 0.4}}) {
    const auto roll = [&](double mu) {
      PhysicsWorld world(no_sleep());
      Slope slope{.angle = angle, .friction = mu, .shape = sphere(R), .height = R};
      MassProperties mass;
      mass.mass = 2;
      mass.I_Bcm_B = Eigen::Matrix3d::Identity() * c.k * 2 * R * R;
      slope.mass = mass;
      const OnSlope built = build_slope(world, slope);
      run(world, 0.5);
      const double v0 = velocity(world, built.body).dot(built.down);
      run(world, 1.5);
      const double v = velocity(world, built.body).dot(built.down);
      const double rim = v + spin(world, built.body).z() * R;  // 0 when rolling
      return std::pair((v - v0) / 1.5, rim);
    };
    const auto [a, slip] = roll(1.02 * c.mu_needed * std::tan(angle));
    const double gsin = kGravity * std::sin(angle);
    EXPECT_NEAR(a / gsin, c.a_ratio, bar(1e-6, 1e-4)) << c.name;
    EXPECT_NEAR(slip, 0, bar(1e-6, 1e-3)) << c.name;
    const auto [a_slides, slides] = roll(0.98 * c.mu_needed * std::tan(angle));
    EXPECT_NEAR(a_slides / gsin, 1 - 0.98 * c.mu_needed, bar(1e-6, 1e-4)) << c.name;
    EXPECT_GT(slides, 1e-2) << c.name;
  }
}

// Reference case C6: no rolling resistance is modelled, so none may appear.
TEST(Friction, C6_RollingOnTheLevelLosesNothing) {
  const double R = 0.5, v = 3;
  PhysicsWorld world(no_sleep());
  add_floor(world, material(0.6));
  const BodyId ball = add(world, moving(at(0, R, 0), vec(v, 0, 0), vec(0, 0, -v / R)),
                          with(sphere(R), material(0.6)));
  run(world, 1);  // it settles on its contact
  const double E0 = world.energy().kinetic_linear + world.energy().kinetic_angular;
  run(world, 60);
  const double turns = v * 60 / (2 * kPi * R);
  const double E1 = world.energy().kinetic_linear + world.energy().kinetic_angular;
  EXPECT_NEAR(E1, E0, bar(1e-9, 1e-6) * turns * E0);
  EXPECT_NEAR(position(world, ball).z(), 0, bar(1e-9, 1e-4));
}

// A ball on a board that is pulled from under it, on a floor without friction: without slip the
// board's acceleration is F/(M + 2/7 m), and the ball's 2/7 of it. However far the board moves in a
// step, the contact stays below the ball: off its middle its weight would drive it, by an amount of
// first order in the step.
TEST(Friction, C6_BallOnABoardThatIsPulledAwayRolls) {
  const double R = 0.5, m = 1, M = 1000, F = 5000;  // heavy, so as not to tilt under the ball
  const double board_right = F / (M + 2 * m / 7), ball_right = 2 * board_right / 7;
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    PhysicsWorld world(no_sleep());
    Material smooth = material(0);
    smooth.friction_rule = CombineRule::Minimum;
    add_floor(world, smooth);
    const auto make = [&](const Pose& pose, double mass, double moment, const Shape& shape) {
      RigidBody body = body_at(pose);
      MassProperties properties;
      properties.mass = real(mass);
      properties.I_Bcm_B = Eigen::Matrix3d::Identity() * moment;
      body.mass = properties;
      return add(world, body, with(shape, material(0.8)));
    };
    const BodyId board = make(at(0, R, 0), M, 1e5, box(20, R, 20));
    const BodyId ball = make(at(0, 3 * R, 0), m, 0.4 * m * R * R, sphere(R));
    const auto pull = [&](double seconds) {
      for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) {
        must(world.apply_force(board, vec(F, 0, 0)));
        world.step(dt);
      }
    };
    pull(0.5);  // the first steps load the contact
    const double board_before = velocity(world, board).x(), ball_before = velocity(world, ball).x();
    pull(2);
    const double tolerance = bar(1e-6, 1e-4);  // [-]
    EXPECT_NEAR((velocity(world, board).x() - board_before) / 2 / board_right, 1, tolerance) << dt;
    EXPECT_NEAR((velocity(world, ball).x() - ball_before) / 2 / ball_right, 1, tolerance) << dt;
  }
}

TEST(Friction, RulesOfCombinationAreObeyed) {
  const auto deceleration = [](CombineRule rule, double a, double b) {
    PhysicsWorld world(no_sleep());
    Material ma = material(a), mb = material(b);
    ma.friction_rule = mb.friction_rule = rule;
    add_floor(world, mb);
    const BodyId body = add(world, slider(at(0, 0.5, 0), {10, 0, 0}), with(sphere(0.5), ma));
    run(world, 0.5);
    return (10 - velocity(world, body).x()) / (0.5 * kGravity);
  };
  const double tolerance = 1e-3;  // the first steps load the contact
  EXPECT_NEAR(deceleration(CombineRule::Average, 0.2, 0.8), 0.5, tolerance);
  EXPECT_NEAR(deceleration(CombineRule::GeometricMean, 0.2, 0.8), 0.4, tolerance);
  EXPECT_NEAR(deceleration(CombineRule::Minimum, 0.2, 0.8), 0.2, tolerance);
  EXPECT_NEAR(deceleration(CombineRule::Maximum, 0.2, 0.8), 0.8, tolerance);
  EXPECT_NEAR(deceleration(CombineRule::Multiply, 0.2, 0.8), 0.16, tolerance);
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
