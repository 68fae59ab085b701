// The shapes of colliders and of the parts of compounds.
#include <algorithm>
#include <string>
#include <variant>

#include "scene/nearest.h"
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

const ShapeKeys& keys_of(std::string_view shape) {
  return *std::find_if(kShapeKeys.begin(), kShapeKeys.end(),
                       [&](const ShapeKeys& keys) { return keys.shape == shape; });
}

// A key that belongs to another shape is a slip that would go unseen.
void refuse_foreign_keys(const ObjectReader& in, const ShapeKeys& own) {
  for (const ShapeKeys& other : kShapeKeys) {
    for (const std::string_view key : other.keys) {
      if (key.empty() || !in.knows(key) || !in.has(key)) continue;
      if (std::find(own.keys.begin(), own.keys.end(), key) != own.keys.end()) continue;
      std::string wanted(own.keys[0]);
      if (own.needed > 1) wanted += " and " + std::string(own.keys[1]);
      in.problems().add(in.line_of(key),
                        in.what() + " is a " + std::string(own.shape) + ", which has no '" +
                            std::string(key) + "'",
                        "it is described by " + wanted);
    }
  }
}

void need(const ObjectReader& in, std::string_view key, const std::string& remedy) {
  if (!in.has(key)) in.missing(key, remedy);
}

template <class Round>
Round read_round(const ObjectReader& in, const char* length_remedy) {
  Round shape;
  need(in, "radius", "give the radius in metres");
  need(in, "half_length", length_remedy);
  in.number("radius", shape.radius, kPositive);
  in.number("half_length", shape.half_length, kPositive);
  in.number("rounding", shape.rounding, kNotNegative);
  return shape;
}

// The shapes whose numbers stand in the object itself; false for the others.
bool read_plain(const ObjectReader& in, std::string_view word, Shape& out) {
  if (word == "sphere") {
    Sphere sphere;
    need(in, "radius", "give the radius in metres");
    in.number("radius", sphere.radius, kPositive);
    out = sphere;
  } else if (word == "box") {
    Box box;
    need(in, "half_extents", "give half of the width, height and depth in metres");
    in.vector("half_extents", box.half_extents, kPositive);
    in.number("rounding", box.rounding, kNotNegative);
    out = box;
  } else if (word == "capsule") {
    Capsule capsule;
    need(in, "radius", "give the radius in metres");
    need(in, "half_length", "give half of the length between the end centres in metres");
    in.number("radius", capsule.radius, kPositive);
    in.number("half_length", capsule.half_length, kPositive);
    out = capsule;
  } else if (word == "cylinder") {
    out = read_round<Cylinder>(in, "give half of the length in metres");
  } else if (word == "cone") {
    out = read_round<Cone>(in, "give half of the height in metres");
  } else if (word == "half_space") {
    HalfSpace half_space;
    in.vector("normal", half_space.normal);
    in.number("offset", half_space.offset);
    if (!(half_space.normal.norm() > 0)) {
      in.problems().add(in.line_of("normal"), "'normal' of " + in.what() + " has no length",
                        "write the direction out of the solid, for example [0, 1, 0]");
    }
    out = half_space;
  } else {
    return false;
  }
  return true;
}

