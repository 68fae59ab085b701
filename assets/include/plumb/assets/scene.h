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

#include "plumb/assets/decompose.h"
#include "plumb/assets/hull.h"
#include "plumb/assets/import.h"
#include "plumb/assets/mass.h"
#include "plumb/assets/mesh.h"
#include "plumb/assets/progress.h"
#include "plumb/assets/repair.h"
#include "plumb/assets/result.h"
#include "plumb/compound.h"
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
  std::optional<RepairOptions> repair;    // unset: taken as it is
  // What the mesh collides as. Concave meshes may collide as their hull too, therefore the file has
  // to ask for it by name. A surface is for static and kinematic bodies and has no mass. Parts are
  // convex ones that keep the hollows of a concave solid.
  enum class Collision { Hull, Surface, Parts } collision = Collision::Hull;
  std::size_t max_hull_vertices = kColliderHullVertices;  // 4..1024, of a hull
  DecomposeOptions parts;                                 // of parts
  MassOptions mass;                                       // of a hull or parts: of the mesh itself
  int line = 0;  // where it stands in the file; 0: it was made by code
};

// Terrain: rows of heights over a grid, written in the scene or in a file of numbers.
struct SceneHeightfield {
  std::string name;
  std::string file;  // as written: relative to the folder of the scene; empty: `heights` holds them
  std::string path;  // where that is, seen from the working directory
  std::array<double, 2> spacing{1, 1};  // [m] > 0 between samples along x and z
  double height_scale = 1;              // [m] finite, height of a 1
  std::size_t samples_x = 0;            // of `heights`
  std::vector<double> heights;          // x running first, NaN: a hole
  int line = 0;
};

// One part of a compound collider.
struct SceneChild {
  CompoundGeometry::Child child;  // its shape is not used if `mesh` is named
  std::string mesh;               // name of a SceneMesh that collides as its hull, or empty
  int line = 0;
};

struct SceneCollider {
  Collider collider;        // of its shape only what the named parts below do not give: rounding of
                            // a hull, scale of a surface
  std::string mesh;         // name of a SceneMesh, or empty
  std::string heightfield;  // name of a SceneHeightfield, or empty
  std::vector<SceneChild> children;  // of a compound, else empty
  std::string material;              // name it came from; empty: written out in `collider`
  std::optional<double> density;     // [kg/m^3] unset: of the mesh, or Collider's default
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

// The name that stands for the world itself where a joint names a body.
inline constexpr std::string_view kWorldName = "world";

// Where a joint takes hold of one of its bodies: at a frame of that body, or at a place of the
// world as the bodies stand when the scene begins.
struct SceneJointSide {
  std::string body;                // name, of a copy "name[3]"; empty: the world itself
  std::optional<LocalPose> frame;  // in the body frame; if set, `anchor` is not used
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  // [m] world
};

struct SceneJoint {
  std::string name;
  SceneJointSide a, b;
  // World axes of the frames that are given by an anchor.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Joint joint;  // without bodies, frames and coupled joints, which are given by name
  // Lengths of distance, rope and spring joints: whether they are as the scene begins.
  bool length_as_placed = false;
  std::string first, second;  // names of the joints that a gear, or rack and pinion, couples
  int line = 0;
};

// What two kinds of material do when they meet, instead of what their numbers combine to.
struct SceneMaterialPair {
  std::uint32_t kind_a = 0, kind_b = 0;  // of Material::kind, not 0, in any order
  MaterialPair values;
  int line = 0;
};

// Two bodies that never meet, or two colliders of theirs.
struct SceneExclusion {
  struct Side {
    std::string body;                     // name, of a copy "name[3]"
    std::optional<std::size_t> collider;  // its place among the body's colliders; on both sides
  } a, b;
  int line = 0;
};

// A body effect (plumb/effects.h).
struct SceneEffect {
  std::string name;
  std::string body;               // name, of a copy "name[3]"; empty: every dynamic body
  std::string other;              // of a spring; empty: the world
  Effect effect;                  // without bodies, which are given by name
  bool length_as_placed = false;  // rest length of a spring: whether it is as the scene begins
  int line = 0;
};

struct Scene {
  std::string source;  // the file, for error texts
  std::string name;
  std::string description;
  SceneStep step;
  WorldSettings settings;
  std::vector<SceneMaterial> materials;
  std::vector<SceneMaterialPair> material_pairs;
  std::vector<SceneMesh> meshes;
  std::vector<SceneHeightfield> heightfields;
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<SceneExclusion> excluded_pairs;
  std::vector<SceneEffect> effects;

  [[nodiscard]] std::size_t body_count() const;  // with all copies
  // Null if there is none of that name.
  [[nodiscard]] const SceneMesh* find_mesh(std::string_view name) const;
  [[nodiscard]] const SceneHeightfield* find_heightfield(std::string_view name) const;
};

// `name` stands for the file in error texts; meshes and heightfields are looked for in `folder`.
Result<Scene> parse_scene(std::string_view text, const std::string& name,
                          const std::string& folder = ".");
// Also checks that the files of meshes and heightfields are there.
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
  TriangleMesh mesh;                              // [m] mesh frame
  std::shared_ptr<const HullGeometry> hull;       // what it collides as; null: its parts or itself
  std::shared_ptr<const CompoundGeometry> parts;  // null: it collides as something else
  std::optional<DecompositionReport> parts_report;
  double hull_excess =
      0;  // volume of the hull over that of the mesh, minus 1; 0 if the mesh has none
};

struct SceneInstanceJoint {
  std::string name;
  JointId id;
};

struct SceneInstanceEffect {
  std::string name;
  EffectId id;
};

struct SceneInstance {
  std::vector<SceneInstanceBody>
      bodies;  // in the order of the file; user_data of a body is its index
  std::vector<SceneInstanceJoint> joints;    // the same for joints
  std::vector<SceneInstanceEffect> effects;  // the same for effects
  std::vector<SceneInstanceMesh> meshes;     // those that bodies use
  // Worth knowing: what a repair changed, what a reader had to leave out, meshes of a size that
  // hints at a wrong unit, meshes that are not closed, dynamic bodies whose colliders bring no
  // mass, concave meshes that collide as their hull, surfaces with open seams, parts that miss the
  // distance asked for, joints whose sides begin far apart or whose angles read like degrees, files
  // that no body uses.
  std::vector<std::string> notes;
  std::map<std::string, std::size_t, std::less<>> index_of;  // name to index in `bodies`

  // Null if there is no such name.
  [[nodiscard]] BodyId find(std::string_view name) const;
  [[nodiscard]] JointId find_joint(std::string_view name) const;
  [[nodiscard]] EffectId find_effect(std::string_view name) const;
};

struct InstantiateOptions {
  // Meshes are read in child processes (import_mesh_guarded), so that a file which crashes or hangs
  // its reader is an error like any other. For tools; a game with threads must not fork.
  bool guarded = false;
  double time_limit = 60;  // [s] > 0 for each guarded reading
  WorkListener on_work = {};
};

// Builds the scene in the world and gives the world its settings. On an error the world is left
// with the bodies and settings that it had before.
Result<SceneInstance> instantiate(const Scene& scene, PhysicsWorld& world,
                                  const InstantiateOptions& options = {});

}  // namespace plumb::inline PLUMB_ABI::assets
