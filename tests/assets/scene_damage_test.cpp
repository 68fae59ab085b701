// Invariant: whatever is wrong with a scene file, loading it gives a scene or an error that names
// the file, and building the scene gives a world that steps, or an error and an untouched world.
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"
#include "support/random.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using nlohmann::json;
using testing_support::Random;

const std::string kScenes = std::string(PLUMB_SOURCE_DIR) + "/assets/scenes/";

// The gallery has every shape and every kind of joint.
std::string gallery_text() {
  std::ifstream file(kScenes + "gallery.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t pick(Random& random, std::size_t count) {
  const double at = random.uniform(0, static_cast<double>(count));
  return std::min(static_cast<std::size_t>(at), count - 1);
}

// What came of a damaged text.
enum class Outcome { Refused, NotBuilt, Built };
Outcome try_scene(const std::string& text) {
  const auto scene = assets::parse_scene(text, "bad.json", kScenes);
  if (!scene.ok()) {
    EXPECT_EQ(scene.error().rfind("bad.json", 0), 0u) << scene.error();
    return Outcome::Refused;
  }
  PhysicsWorld world;
  const auto kept = world.create_body(RigidBody{});
  const std::uint64_t before = world.state_hash();
  const auto instance = assets::instantiate(*scene, world);
  if (!instance.ok()) {
    EXPECT_EQ(instance.error().rfind("bad.json", 0), 0u) << instance.error();
    EXPECT_EQ(world.state_hash(), before);
    EXPECT_EQ(world.body_count(), 1u);
    EXPECT_EQ(world.joint_count(), 0u);
    EXPECT_TRUE(world.is_valid(kept.id));
    return Outcome::NotBuilt;
  }
  EXPECT_EQ(world.body_count(), instance->bodies.size() + 1);
  EXPECT_EQ(world.joint_count(), instance->joints.size());
  EXPECT_TRUE(world.step(1.0 / 60).status.ok());
  for (const assets::SceneInstanceBody& body : instance->bodies) {
    const Pose pose = world.pose(body.id);
    EXPECT_TRUE(pose.position.allFinite() && pose.orientation.coeffs().allFinite()) << body.name;
  }
  return Outcome::Built;
}

// Bytes lost, changed or put in: nearly always no JSON any more, or a key that is not known.
TEST(DamagedScene, WithAnyByteChangedIsReadOrRefused) {
  const std::string good = gallery_text();
  ASSERT_EQ(try_scene(good), Outcome::Built);
  Random random(1);
  int refused = 0;
  const int rounds = 300;
  for (int k = 0; k < rounds; ++k) {
    std::string text = good;
    const std::size_t at = pick(random, text.size());
    const std::string characters = "\"{}[],:0-e.x\n\x01\xff";
    const char put = characters[pick(random, characters.size())];
    const std::size_t how = pick(random, 4);
    if (how == 0) text.resize(at);
    if (how == 1) text.erase(at, 1 + pick(random, 8));
    if (how == 2) text[at] = put;
    if (how == 3) text.insert(at, 1, put);
    SCOPED_TRACE("round " + std::to_string(k) + " at " + std::to_string(at));
    if (try_scene(text) == Outcome::Refused) ++refused;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(refused, rounds / 2);
}

// All places of the document: of objects, lists and values alike.
void collect(const json& node, const json::json_pointer& at,
             std::vector<json::json_pointer>& places) {
  places.push_back(at);
  if (node.is_object())
    for (const auto& [key, value] : node.items()) collect(value, at / key, places);
  if (node.is_array())
    for (std::size_t k = 0; k < node.size(); ++k) collect(node[k], at / k, places);
}

// Values replaced by others that are JSON, but mostly not what should stand there.
TEST(DamagedScene, WithAnyValueReplacedIsBuiltOrRefused) {
  const json good = json::parse(gallery_text());
  std::vector<json::json_pointer> places;
  collect(good, json::json_pointer(), places);
  const std::vector<json> values = {nullptr,
                                    true,
                                    0,
                                    -1,
                                    1,
                                    2.5,
                                    1e-300,
                                    1e30,
                                    -1e300,
                                    1e18,
                                    "",
                                    "a",
                                    "beam",
                                    "world",
                                    json::array(),
                                    json::object(),
                                    json::array({0, 0, 0}),
                                    json::array({1, 1e-30, 1e30})};
  Random random(2);
  int outcomes[3] = {0, 0, 0};
  for (int k = 0; k < 400; ++k) {
    json damaged = good;
    const json::json_pointer& place = places[pick(random, places.size())];
    const json& value = values[pick(random, values.size())];
    damaged[place] = value;
    SCOPED_TRACE("round " + std::to_string(k) + ": " + place.to_string() + " = " + value.dump());
    ++outcomes[static_cast<int>(try_scene(damaged.dump()))];
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(outcomes[static_cast<int>(Outcome::Refused)], 50);
  EXPECT_GT(outcomes[static_cast<int>(Outcome::Built)], 50);
}

}  // namespace
