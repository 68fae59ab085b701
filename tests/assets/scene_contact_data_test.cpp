// Invariant: what a scene says about contacts is what its world has: belts, sides, groups, kinds,
// the table of materials and the excluded pairs; written out it reads the same.
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using assets::instantiate;
using assets::parse_scene;

const char* const kScene = R"({
  "plumb_scene": 1,
  "materials": {
    "rubber": { "rolling_friction": 0.25, "torsional_friction": 0.125, "kind": 4294967295,
                "grain": [0, 0, 2], "grain_friction": 0.375, "adhesion": 12.5 },
    "ice": { "kind": 2 }
  },
  "material_pairs": [
    { "kinds": [4294967295, 2], "friction": 0.5, "torsional_friction": 0 },
    { "kinds": [2, 2], "restitution": 0.75, "rolling_friction": 0.5 }
  ],
  "bodies": [
    { "name": "belt", "type": "static", "colliders": [
      { "shape": "box", "half_extents": [4, 0.5, 1], "material": "rubber",
        "surface_velocity": { "linear": [1.5, 0, 0], "angular": [0, 2, 0] } },
      { "shape": "box", "half_extents": [1, 0.5, 1], "position": [0, 3, 0], "one_way": [0, 2, 0],
        "group": -2147483648 }] },
    { "name": "crate", "position": [0, 1, 0], "repeat": { "count": [3, 1, 1] }, "colliders": [
      { "shape": "box", "half_extents": [0.25, 0.25, 0.25], "material": "ice", "group": 7 }] }
  ],
  "excluded_pairs": [
    { "body_a": "belt", "body_b": "crate[1]" },
    { "body_a": "crate[2]", "collider_a": 0, "body_b": "belt", "collider_b": 1 }
  ]
})";

TEST(SceneContactData, BuildsWhatIsWritten) {
  const auto scene = parse_scene(kScene, "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  const BodyId belt = instance->find("belt");
  BodyId crates[3];
  for (int k = 0; k < 3; ++k) crates[k] = instance->find("crate[" + std::to_string(k) + "]");

  const Collider running = world.collider(world.colliders_of(belt)[0]);
  EXPECT_EQ(running.surface_velocity.linear, Vec3(Real(1.5), 0, 0));
  EXPECT_EQ(running.surface_velocity.angular, Vec3(0, 2, 0));
  EXPECT_EQ(running.material.rolling_friction, Real(0.25));
  EXPECT_EQ(running.material.torsional_friction, Real(0.125));
  EXPECT_EQ(running.material.kind, 4294967295u);
  EXPECT_EQ(running.material.grain, Vec3(0, 0, 2));
  EXPECT_EQ(running.material.grain_friction, Real(0.375));
  EXPECT_EQ(running.material.adhesion, Real(12.5));
  EXPECT_EQ(running.filter.group, 0);
  const Collider shelf = world.collider(world.colliders_of(belt)[1]);
  EXPECT_EQ(shelf.one_way, Vec3(0, 1, 0));  // of any length
  EXPECT_EQ(shelf.filter.group, -2147483647 - 1);
  EXPECT_EQ(world.collider(world.colliders_of(crates[2])[0]).filter.group, 7);

  const auto unlike = world.material_pair(2, 4294967295u);
  ASSERT_TRUE(unlike.has_value());
  EXPECT_EQ(unlike->friction, Real(0.5));
  EXPECT_EQ(unlike->torsional_friction, Real(0));
  EXPECT_FALSE(unlike->restitution.has_value() || unlike->rolling_friction.has_value());
  EXPECT_EQ(world.material_pair(2, 2)->restitution, Real(0.75));
  EXPECT_EQ(world.material_pair(2, 2)->rolling_friction, Real(0.5));

  EXPECT_FALSE(world.is_excluded(belt, crates[0]));
  EXPECT_TRUE(world.is_excluded(belt, crates[1]));
  EXPECT_FALSE(world.is_excluded(belt, crates[2]));
  const ColliderId crate = world.colliders_of(crates[2])[0];
  EXPECT_TRUE(world.is_excluded(world.colliders_of(belt)[1], crate));
  EXPECT_FALSE(world.is_excluded(world.colliders_of(belt)[0], crate));
}

TEST(SceneContactData, SurvivesWriting) {
  const auto scene = parse_scene(kScene, "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  const std::string once = assets::scene_to_json(*scene);
  const auto again = parse_scene(once, "written.json");
  ASSERT_TRUE(again.ok()) << again.error();
  EXPECT_EQ(assets::scene_to_json(*again), once);
  PhysicsWorld first, second;
  ASSERT_TRUE(instantiate(*scene, first).ok());
  ASSERT_TRUE(instantiate(*again, second).ok());
  EXPECT_TRUE(first.save() == second.save());
}

// A scene made by code that names what is not there: an error, and the world as it was, with the
// entries that its table had.
TEST(SceneContactData, AFailureLeavesTheTableAsItWas) {
  const auto scene = parse_scene(kScene, "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  ASSERT_TRUE(world.set_material_pair(2, 2, MaterialPair{.friction = Real(0.0625)}).ok());
  const auto fails = [&](const auto& spoil, const std::string& says) {
    assets::Scene bad = *scene;
    spoil(bad);
    const auto instance = instantiate(bad, world);
    ASSERT_FALSE(instance.ok());
    EXPECT_NE(instance.error().find(says), std::string::npos) << instance.error();
    EXPECT_EQ(world.body_count(), 0u);
    EXPECT_EQ(world.material_pair(2, 2)->friction, Real(0.0625));
    EXPECT_FALSE(world.material_pair(2, 2)->restitution.has_value());
    EXPECT_FALSE(world.material_pair(2, 4294967295u).has_value());
  };
  fails([](assets::Scene& s) { s.excluded_pairs[0].b.body = "nobody"; }, "no body 'nobody'");
  fails([](assets::Scene& s) { s.excluded_pairs[1].b.collider = 2; }, "no collider 2");
  fails([](assets::Scene& s) { s.excluded_pairs[1].a.collider.reset(); }, "one side only");
  fails([](assets::Scene& s) { s.material_pairs[1].kind_a = 0; }, "material pair");
  fails([](assets::Scene& s) { s.material_pairs[1].values.friction = Real(-1); }, "friction");
}

// The belt of the file carries what lies on it, and the excluded crate falls through it.
TEST(SceneContactData, ActsInTheWorld) {
  const auto scene = parse_scene(kScene, "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  EXPECT_GT(world.pose(instance->find("crate[0]")).position.x(),
            scene->bodies[1].body.pose.position.x() - 1 + 0.5);
  EXPECT_LT(world.pose(instance->find("crate[1]")).position.y(), 0);
}

}  // namespace
