// Invariant: no face of a file gets lost in silence. Faces of any number of corners become
// triangles; a file whose faces name vertices that are not there, or that ends early, is an error
// that names file, place and index; what cannot be cut into triangles is counted.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>

#include "own_folder.h"
#include "plumb/assets/certificate.h"
#include "plumb/assets/import.h"
#include "plumb/assets/report.h"
#include "plumb/assets/scene.h"

namespace plumb::test {
namespace {

using namespace assets;

class ImportLosses : public OwnFolder {
 protected:
  // The error of reading this text, which has to name the file.
  [[nodiscard]] std::string error_of(const std::string& name, const std::string& text) const {
    const std::string path = write(name, text);
    const Result<Imported> imported = import_mesh(path);
    EXPECT_FALSE(imported.ok()) << text;
    EXPECT_NE(imported.error().find(path), std::string::npos) << imported.error();
    EXPECT_EQ(import_mesh_guarded(path).error(), imported.error());
    return imported.error();
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A prism of height 1 with caps of n corners, every other one at a smaller radius.
std::string off_prism(int n, double inner) {
  std::ostringstream text;
  text << "OFF\n" << 2 * n << ' ' << n + 2 << " 0\n";
  for (int z = 0; z < 2; ++z) {
    for (int k = 0; k < n; ++k) {
      const double r = k % 2 == 0 ? 1 : inner, angle = 2 * std::numbers::pi * k / n;
      text << r * std::cos(angle) << ' ' << r * std::sin(angle) << ' ' << z << '\n';
    }
  }
  text << n;
  for (int k = n - 1; k >= 0; --k) text << ' ' << k;
  text << '\n' << n;
  for (int k = 0; k < n; ++k) text << ' ' << n + k;
  text << '\n';
  for (int k = 0; k < n; ++k)
    text << "4 " << k << ' ' << (k + 1) % n << ' ' << n + (k + 1) % n << ' ' << n + k << '\n';
  return text.str();
}

TEST_F(ImportLosses, FacesOfAnyNumberOfCornersAreTriangulated) {
  for (const int n : {4, 8, 10, 12, 40, 300}) {
    for (const double inner : {1.0, 0.4}) {  // convex caps, and stars
      SCOPED_TRACE(std::to_string(n) + " corners, inner radius " + std::to_string(inner));
      const Result<Imported> imported = import_mesh(write("prism.off", off_prism(n, inner)));
      ASSERT_TRUE(imported.ok()) << imported.error();
      EXPECT_EQ(imported->mesh.triangles.size(), static_cast<std::size_t>(2 * (n - 2) + 2 * n));
      EXPECT_TRUE(imported->report.losses.empty());
      const MeshCertificate certificate = certify(imported->mesh);
      EXPECT_TRUE(certificate.solid) << certificate.fault_text();
      // n triangles with one corner in the middle.
      const double area = 0.5 * n * inner * std::sin(2 * std::numbers::pi / n);
      EXPECT_NEAR(certificate.signed_volume, area, 1e-5);  // six digits of text, then floats
    }
  }
}

const std::string kTetrahedron =
    "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(ImportLosses, VariantsOfOffAreRead) {
  const std::string comments =
      "# a\nOFF # b\n\n# c\n4 4 6\n0 0 0 # d\n\n1 0 0\n0 1 0\n0 0 1\n"
      "3 0 2 1\n# e\n3 0 1 3 255 0 0\n3 0 3 2\n3 1 2 3";
  for (const std::string& text :
       {kTetrahedron, comments, changed(kTetrahedron, "OFF\n4 4 6", "OFF 4 4 6"),
        changed(kTetrahedron, "4 4 6", "4 4"), changed(kTetrahedron, "\n1 0 0\n", "\n+1e0 0 -0.\n"),
        changed(changed(kTetrahedron, "OFF", "COFF"), "1 0 0", "1 0 0 0.5 0.5 0.5 1"),
        changed(changed(kTetrahedron, "OFF", "STCNOFF"), "1 0 0", "1 0 0 9 9 9 9 9 9 9 9 9"),
        changed(kTetrahedron, "OFF\n", "nOFF\n3\n"),
        std::string("4OFF\r\n4 4 6\r\n0 0 0 1\r\n2 0 0 2\r\n0 0.5 0 0.5\r\n0 0 1 1\r\n3 0 2 1\r\n"
                    "3 0 1 3\r\n3 0 3 2\r\n3 1 2 3\r\n")}) {
    const Result<Imported> imported = import_mesh(write("tetrahedron.off", text));
    ASSERT_TRUE(imported.ok()) << imported.error() << "\n" << text;
    const MeshCertificate certificate = certify(imported->mesh);
    EXPECT_TRUE(certificate.solid) << text;
    EXPECT_NEAR(certificate.signed_volume, 1.0 / 6, 1e-7) << text;  // floats
  }
}

TEST_F(ImportLosses, DamagedOffFilesAreErrorsWithTheirPlace) {
  const auto error = [&](const std::string& from, const std::string& to) {
    return error_of("damaged.off", changed(kTetrahedron, from, to));
  };
  for (const std::string index : {"4", "99", "-1", "4294967296", "99999999999999999999"}) {
    const std::string text = error("3 0 1 3", "3 0 " + index + " 3");
    EXPECT_TRUE(has(text, "line 8: ") && has(text, index)) << text;
    EXPECT_TRUE(has(text, "face 1 of 4")) << text;
  }
  EXPECT_TRUE(has(error("3 0 3 2\n3 1 2 3\n", "3 0 3 2\n"), "the file ends before face 3 of 4"));
  EXPECT_TRUE(has(error("3 1 2 3", "3 1 2"), "the file ends before face 3 of 4"));
  EXPECT_TRUE(has(error("4 4 6", "4 3 6"), "line 10: there is more after the last of the 3 faces"));
  EXPECT_TRUE(has(error("1 0 0", "1 zero 0"), "line 4: 'zero' is no coordinate of vertex 1 of 4"));
  EXPECT_TRUE(has(error("4 4 6", "four 4 6"), "line 2: 'four' is no count"));
  EXPECT_TRUE(has(error("4 4 6", "4 -4 6"), "line 2: '-4' is no count"));
  EXPECT_TRUE(has(error("OFF\n", "OFF BINARY\n"), "binary OFF cannot be read"));
  EXPECT_TRUE(has(error("OFF\n", "nOFF\n4\n"), "only 3 dimensions"));
  EXPECT_TRUE(has(error("OFF\n", "ON\n"), "does not begin with OFF"));
  // Counts that no file of this size can keep: an error, and no flood of memory.
  EXPECT_TRUE(has(error("4 4 6", "4000000000 4 6"), "'3' is no") ||
              has(error("4 4 6", "4000000000 4 6"), "the file ends before vertex"));
}

// A tetrahedron in glTF's binary form, with one index as given.
std::string glb(std::uint16_t index) {
  const float points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint16_t corners[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, index};
  std::string data(sizeof points + sizeof corners, '\0');
  std::memcpy(data.data(), points, sizeof points);
  std::memcpy(data.data() + sizeof points, corners, sizeof corners);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
      R"("buffers":[{"byteLength":72}],"bufferViews":[{"buffer":0,"byteLength":48},)"
      R"({"buffer":0,"byteOffset":48,"byteLength":24}],"accessors":[{"bufferView":0,)"
      R"("componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},)"
      R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    std::string bytes(sizeof bits, '\0');
    std::memcpy(bytes.data(), &bits, sizeof bits);
    return bytes;
  };
  return "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" +
         json + word(data.size()) + std::string("BIN\0", 4) + data;
}

