#include <algorithm>
#include <limits>
#include <string>

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
    if (!in.number("mass", mass, kMassRange)) return;
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
  bool good = parts.number("mass", properties.mass, kMassRange);
  if (!parts.has("mass")) parts.missing("mass", "give the mass in kilograms");
  if (parts.has("center")) good = parts.vector("center", properties.center) && good;
  const JsonNode* inertia = parts.find("inertia");
  if (!inertia) {
    parts.missing("inertia", "give [xx, yy, zz] or [xx, yy, zz, xy, xz, yz] in kg m^2");
    return;
  }
  double t[6] = {0, 0, 0, 0, 0, 0};
  const bool diagonal = inertia->kind == JsonNode::Kind::Array && inertia->items.size() == 3;
  if (inertia->kind == JsonNode::Kind::Array && !diagonal && inertia->items.size() != 6) {
    in.problems().add(inertia->line,
                      "'inertia' of " + parts.what() + " has " +
                          std::to_string(inertia->items.size()) + " entries",
                      "write 3 numbers [xx, yy, zz], or 6 [xx, yy, zz, xy, xz, yz], in kg m^2");
    return;
  }
  if (!parts.numbers("inertia", t, diagonal ? 3 : 6) || !good) return;
  properties.I_Bcm_B << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
  const Status status = check(properties);
  if (!status.ok()) {
    in.problems().add(node->line, "mass of " + in.what() + ": " + status.message, "");
    return;
  }
  body.body.mass = properties;
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

void read_surface_velocity(const ObjectReader& parent, SurfaceVelocity& velocity) {
  const JsonNode* node = parent.find("surface_velocity");
  if (!node) return;
  const ObjectReader in(*node, "surface_velocity of " + parent.what(), keys::kSurfaceVelocity,
                        parent.problems());
  if (!in.is_object()) return;
  in.vector("linear", velocity.linear);
  in.vector("angular", velocity.angular);
}

}  // namespace

void read_collider(const JsonNode& node, const std::string& what, const Scene& scene,
                   SceneCollider& collider, Problems& problems) {
  const ObjectReader in(node, what, keys::kCollider, problems);
  collider.line = node.line;
  if (!in.is_object()) return;
  read_shape(in, scene, collider);
  read_pose(in, collider.collider.pose);
  read_surface(in, scene, collider);
  double density = 0;
  const JsonNode* given = in.find("density");  // 0: the collider adds no mass
  const bool none = given && given->kind == JsonNode::Kind::Number && given->number == 0;
  if (in.number("density", density, none ? kNotNegative : kMassRange)) {
    collider.density = density;
    collider.collider.density = density;
  }
  read_layers(in, "layers", collider.collider.filter.layers);
  read_layers(in, "collides_with", collider.collider.filter.collides_with);
  in.integer("group", collider.collider.filter.group, std::numeric_limits<std::int32_t>::min(),
             std::numeric_limits<std::int32_t>::max());
  in.flag("sensor", collider.collider.is_sensor);
  read_surface_velocity(in, collider.collider.surface_velocity);
  in.vector("one_way", collider.collider.one_way);
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
  if (body.name == kWorldName) {
    problems.add(in.line_of("name"), "'world' cannot be the name of a body",
                 "joints mean the world itself by it: use another name");
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
  in.flag("continuous", out.continuous);
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
    check_motion(scene, collider, "collider " + std::to_string(k) + " of " + what, out.type,
                 problems);
  }
}

}  // namespace plumb::inline PLUMB_ABI::assets::scene
