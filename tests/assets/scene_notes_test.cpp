// Invariant: what looks like a slip in a scene that can be run all the same is told once, by name:
// meshes that are not closed, joints that begin far apart, angles that read like degrees, files
// that nothing uses. What is sound is not remarked upon.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "plumb/assets/scene.h"

namespace {

using namespace plumb;  // NOLINT(google-build-using-namespace)

class SceneNotes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("plumb_notes_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  // Of the scene {"plumb_scene": 1, BODY}.
  [[nodiscard]] std::vector<std::string> notes_of(const std::string& body) const {
    const auto scene =
        assets::parse_scene("{\"plumb_scene\": 1, " + body + "}", "test.json", folder_.string());
    EXPECT_TRUE(scene.ok()) << scene.error();
    if (!scene.ok()) return {};
    PhysicsWorld world;
    const auto made = assets::instantiate(*scene, world);
    EXPECT_TRUE(made.ok()) << made.error();
    return made.ok() ? made->notes : std::vector<std::string>{};
  }

  std::filesystem::path folder_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A box of 1 x 1 x 1 m; without its lid, four edges are free.
void write_box(std::ofstream file, bool lid) {
  file << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
          "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  if (lid) file << "f 5 6 7 8\n";
}

TEST_F(SceneNotes, AMeshThatIsNotClosedIsNamedOnceWithTheMethodOfItsMass) {
  const auto notes = [&](bool lid, const std::string& mesh_keys, const std::string& body_keys) {
    write_box(std::ofstream(folder_ / "box.obj"), lid);
    return notes_of(
        R"("meshes": {"box": {"file": "box.obj", "collision": "hull")" + mesh_keys +
        R"(}}, "bodies": [{"name": "one")" + body_keys +
        R"(, "colliders": [{"shape": "mesh", "mesh": "box"}]}, {"name": "two", "position": [5, 0, )"
        R"(0])" +
        body_keys + R"(, "colliders": [{"shape": "mesh", "mesh": "box"}]}])");
  };
  struct Way {
    std::string mesh_keys, body_keys, says;
  };
  for (const Way& way :
       {Way{R"(, "mass_of": {"method": "voxel", "resolution": 16})", "",
            R"("mass_of": {"method": "voxel"})"},
        Way{R"(, "mass_of": {"method": "hull"})", "", R"("mass_of": {"method": "hull"})"},
        Way{R"(, "mass_of": {"method": "shell", "thickness": 0.01})", "",
            R"("mass_of": {"method": "shell"})"},
        Way{"", R"(, "mass": {"mass": 2, "inertia": [1, 1, 1]})", "no mass was taken from it"},
        Way{"", R"(, "type": "static")", "no mass was taken from it"}}) {
    const auto open = notes(false, way.mesh_keys, way.body_keys);
    ASSERT_EQ(std::count_if(open.begin(), open.end(),
                            [](const std::string& note) { return has(note, "not closed"); }),
              1)
        << way.says;
    EXPECT_TRUE(has(open[0], "mesh 'box' is not closed: 4 edges") && has(open[0], way.says))
        << open[0];
    for (const std::string& note : notes(true, way.mesh_keys, way.body_keys))
      EXPECT_FALSE(has(note, "not closed")) << note;
  }
}

// Boxes of 1 x 0.5 x 0.5 m, which a joint holds by points so far apart.
std::string pair_held_by(const std::string& joint_keys) {
  const std::string box = R"("colliders": [{"shape": "box", "half_extents": [0.5, 0.25, 0.25]}])";
  return R"("bodies": [{"name": "a", )" + box + R"(}, {"name": "b", "position": [3, 0, 0], )" +
         box + R"(}], "joints": [{"name": "link", "body_a": "a", "body_b": "b", )" + joint_keys +
         "}]";
}

TEST_F(SceneNotes, JointsThatBeginFartherApartThanTheirBodiesAreLongAreNamed) {
  for (const std::string kind : {"ball", "hinge", "fixed"}) {
    const std::string joint = R"("kind": ")" + kind + R"(", "anchor_a": [0, 0, 0], "anchor_b": )";
    const auto far = notes_of(pair_held_by(joint + "[0, 1.25, 0]"));
    ASSERT_EQ(far.size(), 1u) << kind;
    EXPECT_TRUE(has(far[0], "joint 'link'") && has(far[0], "1.25 m") && has(far[0], "(1 m)"))
        << far[0];
    EXPECT_TRUE(notes_of(pair_held_by(joint + "[0, 0.75, 0]")).empty()) << kind;
    // To the world it is the one body that counts.
    const auto to_world =
        notes_of(R"("bodies": [{"name": "a", "colliders": [{"shape": "sphere", "radius": 0.1}]}], )"
                 R"("joints": [{"name": "link", "body_a": "a", "anchor_a": [0, 0, 0], "anchor_b": )"
                 R"([1, 0, 0], "kind": ")" +
                 kind + "\"}]");
    EXPECT_EQ(to_world.size(), 1u) << kind;
  }
  // These are apart because they are meant to be.
  for (const std::string kind : {R"("distance")", R"("rope")", R"("spring", "stiffness": 10)"}) {
    EXPECT_TRUE(
        notes_of(pair_held_by(R"("anchor_a": [0, 0, 0], "anchor_b": [3, 0, 0], "kind": )" + kind))
            .empty())
        << kind;
  }
  // Points have no size of their own.
  const std::string points =
      R"("bodies": [{"name": "a"}, {"name": "b", "position": [1, 0, 0]}], "joints": [{"name": )"
      R"("link", "kind": "ball", "body_a": "a", "body_b": "b", "anchor_a": [0, 0, 0], "anchor_b": )";
  EXPECT_EQ(notes_of(points + "[0.01, 0, 0]}]").size(), 1u);
  EXPECT_TRUE(notes_of(points + "[0.0001, 0, 0]}]").empty());
}

TEST_F(SceneNotes, AnglesThatReadLikeDegreesAreNamed) {
  const auto hinge = [&](const std::string& keys) {
    return notes_of(pair_held_by(R"("kind": "hinge", "anchor": [1.5, 0, 0], )" + keys));
  };
  for (const std::string keys :
       {R"("limit": {"range": [-90, 90]})", R"("limit": {"range": [0, 22.5]})",
        R"("limit": {"range": [-45, null]})",
        R"("motor": {"mode": "position", "target": 180, "max_effort": 1})",
        R"("spring": {"rest": -30, "stiffness": 1})"}) {
    const auto notes = hinge(keys);
    ASSERT_EQ(notes.size(), 1u) << keys;
    EXPECT_TRUE(has(notes[0], "joint 'link'") && has(notes[0], "_degrees")) << notes[0];
  }
  // Angles within a turn, whole turns of a winch, degrees called so, and speeds.
  for (const std::string keys :
       {R"("limit": {"range": [-1.5, 6]})", R"("limit": {"range": [-62.83185, 62.83185]})",
        R"("limit": {"range_degrees": [-720, 3600]})", R"("limit": {"range": [null, null]})",
        R"("motor": {"mode": "velocity", "target": 20, "max_effort": 1})"})
    EXPECT_TRUE(hinge(keys).empty()) << keys;
  // A path in metres is no angle; the angles of a six-dof joint are.
  EXPECT_TRUE(notes_of(pair_held_by(R"("kind": "slider", "anchor": [1.5, 0, 0], )"
                                    R"("limit": {"range": [-90, 90]})"))
                  .empty());
  const auto six = [&](const std::string& coordinate) {
    return notes_of(pair_held_by(R"("kind": "six_dof", "anchor": [1.5, 0, 0], "coordinates": {")" +
                                 coordinate + R"(": {"limit": {"range": [-90, 90]}}})"));
  };
  EXPECT_TRUE(six("x").empty());
  EXPECT_EQ(six("twist").size(), 1u);
}