TEST_F(ImportLosses, DamagedGlbFilesAreErrors) {
  const Result<Imported> good = import_mesh(write("good.glb", glb(3)));
  ASSERT_TRUE(good.ok()) << good.error();
  EXPECT_EQ(good->mesh.triangles.size(), 4u);
  const std::string text = error_of("damaged.glb", glb(60));
  EXPECT_TRUE(has(text, "it is damaged") && has(text, "out-of-range indices")) << text;
  EXPECT_TRUE(import_mesh(write("good.glb", glb(3))).ok());  // nothing is left of the bad one
}

TEST_F(ImportLosses, EachThreadHearsItsOwnReader) {
  const std::string good = write("good.glb", glb(3)), bad = write("bad.glb", glb(60));
  constexpr int kTimes = 40;  // enough for the threads to meet
  int good_read = 0, bad_refused = 0;
  std::thread other([&] {
    for (int k = 0; k < kTimes; ++k)
      bad_refused += has(import_mesh(bad).error(), "damaged") ? 1 : 0;
  });
  for (int k = 0; k < kTimes; ++k) good_read += import_mesh(good).ok() ? 1 : 0;
  other.join();
  EXPECT_EQ(good_read, kTimes);
  EXPECT_EQ(bad_refused, kTimes);
}

// The reader of assimp reads for ever where no line of a PLY header is its end.
TEST_F(ImportLosses, APlyHeaderEndsWithALineOfItsOwn) {
  const auto ply = [](const std::string& last) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nelement face 1\nproperty list uchar int vertex_indices" +
           last + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  };
  for (const std::string last : {"\nend_header\n", "\r\nend_header\r\n", "\n  end_header  \n"})
    EXPECT_TRUE(import_mesh_guarded(write("good.ply", ply(last))).ok()) << last;
  for (const std::string last : {"*end_header\n", "\nend_headers\n", "\nthe end_header\n", "\n"}) {
    const Result<Imported> damaged = import_mesh_guarded(write("damaged.ply", ply(last)));
    EXPECT_FALSE(damaged.ok()) << last;
    EXPECT_TRUE(has(damaged.error(), "no end_header line")) << damaged.error();
  }
}

