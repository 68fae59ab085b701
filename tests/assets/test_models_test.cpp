// Invariant: every file of a large collection of real and broken models in forty formats gives a
// certificate or an error that names the file; none crashes or hangs this program.
//
// The models are those of Debian's package assimp-testmodels, which build.sh installs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "plumb/assets/report.h"

namespace plumb::test {
namespace {

using namespace assets;

const std::filesystem::path kModels = "/usr/share/assimp/models";
constexpr std::size_t kMostPartsOfAFile = 6;  // few, so that large models do not take minutes
constexpr double kTimeLimit = 120;  // [s] of one file; a guard against hanging, not a speed test

struct Walk {
  std::size_t files = 0, read = 0, solid = 0, refused = 0;
  std::map<std::string, std::size_t> read_by_extension, solid_by_extension;
};

void expect_sound(const MeshInspection& inspection) {
  const MeshCertificate& c = inspection.certificate;
  EXPECT_GT(c.triangles, 0u);
  EXPECT_EQ(c.solid, c.fault_text().empty());
  EXPECT_TRUE(!c.solid || c.signed_volume > 0);
  // A solid has mass properties; anything else says why it has none and what would help.
  EXPECT_EQ(inspection.mass.has_value(), inspection.mass_error.empty());
  if (!c.solid) {
    EXPECT_FALSE(inspection.mass.has_value());
    EXPECT_NE(inspection.mass_error.find("remedy"), std::string::npos) << inspection.mass_error;
  }
  if (inspection.mass) {
    EXPECT_GT(inspection.mass->principal_moments[0], 0);
    EXPECT_GE(inspection.mass->triangle_margin, -1e-9);  // rounding of the eigenvalues
    EXPECT_TRUE(c.bounds.center().array().isFinite().all());
    EXPECT_TRUE(
        ((inspection.mass->center - c.bounds.lower).array() >= -1e-9 * c.bounds.diagonal()).all());
    EXPECT_TRUE(
        ((c.bounds.upper - inspection.mass->center).array() >= -1e-9 * c.bounds.diagonal()).all());
  }
  EXPECT_EQ(inspection.hull.has_value(), inspection.hull_error.empty());
  // A solid has convex parts; anything else says why not.
  EXPECT_EQ(inspection.parts.has_value(), c.solid) << inspection.parts_error;
  EXPECT_EQ(inspection.parts.has_value(), inspection.parts_error.empty());
  if (inspection.parts) {
    EXPECT_LE(inspection.parts->parts, kMostPartsOfAFile);
    EXPECT_GT(inspection.parts->parts_volume, 0);
  }
  EXPECT_FALSE(to_text(inspection).empty());
  EXPECT_FALSE(to_json(inspection).empty());
}

TEST(TestModels, EveryFileGivesACertificateOrAClearError) {
  ASSERT_TRUE(std::filesystem::is_directory(kModels))
      << kModels << " is not there: install the Debian package assimp-testmodels (build.sh does)";
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kModels)) {
    if (entry.is_regular_file()) paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  InspectOptions options{.guarded = true, .time_limit = kTimeLimit};
  options.hull.max_vertices = kColliderHullVertices;
  options.parts = DecomposeOptions{.max_parts = kMostPartsOfAFile};
  Walk walk;
  for (const std::string& path : paths) {
    SCOPED_TRACE(path);
    ++walk.files;
    const Result<MeshInspection> inspection = inspect_mesh_file(path, options);
    if (!inspection) {
      ++walk.refused;
      EXPECT_NE(inspection.error().find(path), std::string::npos) << inspection.error();
      EXPECT_GT(inspection.error().size(), path.size() + 10);
      EXPECT_EQ(inspection.error().find("did not finish"), std::string::npos) << inspection.error();
      continue;
    }
    ++walk.read;
    ++walk.read_by_extension[std::filesystem::path(path).extension().string()];
    expect_sound(*inspection);
    if (!inspection->certificate.solid) continue;
    ++walk.solid;
    ++walk.solid_by_extension[std::filesystem::path(path).extension().string()];
  }
  RecordProperty("files", std::to_string(walk.files));
  RecordProperty("read", std::to_string(walk.read));
  RecordProperty("solid", std::to_string(walk.solid));
  RecordProperty("refused", std::to_string(walk.refused));
  // The collection of assimp 5.2 holds 595 files, textures and texts among them; 318 are meshes
  // that can be read, 162 of these solids.
  EXPECT_GE(walk.files, 500u);
  EXPECT_GE(walk.read, 250u);
  EXPECT_GE(walk.solid, 100u);
  for (const char* extension :
       {".obj", ".ply", ".off", ".dae", ".fbx", ".glb", ".gltf", ".3ds", ".x", ".blend"}) {
    EXPECT_GE(walk.solid_by_extension[extension], 1u) << extension;
  }
  EXPECT_GE(walk.read_by_extension[".stl"], 5u);  // all of them have holes
}

}  // namespace
}  // namespace plumb::test
