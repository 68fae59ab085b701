// Invariant: in no scene that ships does energy appear, is a body lost, or is one thrown. Motors
// and springs do some work; an explosion of numbers does a hundred times as much.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)

constexpr double kSeconds = 10;      // of each scene
constexpr double kWorkShare = 0.1;   // [-] of the largest kinetic energy: what may be gained
constexpr double kSinkShare = 1e-3;  // [-] of all energy: stacks breathe on their contacts
constexpr double kFastest = 60;      // [m/s] the fastest fall in them reaches 20

class ShippedScenes : public testing::TestWithParam<std::string> {};

TEST_P(ShippedScenes, GainNothingAndLoseNobody) {
  const assets::Result<assets::Scene> scene =
      assets::load_scene(std::string(PLUMB_SOURCE_DIR) + "/assets/scenes/" + GetParam() + ".json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto instance = assets::instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  const double begun = world.energy().total();
  double lowest = begun, gained = 0, kinetic = 0, fastest = 0;
  const int steps = static_cast<int>(kSeconds / scene->step.dt);
  for (int i = 0; i < steps; ++i) {
    world.step(scene->step.dt);
    ASSERT_EQ(world.last_report().quarantined, 0u) << "step " << i;
    const EnergyReport energy = world.energy();
    lowest = std::min(lowest, energy.total());
    gained = std::max(gained, energy.total() - lowest);
    kinetic = std::max(kinetic, energy.kinetic_linear + energy.kinetic_angular);
    for (const auto& body : instance->bodies)
      fastest = std::max(fastest,
                         static_cast<double>(world.linear_velocity(body.id).cast<double>().norm()));
  }
  EXPECT_LE(gained, kWorkShare * kinetic + kSinkShare * std::abs(begun));
  EXPECT_LE(fastest, kFastest);
}

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(PLUMB_SOURCE_DIR) + "/assets/scenes"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, ShippedScenes, testing::ValuesIn(shipped()),
                         [](const auto& named) { return named.param; });

}  // namespace
