// The anchor scenes are the same numbers everywhere: the random sequence is the stated one, bodies
// have the mass and inertia of their shapes, and our engine builds each of them as described.
#include "bench/anchors/scenes.h"

#include <gtest/gtest.h>

#include "bench/anchors/engines/plumb_world.h"

namespace plumb::anchors {
namespace {

// FNV-1a of the first thousand numbers, from an independent computation in whole numbers.
TEST(AnchorScenes, RandomNumbersAreTheStatedOnes) {
  Random random(1);
  std::uint64_t hash = 14695981039346656037u;
  std::vector<std::uint64_t> numbers;
  for (int i = 0; i < 1000; ++i) {
    numbers.push_back(static_cast<std::uint64_t>(random.range(0, 16777216)));
    hash = (hash ^ numbers.back()) * 1099511628211u;
  }
  EXPECT_EQ(numbers[0], 3967065u);
  EXPECT_EQ(numbers[3], 11825978u);
  EXPECT_EQ(hash, 0xd5b8091188d139e5u);
}

TEST(AnchorScenes, HaveTheStatedNumbersOfThings) {
  EXPECT_EQ(pyramid().bodies.size(), 820u);
  EXPECT_EQ(pile().bodies.size(), 4096u);
  EXPECT_EQ(pile().ground.size(), 5u);
  EXPECT_EQ(hulls().bodies.size(), 1000u);
  EXPECT_EQ(hulls().hulls.size(), 32u);
  EXPECT_EQ(free_bodies(3000).bodies.size(), 3000u);
  EXPECT_EQ(chain().bodies.size(), 101u);
  EXPECT_EQ(chain().joints.size(), 101u);
  EXPECT_EQ(on_mesh(1).mesh.triangles.size(), 80000u);
  EXPECT_EQ(catalogue().size(), 12u);
}

// 20 kg a link and 20,000 kg at the end, each joint closed at the start.
TEST(AnchorScenes, ChainHangsTogether) {
  const Scene s = chain();
  EXPECT_NEAR(s.bodies.front().mass, 20, 1e-9);
  EXPECT_NEAR(s.bodies.back().mass, 20000, 10);  // of the radius rounded to a millimetre
  for (const BallJoint& joint : s.joints) {
    const auto place = [&](int i, const Vector3d& at) -> Vector3d {
      if (i < 0) return at;
      const Body& body = s.bodies[static_cast<std::size_t>(i)];
      return body.position + body.orientation * at;
    };
    EXPECT_LT((place(joint.a, joint.at_a) - place(joint.b, joint.at_b)).norm(), 1e-12);
  }
}

// A hull of n points in general position has 2 n - 4 triangles.
TEST(AnchorScenes, HullsAreClosedAndStandOnTheirPrincipalAxes) {
  const Scene s = hulls(4);
  for (std::size_t h = 0; h < s.hulls.size(); ++h) {
    EXPECT_EQ(s.hulls[h].triangles.size(), 28u);
    const HullMoments moments = moments_of(s.hulls[h]);
    EXPECT_LT(moments.center.norm(), 1e-13);
    const Body& body = s.bodies[h];
    EXPECT_NEAR(body.mass, 1000 * moments.volume, 1e-9);
    const Eigen::Matrix3d off = 1000 * moments.inertia - Eigen::Matrix3d(body.inertia.asDiagonal());
    EXPECT_LT(off.norm(), 1e-11);
  }
}

// What the description says of mass is what the engine derives from shape and density. 1e-6: sizes
// are rounded to float, and the tensor holds their fifth power.
TEST(AnchorScenes, OurMassesAreTheDescribedOnes) {
  for (const Scene& s : {pile(3), hulls(3), chain(3), elastic_grid(), mass_ratio()}) {
    PhysicsWorld world(settings_of(s));
    const std::vector<BodyId> ids = build_in(world, s);
    ASSERT_EQ(ids.size(), s.bodies.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const MassProperties ours = world.mass_properties(ids[i]);
      const Body& body = s.bodies[i];
      EXPECT_NEAR(ours.mass, body.mass, 1e-6 * body.mass) << s.name << " body " << i;
      EXPECT_LT(ours.center.norm(), 1e-6) << s.name << " body " << i;
      const Eigen::Matrix3d off = ours.I_Bcm_B - Eigen::Matrix3d(body.inertia.asDiagonal());
      EXPECT_LT(off.norm(), 2e-6 * body.inertia.norm()) << s.name << " body " << i;
    }
  }
}

TEST(AnchorScenes, OursStepsEachOfThem) {
  for (const Scene& s :
       {pyramid(4), pile(3), hulls(3), free_bodies(50), spread(20), chain(5), mass_ratio(),
        tall_stack(3), dzhanibekov(), on_mesh(20), elastic_grid(), sleepers(20)}) {
    PhysicsWorld world(settings_of(s));
    const std::vector<BodyId> ids = build_in(world, s);
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(world.step(s.dt).status.ok()) << s.name;
    EXPECT_EQ(world.joint_count(), s.joints.size()) << s.name;
    EXPECT_EQ(world.last_report().quarantined, 0u) << s.name;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      // Nothing goes farther in five steps than its own speed and the fall take it, and 1 mm.
      const double reach = 5 * s.dt * (s.bodies[i].velocity.norm() + 5 * s.dt * s.gravity.norm());
      const Vector3d way = world.center_of_mass(ids[i]).cast<double>() - s.bodies[i].position;
      EXPECT_LT(way.norm(), reach + 1e-3) << s.name << " body " << i;
    }
  }
}

}  // namespace
}  // namespace plumb::anchors
