// Invariant: the published schema and the loader know the same keys, the same words and the same
// defaults; every scene that comes with Plumb loads.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"
#include "scene/keys.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using plumb::assets::parse_scene;
namespace scene_keys = plumb::assets::scene;

json schema() {
  std::ifstream file(fs::path(PLUMB_SOURCE_DIR) / "assets/schema/scene.schema.json");
  return json::parse(file);
}

std::set<std::string> words(scene_keys::Keys keys) { return {keys.begin(), keys.end()}; }

std::set<std::string> words_of(const json& list) { return list.get<std::set<std::string>>(); }

TEST(SceneSchema, KnowsTheKeysOfTheLoader) {
  const json definitions = schema().at("$defs");
  for (const auto& object : scene_keys::keys::kAll) {
    const json& definition = definitions.at(std::string(object.name));
    std::set<std::string> published;
    for (const auto& [key, value] : definition.at("properties").items()) published.insert(key);
    EXPECT_EQ(published, words(object.keys)) << object.name;
    EXPECT_EQ(definition.at("additionalProperties"), false) << object.name;
  }
  // And no object beyond those: what has properties is in the table.
  for (const auto& [name, definition] : definitions.items()) {
    if (!definition.contains("properties")) continue;
    const auto& all = scene_keys::keys::kAll;
    const std::string& wanted = name;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const auto& o) {
      return o.name == wanted;
    })) << name;
  }
}

TEST(SceneSchema, KnowsTheWordsOfTheLoader) {
  const json d = schema().at("$defs");
  const auto enum_of = [&](const char* object, const char* key) {
    return words_of(d.at(object).at("properties").at(key).at("enum"));
  };
  EXPECT_EQ(enum_of("body", "type"), words(scene_keys::kMotionTypes));
  EXPECT_EQ(enum_of("settings", "rotation"), words(scene_keys::kRotationMethods));
  EXPECT_EQ(enum_of("mesh", "up"), words(scene_keys::kAxes));
  EXPECT_EQ(enum_of("mesh", "collision"), words(scene_keys::kCollisions));
  EXPECT_EQ(enum_of("mass_of", "method"), words(scene_keys::kMassMethods));
  EXPECT_EQ(words_of(d.at("combine_rule").at("enum")), words(scene_keys::kCombineRules));
  EXPECT_EQ(words_of(d.at("body").at("properties").at("locks").at("items").at("enum")),
            words(scene_keys::kLocks));
  std::set<std::string> shapes;
  for (const auto& shape : scene_keys::kShapeKeys) shapes.emplace(shape.shape);
  EXPECT_EQ(enum_of("collider", "shape"), shapes);
}

// What the loader takes for a key that is absent is what the schema says: the scene with all the
// published defaults written out reads as the one without them.
TEST(SceneSchema, TellsTheDefaultsOfTheLoader) {
  const json d = schema().at("$defs");
  const auto defaults_of = [&](const char* object) {
    json out = json::object();
    for (const auto& [key, property] : d.at(object).at("properties").items())
      if (property.contains("default")) out[key] = property.at("default");
    return out;
  };
  const auto text_of = [](const json& scene) {
    const auto read = parse_scene(scene.dump(), "test.json");
    return read.ok() ? plumb::assets::scene_to_json(*read) : read.error();
  };

  json bare = {{"plumb_scene", 1},
               {"step", json::object()},
               {"settings", json::object()},
               {"materials", {{"m", json::object()}}},
               {"meshes", {{"k", {{"file", "k.obj"}, {"collision", "hull"}}}}}};
  json body = {
      {"name", "b"}, {"type", "static"}, {"colliders", json::array({{{"shape", "half_space"}}})}};
  body["repeat"] = {{"count", {2, 1, 1}}};
  bare["bodies"] = json::array({body});

  json full = bare;
  full["step"].update(defaults_of("step"));
  full["settings"].update(defaults_of("settings"));
  full["materials"]["m"].update(defaults_of("material"));
  full["meshes"]["k"].update(defaults_of("mesh"));
  json full_body = defaults_of("body");
  full_body.update(body);
  full_body["repeat"].update(defaults_of("repeat"));
  full_body["colliders"][0].update(defaults_of("collider"));
  full["bodies"] = json::array({full_body});

  EXPECT_EQ(text_of(full), text_of(bare));
  EXPECT_GE(defaults_of("settings").size(), 8u);
  EXPECT_GE(defaults_of("body").size(), 10u);
}

// Read, written, read and written again: the same text, for every scene that comes with Plumb.
TEST(SceneFiles, LoadAndSurviveWriting) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(PLUMB_SOURCE_DIR) / "assets/scenes")) {
    if (entry.path().extension() != ".json") continue;
    const auto scene = plumb::assets::load_scene(entry.path().string());
    ASSERT_TRUE(scene.ok()) << scene.error();
    EXPECT_FALSE(scene->description.empty()) << entry.path();
    const std::string once = plumb::assets::scene_to_json(*scene);
    const auto again = parse_scene(once, "written.json");
    ASSERT_TRUE(again.ok()) << again.error();
    EXPECT_EQ(plumb::assets::scene_to_json(*again), once);
    ++count;
  }
  EXPECT_GE(count, 6);
}

}  // namespace
