// Proves that joints and what surrounds them leave each other's work alone: locks do not hinder a
// motor, and where joints and contacts pull at the same bodies no energy appears.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;

RigidBody awake_at(const Vector3d& place) {
  RigidBody body = body_at(at(place, Quat::Identity()));
  body.can_sleep = false;
  return body;
}

// Planar locks take from the hinge what it would hold itself; the axis they leave is the motor's.
TEST(JointsAndLocks, AMotorTurnsABodyThatIsLockedToThePlane) {
  PhysicsWorld world(no_gravity());
  RigidBody wheel = free_body(1, {0.4, 0.4, 0.4});
  wheel.locks = MotionLocks::planar();
  wheel.can_sleep = false;
  const BodyId body = must(world.create_body(wheel));
  JointAxis axis;
  axis.motor = JointMotor{JointMotor::Mode::Velocity, real(6), real(50)};
  must(world.create_joint(
      joint_at(world, {}, body, HingeJoint{axis}, {0, 0, 0}, Vector3d::UnitZ())));
  run(world, 1);
  EXPECT_NEAR(spin(world, body).z(), 6, 1e-4);
  EXPECT_LE(position(world, body).norm(), 1e-6);
}

// Planks hinged end to end between two walls, taut, and a ball of 113 kg let fall on them from
// 16 cm. A taut chain is the stiffest thing there is across a load: it can close a gap of the
// square of its sag only by lifting all that it carries.
struct Bridge {
  int planks, substeps;
  double ball;  // [planks] where it falls
};
void PrintTo(const Bridge& b, std::ostream* out) {
  *out << b.planks << " planks, " << b.substeps << " substeps, ball at " << b.ball;
}
class TautBridge : public ::testing::TestWithParam<Bridge> {};

TEST_P(TautBridge, CarriesABallAndGainsNothing) {
  const Bridge bridge = GetParam();
  WorldSettings settings;
  settings.substeps = bridge.substeps;
  PhysicsWorld world(settings);
  std::vector<JointId> hinges;
  BodyId last;
  const double length = 0.5;  // [m]
  for (int i = 0; i <= bridge.planks; ++i) {
    BodyId plank;
    if (i < bridge.planks)
      plank = add(world, awake_at({length * (i + 0.5), 0, 0}), with(box(0.24, 0.04, 0.5)));
    hinges.push_back(must(world.create_joint(
        joint_at(world, last, plank, HingeJoint{}, {length * i, 0, 0}, Vector3d::UnitZ()))));
    last = plank;
  }
  const BodyId ball = add(world, awake_at({length * bridge.ball, 0.5, 0}), with(sphere(0.3)));
  const double start = world.energy().total();
  const double scale = world.mass_properties(ball).mass * kGravity * 0.16;  // [J] of the fall
  double top = start, gap = 0;
  for (int i = 0; i < 600; ++i) {
    world.step(1.0 / 60);
    top = std::max(top, world.energy().total());
    for (const JointId hinge : hinges)
      gap = std::max(gap, static_cast<double>(world.joint_state(hinge).linear_error));
  }
  std::printf("[ figures  ] gap %.2g m, gain %.2g of the fall\n", gap, (top - start) / scale);
  EXPECT_LE(top - start, 1e-3 * scale);
  EXPECT_LE(gap, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Cases, TautBridge,
                         ::testing::Values(Bridge{10, 1, 3.3}, Bridge{10, 2, 3.3},
                                           Bridge{10, 4, 3.3}, Bridge{10, 8, 3.3},
                                           Bridge{10, 16, 3.3}, Bridge{10, 4, 0.5},
                                           Bridge{10, 8, 7.7}, Bridge{40, 4, 20},
                                           Bridge{40, 8, 20}));

// Two boxes of 85 and 141 kg over a pulley; the lighter is drawn up against a plate that stops it.
TEST(JointsAndContacts, APulleysLoadThatHitsAPlateGainsNothing) {
  PhysicsWorld world;
  const BodyId a = add(world, awake_at({-0.6, 1.6, 0}), with(cube(0.22)));
  const BodyId b = add(world, awake_at({0.6, 2.9, 0}), with(cube(0.26)));
  add(world, body_at(at(0, 4.3, 0), MotionType::Static), with(box(1.5, 0.05, 0.06)));
  Joint joint;
  joint.body_a = a;
  joint.body_b = b;
  PulleyJoint pulley;
  pulley.over_a = pos(-0.6, 4.2, 0);
  pulley.over_b = pos(0.6, 4.2, 0);
  joint.kind = pulley;
  must(world.create_joint(joint));
  const double start = world.energy().total();
  double top = start;
  bool hit = false;
  for (int i = 0; i < 300; ++i) {
    world.step(1.0 / 60);
    top = std::max(top, world.energy().total());
    hit = hit || !contacts(world).empty();
  }
  EXPECT_TRUE(hit);
  EXPECT_LE(top - start, 1e-3 * std::abs(start));
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
