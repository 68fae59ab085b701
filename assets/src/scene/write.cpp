#include <charconv>
#include <nlohmann/json.hpp>

#include "plumb/assets/scene.h"
#include "scene/keys.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

// Keys in the order in which they are written.
using Json = nlohmann::ordered_json;

constexpr int kIndent = 2;
constexpr std::uint32_t kAllLayers = 0xffffffffu;

[[maybe_unused]] double tidy(double value) { return value; }
// The shortest decimal that is this float, so that 0.1f is written 0.1 and not 0.10000000149.
[[maybe_unused]] double tidy(float value) {
  char digits[32];
  const char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  double wide = 0;
  std::from_chars(digits, end, wide);
  return wide;
}

template <class T>
Json list(const Eigen::Matrix<T, 3, 1>& v) {
  return Json::array({tidy(v.x()), tidy(v.y()), tidy(v.z())});
}

template <class T, int Options>
Json orientation(const Eigen::Quaternion<T, Options>& q) {
  return {{"quaternion", Json::array({tidy(q.x()), tidy(q.y()), tidy(q.z()), tidy(q.w())})}};
}

template <class Enum>
std::string word(scene::Keys words, Enum value) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

Json layers(std::uint32_t bits) {
  Json out = Json::array();
  for (int k = 0; k < 32; ++k)
    if (bits >> k & 1u) out.push_back(k);
  return out;
}

Json json_of(const Material& material) {
  return {{"friction", tidy(material.friction)},
          {"restitution", tidy(material.restitution)},
          {"friction_rule", word(scene::kCombineRules, material.friction_rule)},
          {"restitution_rule", word(scene::kCombineRules, material.restitution_rule)}};
}

Json json_of(const WorldSettings& settings) {
  return {{"gravity", list(settings.gravity)},
          {"substeps", settings.substeps},
          {"contact_frequency", tidy(settings.contact_frequency)},
          {"contact_damping_ratio", tidy(settings.contact_damping_ratio)},
          {"rotation", word(scene::kRotationMethods, settings.rotation)},
          {"warm_starting", settings.warm_starting},
          {"sleeping", settings.sleeping},
          {"time_to_sleep", tidy(settings.time_to_sleep)}};
}

Json json_of(const SceneMesh& mesh) {
  Json out;
  out["file"] = mesh.file;
  if (mesh.metres_per_unit) out["metres_per_unit"] = *mesh.metres_per_unit;
  if (mesh.up) out["up"] = word(scene::kAxes, *mesh.up);
  out["collision"] = word(scene::kCollisions, mesh.collision);
  out["max_hull_vertices"] = mesh.max_hull_vertices;
  out["density"] = mesh.mass.density;
  Json mass = {{"method", word(scene::kMassMethods, mesh.mass.method)}};
  if (mesh.mass.method == MassMethod::Shell) mass["thickness"] = mesh.mass.shell_thickness;
  if (mesh.mass.method == MassMethod::Voxel) mass["resolution"] = mesh.mass.voxel_resolution;
  out["mass_of"] = std::move(mass);
  return out;
}

void write_rounding(Real rounding, Json& out) {
  if (rounding > Real(0)) out["rounding"] = tidy(rounding);
}

void write_shape(const Shape& shape, Json& out) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    out["shape"] = "sphere";
    out["radius"] = tidy(sphere->radius);
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    out["shape"] = "box";
    out["half_extents"] = list(box->half_extents);
    write_rounding(box->rounding, out);
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    out["shape"] = "capsule";
    out["half_length"] = tidy(capsule->half_length);
    out["radius"] = tidy(capsule->radius);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    out["shape"] = "cylinder";
    out["half_length"] = tidy(cylinder->half_length);
    out["radius"] = tidy(cylinder->radius);
    write_rounding(cylinder->rounding, out);
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    out["shape"] = "cone";
    out["half_length"] = tidy(cone->half_length);
    out["radius"] = tidy(cone->radius);
    write_rounding(cone->rounding, out);
  } else if (const auto* half_space = std::get_if<HalfSpace>(&shape)) {
    out["shape"] = "half_space";
    out["normal"] = list(half_space->normal);
    out["offset"] = tidy(half_space->offset);
  }
}

