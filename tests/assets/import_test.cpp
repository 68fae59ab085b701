// Invariant: whatever the format, unit, axes and node transforms, a file yields the same body in
// metres; what was learnt, assumed and changed is reported; a file that cannot be read is an error
// that names it.
#include "plumb/assets/import.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "own_folder.h"
#include "plumb/assets/certificate.h"
#include "plumb/assets/report.h"
#include "sample_meshes.h"

namespace plumb::test {
namespace {

using namespace assets;

class ImportTest : public OwnFolder {};

// A box of 1 x 2 x 3 units with its low corner at the origin.
std::string obj_box() {
  return "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 1 2 0\nv 0 0 3\nv 1 0 3\nv 0 2 3\nv 1 2 3\n"
         "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

Imported must(const Result<Imported>& imported) {
  EXPECT_TRUE(imported.ok()) << imported.error();
  return imported.ok() ? *imported : Imported{};
}

void expect_box(const Imported& imported, const Vector3d& lower, const Vector3d& upper) {
  const MeshCertificate certificate = certify(imported.mesh);
  EXPECT_TRUE(certificate.solid) << certificate.fault_text();
  // Coordinates come through floats.
  const double rounding = 2 * imported.report.coordinate_rounding + 1e-15;
  EXPECT_GT(imported.report.coordinate_rounding, 0);
  EXPECT_LE((certificate.bounds.lower - lower).cwiseAbs().maxCoeff(), rounding)
      << certificate.bounds.lower.transpose();
  EXPECT_LE((certificate.bounds.upper - upper).cwiseAbs().maxCoeff(), rounding)
      << certificate.bounds.upper.transpose();
}

TEST_F(ImportTest, ObjHasNoUnitAndSaysSo) {
  const Imported imported = must(import_mesh(write("box.obj", obj_box())));
  expect_box(imported, {0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(imported.report.unit_origin, Origin::Unknown);
  EXPECT_EQ(imported.report.up_origin, Origin::Unknown);
  EXPECT_EQ(imported.report.notes.size(), 2u);  // unit and axis were assumed
  EXPECT_EQ(imported.mesh.name, "box");
}

TEST_F(ImportTest, UnitAndAxisCanBeGiven) {
  ImportOptions options{.metres_per_unit = 0.001, .file_up = Axis::Z};
  Imported imported = must(import_mesh(write("box.obj", obj_box()), options));
  expect_box(imported, {0, 0, -0.002}, {0.001, 0.003, 0});  // (x, y, z) -> (x, z, -y)
  EXPECT_EQ(imported.report.unit_origin, Origin::Option);
  EXPECT_EQ(imported.report.file_up, Axis::Z);
  options = {.file_up = Axis::X};
  imported = must(import_mesh(write("box.obj", obj_box()), options));
  expect_box(imported, {0, 0, 0}, {3, 1, 2});  // x comes up, nothing is mirrored
  options = {.file_up = Axis::Y, .world_up = Axis::Z};
  imported = must(import_mesh(write("box.obj", obj_box()), options));
  expect_box(imported, {0, -3, 0}, {1, 0, 2});
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_FALSE(import_mesh(write("box.obj", obj_box()), {.metres_per_unit = bad}).ok());
  }
}

std::string collada_box(const std::string& unit, const std::string& up, const std::string& node) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2000-01-01T00:00:00Z</created><modified>2000-01-01T00:00:00Z</modified>
<unit name="u" meter=")" +
         unit + R"("/><up_axis>)" + up + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="24">
0 0 0 1 0 0 0 2 0 1 2 0 0 0 3 1 0 3 0 2 3 1 2 3</float_array><technique_common>
<accessor source="#a" count="8" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>
0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5</p></triangles></mesh></geometry>
</library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n">)" +
         node + R"(<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

TEST_F(ImportTest, ColladaUnitAndAxisAreHonoured) {
  const std::string path =
      write("box.dae", collada_box("0.01", "Z_UP", "<translate>10 0 0</translate>"));
  const Imported imported = must(import_mesh(path));
  expect_box(imported, {0.1, 0, -0.02}, {0.11, 0.03, 0});
  EXPECT_EQ(imported.report.metres_per_unit, 0.01);
  EXPECT_EQ(imported.report.unit_origin, Origin::File);
  // An option beats the file.
  expect_box(must(import_mesh(path, {.metres_per_unit = 1})), {10, 0, -2}, {11, 3, 0});
  expect_box(must(import_mesh(path, {.file_up = Axis::Y})), {0.1, 0, 0}, {0.11, 0.02, 0.03});
}

TEST_F(ImportTest, MirroredNodesAreTurnedRightSideOut) {
  const Imported imported =
      must(import_mesh(write("box.dae", collada_box("1", "Y_UP", "<scale>-1 1 1</scale>"))));
  expect_box(imported, {-1, 0, 0}, {0, 2, 3});
  EXPECT_EQ(imported.report.mirrored_parts, 1u);
}

TEST_F(ImportTest, EveryInstanceIsAPart) {
  std::string text = collada_box("1", "Y_UP", "");
  const std::string second =
      R"(</node><node id="m"><translate>5 0 0</translate><instance_geometry url="#g"/></node>)";
  text.replace(text.find("</node>"), 7, second);
  const Imported imported = must(import_mesh(write("two.dae", text)));
  EXPECT_EQ(imported.report.parts, 2u);
  expect_box(imported, {0, 0, 0}, {6, 2, 3});
  EXPECT_EQ(certify(imported.mesh).components, 2u);
}

std::string fbx_box(double unit, int up, int up_sign, int front, int front_sign) {
  const auto setting = [](const std::string& name, const std::string& type,
                          const std::string& value) {
    return "P: \"" + name + "\", \"" + type + "\", \"\", \"\"," + value + "\n";
  };
  return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: "
         "7400\n}\n"
         "GlobalSettings: {\nVersion: 1000\nProperties70: {\n" +
         setting("UpAxis", "int", std::to_string(up)) +
         setting("UpAxisSign", "int", std::to_string(up_sign)) +
         setting("FrontAxis", "int", std::to_string(front)) +
         setting("FrontAxisSign", "int", std::to_string(front_sign)) +
         setting("CoordAxis", "int", "0") + setting("CoordAxisSign", "int", "1") +
         setting("UnitScaleFactor", "double", std::to_string(unit)) + "}\n}\n" +
         "Objects: {\nGeometry: 100, \"Geometry::box\", \"Mesh\" {\n"
         "Vertices: *24 {\na: 0,0,0,1,0,0,0,2,0,1,2,0,0,0,3,1,0,3,0,2,3,1,2,3\n}\n"
         "PolygonVertexIndex: *24 {\na: 0,2,3,-2,4,5,7,-7,0,1,5,-5,2,6,7,-4,0,4,6,-3,1,3,7,-6\n}\n"
         "GeometryVersion: 124\n}\n"
         "Model: 200, \"Model::box\", \"Mesh\" {\nVersion: 232\n}\n}\n"
         "Connections: {\nC: \"OO\",200,0\nC: \"OO\",100,200\n}\n";
}

TEST_F(ImportTest, FbxUnitAndAxesAreHonoured) {
  // Centimetres, z up, front -y: what most modelling programs write.
  Imported imported = must(import_mesh(write("z_up.fbx", fbx_box(1, 2, 1, 1, -1))));
  expect_box(imported, {0, 0, -0.02}, {0.01, 0.03, 0});
  EXPECT_EQ(imported.report.metres_per_unit, 0.01);
  EXPECT_EQ(imported.report.unit_origin, Origin::File);
  EXPECT_EQ(imported.report.file_up, Axis::Z);
  EXPECT_EQ(imported.report.up_origin, Origin::File);
  // Metres, y up.
  imported = must(import_mesh(write("y_up.fbx", fbx_box(100, 1, 1, 2, 1))));
  expect_box(imported, {0, 0, 0}, {1, 2, 3});
  EXPECT_EQ(imported.report.file_up, Axis::Y);
  // Left-handed axes: brought back, faces still outward.
  imported = must(import_mesh(write("left.fbx", fbx_box(100, 1, 1, 2, -1))));
  expect_box(imported, {0, 0, -3}, {1, 2, 0});
  // Axes that are no axes are reported, not obeyed.
  imported = must(import_mesh(write("odd.fbx", fbx_box(100, 1, 1, 1, 1))));
  expect_box(imported, {0, 0, 0}, {1, 2, 3});
  EXPECT_FALSE(imported.report.notes.empty());
}

TEST_F(ImportTest, FilesThatAreNoMeshesAreErrorsThatNameThem) {
  const std::vector<std::string> paths{
      write("empty.obj", ""),
      write("text.obj", "this is no mesh\n"),
      write("broken.dae", "<COLLADA"),
      write("short.stl", std::string(83, 'x')),
      write("points.obj", "v 0 0 0\n"),
      write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
      write("what.xyz", "1 2 3\n"),
      "no_such_file.obj",
      testing::TempDir()};
  for (const std::string& path : paths) {
    const Result<Imported> imported = import_mesh(path);
    EXPECT_FALSE(imported.ok()) << path;
    EXPECT_NE(imported.error().find(path), std::string::npos) << imported.error();
    const Result<Imported> guarded = import_mesh_guarded(path);
    EXPECT_EQ(guarded.error(), imported.error());
  }
}

TEST_F(ImportTest, LimitsAreKept) {
  const std::string path = write("box.obj", obj_box());
  EXPECT_NE(import_mesh(path, {.max_triangles = 11}).error().find("max_triangles"),
            std::string::npos);
  EXPECT_NE(import_mesh(path, {.max_file_bytes = 10}).error().find("max_file_bytes"),
            std::string::npos);
  EXPECT_TRUE(import_mesh(path, {.max_triangles = 12}).ok());
}

// No time at all is too little for any file: the child is ended and the limit is named.
TEST_F(ImportTest, TimeLimitIsKept) {
  const std::string path = write("box.obj", obj_box());
  EXPECT_NE(import_mesh_guarded(path, {}, 1e-9).error().find("did not finish"), std::string::npos);
  EXPECT_FALSE(import_mesh_guarded(path, {}, 0).ok());
}

TEST_F(ImportTest, GuardedReadingGivesTheSame) {
  const std::string path = write("box.dae", collada_box("0.01", "Z_UP", ""));
  const Imported plain = must(import_mesh(path)), guarded = must(import_mesh_guarded(path));
  EXPECT_EQ(plain.mesh.vertices, guarded.mesh.vertices);
  EXPECT_EQ(plain.mesh.triangles, guarded.mesh.triangles);
  EXPECT_EQ(plain.mesh.name, guarded.mesh.name);
  EXPECT_EQ(plain.report.notes, guarded.report.notes);
  EXPECT_EQ(plain.report.metres_per_unit, guarded.report.metres_per_unit);
  EXPECT_EQ(plain.report.coordinate_rounding, guarded.report.coordinate_rounding);
}

TEST_F(ImportTest, ReportsArePrinted) {
  const std::string path = write("box.obj", obj_box());
  const Result<MeshInspection> inspection = inspect_mesh_file(path);
  ASSERT_TRUE(inspection.ok()) << inspection.error();
  const std::string text = to_text(*inspection);
  for (const char* word :
       {"certificate: SOLID", "mass: method solid", "6000 kg", "convex hull", "closed", "genus"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << '\n' << text;
  }
  const std::string json = to_json(*inspection);
  for (const char* word :
       {"\"schema\": \"plumb-mesh/1\"", "\"solid\": true", "\"method\": \"solid\""}) {
    EXPECT_NE(json.find(word), std::string::npos) << word << '\n' << json;
  }
}

}  // namespace
}  // namespace plumb::test