// A hexagon that crosses itself, and a triangle.
const std::string kCrossing =
    "v 0 4 0\nv 4 1 0\nv 2 2 0\nv 2 0 0\nv 3 2 0\nv 3 3 0\nv 0 0 1\nf 1 2 3 4 5 6\nf 1 2 7\n";

TEST_F(ImportLosses, PolygonsThatCannotBeCutAreCounted) {
  const std::string path = write("crossing.obj", kCrossing);
  for (const bool is_guarded : {false, true}) {
    const Result<Imported> imported = is_guarded ? import_mesh_guarded(path) : import_mesh(path);
    ASSERT_TRUE(imported.ok()) << imported.error();
    EXPECT_EQ(imported->mesh.triangles.size(), 3u);
    ASSERT_EQ(imported->report.losses.size(), 1u);
    EXPECT_TRUE(has(imported->report.losses[0], "2 of 5 triangles")) << imported->report.losses[0];
  }
  const Result<MeshInspection> inspection = inspect_mesh_file(path);
  ASSERT_TRUE(inspection.ok()) << inspection.error();
  EXPECT_TRUE(has(to_text(*inspection), "LOST")) << to_text(*inspection);
  EXPECT_TRUE(has(to_json(*inspection), "2 of 5 triangles")) << to_json(*inspection);
}

TEST_F(ImportLosses, ASceneTellsThem) {
  (void)write("crossing.obj", kCrossing);
  const auto scene = parse_scene(
      R"({"plumb_scene": 1, "meshes": {"sheet": {"file": "crossing.obj", "collision": "surface"}},)"
      R"("bodies": [{"type": "static", "colliders": [{"shape": "mesh", "mesh": "sheet"}]}]})",
      "test.json", folder_.string());
  ASSERT_TRUE(scene.ok()) << scene.error();
  PhysicsWorld world;
  const auto made = instantiate(*scene, world);
  ASSERT_TRUE(made.ok()) << made.error();
  ASSERT_FALSE(made->notes.empty());
  EXPECT_TRUE(has(made->notes[0], "mesh 'sheet'") && has(made->notes[0], "2 of 5 triangles"))
      << made->notes[0];
}

}  // namespace
}  // namespace plumb::test
