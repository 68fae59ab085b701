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
  EXPECT_EQ(enum_of("settings", "contact_solver"), words(scene_keys::kContactSolvers));
  EXPECT_EQ(enum_of("settings", "friction_cone"), words(scene_keys::kFrictionCones));
  EXPECT_EQ(enum_of("mesh", "up"), words(scene_keys::kAxes));
  EXPECT_EQ(enum_of("mesh", "collision"), words(scene_keys::kCollisions));
  EXPECT_EQ(enum_of("mesh", "collision"), words(scene_keys::kCollisions));
  EXPECT_EQ(enum_of("mass_of", "method"), words(scene_keys::kMassMethods));
  EXPECT_EQ(words_of(d.at("combine_rule").at("enum")), words(scene_keys::kCombineRules));
  EXPECT_EQ(words_of(d.at("body").at("properties").at("locks").at("items").at("enum")),
            words(scene_keys::kLocks));
  std::set<std::string> shapes;
  for (const auto& shape : scene_keys::kShapeKeys) shapes.emplace(shape.shape);
  EXPECT_EQ(enum_of("collider", "shape"), shapes);
  EXPECT_EQ(enum_of("child", "shape"), words(scene_keys::kChildShapes));
  std::set<std::string> kinds;
  for (const auto& joint : scene_keys::kJointKeys) kinds.emplace(joint.kind);
  EXPECT_EQ(enum_of("joint", "kind"), kinds);
  EXPECT_EQ(enum_of("joint", "mode"), words(scene_keys::kMotorModes));
  EXPECT_EQ(enum_of("joint_motor", "mode"), words(scene_keys::kMotorModes));
}

