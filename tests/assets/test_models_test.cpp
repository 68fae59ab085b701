// Invariant: every file of a large collection of real and broken models in forty formats gives a
// certificate or an error that names the file; none crashes or hangs this program.
//
// The models are those of Debian's package assimp-testmodels, which build.sh installs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "plumb/assets/report.h"

namespace plumb::test {
namespace {

using namespace assets;

const std::filesystem::path kModels = "/usr/share/assimp/models";
constexpr std::size_t kMostPartsOfAFile = 6;  // few, so that large models do not take minutes
constexpr double kTimeLimit = 120;  // [s] of one file; a guard against hanging, not a speed test

// One folder of the collection of assimp 5.2: 595 files, textures and texts among them; 316 are
// meshes that can be read, 162 of these solids. invalid.off and IndexOutOfRange.gltf, whose faces
// name vertices that are not there, are errors.
struct Folder {
  const char* name;
  std::size_t files, read, solid;
  const char* solid_extensions;  // each with a solid
};

constexpr Folder kFolders[] = {
    {"3D", 3, 3, 3, ""},
    {"3DS", 15, 10, 7, ".3ds"},
    {"3MF", 1, 1, 1, ""},
    {"AC", 11, 7, 3, ""},
    {"AMF", 12, 11, 11, ""},
    {"ASE", 16, 13, 6, ""},
    {"B3D", 1, 1, 0, ""},
    {"BLEND", 27, 25, 15, ".blend"},
    {"BVH", 4, 0, 0, ""},
    {"COB", 8, 6, 0, ""},
    {"CSM", 2, 0, 0, ""},
    {"Collada", 35, 25, 13, ".dae"},
    {"DXF", 5, 5, 1, ""},
    {"FBX", 19, 18, 14, ".fbx"},
    {"HMP", 2, 2, 0, ""},
    {"IFC", 2, 1, 0, ""},
    {"IQM", 3, 1, 0, ""},
    {"IRR", 11, 0, 0, ""},
    {"IRRMesh", 7, 0, 0, ""},
    {"JT", 1, 0, 0, ""},
    {"LWO", 52, 38, 24, ""},
    {"LWS", 15, 15, 15, ""},
    {"M3D", 8, 0, 0, ""},
    {"MD2", 6, 2, 0, ""},
    {"MD5", 2, 1, 1, ""},
    {"MDC", 1, 1, 0, ""},
    {"MDL", 40, 18, 4, ""},
    {"MS3D", 6, 4, 0, ""},
    {"NFF", 10, 9, 5, ""},
    {"OBJ", 36, 18, 9, ".obj"},
    {"OFF", 4, 3, 2, ".off"},
    {"Ogre", 4, 1, 1, ""},
    {"OpenGEX", 6, 3, 2, ""},
    {"PLY", 8, 5, 3, ".ply"},
    {"ParsingFiles", 2, 0, 0, ""},
    {"Q3D", 6, 4, 0, ""},
    {"RAW", 3, 1, 0, ""},
    {"ReferenceImages", 11, 0, 0, ""},
    {"SIB", 4, 1, 0, ""},
    {"SMD", 4, 3, 1, ""},
    {"STL", 9, 9, 0, ""},
    {"SourceFiles", 4, 0, 0, ""},
    {"TER", 2, 0, 0, ""},
    {"WRL", 3, 0, 0, ""},
    {"X", 19, 10, 7, ".x"},
    {"X3D", 2, 2, 1, ""},
    {"XGL", 8, 8, 1, ""},
    {"glTF", 23, 6, 4, ""},
    {"glTF2", 97, 24, 8, ".glb .gltf"},
    {"invalid", 15, 1, 0, ""},
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

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

class TestModels : public testing::TestWithParam<Folder> {};

TEST_P(TestModels, GiveACertificateOrAClearError) {
  const Folder& folder = GetParam();
  ASSERT_TRUE(std::filesystem::is_directory(kModels))
      << kModels << " is not there: install the Debian package assimp-testmodels (build.sh does)";
  InspectOptions options{.guarded = true, .time_limit = kTimeLimit};
  options.hull.max_vertices = kColliderHullVertices;
  options.parts = DecomposeOptions{.max_parts = kMostPartsOfAFile};
  const std::vector<std::string> paths = files_in(kModels / folder.name);
  std::size_t read = 0, solid = 0;
  std::set<std::string> solid_extensions;
  for (const std::string& path : paths) {
    SCOPED_TRACE(path);
    const Result<MeshInspection> inspection = inspect_mesh_file(path, options);
    if (!inspection) {
      EXPECT_NE(inspection.error().find(path), std::string::npos) << inspection.error();
      EXPECT_GT(inspection.error().size(), path.size() + 10);
      EXPECT_EQ(inspection.error().find("did not finish"), std::string::npos) << inspection.error();
      continue;
    }
    ++read;
    expect_sound(*inspection);
    if (!inspection->certificate.solid) continue;
    ++solid;
    solid_extensions.insert(std::filesystem::path(path).extension().string());
  }
  EXPECT_GE(paths.size(), folder.files);
  EXPECT_GE(read, folder.read);
  EXPECT_GE(solid, folder.solid);
  std::istringstream expected(folder.solid_extensions);
  for (std::string extension; expected >> extension;)
    EXPECT_TRUE(solid_extensions.contains(extension)) << extension;
}

INSTANTIATE_TEST_SUITE_P(, TestModels, testing::ValuesIn(kFolders),
                         [](const auto& folder) { return "Of" + std::string(folder.param.name); });

TEST(TestModelFolders, AreAllLookedAt) {
  std::set<std::string> known;
  for (const Folder& folder : kFolders) known.insert(folder.name);
  for (const auto& entry : std::filesystem::directory_iterator(kModels))
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
}

}  // namespace
}  // namespace plumb::test
