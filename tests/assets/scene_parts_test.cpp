// Invariant: bodies of convex parts have the mass of their mesh and keep its hollows: rings hang on
// pegs and lie around posts, balls stay in cups, and they come to rest there.
#include <cmath>
#include <string>

#include "gtest/gtest.h"
#include "plumb/assets/import.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)
using assets::instantiate;
using assets::parse_scene;

const std::string kScenes = std::string(PLUMB_SOURCE_DIR) + "/assets/scenes/";

// The torus: ring 0.3 m, tube 0.1 m, its axis along y; so a hole of radius 0.2 m.
constexpr double kHole = 0.2, kTube = 0.1;
constexpr double kDistance = 0.02;  // of its parts
constexpr double kSlop = 5e-3;      // contacts of half a metre

struct Built {
  PhysicsWorld world;
  assets::SceneInstance instance;

  explicit Built(const std::string& bodies, const std::string& collision = "parts") {
    const std::string text = R"({"plumb_scene": 1, "meshes": {
      "ring": {"file": "../models/torus.stl", "collision": ")" +
                             collision + R"(", "density": 500},
      "bowl": {"file": "../models/bowl.gltf", "collision": ")" +
                             collision + R"(", "density": 2000}},
      "bodies": [{"name": "ground", "type": "static", "colliders": [{"shape": "half_space"}]},)" +
                             bodies + "]}";
    auto scene = parse_scene(text, "test.json", kScenes);
    EXPECT_TRUE(scene.ok()) << scene.error();
    if (!scene.ok()) return;
    for (assets::SceneMesh& mesh : scene.value().meshes) {
      mesh.parts.max_distance = kDistance;
      mesh.parts.max_parts = 24;
    }
    auto made = instantiate(*scene, world);
    EXPECT_TRUE(made.ok()) << made.error();
    if (made.ok()) instance = std::move(made).value();
  }
  void run(double seconds) {
    for (int k = 0; k < seconds * 60; ++k) ASSERT_TRUE(world.step(1.0 / 60).status.ok());
  }
  [[nodiscard]] Eigen::Vector3d place(const char* name) const {
    return world.pose(instance.find(name)).position.cast<double>();
  }
  void expect_rest(const char* name) const {
    const RigidBody body = world.body(instance.find(name));
    EXPECT_LT(body.linear_velocity.norm(), Real(0.01)) << name;
    EXPECT_LT(body.angular_velocity.norm(), Real(0.05)) << name;
  }
};

const char* const kRingOnPost = R"(
  {"name": "post", "type": "static", "position": [0, 0.5, 0],
   "colliders": [{"shape": "cylinder", "radius": 0.1, "half_length": 0.5}]},
  {"name": "ring", "position": [0.05, 1.2, 0], "orientation": {"axis_angle": [1, 0, 0, 8]},
   "colliders": [{"shape": "mesh", "mesh": "ring"}]})";

TEST(SceneParts, HaveTheMassOfTheirMesh) {
  const Built built(kRingOnPost);
  const BodyId ring = built.instance.find("ring");
  const Shape shape = built.world.collider(built.world.colliders_of(ring)[0]).shape;
  ASSERT_TRUE(std::holds_alternative<Compound>(shape));
  ASSERT_EQ(built.instance.meshes.size(), 1u);
  const assets::SceneInstanceMesh& mesh = built.instance.meshes[0];
  EXPECT_EQ(std::get<Compound>(shape).geometry, mesh.parts);
  EXPECT_EQ(mesh.hull, nullptr);
  ASSERT_TRUE(mesh.parts_report.has_value());
  EXPECT_TRUE(mesh.parts_report->within_distance) << mesh.parts_report->text();
  EXPECT_EQ(mesh.parts_report->parts, mesh.parts->children().size());
  ASSERT_EQ(built.instance.notes.size(), 1u);  // and nothing on the ring
  EXPECT_NE(built.instance.notes[0].find("'bowl' is used by no body"), std::string::npos);
  // It is drawn as the mesh.
  EXPECT_EQ(built.instance.bodies[built.instance.index_of.find("ring")->second].visuals.size(), 1u);

  const auto own = assets::mass_of_mesh(mesh.mesh, {.density = 500});
  ASSERT_TRUE(own.ok()) << own.error();
  const MassProperties mass = built.world.mass_properties(ring);
  EXPECT_NEAR(mass.mass, own->mass, 1e-6 * own->mass);
  EXPECT_LE((mass.I_Bcm_B - own->I_Bcm_B).norm(), 1e-5 * own->I_Bcm_B.norm());
  // Not that of the parts, which is more.
  EXPECT_GT(mesh.parts_report->parts_volume, 1.01 * own->volume);
}

TEST(SceneParts, LetARingFallAroundAPost) {
  Built built(kRingOnPost);
  built.run(4);
  const Eigen::Vector3d place = built.place("ring");
  EXPECT_NEAR(place.y(), kTube, kSlop);  // flat on the ground
  EXPECT_LE(std::hypot(place.x(), place.z()), kHole - 0.1 + kSlop);
  built.expect_rest("ring");
  // Its hull stays on top.
  Built filled(kRingOnPost, "hull");
  filled.run(4);
  EXPECT_GT(
      std::hypot(filled.place("ring").x(), filled.place("ring").z()) + filled.place("ring").y(),
      0.4);
}