TEST_F(SceneNotes, FilesThatNoBodyUsesAreNamed) {
  write("damaged.obj", "f 1 2 3\n");
  write("heights.csv", "0,1\n0,1\n");
  const std::string files =
      R"("meshes": {"spare": {"file": "damaged.obj", "collision": "hull"}}, )"
      R"("heightfields": {"hill": {"file": "heights.csv", "spacing": [1, 1]}}, "bodies": [)";
  const auto notes = notes_of(files + "]");
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_TRUE(has(notes[0], "mesh 'spare' is used by no body")) << notes[0];
  EXPECT_TRUE(has(notes[1], "heightfield 'hill' is used by no body")) << notes[1];
  EXPECT_EQ(notes_of(files + R"({"type": "static", "colliders": [{"shape": "heightfield", )" +
                     R"("heightfield": "hill"}]}])")
                .size(),
            1u);
  // A file that is not there is an error whether it is used or not.
  write("scene.json", R"({"plumb_scene": 1, "meshes": {"spare": {"file": "none.obj",)"
                      R"( "collision": "hull"}}, "bodies": []})");
  const auto loaded = assets::load_scene((folder_ / "scene.json").string());
  ASSERT_FALSE(loaded.ok());
  EXPECT_TRUE(has(loaded.error(), "none.obj' of mesh 'spare' is not there")) << loaded.error();
}

}  // namespace
