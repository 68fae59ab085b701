#include "scene/prepared_mesh.h"

#include <algorithm>
#include <cstdio>

#include "mass/integrals.h"
#include "mesh/topology.h"
#include "plumb/assets/import.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/repair.h"
#include "plumb/assets/to_physics.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

// A hull this much larger than its mesh is worth a note: things will rest on air.
constexpr double kNotableHullExcess = 0.05;  // relative volume
// A body longer than this is more often one whose file is in millimetres.
constexpr double kDoubtfulSize = 100;  // [m]

std::string triangles_of(const TriangleMesh& mesh) {
  return std::to_string(mesh.triangles.size()) + " triangles";
}

// Edges that an odd number of triangles use: a closed surface has none.
std::size_t free_edges(const TriangleMesh& mesh) {
  const detail::Places places = detail::gather_places(mesh.vertices, 0);
  std::vector<Triangle> faces = mesh.triangles;
  for (Triangle& face : faces)
    for (std::uint32_t& corner : face) corner = places.place_of[corner];
  std::size_t free = 0;
  detail::for_each_edge(detail::sorted_edge_uses(faces), [&](std::size_t begin, std::size_t end) {
    if ((end - begin) % 2 != 0) ++free;
  });
  return free;
}

// What there is to say of a mesh that is not closed, whose mass cannot be that of its inside; empty
// if it is closed. A surface may be open, and parts never are.
std::string note_on_opening(const PreparedMesh& mesh) {
  const bool solid = mesh.mass && mesh.source->mass.method == MassMethod::Solid;
  if (!mesh.hull || solid) return {};
  const std::size_t free = free_edges(mesh.mesh);
  if (free == 0) return {};
  const std::string method = name_of(mesh.source->mass.method);
  return "mesh '" + mesh.source->name + "' is not closed: " + std::to_string(free) +
         " edges have a free side; " +
         (mesh.mass ? "its mass is by \"mass_of\": {\"method\": \"" + method + "\"}"
                    : std::string("no mass was taken from it"));
}

}  // namespace

std::string MeshStore::place_of(const SceneMesh& mesh) const {
  std::string place = scene_.source;
  if (mesh.line > 0) place += ":" + std::to_string(mesh.line);
  return place + ": mesh '" + mesh.name + "': ";
}

void MeshStore::tell(const SceneMesh& mesh, const std::string& work) const {
  if (options_.on_work) options_.on_work("mesh '" + mesh.name + "': " + work);
}

std::string MeshStore::read(PreparedMesh& prepared) const {
  const SceneMesh& source = *prepared.source;
  tell(source, "reading " + source.path);
  ImportOptions options;
  options.metres_per_unit = source.metres_per_unit;
  options.file_up = source.up;
  Result<Imported> imported = options_.guarded
                                  ? import_mesh_guarded(source.path, options, options_.time_limit)
                                  : import_mesh(source.path, options);
  if (!imported.ok()) return imported.error();
  prepared.mesh = std::move(imported.value().mesh);
  for (const std::string& loss : imported->report.losses)
    prepared.notes.push_back("mesh '" + source.name + "': " + loss);
  if (source.repair) {
    tell(source, "repairing " + triangles_of(prepared.mesh));
    Result<Repaired> repaired = repair(prepared.mesh, *source.repair);
    if (!repaired.ok()) return repaired.error();
    prepared.notes.push_back("mesh '" + source.name + "' was repaired: " + repaired->text());
    prepared.mesh = std::move(repaired.value().mesh);
  }
  const double longest = bounds_of(prepared.mesh).size().maxCoeff();
  const bool assumed = imported->report.unit_origin == Origin::Unknown;
  if (assumed && longest > kDoubtfulSize && source.collision != SceneMesh::Collision::Surface) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4g m", longest);
    prepared.notes.push_back("mesh '" + source.name + "' is " + text +
                             " long, and its file tells no unit: metres were assumed; give "
                             "metres_per_unit, 0.001 if it is in millimetres");
  }
  return {};
}

std::string MeshStore::make_hull(PreparedMesh& prepared) const {
  tell(*prepared.source,
       "convex hull of " + std::to_string(prepared.mesh.vertices.size()) + " vertices");
  Result<HullMesh> hull =
      convex_hull(prepared.mesh.vertices, {.max_vertices = prepared.source->max_hull_vertices});
  if (!hull.ok()) return hull.error();
  prepared.hull_mesh = std::move(hull).value();
  Result<std::shared_ptr<const HullGeometry>> geometry = to_physics(prepared.hull_mesh);
  if (!geometry.ok()) return geometry.error();
  prepared.hull = geometry.value();
  return {};
}

std::string MeshStore::make_surface(PreparedMesh& prepared) const {
  tell(*prepared.source, "surface of " + triangles_of(prepared.mesh));
  Result<std::shared_ptr<const TriangleMeshGeometry>> surface = to_physics(prepared.mesh);
  if (!surface.ok()) return surface.error();
  prepared.surface = surface.value();
  const bool closed = prepared.surface->open_edges() == 0 && prepared.surface->odd_edges() == 0;
  if (closed && detail::polyhedron_moments(prepared.mesh).volume < 0) {
    prepared.notes.push_back("mesh '" + prepared.source->name +
                             "' is inside out: its triangles face inwards; if it is not meant to "
                             "be felt from within, give it \"repair\": {\"orient\": true}");
  }
  return {};
}