TEST(SceneParts, LetARingHangOnAPeg) {
  Built built(R"(
    {"name": "peg", "type": "static", "position": [0, 2, 0],
     "orientation": {"axis_angle": [1, 0, 0, 90]},
     "colliders": [{"shape": "capsule", "radius": 0.05, "half_length": 1}]},
    {"name": "ring", "position": [0.02, 1.95, 0], "orientation": {"axis_angle": [1, 0, 0, 90]},
     "colliders": [{"shape": "mesh", "mesh": "ring"}], "angular_damping": 2})");
  built.run(8);
  const Eigen::Vector3d place = built.place("ring");
  // The top of the hole lies on the peg, as high as the parts leave it open.
  EXPECT_GE(place.y(), 2.05 - kHole - kSlop);
  EXPECT_LE(place.y(), 2.05 - kHole + kDistance + kSlop);
  EXPECT_LE(std::hypot(place.x(), place.z()), 0.05);
  built.expect_rest("ring");
}

TEST(SceneParts, KeepABallInACup) {
  Built built(R"(
    {"name": "cup", "position": [0, 0.01, 0], "colliders": [{"shape": "mesh", "mesh": "bowl"}]},
    {"name": "ball", "position": [0.05, 0.6, 0.02],
     "colliders": [{"shape": "sphere", "radius": 0.08}], "angular_damping": 1})");
  built.run(6);
  const assets::MeshBounds bounds = assets::bounds_of(built.instance.meshes[0].mesh);
  const Eigen::Vector3d ball = built.place("ball"), cup = built.place("cup");
  EXPECT_LT((ball - cup).head<1>().norm(), 0.25 * bounds.size().x());
  EXPECT_LT(ball.y(), bounds.upper.y() - bounds.lower.y());  // below the rim
  EXPECT_GT(ball.y(), 0.08);
  built.expect_rest("ball");
  built.expect_rest("cup");
}

TEST(SceneParts, AreWrittenAsTheyWereRead) {
  const auto scene = parse_scene(R"({"plumb_scene": 1, "bodies": [], "meshes": {
    "a": {"file": "a.obj", "collision": "parts",
          "parts": {"max_distance": 0.25, "max_parts": 7, "max_vertices": 20}},
    "b": {"file": "b.obj", "collision": "parts"}}})",
                                 "test.json");
  ASSERT_TRUE(scene.ok()) << scene.error();
  EXPECT_EQ(scene->meshes[0].parts.max_distance, 0.25);
  EXPECT_EQ(scene->meshes[0].parts.max_parts, 7u);
  EXPECT_EQ(scene->meshes[0].parts.max_part_vertices, 20u);
  EXPECT_EQ(scene->meshes[1].parts.max_distance, 0);
  const std::string once = assets::scene_to_json(*scene);
  const auto again = parse_scene(once, "written.json");
  ASSERT_TRUE(again.ok()) << again.error();
  EXPECT_EQ(assets::scene_to_json(*again), once);
}

TEST(SceneParts, AreRefusedWithLineAndRemedy) {
  const struct {
    const char* mesh;
    const char* collider;
    const char* says;
  } bad[] = {
      {R"("collision": "hull", "parts": {})", "",
       "test.json:2: 'parts' of mesh 'ring' has no meaning"},
      {R"("collision": "parts", "max_hull_vertices": 8)", "", "test.json:2: 'max_hull_vertices'"},
      {R"("collision": "parts", "parts": {"max_parts": 0})", "", "test.json:2: 'max_parts'"},
      {R"("collision": "parts", "parts": {"max_distance": 0})", "", "test.json:2: 'max_distance'"},
      {R"("collision": "parts", "parts": {"max_vertices": 257})", "",
       "test.json:2: 'max_vertices'"},
      {R"("collision": "parts", "parts": {"most": 3})", "", "test.json:2: unknown key 'most'"},
      {R"("collision": "parts")", R"(, "rounding": 0.1)",
       "collides as parts, which have no 'rounding'"},
      {R"("collision": "parts")", R"(, "scale": [1, 1, 1])",
       "collides as parts, which have no 'scale'"},
  };
  for (const auto& slip : bad) {
    const auto scene = parse_scene(std::string(R"({"plumb_scene": 1, "meshes": {
"ring": {"file": "../models/torus.stl", )") +
                                       slip.mesh + R"(}}, "bodies": [{"colliders": [
{"shape": "mesh", "mesh": "ring")" + slip.collider +
                                       "}]}]}",
                                   "test.json", kScenes);
    ASSERT_FALSE(scene.ok()) << slip.mesh << slip.collider;
    EXPECT_NE(scene.error().find(slip.says), std::string::npos) << scene.error();
  }
  const auto child = parse_scene(R"({"plumb_scene": 1, "meshes": {
"ring": {"file": "../models/torus.stl", "collision": "parts"}}, "bodies": [{"colliders": [
{"shape": "compound", "children": [{"shape": "mesh", "mesh": "ring"}]}]}]})",
                                 "test.json", kScenes);
  EXPECT_NE(child.error().find("test.json:3: mesh 'ring' collides as parts"), std::string::npos)
      << child.error();
}

}  // namespace