// What the schema forbids a kind, or a shape, the loader refuses it, and nothing else.
TEST(SceneSchema, ForbidsEachKindTheKeysOfTheOthers) {
  const auto forbidden_by = [](const json& cases, const char* selector, const std::string& word) {
    std::set<std::string> out;
    for (const json& one : cases) {
      const json& wanted = one.at("if").at("properties").at(selector);
      const json& list =
          wanted.contains("enum") ? wanted.at("enum") : json::array({wanted.at("const")});
      if (std::find(list.begin(), list.end(), word) == list.end()) continue;
      for (const auto& [key, allowed] : one.at("then").at("properties").items())
        if (allowed == false) out.insert(key);
    }
    return out;
  };
  const json d = schema().at("$defs");
  const auto expected = [](const auto& table, const auto& own) {
    std::set<std::string> out;
    for (const auto& other : table)
      for (const std::string_view key : other.keys)
        if (!key.empty()) out.emplace(key);
    for (const std::string_view key : own.keys) out.erase(std::string(key));
    return out;
  };
  for (const auto& shape : scene_keys::kShapeKeys) {
    const std::string word(shape.shape);
    EXPECT_EQ(forbidden_by(d.at("collider").at("allOf"), "shape", word),
              expected(scene_keys::kShapeKeys, shape))
        << word;
  }
  for (const auto& joint : scene_keys::kJointKeys) {
    const std::string word(joint.kind);
    std::set<std::string> keys = expected(scene_keys::kJointKeys, joint);
    if (word == "gear" || word == "rack_pinion")
      for (const std::string_view key : scene_keys::kPlacementKeys) keys.emplace(key);
    EXPECT_EQ(forbidden_by(d.at("joint").at("allOf"), "kind", word), keys) << word;
  }
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
               {"meshes",
                {{"k", {{"file", "k.obj"}, {"collision", "hull"}}},
                 {"p", {{"file", "p.obj"}, {"collision", "parts"}}}}},
               {"heightfields", {{"f", {{"spacing", {1, 1}}, {"heights", {{0, 0}, {0, 0}}}}}}}};
  json body = {
      {"name", "b"}, {"type", "static"}, {"colliders", json::array({{{"shape", "half_space"}}})}};
  body["repeat"] = {{"count", {2, 1, 1}}};
  const json moving = {
      {"name", "c"},
      {"colliders",
       json::array({{{"shape", "compound"},
                     {"children", json::array({{{"shape", "sphere"}, {"radius", 1}}})}}})}};
  bare["bodies"] = json::array({body, moving});
  const json axis = {
      {"limit", {{"range", {-1, 1}}}}, {"motor", json::object()}, {"spring", json::object()}};
  for (const auto& kind : scene_keys::kJointKeys) {
    json joint = {{"name", kind.kind}, {"kind", kind.kind}, {"body_b", "c"}};
    const std::string word(kind.kind);
    if (word == "hinge" || word == "slider") joint.update(axis);
    if (word == "spring") joint["stiffness"] = 1;
    if (word == "cone_twist") joint["cone"] = 1;
    if (word == "six_dof") joint["coordinates"] = {{"x", axis}};
    if (word == "pulley") joint.update({{"over_a", {0, 1, 0}}, {"over_b", {0, 1, 0}}});
    if (word == "gear" || word == "rack_pinion") {
      joint.erase("body_b");
      joint.update(word == "gear" ? json{{"first", "hinge"}, {"second", "hinge"}}
                                  : json{{"pinion", "hinge"}, {"rack", "slider"}, {"radius", 1}});
    } else {
      joint["frame_a"] = joint["frame_b"] = json::object();
    }
    bare["joints"].push_back(joint);
  }

  json full = bare;
  full["step"].update(defaults_of("step"));
  full["settings"].update(defaults_of("settings"));
  full["materials"]["m"].update(defaults_of("material"));
  full["meshes"]["k"].update(defaults_of("mesh"));
  full["meshes"]["p"]["parts"] = defaults_of("mesh_parts");
  json full_body = defaults_of("body");
  full_body.update(body);
  full_body["repeat"].update(defaults_of("repeat"));
  full_body["colliders"][0].update(defaults_of("collider"));
  full_body["colliders"][0]["surface_velocity"] = defaults_of("surface_velocity");
  json full_moving = moving;
  full_moving["colliders"][0]["children"][0].update(defaults_of("child"));
  full["bodies"] = json::array({full_body, full_moving});
  full["heightfields"]["f"].update(defaults_of("heightfield"));
  const auto fill = [&](json& object, const char* name) {
    json filled = defaults_of(name);
    filled.update(object);
    object = filled;
  };
  const auto fill_axis = [&](json& owner) {
    fill(owner["limit"], "joint_limit");
    fill(owner["motor"], "joint_motor");
    fill(owner["spring"], "joint_spring");
    owner["limit"]["softness"] = defaults_of("joint_softness");
    owner["motor"]["softness"] = defaults_of("joint_softness");
  };
  const json of_joints = defaults_of("joint");
  for (std::size_t k = 0; k < std::size(scene_keys::kJointKeys); ++k) {
    json& joint = full["joints"][k];
    const auto& own = scene_keys::kJointKeys[k].keys;
    const bool couples = !joint.contains("body_b");
    for (const auto& [key, value] : of_joints.items()) {
      const bool is_own = std::find(own.begin(), own.end(), key) != own.end();
      const bool is_common = key == "body_a" || key == "collide_connected";
      if (is_own || (is_common && !couples)) joint[key] = value;
    }
    if (joint.contains("frame_a")) joint["frame_a"] = joint["frame_b"] = defaults_of("joint_frame");
    joint["softness"] = defaults_of("joint_softness");
    if (joint.contains("limit")) fill_axis(joint);
    if (!joint.contains("coordinates")) continue;
    fill(joint["coordinates"]["x"], "joint_axis");
    fill_axis(joint["coordinates"]["x"]);
  }

  EXPECT_EQ(text_of(full), text_of(bare));
  EXPECT_GE(defaults_of("settings").size(), 8u);
  EXPECT_GE(defaults_of("body").size(), 10u);
  EXPECT_GE(of_joints.size(), 12u);
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
  EXPECT_GE(count, 9);
}

}  // namespace
