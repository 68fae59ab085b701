// The meshes of a scene: files, and what they collide as.
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr int kFewestHullVertices = 4;
constexpr int kMostHullVertices = 1024;
constexpr int kCoarsestVoxels = 8;
constexpr int kFinestVoxels = 512;

void refuse(const ObjectReader& in, std::string_view key, const std::string& kind,
            const std::string& collision) {
  if (!in.has(key)) return;
  in.problems().add(in.line_of(key),
                    "'" + std::string(key) + "' of " + in.what() + " has no meaning for " + kind,
                    "remove it or write \"collision\": \"" + collision + "\"");
}

// Keys that belong to another way of colliding are slips that would go unseen.
void refuse_foreign_keys(const ObjectReader& in, SceneMesh::Collision collision) {
  switch (collision) {
    case SceneMesh::Collision::Hull:
      refuse(in, "parts", "a hull", "parts");
      break;
    case SceneMesh::Collision::Parts:
      refuse(in, "max_hull_vertices", "parts, which have a max_vertices of their own", "hull");
      break;
    case SceneMesh::Collision::Surface:
      for (const std::string_view key : {"max_hull_vertices", "density", "mass_of"})
        refuse(in, key, "a surface", "hull");
      refuse(in, "parts", "a surface", "parts");
      break;
  }
}

void read_mesh_parts(const JsonNode& node, const std::string& what, DecomposeOptions& out,
                     Problems& problems) {
  const ObjectReader in(node, "parts of " + what, keys::kMeshParts, problems);
  if (!in.is_object()) return;
  in.number("max_distance", out.max_distance, kPositive);
  int parts = static_cast<int>(out.max_parts), vertices = static_cast<int>(out.max_part_vertices);
  in.integer("max_parts", parts, 1, static_cast<int>(kMostParts));
  in.integer("max_vertices", vertices, 4, static_cast<int>(kMostPartVertices));
  out.max_parts = static_cast<std::size_t>(parts);
  out.max_part_vertices = static_cast<std::size_t>(vertices);
}

void read_mesh_repair(const JsonNode& node, const std::string& what, RepairOptions& out,
                      Problems& problems) {
  const ObjectReader in(node, "repair of " + what, keys::kMeshRepair, problems);
  if (!in.is_object()) return;
  in.number("weld_tolerance", out.weld_tolerance, kNotNegative);
  in.flag("orient", out.orient);
}

void read_mass_of(const JsonNode& node, const std::string& what, MassOptions& out,
                  Problems& problems) {
  const std::string part = "mass_of of " + what;
  const ObjectReader mass(node, part, keys::kMassOf, problems);
  if (!mass.is_object()) return;
  mass.choice("method", kMassMethods, out.method);
  mass.number("thickness", out.shell_thickness, kPositive);
  mass.integer("resolution", out.voxel_resolution, kCoarsestVoxels, kFinestVoxels);
  if (!mass.has("method")) mass.missing("method", "use one of solid, shell, hull, voxel");
  const bool shell = out.method == MassMethod::Shell;
  if (shell && !mass.has("thickness")) {
    mass.missing("thickness", "give the thickness of the shell in metres");
  }
  if (!shell && mass.has("thickness")) {
    problems.add(mass.line_of("thickness"), "'thickness' has no meaning unless the method is shell",
                 "remove it or write \"method\": \"shell\"");
  }
  if (out.method != MassMethod::Voxel && mass.has("resolution")) {
    problems.add(mass.line_of("resolution"),
                 "'resolution' has no meaning unless the method is voxel",
                 "remove it or write \"method\": \"voxel\"");
  }
}

}  // namespace

void read_mesh(const JsonNode& node, const std::string& what, SceneMesh& mesh, Problems& problems) {
  const ObjectReader in(node, what, keys::kMesh, problems);
  mesh.line = node.line;
  if (!in.is_object()) return;
  in.text("file", mesh.file);
  if (!in.has("file")) {
    in.missing("file", "name the mesh file, relative to the folder of the scene");
  } else if (mesh.file.empty() && in.find("file")->kind == JsonNode::Kind::Text) {
    problems.add(in.line_of("file"), "'file' of " + what + " is empty",
                 "name the mesh file, relative to the folder of the scene");
  }
  double scale = 1;
  if (in.number("metres_per_unit", scale, kPositive)) mesh.metres_per_unit = scale;
  Axis up = Axis::Y;
  if (in.choice("up", kAxes, up)) mesh.up = up;
  if (const JsonNode* repair = in.find("repair"))
    read_mesh_repair(*repair, what, mesh.repair.emplace(), problems);
  in.choice("collision", kCollisions, mesh.collision);
  if (!in.has("collision")) {
    in.missing(
        "collision",
        "write \"collision\": \"hull\" to let it collide as its convex hull, the hollows of a "
        "concave mesh filled, \"parts\" to let it keep them, or \"surface\" for triangles that do "
        "not move freely");
  }
  refuse_foreign_keys(in, mesh.collision);
  if (mesh.collision == SceneMesh::Collision::Surface) return;
  if (const JsonNode* parts = in.find("parts")) read_mesh_parts(*parts, what, mesh.parts, problems);
  int vertices = static_cast<int>(mesh.max_hull_vertices);
  in.integer("max_hull_vertices", vertices, kFewestHullVertices, kMostHullVertices);
  mesh.max_hull_vertices = static_cast<std::size_t>(vertices);
  in.number("density", mesh.mass.density, kMassRange);
  if (const JsonNode* mass = in.find("mass_of")) read_mass_of(*mass, what, mesh.mass, problems);
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
