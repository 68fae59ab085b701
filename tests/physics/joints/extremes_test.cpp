// Proves that joints stay calm where their equations are at their worst: limits and friction that
// hold the same turn, springs that no substep can follow, a pulley one of whose ends has arrived, a
// joint with as many soft rows as there can be.
#include "tumblers.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace joint_scenes;

// Both limits and the friction of a cone-twist joint ask for rates in three dimensions.
TEST(JointExtremes, FrictionBesideLimitsGainsNothing) {
  for (int i = 1; i <= 12; ++i) {
    Tumblers t;
    Joint joint = joint_at(t.world, t.a, t.b,
                           ConeTwistJoint{real(0.4), real(-0.3), real(0.3), {}, real(0.02 * i)},
                           {0.5, 0.3, -0.2}, {1, 1, 0});
    joint.frame_b.position += vec(0.05, 0, -0.03);
    const JointId id = must(t.world.create_joint(joint));
    t.world.step(1.0 / 60);  // they begin with velocities that the joint does not allow
    const double energy = t.world.energy().total();
    double most = 0;
    run(t.world, 10, 1.0 / 60, [&] { most = std::max(most, t.world.energy().total()); });
    EXPECT_LE(most, 1.01 * energy) << i;
    EXPECT_LE(static_cast<double>(t.world.joint_state(id).linear_error), 1e-3) << i;
  }
}

// Eight rows that are all free.
TEST(JointExtremes, SoftConeTwistWithFrictionKeepsBothMomenta) {
  Tumblers t;
  Joint joint =
      joint_at(t.world, t.a, t.b, ConeTwistJoint{real(0.4), real(-0.3), real(0.3), {}, real(0.1)},
               {0.5, 0.3, -0.2}, {1, 1, 0});
  joint.softness = {real(5), real(0.5)};
  must(t.world.create_joint(joint));
  const EnergyReport before = t.world.energy();
  run(t.world, 10);
  const EnergyReport after = t.world.energy();
  EXPECT_LE((after.momentum - before.momentum).norm(), 1e-3);
  EXPECT_LE((after.angular_momentum - before.angular_momentum).norm(), 1e-3);
  EXPECT_LE(after.total(), before.total());
}

// A spring of w h = 1 to 20 off the centres of two bodies that spin.
TEST(JointExtremes, AStiffSpringOffCentreGainsNothing) {
  for (const double stiffness : {3e4, 1e5, 3e5, 1e6, 1e7}) {
    PhysicsWorld world(no_gravity());
    const BodyId a = add_body(world, {0, 0, 0}, 1, {0.17, 0.17, 0.1});
    const BodyId b = add_body(world, {2, 0, 0}, 2, {0.3, 0.2, 0.3});
    must(world.set_angular_velocity(a, vec(1, 2, 3)));
    must(world.set_angular_velocity(b, vec(-2, 1, 2)));
    Joint joint;
    joint.body_a = a;
    joint.body_b = b;
    joint.frame_a.position = vec(0.5, 0.4, 0.2);
    joint.frame_b.position = vec(-0.5, 0.2, 0.5);
    joint.kind = SpringJoint{real(1), real(stiffness), real(0)};
    const JointId id = must(world.create_joint(joint));
    const auto energy = [&] {
      const double stretch = static_cast<double>(world.joint_state(id).translation) - 1;
      return world.energy().total() + 0.5 * stiffness * stretch * stretch;
    };
    const double before = energy();
    double most = 0;
    run(world, 10, 1.0 / 60, [&] { most = std::max(most, energy()); });
    EXPECT_LE(most, 1.05 * before) << stiffness;
  }
}

// The light end is drawn to its point; the heavy one must hang there, and not run out.
TEST(JointExtremes, APulleyHoldsItsLoadWhenTheOtherEndHasArrived) {
  for (const bool stiff : {false, true}) {
    PhysicsWorld world;
    const BodyId light = add_body(world, {-0.5, -2, 0}, 0.5, {0.05, 0.05, 0.05});
    const BodyId heavy = add_body(world, {0.5, -1, 0}, 50, {5, 5, 5});
    Joint joint;
    joint.body_a = light;
    joint.body_b = heavy;
    PulleyJoint pulley;
    pulley.over_a = pos(Vector3d(-0.5, 0, 0));
    pulley.over_b = pos(Vector3d(0.5, 0, 0));
    pulley.stiff = stiff;
    joint.kind = pulley;
    must(world.create_joint(joint));
    run(world, 5);
    // 3 m of rope, all of it on the heavy side
    EXPECT_NEAR(position(world, heavy).y(), -3, 0.05) << stiff;
    EXPECT_LE((position(world, light) - Vector3d(-0.5, 0, 0)).norm(), 0.1) << stiff;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
