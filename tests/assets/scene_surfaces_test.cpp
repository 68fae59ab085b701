// Invariant: surfaces, heightfields, compounds and continuous bodies of a scene become what it
// describes: the same triangles, heights and parts, in place and in size.
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

namespace fs = std::filesystem;
using namespace plumb;  // NOLINT(google-build-using-namespace)
using assets::instantiate;
using assets::parse_scene;

const std::string kScenes = std::string(PLUMB_SOURCE_DIR) + "/assets/scenes/";

// The world of a scene, or a failure.
struct Built {
  PhysicsWorld world;
  assets::SceneInstance instance;

  explicit Built(const std::string& text, const std::string& folder = kScenes) {
    const auto scene = parse_scene(text, "test.json", folder);
    EXPECT_TRUE(scene.ok()) << scene.error();
    if (!scene.ok()) return;
    auto made = instantiate(*scene, world);
    EXPECT_TRUE(made.ok()) << made.error();
    if (made.ok()) instance = std::move(made).value();
  }
  [[nodiscard]] Shape shape(const char* body) const {
    return world.collider(world.colliders_of(instance.find(body))[0]).shape;
  }
};

TEST(SceneSurfaces, AreTheTrianglesOfTheFileScaled) {
  const Built built(R"({"plumb_scene": 1,
    "meshes": {"torus": {"file": "../models/torus.stl", "collision": "surface"}},
    "bodies": [
      {"name": "plain", "type": "static", "colliders": [{"shape": "mesh", "mesh": "torus"}]},
      {"name": "large", "type": "kinematic", "position": [9, 1, 0],
       "colliders": [{"shape": "mesh", "mesh": "torus", "scale": [2, 3, 4]}]}]})");
  const auto plain = std::get<SurfaceMesh>(built.shape("plain"));
  const auto large = std::get<SurfaceMesh>(built.shape("large"));
  EXPECT_EQ(plain.geometry, large.geometry);  // read once
  EXPECT_EQ(plain.scale, Vec3(1, 1, 1));
  EXPECT_EQ(large.scale, Vec3(2, 3, 4));
  ASSERT_EQ(built.instance.meshes.size(), 1u);
  EXPECT_EQ(plain.geometry->triangle_count(), built.instance.meshes[0].mesh.triangles.size());
  // A closed mesh whose facets share their corners.
  EXPECT_EQ(plain.geometry->open_edges(), 0u);
  EXPECT_EQ(built.instance.meshes[0].hull, nullptr);
  EXPECT_TRUE(built.instance.notes.empty());
  // The model lies flat, 0.8 m across and 0.2 m high; its coordinates are floats.
  const Vec3 half(Real(0.4F), Real(0.1F), Real(0.4F));
  EXPECT_EQ(plain.geometry->upper(), half);
  EXPECT_EQ(plain.geometry->lower(), -half);
}

const char* const kHills = R"({"plumb_scene": 1, "heightfields": {"hills": {
    "spacing": [2, 3], "height_scale": 0.5, "heights": [[0, 1, 2], [4, 5, null]]}},
    "bodies": [{"name": "ground", "type": "static", "position": [10, 20, 30],
                "colliders": [{"shape": "heightfield", "heightfield": "hills"}]}]})";

TEST(SceneHeightfields, StandWithTheirFirstSampleAtTheOrigin) {
  const Built built(kHills);
  const auto& field = *std::get<Heightfield>(built.shape("ground")).geometry;
  EXPECT_EQ(field.samples_x(), 3u);
  EXPECT_EQ(field.samples_z(), 2u);
  EXPECT_EQ(field.holes(), 1u);
  EXPECT_EQ(field.spacing_x(), Real(2));
  EXPECT_EQ(field.spacing_z(), Real(3));
  const double heights[] = {0, 0.5, 1, 2, 2.5};
  for (std::size_t k = 0; k < std::size(heights); ++k)
    EXPECT_EQ(field.heights()[k], static_cast<Real>(heights[k])) << k;
  EXPECT_TRUE(std::isnan(field.height(2, 1)));
  EXPECT_TRUE(field.is_hole(1, 0));
  EXPECT_EQ(built.world.pose(built.instance.find("ground")).position, Pos3(10, 20, 30));
}

