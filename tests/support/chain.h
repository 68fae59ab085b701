// A chain of links 0.5 m long, ball to ball, held level at one end and let go: the light links lash
// about, and a heavy end stretches them taut.
#pragma once

#include <algorithm>
#include <vector>

#include "support/build.h"

namespace plumb::inline PLUMB_ABI {
namespace testing_support {

struct Chain {
  static constexpr double kLink = 0.5;  // [m]
  PhysicsWorld world;
  std::vector<JointId> joints;
  double scale = 0;  // [J] m g l of the whole chain: what it could fall by

  // heavy_end: mass of the last link over that of the others, which have 1 kg.
  Chain(int links, double heavy_end, int substeps = WorldSettings{}.substeps)
      : world(settings(substeps)) {
    BodyId last;
    for (int i = 0; i < links; ++i) {
      const double m = i + 1 == links ? heavy_end : 1, x = kLink * (i + 0.5);
      RigidBody body = free_body(m, Eigen::Vector3d::Constant(0.02 * m));
      body.pose = at(x, 0, 0);
      body.can_sleep = false;
      const BodyId link = must(world.create_body(body));
      Joint joint;
      joint.body_a = last;
      joint.body_b = link;
      joint.frame_a.position = Vec3(last.is_null() ? Real(0) : static_cast<Real>(kLink / 2), 0, 0);
      joint.frame_b.position = Vec3(static_cast<Real>(-kLink / 2), 0, 0);
      joint.kind = BallJoint{};
      joints.push_back(must(world.create_joint(joint)));
      last = link;
      scale += m * 9.81 * x;
    }
  }
  struct Worst {
    double gap = 0, rise = -1e9, left = 0;  // [m], of the scale, of the scale
  };
  Worst fall(double seconds, double dt) {
    Worst worst;
    const double start = world.energy().total();
    for (int i = 0; i < static_cast<int>(seconds / dt + 0.5); ++i) {
      world.step(dt);
      for (const JointId joint : joints)
        worst.gap = std::max(worst.gap, static_cast<double>(world.joint_state(joint).linear_error));
      worst.left = (world.energy().total() - start) / scale;
      worst.rise = std::max(worst.rise, worst.left);
    }
    return worst;
  }

 private:
  static WorldSettings settings(int substeps) {
    WorldSettings given;
    given.substeps = substeps;
    return given;
  }
};

}  // namespace testing_support
}  // namespace plumb::inline PLUMB_ABI
