// Invariant: what a scene says about effects is what its world has; written out it reads the same;
// what is wrong is told with its line and the remedy, and leaves the world as it was.
#include <string>

#include "assets/bad_scene.h"
#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using assets::instantiate;
using assets::parse_scene;

const char* const kBodies = R"("bodies": [
    { "name": "a", "position": [0, 1, 0], "colliders": [{ "shape": "sphere", "radius": 0.5 }] },
    { "name": "b", "position": [3, 5, 0], "colliders": [{ "shape": "sphere", "radius": 0.5 }] }
  ])";

std::string scene_with(const std::string& effects) {
  return std::string("{ \"plumb_scene\": 1,\n  ") + kBodies + ",\n  \"effects\": [\n" + effects +
         "\n] }";
}

const char* const kAll = R"(
    { "kind": "point_gravity", "center": [1, 2, 3], "mu": 4.5, "softening": 0.25 },
    { "kind": "thrust", "name": "engine", "body": "a", "force": [1, 2, 3], "point": [0, 0.5, 0],
      "in_world_axes": true },
    { "kind": "explosion", "center": [9, 0, 0], "impulse": 12, "falloff": 1.5, "updraft": 3 },
    { "kind": "drag", "body": "b", "linear": 1.25, "quadratic": 0.5, "angular_linear": 2,
      "medium": [1, 0, 0] },
    { "kind": "magnus", "coefficient": -0.75 },
    { "kind": "attractor", "center": [0, 9, 0], "strength": -3, "law": "inverse_square",
      "range": 8 },
    { "kind": "wind", "velocity": [0, 0, 5], "density": 1.5 },
    { "kind": "aero_surface", "name": "flap", "body": "a", "tensor": [1, 2, 3, 4, 5, 6, 7, 8, 9],
      "minimum": [0, 0, 0, 0, 0, 0, 0, 0, 1], "maximum": [2, 0, 0, 0, 0, 0, 0, 0, 0],
      "control": -0.5, "orientation": { "euler_degrees": [0, 90, 0] } },
    { "kind": "buoyancy", "name": "lake", "level": -2, "density": 1025, "current": [0.5, 0, 0] },
    { "kind": "spring", "name": "tie", "body": "a", "other": "b", "stiffness": 50,
      "acts": "when_stretched" },
    { "kind": "spring", "name": "hook", "body": "a", "other_point": [0, 4, 0], "rest_length": 2 })";

TEST(SceneEffects, BuildsWhatIsWritten) {
  const auto scene = parse_scene(scene_with(kAll), "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  EXPECT_EQ(world.effect_count(), 11u);
  const BodyId a = instance->find("a"), b = instance->find("b");

  const Effect lake = world.effect(instance->find_effect("lake"));
  EXPECT_TRUE(lake.body.is_null());
  EXPECT_EQ(std::get<Buoyancy>(lake.kind).density, Real(1025));
  EXPECT_EQ(std::get<Buoyancy>(lake.kind).level, Real(-2));
  const Effect engine = world.effect(instance->find_effect("engine"));
  EXPECT_EQ(engine.body, a);
  EXPECT_EQ(std::get<Thrust>(engine.kind).force, Vec3(1, 2, 3));
  EXPECT_TRUE(std::get<Thrust>(engine.kind).in_world_axes);
  const auto flap = std::get<AeroSurface>(world.effect(instance->find_effect("flap")).kind);
  EXPECT_EQ(flap.tensor(1, 0), Real(4));  // row by row
  EXPECT_TRUE(flap.is_controlled);
  EXPECT_EQ(flap.control, Real(-0.5));
  const auto tie = std::get<Spring>(world.effect(instance->find_effect("tie")).kind);
  EXPECT_EQ(tie.other, b);
  EXPECT_EQ(tie.rest_length, Real(5));  // as the scene begins
  EXPECT_EQ(tie.acts, Spring::Acts::WhenStretched);
  const auto hook = std::get<Spring>(world.effect(instance->find_effect("hook")).kind);
  EXPECT_TRUE(hook.other.is_null());
  EXPECT_EQ(hook.rest_length, Real(2));
  EXPECT_EQ(std::get<Attractor>(world.effect(instance->find_effect("effect 5")).kind).law,
            Attractor::Law::InverseSquare);
  EXPECT_TRUE(instance->find_effect("nobody").is_null());
  for (const PlanItem item : {PlanItem::PointGravity, PlanItem::Thrust, PlanItem::Drag,
                              PlanItem::Spring, PlanItem::AeroSurface, PlanItem::Wind})
    EXPECT_TRUE(world.plan().active(item)) << name_of(item);
  EXPECT_FALSE(world.plan().active(PlanItem::Buoyancy));  // nobody is near the water
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
}

TEST(SceneEffects, SurvivesWriting) {
  const auto scene = parse_scene(scene_with(kAll), "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  const std::string once = assets::scene_to_json(*scene);
  const auto again = parse_scene(once, "written.json");
  ASSERT_TRUE(again.ok()) << again.error();
  EXPECT_EQ(assets::scene_to_json(*again), once);
}

TEST(SceneEffects, MistakesAreNamedWithTheirLine) {
  const bad_scenes::BadScene bad[] = {
      {"kind", scene_with("{ \"kind\": \"gravityy\" }"), 7, "no kind of effect 'gravityy'",
       "point_gravity"},
      {"none", scene_with("{ \"name\": \"x\" }"), 7, "has no 'kind'", "buoyancy"},
      {"body", scene_with("{ \"kind\": \"thrust\" }"), 7, "body", "name the body"},
      {"unknown", scene_with("{ \"kind\": \"drag\", \"body\": \"c\" }"), 7, "'c'", "a"},
      {"key", scene_with("{ \"kind\": \"drag\", \"stiffness\": 4 }"), 7, "stiffness", ""},
      {"twice", scene_with("{ \"kind\": \"spring\", \"body\": \"a\", \"other\": \"a\" }"), 7,
       "one body twice", "name two"},
      {"half",
       scene_with("{ \"kind\": \"aero_surface\", \"body\": \"a\",\n \"minimum\": "
                  "[0,0,0,0,0,0,0,0,0] }"),
       7, "one of 'minimum' and 'maximum'", "both"},
      {"names",
       scene_with("{ \"kind\": \"wind\", \"name\": \"w\" },\n{ \"kind\": \"wind\", "
                  "\"name\": \"w\" }"),
       8, "another effect named 'w'", "name of its own"},
  };
  for (const auto& one : bad) bad_scenes::expect_error_of(one);
}

// What only the world can tell: its message comes with the line, and nothing of the scene stays.
TEST(SceneEffects, WhatTheWorldRefusesLeavesItAsItWas) {
  for (const char* wrong : {"{ \"kind\": \"buoyancy\", \"density\": -1 }",
                            "{ \"kind\": \"spring\", \"body\": \"a\", "
                            "\"stiffness\": 1e30 }",
                            "{ \"kind\": \"wind\", \"density\": 0 }"}) {
    const auto scene = parse_scene(
        scene_with(std::string("{ \"kind\": \"drag\", \"linear\": 1 },\n") + wrong), "test.json");
    ASSERT_TRUE(scene.ok()) << scene.error();
    PhysicsWorld world;
    const auto instance = instantiate(*scene, world);
    ASSERT_FALSE(instance.ok());
    EXPECT_EQ(instance.error().rfind("test.json:8: effect ", 0), 0u) << instance.error();
    EXPECT_EQ(world.body_count(), 0u);
    EXPECT_EQ(world.effect_count(), 0u);
  }
}

}  // namespace