// A ball that is let go over the middle of a level cell comes to rest on it, and one over a hole
// falls through.
TEST(SceneHeightfields, CarryWhatLiesOnThem) {
  Built built(R"({"plumb_scene": 1, "heightfields": {"shelf": {
    "spacing": [2, 2], "heights": [[1, 1, null], [1, 1, 1]]}},
    "bodies": [
      {"name": "ground", "type": "static", "position": [10, 20, 30],
       "colliders": [{"shape": "heightfield", "heightfield": "shelf"}]},
      {"name": "kept", "position": [11, 21.75, 31], "colliders": [{"shape": "sphere", "radius": 0.5}]},
      {"name": "lost", "position": [13.25, 21.75, 30.5],
       "colliders": [{"shape": "sphere", "radius": 0.25}]}]})");
  for (int k = 0; k < 120; ++k) ASSERT_TRUE(built.world.step(1.0 / 60).status.ok());
  const auto height = [&](const char* name) {
    return static_cast<double>(built.world.pose(built.instance.find(name)).position.y());
  };
  EXPECT_NEAR(height("kept"), 21.5, 5e-3);  // the contact slop of half a metre
  EXPECT_LT(height("lost"), 19);
}

// Files of heights in a folder of their own.
class HeightFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              ("plumb_heights_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) { std::ofstream(folder_ / "hills.csv") << text; }
  [[nodiscard]] std::string scene() const {
    return R"({"plumb_scene": 1, "heightfields": {
      "hills": {"spacing": [2, 3], "height_scale": 0.5, "file": "hills.csv"}},
      "bodies": [{"name": "ground", "type": "static", "position": [10, 20, 30],
                  "colliders": [{"shape": "heightfield", "heightfield": "hills"}]}]})";
  }
  [[nodiscard]] std::string error() const {
    const auto scene_read = parse_scene(scene(), "test.json", folder_.string());
    EXPECT_TRUE(scene_read.ok());
    PhysicsWorld world;
    const auto instance = instantiate(*scene_read, world);
    EXPECT_EQ(world.body_count(), instance.ok() ? 1u : 0u);
    return instance.error();
  }
  fs::path folder_;
};

TEST_F(HeightFiles, HoldWhatCouldStandInTheScene) {
  write("# two rows\n0, 1\t2\n\n4 5, nan # a hole\r\n");
  const Built from_file(scene(), folder_.string());
  const Built inline_heights(kHills);
  EXPECT_EQ(from_file.world.state_hash(), inline_heights.world.state_hash());
  const auto a = std::get<Heightfield>(from_file.shape("ground")).geometry;
  const auto b = std::get<Heightfield>(inline_heights.shape("ground")).geometry;
  ASSERT_EQ(a->heights().size(), b->heights().size());
  for (std::size_t k = 0; k + 1 < a->heights().size(); ++k)
    EXPECT_EQ(a->heights()[k], b->heights()[k]);
  EXPECT_TRUE(std::isnan(a->heights().back()) && std::isnan(b->heights().back()));
}

TEST_F(HeightFiles, AreRefusedWithTheirLine) {
  const struct {
    const char* text;
    const char* says;
  } bad[] = {{"0 1\n0 x1\n", "hills.csv:2: 'x1' is no height"},
             {"0 1\n0 1 2\n", "hills.csv:2: this row has 3 heights, the first one has 2"},
             {"0 1\n\n# c\n0 inf\n", "hills.csv:4: 'inf' is no height"},
             {"0 1\n0 1e9\n", "hills.csv:2: a height lies beyond 1000 km"},
             {"0 1e999\n0 1\n", "hills.csv:1: '1e999' is no height"},
             {"0 1\n", "hills.csv: a heightfield needs two rows"},
             {"", "hills.csv: a heightfield needs two rows"},
             {"0\n1\n", "hills.csv: a heightfield needs two rows of two"}};
  for (const auto& file : bad) {
    write(file.text);
    const std::string told = error();
    EXPECT_EQ(told.rfind("test.json:2: heightfield 'hills': ", 0), 0u) << told;
    EXPECT_NE(told.find(file.says), std::string::npos) << told;
  }
}

