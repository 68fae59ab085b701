// Proves that a manifold that is kept tells what a search would: same points and depths while
// bodies hardly move, and that whatever changes a shape or a place makes it be found anew.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

struct Point {
  Eigen::Vector3d place;  // [m] from the body that the contact is told from
  double separation;      // [m] as the step began
};
// Of the only contact there is.
std::vector<Point> points_of(const PhysicsWorld& world) {
  const Snapshot saved = world.save();
  std::vector<Point> points(static_cast<std::size_t>(saved.find("contact.points")->integers.at(0)));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::vector<double>& n = saved.find("contact.place" + std::to_string(k))->reals;
    points[k] = {{n[0], n[1], n[2]}, n[3]};
  }
  return points;
}
WorldSettings awake() {
  WorldSettings settings;
  settings.sleeping = false;
  return settings;
}

// A box at rest, pushed by so little that its manifold is kept, is told as sinking and tilting just
// as it does: the depth of each point is the distance of a corner to the floor.
TEST(Recycling, DepthsFollowTheBody) {
  PhysicsWorld world(awake());
  add_slab(world, 10, 10);
  const BodyId box_id = add(world, body_at(at(0, 0.5, 0)), with(cube(0.5)));
  for (int i = 0; i < 200; ++i) world.step(1.0 / 60);
  ASSERT_EQ(points_of(world).size(), 4u);
  for (int k = 0; k < 60; ++k) {
    must(world.apply_torque(box_id, vec(20.0 * k, 0, -15.0 * k)));
    const Pose pose = world.pose(box_id);
    world.step(1.0 / 60);
    const std::vector<Point> points = points_of(world);
    ASSERT_EQ(points.size(), 4u);
    for (const Point& point : points) {
      // The corner of the box nearest to the point, where the step began.
      double depth = 1;
      for (double x : {-0.5, 0.5})
        for (double z : {-0.5, 0.5}) {
          const Eigen::Vector3d corner =
              (pose.orientation * vec(x, -0.5, z)).template cast<double>();
          const Eigen::Vector3d across = corner - point.place;
          if (std::hypot(across.x(), across.z()) < 0.1)
            depth = corner.y() + static_cast<double>(pose.position.y());
        }
      EXPECT_NEAR(point.separation, depth, sizeof(Real) == 4 ? 3e-7 : 1e-9);
    }
  }
}

// A body that is moved by hand, or given another shape, shows it in the next step.
TEST(Recycling, ChangesMakeItAnew) {
  PhysicsWorld world(awake());
  add_slab(world, 10, 10);
  const BodyId body = must(world.create_body(body_at(at(0, 0.5, 0))));
  const ColliderId collider = must(world.create_collider(body, with(cube(0.5))));
  for (int i = 0; i < 100; ++i) world.step(1.0 / 60);
  ASSERT_EQ(points_of(world).size(), 4u);
  must(world.set_shape(collider, sphere(0.5)));
  world.step(1.0 / 60);
  ASSERT_EQ(points_of(world).size(), 1u);
  must(world.set_shape(collider, cube(0.5)));
  world.step(1.0 / 60);
  ASSERT_EQ(points_of(world).size(), 4u);
  must(world.set_pose(body, at(0, 0.4, 0)));
  world.step(1.0 / 60);
  for (const Point& point : points_of(world)) EXPECT_NEAR(point.separation, -0.1, 1e-3);
}

// What is saved with kept manifolds goes on as if it had not been.
TEST(Recycling, SurvivesSavingInTheMiddle) {
  PhysicsWorld world(awake()), copy;
  build_pyramid(world, {.base = 6});
  for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
  must(copy.restore(world.save()));
  for (int i = 0; i < 60; ++i) {
    world.step(1.0 / 60);
    copy.step(1.0 / 60);
    ASSERT_EQ(world.state_hash(), copy.state_hash()) << i;
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
