// Invariant: a mesh is mended only when its scene asks for it, the body is then the one that was
// meant, and a note says what was changed; a size that hints at a wrong unit is told.
#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/report.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)

// A box of 2 x 1 x 3 in a file, in which some faces may be wound the wrong way.
class SceneMeshRepair : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("plumb_repair_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // turned: bit k turns face k. scale: [units] of the file.
  void write_box(unsigned turned, double scale = 1) const {
    constexpr std::array<std::array<int, 3>, 12> kFaces{{{1, 3, 2},
                                                         {1, 4, 3},
                                                         {5, 6, 7},
                                                         {5, 7, 8},
                                                         {1, 2, 6},
                                                         {1, 6, 5},
                                                         {3, 4, 8},
                                                         {3, 8, 7},
                                                         {2, 3, 7},
                                                         {2, 7, 6},
                                                         {1, 5, 8},
                                                         {1, 8, 4}}};
    std::ofstream file(folder_ / "box.obj");
    for (const double z : {0.0, 3.0})
      for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {0, 1}})
        file << "v " << scale * x << ' ' << scale * y << ' ' << scale * z << '\n';
    for (std::size_t k = 0; k < kFaces.size(); ++k) {
      const bool turn = (turned >> k & 1u) != 0;
      file << "f " << kFaces[k][0] << ' ' << kFaces[k][turn ? 2 : 1] << ' '
           << kFaces[k][turn ? 1 : 2] << '\n';
    }
  }
  [[nodiscard]] assets::Result<assets::Scene> scene(const std::string& keys) const {
    return assets::parse_scene(R"({"plumb_scene": 1, "meshes": {"box": {"file": "box.obj", )" +
                                   keys + R"(}}, "bodies": [{"name": "body", "colliders": [)" +
                                   R"({"shape": "mesh", "mesh": "box"}]}]})",
                               "test.json", folder_.string());
  }
  std::filesystem::path folder_;
};

constexpr unsigned kAll = 0xfff, kFour = 0x225;

TEST_F(SceneMeshRepair, TurnsFacesOutwardsWhereAskedAndSaysSo) {
  for (const unsigned turned : {kAll, kFour}) {
    write_box(turned);
    for (const std::string collision : {"hull", "parts"}) {
      PhysicsWorld world;
      const std::string plain = "\"collision\": \"" + collision + "\"";
      const auto refused = instantiate(*scene(plain), world);
      ASSERT_FALSE(refused.ok());
      if (collision == "hull") {
        EXPECT_NE(refused.error().find("\"repair\": {\"orient\": true}"), std::string::npos)
            << refused.error();
      }
      const auto loaded = scene(plain + R"(, "repair": {"orient": true})");
      ASSERT_TRUE(loaded.ok()) << loaded.error();
      const auto made = instantiate(*loaded, world);
      ASSERT_TRUE(made.ok()) << made.error();
      const MassProperties mass = world.mass_properties(made->find("body"));
      EXPECT_NEAR(mass.mass, 6000, 6000 * 1e-6);  // 2 x 1 x 3 m^3 of 1000 kg/m^3
      EXPECT_LT((mass.center - Eigen::Vector3d(1, 0.5, 1.5)).norm(), 1e-5);
      ASSERT_EQ(made->notes.size(), 1u);
      EXPECT_NE(made->notes[0].find("'box' was repaired"), std::string::npos) << made->notes[0];
      EXPECT_NE(made->notes[0].find(turned == kAll ? "12 faces turned" : "4 faces turned"),
                std::string::npos)
          << made->notes[0];
    }
  }
}

// A surface needs no inside, so that it is not refused; but it is felt from the wrong side.
TEST_F(SceneMeshRepair, IsAdvisedForASurfaceThatIsInsideOut) {
  const auto notes = [&](unsigned turned, const std::string& keys) {
    write_box(turned);
    const auto loaded = assets::parse_scene(
        R"({"plumb_scene": 1, "meshes": {"box": {"file": "box.obj", "collision": "surface")" +
            keys + R"(}}, "bodies": [{"name": "body", "type": "static", "colliders": [)" +
            R"({"shape": "mesh", "mesh": "box"}]}]})",
        "test.json", folder_.string());
    EXPECT_TRUE(loaded.ok()) << loaded.error();
    PhysicsWorld world;
    const auto made = instantiate(*loaded, world);
    EXPECT_TRUE(made.ok()) << made.error();
    return made->notes;
  };
  EXPECT_TRUE(notes(0, "").empty());
  const auto inside_out = notes(kAll, "");
  ASSERT_EQ(inside_out.size(), 1u);
  EXPECT_NE(inside_out[0].find("mesh 'box' is inside out"), std::string::npos) << inside_out[0];
  EXPECT_NE(inside_out[0].find("\"repair\": {\"orient\": true}"), std::string::npos);
  for (const std::string& note : notes(kAll, R"(, "repair": {"orient": true})"))
    EXPECT_EQ(note.find("inside out"), std::string::npos) << note;
}

// The report on a file shows what the same repair makes of it.
TEST_F(SceneMeshRepair, IsShownByTheReport) {
  write_box(kFour);
  const std::string path = (folder_ / "box.obj").string();
  assets::InspectOptions options;
  EXPECT_FALSE(inspect_mesh_file(path, options)->certificate.solid);
  EXPECT_TRUE(inspect_mesh_file(path, options)->repaired.empty());
  options.repair = assets::RepairOptions{.orient = true};
  const auto inspection = inspect_mesh_file(path, options);
  ASSERT_TRUE(inspection.ok()) << inspection.error();
  EXPECT_TRUE(inspection->certificate.solid);
  EXPECT_NE(to_text(*inspection).find("repaired"), std::string::npos);
  EXPECT_NE(to_json(*inspection).find("4 faces turned"), std::string::npos);
}

TEST_F(SceneMeshRepair, ComesBackFromTheTextOfItsScene) {
  const auto loaded = scene(R"("collision": "hull", "repair": {"weld_tolerance": 0.25})");
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const auto again = assets::parse_scene(assets::scene_to_json(*loaded), "again.json");
  ASSERT_TRUE(again.ok()) << again.error();
  ASSERT_TRUE(again->meshes[0].repair.has_value());
  EXPECT_EQ(again->meshes[0].repair->weld_tolerance, 0.25);
  EXPECT_FALSE(again->meshes[0].repair->orient);
  const auto bad = scene(R"("collision": "hull", "repair": {"orient": 1, "weld_tolerance": -1})");
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(bad.error().find("'orient' of repair of mesh 'box'"), std::string::npos) << bad.error();
  EXPECT_NE(bad.error().find("'weld_tolerance' of repair of"), std::string::npos) << bad.error();
}

// An OBJ knows no unit: a box of 300 "metres" is one of 300 millimetres.
TEST_F(SceneMeshRepair, ADoubtfulSizeIsTold) {
  write_box(0, 100);
  PhysicsWorld world;
  const auto doubtful = instantiate(*scene(R"("collision": "hull")"), world);
  ASSERT_TRUE(doubtful.ok()) << doubtful.error();
  ASSERT_EQ(doubtful->notes.size(), 1u);
  EXPECT_NE(doubtful->notes[0].find("300 m long"), std::string::npos) << doubtful->notes[0];
  EXPECT_NE(doubtful->notes[0].find("metres_per_unit"), std::string::npos) << doubtful->notes[0];
  const auto given = instantiate(*scene(R"("collision": "hull", "metres_per_unit": 0.001)"), world);
  ASSERT_TRUE(given.ok()) << given.error();
  EXPECT_TRUE(given->notes.empty());
}

}  // namespace
