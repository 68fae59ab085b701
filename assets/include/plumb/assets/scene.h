// A scene as a file describes it, and its way into a world.
//
//   auto scene = assets::load_scene("assets/scenes/default.json");
//   plumb::PhysicsWorld world(scene->settings);
//   auto instance = assets::instantiate(*scene, world);
//   world.step(scene->step.dt);
//
// The file format is published as assets/schema/scene.schema.json and explained in
// assets/scenes/README.md. Every error names the file, the line and what would be right.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plumb/assets/hull.h"
#include "plumb/assets/import.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/mesh.h"
#include "plumb/assets/result.h"
#include "plumb/world.h"

namespace plumb::inline PLUMB_ABI::assets {

inline constexpr int kSceneVersion = 1;

struct SceneStep {
  double dt = 1.0 / 60;  // [s] > 0
  double duration = 10;  // [s] >= 0

  // Steps that cover the duration; a duration that is a multiple of dt up to rounding counts as
  // one.
  [[nodiscard]] std::uint64_t count() const;
};

struct SceneMaterial {
  std::string name;
  Material material;
};

struct SceneMesh {
  std::string name;
  std::string file;                       // as written: relative to the folder of the scene
  std::string path;                       // where that is, seen from the working directory
  std::optional<double> metres_per_unit;  // [m] > 0; unset: what the file says
  std::optional<Axis> up;                 // unset: what the file says
  // What the mesh collides as. Concave meshes collide as their hull too, therefore the file has to
  // ask for it by name.
  enum class Collision { Hull } collision = Collision::Hull;
  std::size_t max_hull_vertices = kColliderHullVertices;  // 4..1024
  MassOptions mass;
  int line = 0;  // where it stands in the file; 0: it was made by code
};

struct SceneCollider {
  Collider collider;              // its shape is not used if `mesh` is named
  std::string mesh;               // name of a SceneMesh, or empty
  std::string material;           // name it came from; empty: written out in `collider`
  std::optional<double> density;  // [kg/m^3] unset: of the mesh, or Collider's default
  int line = 0;
};

// Copies of one body on a grid along the world axes.
struct SceneRepeat {
  std::array<int, 3> count{1, 1, 1};                  // >= 1 each
  Eigen::Vector3d spacing = Eigen::Vector3d::Ones();  // [m]
  Eigen::Vector3d jitter = Eigen::Vector3d::Zero();   // [m] >= 0: moved by up to this, either way
  bool random_orientation = false;                    // uniformly over all rotations
  std::uint64_t seed = 1;                             // same seed, same scene, on every machine

  [[nodiscard]] std::size_t total() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) *
           static_cast<std::size_t>(count[2]);
  }
};

struct SceneBody {
  std::string name;
  RigidBody body;
  std::optional<double> mass_scaled_to;  // [kg] > 0: keep the shape's distribution, with this mass
  std::vector<SceneCollider> colliders;
  std::optional<SceneRepeat> repeat;  // copies are named "name[0]", "name[1]", ...
  int line = 0;
};

struct Scene {
  std::string source;  // the file, for error texts
  std::string name;
  std::string description;
  SceneStep step;
  WorldSettings settings;
  std::vector<SceneMaterial> materials;
  std::vector<SceneMesh> meshes;
  std::vector<SceneBody> bodies;

  [[nodiscard]] std::size_t body_count() const;  // with all copies
  [[nodiscard]] const SceneMesh* find_mesh(std::string_view name) const;
};

// `name` stands for the file in error texts; meshes are looked for in `folder`.
Result<Scene> parse_scene(std::string_view text, const std::string& name,
                          const std::string& folder = ".");
// Also checks that the mesh files are there.
Result<Scene> load_scene(const std::string& path);
// The text of a scene file that describes the same scene. Everything is written out; numbers come
// back with the same bits.
std::string scene_to_json(const Scene& scene);

// A mesh as it looks, for recorders and renderers; what it collides as is in the colliders.
struct SceneVisual {
  std::size_t mesh = 0;  // index into SceneInstance::meshes
  LocalPose pose;        // of the mesh frame in the body frame
};

struct SceneInstanceBody {
  std::string name;
  BodyId id;
  std::vector<ColliderId> colliders;
  std::vector<SceneVisual> visuals;
};

struct SceneInstanceMesh {
  std::string name;
  TriangleMesh mesh;                         // [m] mesh frame
  std::shared_ptr<const HullGeometry> hull;  // what it collides as
  double hull_excess =
      0;  // volume of the hull over that of the mesh, minus 1; 0 if the mesh has none
};

struct SceneInstance {
  std::vector<SceneInstanceBody>
      bodies;  // in the order of the file; user_data of a body is its index
  std::vector<SceneInstanceMesh> meshes;  // those that bodies use
  std::vector<std::string> notes;  // worth knowing: concave meshes that collide as their hull
  std::map<std::string, std::size_t, std::less<>> index_of;  // name to index in `bodies`

  // Null if there is no such name.
  [[nodiscard]] BodyId find(std::string_view name) const;
};

// Builds the scene in the world and gives the world its settings. On an error the world is left
// with the bodies and settings that it had before.
Result<SceneInstance> instantiate(const Scene& scene, PhysicsWorld& world);

}  // namespace plumb::inline PLUMB_ABI::assets
