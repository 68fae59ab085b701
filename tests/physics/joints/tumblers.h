// Two free bodies to put a joint between.
#pragma once

#include "joint_scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace joint_scenes {

// Of unequal moments; they move and tumble, turned in general position, with nothing acting on
// them.
struct Tumblers {
  PhysicsWorld world{no_gravity()};
  BodyId a, b;
  Tumblers() {
    RigidBody first = free_body(2, {1, 2, 2.5}), second = free_body(0.5, {0.1, 0.2, 0.25});
    first.pose = at(Vector3d(0, 0, 0), turn(0.3, {1, 2, 3}));
    first.linear_velocity = vec(1, 0, 0);
    first.angular_velocity = vec(1, 2, -1);
    second.pose = at(Vector3d(1, 0.5, 0), turn(1.1, {0, 2, 3}));
    second.linear_velocity = vec(0, 1, 2);
    first.can_sleep = second.can_sleep = false;
    a = must(world.create_body(first));
    b = must(world.create_body(second));
  }
};

}  // namespace joint_scenes
}  // namespace plumb::inline PLUMB_ABI
