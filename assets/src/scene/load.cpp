#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

#include "plumb/assets/scene.h"
#include "scene/effects.h"
#include "scene/json_tree.h"
#include "scene/keys.h"
#include "scene/object_reader.h"
#include "scene/read_joint.h"
#include "scene/read_pairs.h"
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using namespace scene;  // NOLINT(google-build-using-namespace): the loader's own parts

// A scene is text that people edit; what is larger is another file given by mistake.
constexpr std::uintmax_t kLargestSceneFile = 64u << 20;  // [bytes]
// A multiple of dt up to the rounding of the two numbers is a whole number of steps.
constexpr double kStepRounding = 1e-9;  // relative to one step

const JsonNode* list_of(const ObjectReader& in, std::string_view key, JsonNode::Kind kind) {
  const JsonNode* node = in.find(key);
  if (!node || node->kind == kind) return node;
  in.problems().add(
      node->line, "'" + std::string(key) + "' is " + name_of(node->kind),
      kind == JsonNode::Kind::Array ? "write a list, [ ... ]" : "write an object, { ... }");
  return nullptr;
}

void read_version(const ObjectReader& in) {
  if (!in.has("plumb_scene")) {
    in.problems().add(in.line(),
                      "the scene does not say which version of the format it is written in",
                      "add \"plumb_scene\": " + std::to_string(kSceneVersion));
    return;
  }
  double version = 0;
  if (in.number("plumb_scene", version) && version != kSceneVersion) {
    in.problems().add(in.line_of("plumb_scene"), "this version of the scene format is not known",
                      "write \"plumb_scene\": " + std::to_string(kSceneVersion) +
                          " and what that version allows");
  }
}

void read_bodies(const ObjectReader& in, Scene& scene) {
  const JsonNode* bodies = list_of(in, "bodies", JsonNode::Kind::Array);
  if (!in.has("bodies")) in.missing("bodies", "add \"bodies\": [ ... ]");
  if (!bodies) return;
  std::set<std::string> names;
  double total = 0;
  for (std::size_t k = 0; k < bodies->items.size(); ++k) {
    SceneBody& body = scene.bodies.emplace_back();
    body.name = "body " + std::to_string(k);
    read_body(bodies->items[k], scene, body, in.problems());
    if (!names.insert(body.name).second) {
      in.problems().add(body.line, "there is another body named '" + body.name + "'",
                        "give each body a name of its own");
    }
    if (!body.repeat) {
      ++total;
      continue;
    }
    double copies = 1;
    for (const int count : body.repeat->count) copies *= count;
    total += copies;
    if (total > static_cast<double>(kMostBodies)) {
      in.problems().add(body.line,
                        "with '" + body.name + "' the scene has more than " +
                            std::to_string(kMostBodies) + " bodies",
                        "lower the count of its repeat");
      return;
    }
  }
}

void read_scene(const JsonNode& root, Scene& scene, Problems& problems) {
  const ObjectReader in(root, "the scene", keys::kScene, problems);
  if (!in.is_object()) return;
  read_version(in);
  in.text("name", scene.name);
  in.text("description", scene.description);
  if (const JsonNode* step = in.find("step")) read_step(*step, scene.step, problems);
  if (const JsonNode* settings = in.find("settings"))
    read_settings(*settings, scene.settings, problems);
  if (const JsonNode* materials = list_of(in, "materials", JsonNode::Kind::Object)) {
    for (const JsonMember& member : materials->members) {
      SceneMaterial& material = scene.materials.emplace_back();
      material.name = member.key;
      read_material(member.value, "material '" + member.key + "'", material.material, problems);
    }
  }
  if (const JsonNode* pairs = list_of(in, "material_pairs", JsonNode::Kind::Array))
    read_material_pairs(*pairs, scene.material_pairs, problems);
  if (const JsonNode* meshes = list_of(in, "meshes", JsonNode::Kind::Object)) {
    for (const JsonMember& member : meshes->members) {
      SceneMesh& mesh = scene.meshes.emplace_back();
      mesh.name = member.key;
      read_mesh(member.value, "mesh '" + member.key + "'", mesh, problems);
    }
  }
  if (const JsonNode* fields = list_of(in, "heightfields", JsonNode::Kind::Object)) {
    for (const JsonMember& member : fields->members) {
      SceneHeightfield& field = scene.heightfields.emplace_back();
      field.name = member.key;
      read_heightfield(member.value, "heightfield '" + member.key + "'", field, problems);
    }
  }
  read_bodies(in, scene);
  if (const JsonNode* joints = list_of(in, "joints", JsonNode::Kind::Array))
    JointsReader(scene, problems).read(*joints, scene.joints);
  if (const JsonNode* pairs = list_of(in, "excluded_pairs", JsonNode::Kind::Array))
    read_excluded_pairs(*pairs, scene, problems);
  if (const JsonNode* effects = list_of(in, "effects", JsonNode::Kind::Array))
    read_effects(*effects, scene, problems);
}