std::string MeshStore::make_parts(PreparedMesh& prepared) const {
  tell(*prepared.source, "cutting " + triangles_of(prepared.mesh) + " into convex parts");
  const Result<Decomposition> decomposition = decompose(prepared.mesh, prepared.source->parts);
  if (!decomposition.ok()) return decomposition.error();
  Result<std::shared_ptr<const CompoundGeometry>> parts = to_physics(decomposition.value());
  if (!parts.ok()) return parts.error();
  prepared.parts = parts.value();
  prepared.parts_report = decomposition->report;
  return {};
}

bool MeshStore::has(const std::string& name) const {
  return std::any_of(meshes_.begin(), meshes_.end(),
                     [&](const PreparedMesh& mesh) { return mesh.source->name == name; });
}

Result<std::size_t> MeshStore::index_of(const std::string& name) {
  for (std::size_t k = 0; k < meshes_.size(); ++k)
    if (meshes_[k].source->name == name) return k;

  const SceneMesh* source = scene_.find_mesh(name);
  if (!source) return Error{scene_.source + ": there is no mesh '" + name + "'"};
  PreparedMesh prepared;
  prepared.source = source;
  if (const std::string wrong = read(prepared); !wrong.empty())
    return Error{place_of(*source) + wrong};
  std::string wrong;
  switch (source->collision) {
    case SceneMesh::Collision::Hull:
      wrong = make_hull(prepared);
      break;
    case SceneMesh::Collision::Surface:
      wrong = make_surface(prepared);
      break;
    case SceneMesh::Collision::Parts:
      wrong = make_parts(prepared);
      break;
  }
  if (!wrong.empty()) return Error{place_of(*source) + wrong};
  meshes_.push_back(std::move(prepared));
  return meshes_.size() - 1;
}

Result<MassProperties> MeshStore::mass_of(const std::string& name, std::optional<double> density) {
  const Result<std::size_t> index = index_of(name);
  if (!index.ok()) return Error{index.error()};
  PreparedMesh& mesh = meshes_[index.value()];
  if (!mesh.mass) {
    tell(*mesh.source, "mass of " + triangles_of(mesh.mesh) + " by the method " +
                           name_of(mesh.source->mass.method));
    const Result<MeshMass> mass = mass_of_mesh(mesh.mesh, mesh.source->mass);
    if (!mass.ok()) {
      return Error{place_of(*mesh.source) + mass.error() +
                   "; in a scene these are keys of the mesh: \"repair\": {\"orient\": true}, and "
                   "\"mass_of\": {\"method\": \"hull\"} for the method"};
    }
    const Result<MassProperties> properties = to_physics(mass.value());
    if (!properties.ok()) return Error{place_of(*mesh.source) + properties.error()};
    mesh.mass = properties.value();
    mesh.density = mass->density;
    // The material of a shell does not fill the mesh, and a hull's mass is that of the hull itself.
    const bool fills = mass->method == MassMethod::Solid || mass->method == MassMethod::Voxel;
    if (fills) mesh.volume = mass->volume;
  }
  if (!density) return *mesh.mass;
  return mesh.mass->scaled_to_mass(mesh.mass->mass * *density / mesh.density);
}

void MeshStore::move_into(SceneInstance& instance) {
  for (PreparedMesh& mesh : meshes_) {
    SceneInstanceMesh& out = instance.meshes.emplace_back();
    out.name = mesh.source->name;
    instance.notes.insert(instance.notes.end(), mesh.notes.begin(), mesh.notes.end());
    if (std::string note = note_on_opening(mesh); !note.empty())
      instance.notes.push_back(std::move(note));
    if (mesh.surface && mesh.surface->odd_edges() > 0) {
      instance.notes.push_back("mesh '" + out.name + "' has " +
                               std::to_string(mesh.surface->odd_edges()) +
                               " edges where triangles do not fit together; they can be felt");
    }
    if (mesh.parts_report && !mesh.parts_report->within_distance)
      instance.notes.push_back("mesh '" + out.name + "' collides as " + mesh.parts_report->text());
    out.parts = std::move(mesh.parts);
    out.parts_report = mesh.parts_report;
    out.hull = std::move(mesh.hull);
    if (mesh.volume > 0 && out.hull) {
      const Result<MeshMass> hull_mass =
          mass_of_mesh(triangulated(mesh.hull_mesh), {.method = MassMethod::Hull});
      if (hull_mass.ok()) out.hull_excess = hull_mass->volume / mesh.volume - 1;
    }
    out.mesh = std::move(mesh.mesh);
    if (out.hull_excess > kNotableHullExcess) {
      char text[64];
      std::snprintf(text, sizeof text, "%.0f %% more volume", 100 * out.hull_excess);
      instance.notes.push_back("mesh '" + out.name + "' collides as its convex hull, which has " +
                               text + " than the mesh");
    }
  }
  meshes_.clear();
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
