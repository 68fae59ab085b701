// The meshes of a scene, each read and turned into a hull, a surface or parts once, when the first
// body asks for it; its mass only when a moving body needs it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plumb/assets/scene.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

struct PreparedMesh {
  const SceneMesh* source = nullptr;
  TriangleMesh mesh;
  HullMesh hull_mesh;
  // What it collides as is one of the three, the others are null.
  std::shared_ptr<const HullGeometry> hull;
  std::shared_ptr<const TriangleMeshGeometry> surface;
  std::shared_ptr<const CompoundGeometry> parts;
  std::optional<DecompositionReport> parts_report;
  std::optional<MassProperties> mass;  // at the density of the scene's mesh
  double density = 0;                  // [kg/m^3] of `mass`
  double volume = 0;                   // [m^3] inside the mesh; 0 if not known
  std::vector<std::string> notes;      // on how it was read
};

class MeshStore {
 public:
  MeshStore(const plumb::PLUMB_ABI::assets::Scene& scene, const InstantiateOptions& options)
      : scene_(scene), options_(options) {}

  Result<std::size_t> index_of(const std::string& name);
  // Whether a body has asked for it.
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] const PreparedMesh& at(std::size_t index) const { return meshes_[index]; }
  // Of a hull or parts. With a density other than that of the mesh if one is given [kg/m^3] > 0.
  Result<MassProperties> mass_of(const std::string& name, std::optional<double> density);
  // Visual meshes, hulls and notes. The stored ones are gone then.
  void move_into(SceneInstance& instance);

 private:
  [[nodiscard]] std::string place_of(const SceneMesh& mesh) const;
  void tell(const SceneMesh& mesh, const std::string& work) const;
  // An empty text: it went well.
  std::string read(PreparedMesh& prepared) const;
  std::string make_hull(PreparedMesh& prepared) const;
  std::string make_surface(PreparedMesh& prepared) const;
  std::string make_parts(PreparedMesh& prepared) const;

  const plumb::PLUMB_ABI::assets::Scene& scene_;
  InstantiateOptions options_;
  std::vector<PreparedMesh> meshes_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
