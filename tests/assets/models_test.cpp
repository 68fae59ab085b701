// Invariant: every model shipped in assets/models is what models.json says: a certified solid of
// that genus and number of cavities, with that volume and centre of mass, whatever format it comes
// in.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "plumb/assets/hull.h"
#include "plumb/assets/import.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/to_physics.h"
#include "plumb/assets/visual.h"

namespace plumb::test {
namespace {

using namespace assets;

const std::filesystem::path kFolder = std::filesystem::path(PLUMB_SOURCE_DIR) / "assets" / "models";
constexpr std::uintmax_t kMaxBytes = 60 * 1024;

nlohmann::json manifest() {
  std::ifstream file(kFolder / "models.json");
  return nlohmann::json::parse(file);
}

TEST(Models, AreWhatTheyAreMeantToBe) {
  const nlohmann::json models = manifest().at("models");
  ASSERT_GE(models.size(), 8u);
  std::set<std::string> formats;
  for (const auto& model : models) {
    const std::filesystem::path path = kFolder / model.at("file").get<std::string>();
    SCOPED_TRACE(path.string());
    formats.insert(path.extension().string());
    EXPECT_LE(std::filesystem::file_size(path), kMaxBytes);
    const Result<Imported> imported = import_mesh(path.string());
    ASSERT_TRUE(imported.ok()) << imported.error();
    const MeshCertificate c = certify(imported->mesh);
    EXPECT_TRUE(c.solid) << c.fault_text();
    EXPECT_TRUE(c.manifold);
    EXPECT_EQ(c.embedding, Embedding::Clean);
    EXPECT_EQ(c.degenerate_faces, 0u);
    EXPECT_EQ(c.triangles, model.at("triangles").get<std::size_t>());
    EXPECT_EQ(c.components, model.at("components").get<std::size_t>());
    EXPECT_EQ(c.cavities, model.at("cavities").get<std::size_t>());
    EXPECT_EQ(c.genus, model.at("genus").get<std::int64_t>());
    const double size = c.bounds.size().maxCoeff();
    EXPECT_GE(size, 0.3);
    EXPECT_LE(size, 1.0);

    const Result<MeshMass> mass = mass_of_mesh(imported->mesh, c, {});
    ASSERT_TRUE(mass.ok()) << mass.error();
    // Written as floats; Collada's unit and node transform round once more on the way.
    const double volume = model.at("volume").get<double>();
    EXPECT_LE(std::abs(mass->volume - volume) / volume, mass->error.volume);
    EXPECT_LT(mass->error.volume, 1e-5);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(mass->center[k], model.at("center")[static_cast<std::size_t>(k)].get<double>(),
                  1e-6);
    EXPECT_TRUE(to_physics(*mass).ok());

    const Result<HullMesh> hull =
        convex_hull(imported->mesh.vertices, {.max_vertices = kColliderHullVertices});
    ASSERT_TRUE(hull.ok()) << hull.error();
    EXPECT_LE(hull->simplification_distance, 0.03 * size);
    const auto geometry = to_physics(*hull, mass->center);
    EXPECT_TRUE(geometry.ok()) << geometry.error();
  }
  for (const char* format : {".obj", ".stl", ".ply", ".off", ".dae", ".glb", ".gltf"}) {
    EXPECT_EQ(formats.count(format), 1u) << format;
  }
}

// What is drawn is the mesh: same triangles, about the origin asked for, unit normals that look the
// way the faces do.
TEST(Models, CanBeDrawn) {
  const nlohmann::json models = manifest().at("models");
  ASSERT_GE(models.size(), 8u);
  for (const auto& model : models) {
    const Result<Imported> imported =
        import_mesh((kFolder / model.at("file").get<std::string>()).string());
    ASSERT_TRUE(imported.ok()) << imported.error();
    const Eigen::Vector3d origin(0.1, 0.2, 0.3);
    const VisualMesh visual = visual_mesh(imported->mesh, {.origin = origin});
    ASSERT_EQ(visual.triangles.size(), imported->mesh.triangles.size());
    ASSERT_EQ(visual.positions.size(), visual.normals.size());
    for (std::size_t t = 0; t < visual.triangles.size(); ++t) {
      std::array<Eigen::Vector3d, 3> p, n;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& position = visual.positions[visual.triangles[t][i]];
        const auto& normal = visual.normals[visual.triangles[t][i]];
        p[i] = {position[0], position[1], position[2]};
        n[i] = {normal[0], normal[1], normal[2]};
        EXPECT_NEAR(n[i].norm(), 1, 1e-6);  // floats
        EXPECT_LE((p[i] + origin - imported->mesh.vertices[imported->mesh.triangles[t][i]]).norm(),
                  1e-6);
      }
      const Eigen::Vector3d face = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      for (const Eigen::Vector3d& normal : n) EXPECT_GT(normal.dot(face), 0.5);
    }
  }
}

}  // namespace
}  // namespace plumb::test
