// The checker that judges all engines sees what is wrong: overlaps of every pair of shapes, corners
// below the mesh, a stretched joint, energy gained, bodies lost, stacks fallen, flips.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/anchors/judge/check.h"
#include "bench/anchors/scenes.h"

namespace plumb::anchors {
namespace {

std::vector<BodyState> states_of(const Scene& scene) {
  std::vector<BodyState> out;
  for (const Body& body : scene.bodies)
    out.push_back({body.position, body.orientation, body.velocity, body.spin});
  return out;
}

double overlap_of(const Body& a, const Body& b, const std::vector<Hull>& hulls = {}) {
  Scene scene;
  scene.hulls = hulls;
  scene.bodies = {a, b};
  return worst_penetration(scene, states_of(scene));
}

TEST(AnchorChecker, SeesOverlapsAsDeepAsTheyAre) {
  EXPECT_NEAR(overlap_of(box(kCube, {0, 0, 0}), box(kCube, {0.1, 0.97, 0})), 0.03, 1e-12);
  EXPECT_EQ(overlap_of(box(kCube, {0, 0, 0}), box(kCube, {0, 1.01, 0})), 0);
  EXPECT_NEAR(overlap_of(sphere(0.5, {0, 0, 0}), sphere(0.3, {0.6, 0, 0})), 0.2, 1e-12);
  EXPECT_NEAR(overlap_of(sphere(0.5, {0, 0.98, 0}), box(kCube, {0, 0, 0})), 0.02, 1e-12);
  EXPECT_NEAR(overlap_of(capsule(0.2, 0.3, {0, 0.95, 0}), box(kCube, {0, 0, 0})), 0.05, 1e-12);
  // A ball whose middle has gone into the box: the way out through the nearest face.
  EXPECT_NEAR(overlap_of(sphere(0.5, {0, 0.4, 0}), box(kCube, {0, 0, 0})), 0.6, 1e-12);
  // A hull along x, told by the corners that reach farthest.
  const Scene s = hulls(2);
  double reach = 0;
  for (const Vector3d& p : s.hulls[0].points) reach = std::max(reach, p.x());
  Body hull = s.bodies[0];
  hull.position = Vector3d::Zero();
  hull.orientation = Quaterniond::Identity();
  const Body wall = box({5, 5, 5}, {reach + 5 - 0.01, 0, 0});
  EXPECT_NEAR(overlap_of(hull, wall, s.hulls), 0.01, 1e-12);
}

TEST(AnchorChecker, SeesTheGroundAndTheMesh) {
  Scene flat = tall_stack(1);
  flat.bodies[0].position.y() = 0.46;
  EXPECT_NEAR(worst_penetration(flat, states_of(flat)), 0.04, 1e-12);

  Scene hills = on_mesh(1);
  for (Vector3d& p : hills.mesh.vertices) p.y() = 0.25 * p.x();  // an even slope
  hills.bodies = {sphere(0.5, {3.3, 0.25 * 3.3, 7.7})};  // middle on the slope: half of it is below
  EXPECT_NEAR(depth_under_mesh(hills, states_of(hills)), 0.5, 1e-12);
  hills.bodies = {box(kCube, {3.3, 0.25 * 3.3, 7.7})};
  // The deepest corner, along the normal (-0.25, 1, 0).
  EXPECT_NEAR(depth_under_mesh(hills, states_of(hills)), 0.5 * 1.25 / std::hypot(0.25, 1), 1e-12);
  hills.bodies = {box(kCube, {3.3, 3, 7.7})};
  EXPECT_EQ(depth_under_mesh(hills, states_of(hills)), 0);
}

TEST(AnchorChecker, SeesWhatMovedAndWhatIsLost) {
  const Scene s = tall_stack(3);
  std::vector<BodyState> end = states_of(s);
  EXPECT_TRUE(Checker(s).finish(end).stands());
  EXPECT_EQ(Checker(s).finish(end).escaped, 0);
  end[2].position += Vector3d(0.3, -0.1, 0.5);
  end[0].position.y() = -3;
  end[1].velocity = {0, 0, 3};
  const Quality q = Checker(s).finish(end);
  EXPECT_FALSE(q.stands());
  EXPECT_NEAR(q.top_sideways, std::hypot(0.3, 0.5), 1e-12);
  EXPECT_NEAR(q.top_up, -0.1, 1e-12);
  EXPECT_NEAR(q.mean_speed, 1, 1e-12);
  EXPECT_EQ(q.escaped, 1);
  end[1].position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Checker(s).finish(end).escaped, 2);
}

TEST(AnchorChecker, SeesGapsAndEnergy) {
  const Scene s = chain(4);
  std::vector<BodyState> now = states_of(s);
  Checker checker(s);
  checker.after_step(now);
  now[2].position += Vector3d(0, 0.07, 0);
  checker.after_step(now);
  const double raised = s.bodies[2].mass * 9.81 * 0.07 / energy_of(s, states_of(s));
  const Quality q = checker.finish(states_of(s));
  EXPECT_NEAR(q.joint_gap, 0.07, 1e-12);
  EXPECT_NEAR(q.energy_rise, raised, 1e-12);
  EXPECT_NEAR(q.energy_rms, raised / std::sqrt(2), 1e-12);
  EXPECT_NEAR(q.energy_change, 0, 1e-12);
}

// A body that turns about x at a steady rate turns over twice a turn; one that wobbles does not.
TEST(AnchorChecker, CountsFlips) {
  const Scene s = dzhanibekov();
  Checker turning(s), wobbling(s);
  std::vector<BodyState> now = states_of(s);
  for (int i = 0; i <= 300; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100;
    now[0].orientation = Eigen::AngleAxisd(angle, Vector3d::UnitX());
    turning.after_step(now);
    now[0].orientation = Eigen::AngleAxisd(1.5 + 0.4 * std::sin(angle), Vector3d::UnitX());
    wobbling.after_step(now);
  }
  EXPECT_EQ(turning.finish(now).flips, 6);
  EXPECT_EQ(wobbling.finish(now).flips, 0);
}

}  // namespace
}  // namespace plumb::anchors
