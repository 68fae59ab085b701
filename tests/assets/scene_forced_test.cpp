// Invariant: what a scene forces of the plan is what its world has; written out it reads the same;
// what cannot be forced is told with its line.
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"
#include "scene/keys.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)

std::string scene_with(const std::string& forced) {
  return "{ \"plumb_scene\": 1, \"settings\": {\n  \"forced\": {\n" + forced +
         "\n} },\n \"bodies\": [] }";
}

TEST(SceneForced, IsWhatTheWorldHasAndReadsBackAsWritten) {
  const auto scene = assets::parse_scene(
      scene_with("\"gyroscopic\": \"off\", \"look_ahead\": \"on\", \"spring\": \"off\","
                 "\"sleeping\": \"automatic\""),
      "scene.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PlanChoices wanted;
  wanted.set(PlanItem::Gyroscopic, Choice::Off);
  wanted.set(PlanItem::LookAhead, Choice::On);
  wanted.set(PlanItem::Spring, Choice::Off);
  EXPECT_EQ(scene->settings.forced, wanted);
  PhysicsWorld world;
  ASSERT_TRUE(assets::instantiate(*scene, world).ok());
  EXPECT_EQ(world.settings().forced, wanted);
  const auto again = assets::parse_scene(assets::scene_to_json(*scene), "again.json");
  ASSERT_TRUE(again.ok()) << again.error();
  EXPECT_EQ(again->settings.forced, wanted);
}

TEST(SceneForced, KnowsEveryItemThatMayBeForced) {
  std::uint64_t known = 0, possible = 0;
  for (const std::string_view key : assets::scene::keys::kForced) {
    const auto item = plan_item_of(key);
    ASSERT_TRUE(item.has_value()) << key;
    known |= bit_of(*item);
  }
  for (std::size_t k = 0; k < kPlanItemCount; ++k)
    if (may_force(static_cast<PlanItem>(k), Choice::Off))
      possible |= bit_of(static_cast<PlanItem>(k));
  EXPECT_EQ(known, possible);
}

TEST(SceneForced, WhatCannotBeForcedIsTold) {
  for (const auto& [forced, word] :
       {std::pair<std::string, std::string>{"\"friction\": \"on\"", "cannot be forced on"},
        {"\"gravity\": \"off\"", "gravity"},
        {"\"gyroscopic\": \"never\"", "never"},
        {"\"gyroscopic\": false", "gyroscopic"}}) {
    const auto scene = assets::parse_scene(scene_with(forced), "scene.json");
    ASSERT_FALSE(scene.ok()) << forced;
    EXPECT_NE(scene.error().find(word), std::string::npos) << scene.error();
    EXPECT_NE(scene.error().find("3"), std::string::npos) << "no line: " << scene.error();
  }
}

}  // namespace