// A name of something that the scene describes under `section`.
template <class Thing>
void read_name(const ObjectReader& in, std::string_view key, const std::vector<Thing>& things,
               const std::string& section, std::string& name) {
  need(in, key, "name one of the scene's " + section);
  if (!in.text(key, name)) return;
  std::vector<std::string_view> names;
  for (const Thing& thing : things) names.push_back(thing.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  in.problems().add(
      in.line_of(key), "there is no " + std::string(key) + " '" + name + "'",
      names.empty() ? "describe it under \"" + section + "\"" : suggestion(name, names));
}

void read_mesh_shape(const ObjectReader& in, const Scene& scene, SceneCollider& collider) {
  read_name(in, "mesh", scene.meshes, "meshes", collider.mesh);
  const SceneMesh* mesh = scene.find_mesh(collider.mesh);
  const auto collision = mesh ? mesh->collision : SceneMesh::Collision::Hull;
  const bool is_surface = collision == SceneMesh::Collision::Surface;
  const bool is_hull = collision == SceneMesh::Collision::Hull;
  for (const char* foreign : {"rounding", "scale"}) {
    const bool belongs = foreign[0] == 'r' ? is_hull : is_surface;
    if (!mesh || belongs || !in.knows(foreign) || !in.has(foreign)) continue;
    in.problems().add(
        in.line_of(foreign),
        "mesh '" + mesh->name + "' collides as " +
            (is_surface ? "a surface, which has"
             : is_hull  ? "a hull, which has"
                        : "parts, which have") +
            " no '" + foreign + "'",
        foreign[0] == 'r' ? "remove it" : "remove it, or use metres_per_unit of the mesh");
    return;
  }
  if (collision == SceneMesh::Collision::Parts) {
    collider.collider.shape = Compound{};  // its geometry comes from the mesh
  } else if (is_surface) {
    SurfaceMesh surface;  // its geometry comes from the mesh
    in.vector("scale", surface.scale, kPositive);
    collider.collider.shape = surface;
  } else {
    ConvexHull hull;  // the same
    in.number("rounding", hull.rounding, kNotNegative);
    collider.collider.shape = hull;
  }
}

void read_child(const JsonNode& node, const std::string& what, const Scene& scene,
                SceneChild& child, Problems& problems) {
  const ObjectReader in(node, what, keys::kChild, problems);
  child.line = node.line;
  if (!in.is_object()) return;
  read_pose(in, child.child.pose);
  std::size_t which = 0;
  need(in, "shape", "use one of " + joined(kChildShapes));
  if (!in.choice("shape", kChildShapes, which)) return;
  const std::string_view word = kChildShapes[which];
  refuse_foreign_keys(in, keys_of(word));
  if (read_plain(in, word, child.child.shape)) return;
  read_name(in, "mesh", scene.meshes, "meshes", child.mesh);
  const SceneMesh* mesh = scene.find_mesh(child.mesh);
  if (mesh && mesh->collision != SceneMesh::Collision::Hull) {
    const bool is_surface = mesh->collision == SceneMesh::Collision::Surface;
    problems.add(in.line_of("mesh"),
                 "mesh '" + mesh->name + "' collides as " + (is_surface ? "a surface" : "parts"),
                 "a compound takes meshes with \"collision\": \"hull\"");
  }
  ConvexHull hull;  // its geometry comes from the mesh
  in.number("rounding", hull.rounding, kNotNegative);
  child.child.shape = hull;
}

void read_children(const ObjectReader& in, const Scene& scene, SceneCollider& collider) {
  collider.collider.shape = Compound{};  // made of the children
  const std::string remedy = "write a list of shapes, [{ \"shape\": ... }, ...]";
  need(in, "children", remedy);
  const JsonNode* node = in.find("children");
  if (!node) return;
  if (node->kind != JsonNode::Kind::Array || node->items.empty() ||
      node->items.size() > CompoundGeometry::kMaxChildren) {
    in.problems().add(node->line,
                      "'children' of " + in.what() + " is " +
                          (node->kind != JsonNode::Kind::Array ? name_of(node->kind)
                           : node->items.empty()               ? "an empty list"
                                                               : "a list of more than 65535"),
                      remedy);
    return;
  }
  for (std::size_t k = 0; k < node->items.size(); ++k) {
    read_child(node->items[k], "child " + std::to_string(k) + " of " + in.what(), scene,
               collider.children.emplace_back(), in.problems());
  }
}

}  // namespace

void read_shape(const ObjectReader& in, const Scene& scene, SceneCollider& collider) {
  std::array<std::string_view, kShapeKeys.size()> words;
  std::transform(kShapeKeys.begin(), kShapeKeys.end(), words.begin(),
                 [](const ShapeKeys& keys) { return keys.shape; });
  std::size_t which = 0;
  need(in, "shape", "use one of " + joined(words));
  if (!in.choice("shape", words, which)) return;
  refuse_foreign_keys(in, kShapeKeys[which]);
  if (read_plain(in, words[which], collider.collider.shape)) return;
  if (words[which] == "mesh") {
    read_mesh_shape(in, scene, collider);
  } else if (words[which] == "heightfield") {
    collider.collider.shape = Heightfield{};  // its geometry comes from the heightfield
    read_name(in, "heightfield", scene.heightfields, "heightfields", collider.heightfield);
  } else {
    read_children(in, scene, collider);
  }
}

void check_motion(const Scene& scene, const SceneCollider& collider, const std::string& what,
                  MotionType type, Problems& problems) {
  const SceneMesh* mesh = scene.find_mesh(collider.mesh);
  const bool is_surface = std::holds_alternative<Heightfield>(collider.collider.shape) ||
                          (mesh && mesh->collision == SceneMesh::Collision::Surface);
  if (type != MotionType::Static && std::holds_alternative<HalfSpace>(collider.collider.shape)) {
    problems.add(collider.line, what + " moves, but it is a half-space, which has no end",
                 "write \"type\": \"static\" or use another shape");
  } else if (type == MotionType::Dynamic && is_surface) {
    problems.add(collider.line, what + " moves freely, but it is a surface, which has no mass",
                 "write \"type\": \"static\" or \"kinematic\", or use another shape");
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