Json json_of(const SceneCollider& scene_collider) {
  const Collider& collider = scene_collider.collider;
  Json out;
  if (scene_collider.mesh.empty()) {
    write_shape(collider.shape, out);
  } else {
    out["shape"] = "mesh";
    out["mesh"] = scene_collider.mesh;
    if (const auto* hull = std::get_if<ConvexHull>(&collider.shape))
      write_rounding(hull->rounding, out);
  }
  if (collider.pose.position != Vec3::Zero()) out["position"] = list(collider.pose.position);
  if (collider.pose.orientation.coeffs() != Quat::Identity().coeffs()) {
    out["orientation"] = orientation(collider.pose.orientation);
  }
  if (scene_collider.material.empty()) {
    out["material"] = json_of(collider.material);
  } else {
    out["material"] = scene_collider.material;
  }
  if (scene_collider.density) out["density"] = *scene_collider.density;
  if (collider.filter.layers != Filter{}.layers) out["layers"] = layers(collider.filter.layers);
  if (collider.filter.collides_with != kAllLayers) {
    out["collides_with"] = layers(collider.filter.collides_with);
  }
  if (collider.is_sensor) out["sensor"] = true;
  return out;
}

Json json_of(const MotionLocks& locks) {
  const bool flags[] = {locks.linear_x,  locks.linear_y,  locks.linear_z,
                        locks.angular_x, locks.angular_y, locks.angular_z};
  Json out = Json::array();
  for (std::size_t k = 0; k < std::size(flags); ++k)
    if (flags[k]) out.push_back(std::string(scene::kLocks[k]));
  return out;
}

Json json_of(const SceneRepeat& repeat) {
  return {{"count", repeat.count},
          {"spacing", list(repeat.spacing)},
          {"jitter", list(repeat.jitter)},
          {"random_orientation", repeat.random_orientation},
          {"seed", repeat.seed}};
}

Json json_of(const SceneBody& scene_body) {
  const RigidBody& body = scene_body.body;
  Json out;
  out["name"] = scene_body.name;
  out["type"] = word(scene::kMotionTypes, body.type);
  out["position"] = list(body.pose.position);
  out["orientation"] = orientation(body.pose.orientation);
  out["linear_velocity"] = list(body.linear_velocity);
  out["angular_velocity"] = list(body.angular_velocity);
  out["linear_damping"] = tidy(body.linear_damping);
  out["angular_damping"] = tidy(body.angular_damping);
  out["gravity_scale"] = tidy(body.gravity_scale);
  out["locks"] = json_of(body.locks);
  out["can_sleep"] = body.can_sleep;
  out["starts_awake"] = body.starts_awake;
  if (scene_body.mass_scaled_to) {
    out["mass"] = *scene_body.mass_scaled_to;
  } else if (body.mass) {
    const Eigen::Matrix3d& t = body.mass->I_Bcm_B;
    out["mass"] = {
        {"mass", body.mass->mass},
        {"center", list(body.mass->center)},
        {"inertia", Json::array({t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(0, 2), t(1, 2)})}};
  }
  Json colliders = Json::array();
  for (const SceneCollider& collider : scene_body.colliders) colliders.push_back(json_of(collider));
  out["colliders"] = std::move(colliders);
  if (scene_body.repeat) out["repeat"] = json_of(*scene_body.repeat);
  return out;
}

}  // namespace

std::string scene_to_json(const Scene& scene) {
  Json out;
  out["plumb_scene"] = kSceneVersion;
  out["name"] = scene.name;
  out["description"] = scene.description;
  out["step"] = {{"dt", scene.step.dt}, {"duration", scene.step.duration}};
  out["settings"] = json_of(scene.settings);
  out["materials"] = Json::object();
  for (const SceneMaterial& material : scene.materials) {
    out["materials"][material.name] = json_of(material.material);
  }
  out["meshes"] = Json::object();
  for (const SceneMesh& mesh : scene.meshes) out["meshes"][mesh.name] = json_of(mesh);
  out["bodies"] = Json::array();
  for (const SceneBody& body : scene.bodies) out["bodies"].push_back(json_of(body));
  return out.dump(kIndent) + "\n";
}

}  // namespace plumb::inline PLUMB_ABI::assets
