// The parts of a scene file, one function per kind of object. Each notes what is wrong in the
// reader's problems and goes on, so that one run of the loader finds everything.
#pragma once

#include <string>

#include "plumb/assets/scene.h"
#include "scene/object_reader.h"

namespace plumb::inline PLUMB_ABI::assets::scene {

// Bodies after all repeats; far above any scene, it catches a slip in a count.
inline constexpr std::size_t kMostBodies = 1'000'000;
inline constexpr std::uint32_t kLastKind = 0xffffffffu;  // of Material::kind

void read_step(const JsonNode& node, SceneStep& step, Problems& problems);
void read_settings(const JsonNode& node, WorldSettings& settings, Problems& problems);
void read_material(const JsonNode& node, const std::string& what, Material& material,
                   Problems& problems);
void read_mesh(const JsonNode& node, const std::string& what, SceneMesh& mesh, Problems& problems);
// `scene` holds the materials, meshes and heightfields that bodies refer to.
void read_body(const JsonNode& node, const Scene& scene, SceneBody& body, Problems& problems);
void read_collider(const JsonNode& node, const std::string& what, const Scene& scene,
                   SceneCollider& collider, Problems& problems);
// Of the keys "shape" and those that belong to it.
void read_shape(const ObjectReader& in, const Scene& scene, SceneCollider& collider);
// Half-spaces are for static bodies alone, surfaces for those that nothing pushes.
void check_motion(const Scene& scene, const SceneCollider& collider, const std::string& what,
                  MotionType type, Problems& problems);
void read_heightfield(const JsonNode& node, const std::string& what, SceneHeightfield& field,
                      Problems& problems);
void read_repeat(const JsonNode& node, const std::string& what, SceneRepeat& repeat,
                 Problems& problems);

// Of the key "orientation"; false if it is absent or wrong.
bool read_orientation(const ObjectReader& parent, Eigen::Quaterniond& orientation);
// Of the keys "position" and "orientation".
void read_pose(const ObjectReader& in, LocalPose& pose);

}  // namespace plumb::inline PLUMB_ABI::assets::scene