TEST_F(HeightFiles, AreMissedWhenTheSceneIsLoaded) {
  std::ofstream(folder_ / "scene.json") << scene();
  const auto loaded = assets::load_scene((folder_ / "scene.json").string());
  ASSERT_FALSE(loaded.ok());
  EXPECT_NE(loaded.error().find("scene.json:2: the file '"), std::string::npos) << loaded.error();
  EXPECT_NE(loaded.error().find("of heightfield 'hills' is not there"), std::string::npos);
}

// One collider whose mass is that of its parts by the parallel-axis theorem.
TEST(SceneCompounds, AreTheirPartsInPlace) {
  const Built built(R"({"plumb_scene": 1,
    "meshes": {"cube": {"file": "../models/l_beam.obj", "collision": "hull"}},
    "bodies": [
      {"name": "hammer", "colliders": [{"shape": "compound", "density": 2, "children": [
        {"shape": "box", "half_extents": [0.5, 0.5, 0.5], "position": [0, 2, 0]},
        {"shape": "box", "half_extents": [0.25, 1, 0.25],
         "orientation": {"axis_angle": [0, 0, 1, 90]}}]}]},
      {"name": "beam", "position": [9, 0, 0], "colliders": [
        {"shape": "compound", "children": [{"shape": "mesh", "mesh": "cube", "rounding": 0.125},
                                           {"shape": "sphere", "radius": 0.5}]}]}]})");
  const auto hammer = std::get<Compound>(built.shape("hammer")).geometry;
  ASSERT_EQ(hammer->children().size(), 2u);
  EXPECT_EQ(hammer->children()[0].pose.position, Vec3(0, 2, 0));
  EXPECT_EQ(std::get<Box>(hammer->children()[1].shape).half_extents,
            Vec3(Real(0.25), 1, Real(0.25)));
  const MassProperties mass = built.world.mass_properties(built.instance.find("hammer"));
  // 2 kg at 2 m, and 1 kg (0.5 x 2 x 0.5 m^3) at the origin, whose long side lies along x.
  const double rounding = 1e-6;  // the turn of 90 degrees passes through floats
  EXPECT_NEAR(mass.mass, 3, 3 * rounding);
  EXPECT_NEAR(mass.center.y(), 4.0 / 3, rounding);
  const double apart = 2 * (2.0 / 3) * (2.0 / 3) + 1 * (4.0 / 3) * (4.0 / 3);
  const double cube = 2 * (1.0 + 1.0) / 12;
  EXPECT_NEAR(mass.I_Bcm_B(0, 0), cube + 0.5 / 12 + apart, 4 * rounding);
  EXPECT_NEAR(mass.I_Bcm_B(1, 1), cube + (4 + 0.25) / 12, 4 * rounding);

  const auto beam = std::get<Compound>(built.shape("beam")).geometry;
  const auto& hull = std::get<ConvexHull>(beam->children()[0].shape);
  EXPECT_EQ(hull.geometry, built.instance.meshes.at(0).hull);
  EXPECT_EQ(hull.rounding, Real(0.125));
}

TEST(SceneBodies, AreContinuousWhereTheyAskForIt) {
  const Built built(R"({"plumb_scene": 1, "bodies": [
    {"name": "bullet", "continuous": true}, {"name": "stone"}]})");
  EXPECT_TRUE(built.world.body(built.instance.find("bullet")).continuous);
  EXPECT_FALSE(built.world.body(built.instance.find("stone")).continuous);
}

}  // namespace