// Where a file is that the scene names, from the working directory; it is missed on request.
std::string path_of(const std::string& folder, const std::string& file, int line,
                    const std::string& what, bool look_for_files, Problems& problems) {
  std::string path = (std::filesystem::path(folder) / file).lexically_normal().string();
  std::error_code ignored;
  if (look_for_files && !file.empty() && !std::filesystem::is_regular_file(path, ignored)) {
    problems.add(line, "the file '" + path + "' of " + what + " is not there",
                 "correct \"file\", which counts from the folder of the scene");
  }
  return path;
}

// With the problems of a file that could be read; mesh files are looked for only on request.
Result<Scene> parse(std::string_view text, const std::string& name, const std::string& folder,
                    bool look_for_files) {
  Problems problems(name);
  JsonNode root;
  if (!parse_json(text, root, problems)) return Error{problems.text()};
  Scene scene;
  scene.source = name;
  read_scene(root, scene, problems);
  for (SceneMesh& mesh : scene.meshes) {
    mesh.path =
        path_of(folder, mesh.file, mesh.line, "mesh '" + mesh.name + "'", look_for_files, problems);
  }
  for (SceneHeightfield& field : scene.heightfields) {
    field.path = path_of(folder, field.file, field.line, "heightfield '" + field.name + "'",
                         look_for_files, problems);
  }
  if (!problems.empty()) return Error{problems.text()};
  return scene;
}

}  // namespace

std::uint64_t SceneStep::count() const {
  return static_cast<std::uint64_t>(std::ceil(duration / dt - kStepRounding));
}

std::size_t Scene::body_count() const {
  std::size_t count = 0;
  for (const SceneBody& body : bodies) count += body.repeat ? body.repeat->total() : 1;
  return count;
}

const SceneMesh* Scene::find_mesh(std::string_view name_wanted) const {
  for (const SceneMesh& mesh : meshes)
    if (mesh.name == name_wanted) return &mesh;
  return nullptr;
}

const SceneHeightfield* Scene::find_heightfield(std::string_view name_wanted) const {
  for (const SceneHeightfield& field : heightfields)
    if (field.name == name_wanted) return &field;
  return nullptr;
}

Result<Scene> parse_scene(std::string_view text, const std::string& name,
                          const std::string& folder) {
  return parse(text, name, folder, false);
}

Result<Scene> load_scene(const std::string& path) {
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (!std::filesystem::is_regular_file(status)) {
    const char* what = std::filesystem::is_directory(status) ? "this is a folder and not a file"
                       : std::filesystem::exists(status)
                           ? "this is a device or a pipe; scenes are read from files, since what "
                             "they name counts from their folder"
                           : "there is no such file";
    return Error{(path.empty() ? "\"\"" : path) + ": " + what +
                 "; give the path of a scene, for example assets/scenes/default.json"};
  }
  if (std::filesystem::file_size(path, problem) > kLargestSceneFile) {
    return Error{path + ": the file is too large for a scene (64 MB); is it a mesh?"};
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) return Error{path + ": the file cannot be read; check its permissions"};
  return parse(text, path, std::filesystem::path(path).parent_path().string(), true);
}

}  // namespace plumb::inline PLUMB_ABI::assets
