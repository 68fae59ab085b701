#include <algorithm>
#include <string>
#include <variant>

#include "scene/nearest.h"
#include "scene/read_parts.h"

namespace plumb::inline PLUMB_ABI::assets::scene {
namespace {

constexpr int kLayerCount = 32;

void read_layers(const ObjectReader& in, std::string_view key, std::uint32_t& bits) {
  const JsonNode* node = in.find(key);
  if (!node) return;
  std::uint32_t read = 0;
  bool good = node->kind == JsonNode::Kind::Array;
  for (const JsonNode& item : node->items) {
    good = good && item.is_unsigned && item.integer < kLayerCount;
    if (good) read |= std::uint32_t{1} << item.integer;
  }
  if (!good) {
    in.problems().add(node->line,
                      "'" + std::string(key) + "' of " + in.what() + " is not a list of layers",
                      "write a list of layer numbers from 0 to 31, for example [0, 3]");
    return;
  }
  bits = read;
}

void read_locks(const ObjectReader& in, MotionLocks& locks) {
  const JsonNode* node = in.find("locks");
  if (!node) return;
  if (node->kind != JsonNode::Kind::Array) {
    in.problems().add(node->line, "'locks' of " + in.what() + " is " + name_of(node->kind),
                      "write a list of " + joined(kLocks));
    return;
  }
  bool* const flags[] = {&locks.linear_x,  &locks.linear_y,  &locks.linear_z,
                         &locks.angular_x, &locks.angular_y, &locks.angular_z};
  for (const JsonNode& item : node->items) {
    const auto found = std::find(std::begin(kLocks), std::end(kLocks), item.text);
    if (item.kind != JsonNode::Kind::Text || found == std::end(kLocks)) {
      in.problems().add(item.line, "'locks' of " + in.what() + " holds '" + item.text + "'",
                        suggestion(item.text, kLocks));
      continue;
    }
    *flags[found - std::begin(kLocks)] = true;
  }
}

void read_mass(const ObjectReader& in, SceneBody& body) {
  const JsonNode* node = in.find("mass");
  if (!node) return;
  if (node->kind == JsonNode::Kind::Number) {
    double mass = 0;
    if (!in.number("mass", mass, kPositive)) return;
    if (!in.has("colliders")) {
      in.problems().add(node->line,
                        "'mass' of " + in.what() +
                            " is a number, but it has no colliders "
                            "to spread it over",
                        "write an object with mass, center and inertia, or add colliders");
      return;
    }
    body.mass_scaled_to = mass;
    return;
  }
  const ObjectReader parts(*node, "mass of " + in.what(), keys::kMass, in.problems());
  if (!parts.is_object()) return;
  MassProperties properties;
  bool good = parts.number("mass", properties.mass, kPositive);
  if (!parts.has("mass")) parts.missing("mass", "give the mass in kilograms");
  if (parts.has("center")) good = parts.vector("center", properties.center) && good;
  const JsonNode* inertia = parts.find("inertia");
  if (!inertia) {
    parts.missing("inertia", "give [xx, yy, zz] or [xx, yy, zz, xy, xz, yz] in kg m^2");
    return;
  }
  double t[6] = {0, 0, 0, 0, 0, 0};
  const bool diagonal = inertia->kind == JsonNode::Kind::Array && inertia->items.size() == 3;
  if (!parts.numbers("inertia", t, diagonal ? 3 : 6) || !good) return;
  properties.I_Bcm_B << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
  const Status status = check(properties);
  if (!status.ok()) {
    in.problems().add(node->line, "mass of " + in.what() + ": " + status.message, "");
    return;
  }
  body.body.mass = properties;
}

// A key that belongs to another shape is a slip that would go unseen.
void refuse_foreign_keys(const ObjectReader& in, const ShapeKeys& own) {
  for (const ShapeKeys& other : kShapeKeys) {
    for (const std::string_view key : other.keys) {
      if (key.empty() || !in.has(key)) continue;
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

void read_shape(const ObjectReader& in, const Scene& scene, SceneCollider& collider) {
  constexpr std::string_view kShapes[] = {
      kShapeKeys[0].shape, kShapeKeys[1].shape, kShapeKeys[2].shape, kShapeKeys[3].shape,
      kShapeKeys[4].shape, kShapeKeys[5].shape, kShapeKeys[6].shape};
  std::size_t which = 0;
  need(in, "shape", "use one of " + joined(kShapes));
  if (!in.choice("shape", kShapes, which)) return;
  refuse_foreign_keys(in, kShapeKeys[which]);
  switch (which) {
    case 0: {
      Sphere sphere;
      need(in, "radius", "give the radius in metres");
      in.number("radius", sphere.radius, kPositive);
      collider.collider.shape = sphere;
      break;
    }
    case 1: {
      Box box;
      need(in, "half_extents", "give half of the width, height and depth in metres");
      in.vector("half_extents", box.half_extents, kPositive);
      in.number("rounding", box.rounding, kNotNegative);
      collider.collider.shape = box;
      break;
    }
    case 2: {
      Capsule capsule;
      need(in, "radius", "give the radius in metres");
      need(in, "half_length", "give half of the length between the end centres in metres");
      in.number("radius", capsule.radius, kPositive);
      in.number("half_length", capsule.half_length, kPositive);
      collider.collider.shape = capsule;
      break;
    }
    case 3: {
      HalfSpace half_space;
      in.vector("normal", half_space.normal);
      in.number("offset", half_space.offset);
      if (!(half_space.normal.norm() > 0)) {
        in.problems().add(in.line_of("normal"), "'normal' of " + in.what() + " has no length",
                          "write the direction out of the solid, for example [0, 1, 0]");
      }
      collider.collider.shape = half_space;
      break;
    }
    case 5: {
      collider.collider.shape = read_round<Cylinder>(in, "give half of the length in metres");
      break;
    }
    case 6: {
      collider.collider.shape = read_round<Cone>(in, "give half of the height in metres");
      break;
    }
    default: {
      ConvexHull hull;  // its geometry comes from the mesh
      in.number("rounding", hull.rounding, kNotNegative);
      collider.collider.shape = hull;
      need(in, "mesh", "name one of the scene's meshes");
      if (!in.text("mesh", collider.mesh) || scene.find_mesh(collider.mesh)) break;
      std::vector<std::string_view> names;
      for (const SceneMesh& mesh : scene.meshes) names.push_back(mesh.name);
      in.problems().add(
          in.line_of("mesh"), "there is no mesh '" + collider.mesh + "'",
          names.empty() ? "describe it under \"meshes\"" : suggestion(collider.mesh, names));
    }
  }
}

void read_surface(const ObjectReader& in, const Scene& scene, SceneCollider& collider) {
  const JsonNode* node = in.find("material");
  if (!node) return;
  if (node->kind == JsonNode::Kind::Object) {
    read_material(*node, "material of " + in.what(), collider.collider.material, in.problems());
    return;
  }
  if (!in.text("material", collider.material)) return;
  std::vector<std::string_view> names;
  for (const SceneMaterial& material : scene.materials) {
    names.push_back(material.name);
    if (material.name != collider.material) continue;
    collider.collider.material = material.material;
    return;
  }
  in.problems().add(
      node->line, "there is no material '" + collider.material + "'",
      names.empty() ? "describe it under \"materials\"" : suggestion(collider.material, names));
}

}  // namespace

void read_collider(const JsonNode& node, const std::string& what, const Scene& scene,
                   SceneCollider& collider, Problems& problems) {
  const ObjectReader in(node, what, keys::kCollider, problems);
  collider.line = node.line;
  if (!in.is_object()) return;
  read_shape(in, scene, collider);
  in.vector("position", collider.collider.pose.position);
  Eigen::Quaterniond orientation;
  if (read_orientation(in, orientation))
    collider.collider.pose.orientation = orientation.cast<Real>();
  read_surface(in, scene, collider);
  double density = 0;
  if (in.number("density", density, kNotNegative)) {
    collider.density = density;
    collider.collider.density = density;
  }
  read_layers(in, "layers", collider.collider.filter.layers);
  read_layers(in, "collides_with", collider.collider.filter.collides_with);
  in.flag("sensor", collider.collider.is_sensor);
}

void read_body(const JsonNode& node, const Scene& scene, SceneBody& body, Problems& problems) {
  if (const JsonMember* name = node.find("name")) body.name = name->value.text;
  const std::string what = "body '" + body.name + "'";
  const ObjectReader in(node, what, keys::kBody, problems);
  body.line = node.line;
  if (!in.is_object()) return;
  in.text("name", body.name);
  if (body.name.empty() || body.name.find('[') != std::string::npos) {
    problems.add(in.line_of("name"), "'" + body.name + "' cannot be the name of a body",
                 "use a text that is not empty and holds no '['");
  }

  RigidBody& out = body.body;
  in.choice("type", kMotionTypes, out.type);
  in.vector("position", out.pose.position);
  Eigen::Quaterniond orientation;
  if (read_orientation(in, orientation)) out.pose.orientation = orientation.cast<Real>();
  in.vector("linear_velocity", out.linear_velocity);
  in.vector("angular_velocity", out.angular_velocity);
  in.number("linear_damping", out.linear_damping, kNotNegative);
  in.number("angular_damping", out.angular_damping, kNotNegative);
  in.number("gravity_scale", out.gravity_scale);
  in.flag("can_sleep", out.can_sleep);
  in.flag("starts_awake", out.starts_awake);
  read_locks(in, out.locks);
  read_mass(in, body);
  if (const JsonNode* repeat = in.find("repeat")) {
    read_repeat(*repeat, what, body.repeat.emplace(), problems);
  }

  const JsonNode* colliders = in.find("colliders");
  if (!colliders) return;
  if (colliders->kind != JsonNode::Kind::Array) {
    problems.add(colliders->line, "'colliders' of " + what + " is " + name_of(colliders->kind),
                 "write a list, [ ... ]");
    return;
  }
  for (std::size_t k = 0; k < colliders->items.size(); ++k) {
    SceneCollider& collider = body.colliders.emplace_back();
    read_collider(colliders->items[k], "collider " + std::to_string(k) + " of " + what, scene,
                  collider, problems);
    if (out.type != MotionType::Static &&
        std::holds_alternative<HalfSpace>(collider.collider.shape)) {
      problems.add(collider.line,
                   what + " moves, but its collider " + std::to_string(k) +
                       " is a half-space, which has no end",
                   "write \"type\": \"static\" or use another shape");
    }
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
