// Invariant: in every scene and demo that ships, a world that is restored from another one before
// each of its steps ends the step with the same bits as that one: nothing that steps depend on is
// missing from a snapshot.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)

constexpr int kSteps = 240;

class RestoredScenes : public testing::TestWithParam<std::string> {};

TEST_P(RestoredScenes, GoTheSameWay) {
  const assets::Result<assets::Scene> scene =
      assets::load_scene(std::string(PLUMB_SOURCE_DIR) + "/" + GetParam());
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world, restored;
  const auto instance = assets::instantiate(*scene, world);
  ASSERT_TRUE(instance.ok()) << instance.error();
  for (int step = 0; step < kSteps; ++step) {
    ASSERT_TRUE(restored.restore(world.save()).ok());
    world.step(scene->step.dt);
    restored.step(scene->step.dt);
    ASSERT_EQ(world.state_hash(), restored.state_hash()) << "step " << step;
  }
}

std::vector<std::string> shipped() {
  std::vector<std::string> files;
  for (const std::string folder : {"assets/scenes", "integration/demos"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PLUMB_SOURCE_DIR) + "/" + folder))
      if (entry.path().extension() == ".json")
        files.push_back(folder + "/" + entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}
INSTANTIATE_TEST_SUITE_P(All, RestoredScenes, testing::ValuesIn(shipped()), [](const auto& named) {
  return std::filesystem::path(named.param).stem().string();
});

}  // namespace
