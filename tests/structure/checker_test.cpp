// Invariant: the checker of the tree sees what it claims to see. Each case plants one violation in
// a tree that is otherwise clean, and expects exactly that one to be named.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "structure/include_rules.h"

namespace plumb::structure {
namespace {

namespace fs = std::filesystem;

class PlantedTree : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(::testing::TempDir()) /
            ("plumb_tree_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    write("physics/include/plumb/world.h", "#include <vector>\n#include <Eigen/Core>\n");
    write("physics/src/world/step.h", "#include \"plumb/world.h\"\n");
    write("physics/src/world/step.cpp", "#include \"world/step.h\"\n#include <cmath>\n");
    write("assets/include/plumb/assets/mesh.h", "#include \"plumb/world.h\"\n");
    write("assets/src/mesh.cpp",
          "#include \"plumb/assets/mesh.h\"\n#include <assimp/scene.h>\n#include <fstream>\n");
    write("replay/include/plumb/replay/recorder.h", "#include \"plumb/world.h\"\n");
    write("integration/src/cli/main.cpp",
          "#include <CLI/CLI.hpp>\n#include \"plumb/replay/recorder.h\"\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  void expect_only(const std::string& path, const std::string& included) {
    const auto violations = find_forbidden_includes(root_);
    ASSERT_EQ(violations.size(), 1u);
    EXPECT_EQ(violations[0].rfind(path + ":", 0), 0u) << violations[0];
    EXPECT_NE(violations[0].find("includes " + included + ","), std::string::npos) << violations[0];
  }

  fs::path root_;
};

TEST_F(PlantedTree, CleanTreeHasNoViolation) {
  EXPECT_TRUE(find_forbidden_includes(root_).empty());
  EXPECT_TRUE(find_stray_root_entries(root_).empty());
}

TEST_F(PlantedTree, StreamsInPhysicsAreSeen) {
  write("physics/src/world/log.cpp", "// prints\n#include <iostream>\n");
  expect_only("physics/src/world/log.cpp:2", "iostream");
}

TEST_F(PlantedTree, IndentedIncludeIsSeen) {
  write("physics/src/a.cpp", "#if 1\n  #  include <cstdio>\n#endif\n");
  expect_only("physics/src/a.cpp:2", "cstdio");
}

TEST_F(PlantedTree, ReplayInPhysicsIsSeen) {
  write("physics/src/a.cpp", "#include \"plumb/replay/recorder.h\"\n");
  expect_only("physics/src/a.cpp", "plumb/replay/recorder.h");
}

TEST_F(PlantedTree, ReachingIntoAnotherFolderByPathIsSeen) {
  write("physics/src/a.cpp", "#include \"../../assets/include/plumb/assets/mesh.h\"\n");
  expect_only("physics/src/a.cpp", "../../assets/include/plumb/assets/mesh.h");
}

TEST_F(PlantedTree, PhysicsInternalsInAssetsAreSeen) {
  write("assets/src/a.cpp", "#include \"world/step.h\"\n");
  expect_only("assets/src/a.cpp", "world/step.h");
}

TEST_F(PlantedTree, ThirdPartyInPublicHeaderIsSeen) {
  write("assets/include/plumb/assets/scene.h", "#include <nlohmann/json.hpp>\n");
  expect_only("assets/include/plumb/assets/scene.h", "nlohmann/json.hpp");
}

TEST_F(PlantedTree, AssetsInReplayIsSeen) {
  write("replay/src/a.cpp", "#include \"plumb/assets/mesh.h\"\n");
  expect_only("replay/src/a.cpp", "plumb/assets/mesh.h");
}

TEST_F(PlantedTree, CommandLineParserOutsideTheProgramIsSeen) {
  write("integration/src/loop.cpp", "#include <CLI/CLI.hpp>\n");
  expect_only("integration/src/loop.cpp", "CLI/CLI.hpp");
}

TEST_F(PlantedTree, LongFileIsSeen) {
  std::string text;
  for (int line = 0; line < 11; ++line) text += "// one line\n";
  write("physics/src/long.cpp", text);
  EXPECT_TRUE(find_long_files(root_, 11).empty());
  const auto violations = find_long_files(root_, 10);
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_NE(violations[0].find("physics/src/long.cpp has 11 lines"), std::string::npos);
}

TEST_F(PlantedTree, StrayRootEntryIsSeen) {
  write("notes.txt", "");
  write("tools/run.sh", "");
  const auto violations = find_stray_root_entries(root_);
  ASSERT_EQ(violations.size(), 2u);
  EXPECT_EQ(violations[0].rfind("notes.txt ", 0), 0u);
  EXPECT_EQ(violations[1].rfind("tools ", 0), 0u);
}

}  // namespace
}  // namespace plumb::structure
