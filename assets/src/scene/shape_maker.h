// From what a scene says of a collider's shape to the shape itself: hulls and surfaces of meshes,
// heightfields, compounds. What several colliders name is made once.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "plumb/assets/scene.h"
#include "scene/prepared_mesh.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

class ShapeMaker {
 public:
  ShapeMaker(const plumb::PLUMB_ABI::assets::Scene& scene, MeshStore& meshes)
      : scene_(scene), meshes_(meshes) {}

  Result<Shape> make(const SceneCollider& collider);
  // Whether a collider has asked for it.
  [[nodiscard]] bool has_heightfield(const std::string& name) const {
    return heightfields_.contains(name);
  }

 private:
  Result<Shape> make_mesh(const std::string& name, const Shape& asked);
  Result<Shape> make_heightfield(const std::string& name);
  Result<Shape> make_compound(const SceneCollider& collider);
  [[nodiscard]] std::string place_of(int line) const;

  const plumb::PLUMB_ABI::assets::Scene& scene_;
  MeshStore& meshes_;
  std::map<std::string, std::shared_ptr<const HeightfieldGeometry>> heightfields_;
};

}  // namespace plumb::inline PLUMB_ABI::assets::scene
