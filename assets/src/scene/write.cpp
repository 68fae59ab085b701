#include <cmath>

#include "plumb/assets/scene.h"
#include "scene/effects.h"
#include "scene/json_words.h"
#include "scene/keys.h"
#include "scene/write_joint.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using scene::Json;
using scene::json_of_joint;
using scene::list;
using scene::orientation;
using scene::tidy;
using scene::word;

constexpr int kIndent = 2;
constexpr std::uint32_t kAllLayers = 0xffffffffu;

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
          {"restitution_rule", word(scene::kCombineRules, material.restitution_rule)},
          {"rolling_friction", tidy(material.rolling_friction)},
          {"torsional_friction", tidy(material.torsional_friction)},
          {"kind", material.kind},
          {"grain", list(material.grain)},
          {"grain_friction", tidy(material.grain_friction)},
          {"adhesion", tidy(material.adhesion)}};
}

Json json_of(const SceneMaterialPair& pair) {
  Json out;
  out["kinds"] = Json::array({pair.kind_a, pair.kind_b});
  const auto write = [&out](const char* key, const std::optional<Real>& value) {
    if (value) out[key] = tidy(*value);
  };
  write("friction", pair.values.friction);
  write("restitution", pair.values.restitution);
  write("rolling_friction", pair.values.rolling_friction);
  write("torsional_friction", pair.values.torsional_friction);
  return out;
}

Json json_of(const SceneExclusion& pair) {
  Json out;
  out["body_a"] = pair.a.body;
  out["body_b"] = pair.b.body;
  if (pair.a.collider) out["collider_a"] = *pair.a.collider;
  if (pair.b.collider) out["collider_b"] = *pair.b.collider;
  return out;
}

Json json_of(const PlanChoices& forced) {
  Json out = Json::object();
  for (const std::string_view key : scene::keys::kForced) {
    const Choice choice = forced.of(*plan_item_of(key));
    if (choice != Choice::Automatic) out[std::string(key)] = word(scene::kForcedChoices, choice);
  }
  return out;
}

Json json_of(const WorldSettings& settings) {
  Json out{{"gravity", list(settings.gravity)},
           {"substeps", settings.substeps},
           {"step_tolerance", tidy(settings.step_tolerance)},
           {"contact_frequency", tidy(settings.contact_frequency)},
           {"contact_damping_ratio", tidy(settings.contact_damping_ratio)},
           {"rotation", word(scene::kRotationMethods, settings.rotation)},
           {"contact_solver", word(scene::kContactSolvers, settings.contact_solver)},
           {"joint_order", settings.joint_order},
           {"warm_starting", settings.warm_starting},
           {"sleeping", settings.sleeping},
           {"time_to_sleep", tidy(settings.time_to_sleep)}};
  if (settings.forced != PlanChoices{}) out["forced"] = json_of(settings.forced);
  return out;
}

Json json_of(const SceneMesh& mesh) {
  Json out;
  out["file"] = mesh.file;
  if (mesh.metres_per_unit) out["metres_per_unit"] = *mesh.metres_per_unit;
  if (mesh.up) out["up"] = word(scene::kAxes, *mesh.up);
  if (mesh.repair) {
    out["repair"] = {{"weld_tolerance", mesh.repair->weld_tolerance},
                     {"orient", mesh.repair->orient}};
  }
  out["collision"] = word(scene::kCollisions, mesh.collision);
  if (mesh.collision == SceneMesh::Collision::Surface) return out;
  if (mesh.collision == SceneMesh::Collision::Hull) {
    out["max_hull_vertices"] = mesh.max_hull_vertices;
  } else {
    Json parts = {{"max_parts", mesh.parts.max_parts},
                  {"max_vertices", mesh.parts.max_part_vertices}};
    if (mesh.parts.max_distance > 0) parts["max_distance"] = mesh.parts.max_distance;
    out["parts"] = std::move(parts);
  }
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

void write_pose(const LocalPose& pose, Json& out) {
  if (pose.position != Vec3::Zero()) out["position"] = list(pose.position);
  if (pose.orientation.coeffs() != Quat::Identity().coeffs())
    out["orientation"] = orientation(pose.orientation);
}

void write_mesh_shape(const std::string& mesh, const Shape& shape, Json& out) {
  out["shape"] = "mesh";
  out["mesh"] = mesh;
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) write_rounding(hull->rounding, out);
  const auto* surface = std::get_if<SurfaceMesh>(&shape);
  if (surface && surface->scale != Vec3::Ones()) out["scale"] = list(surface->scale);
}

Json json_of(const SceneChild& child) {
  Json out;
  if (child.mesh.empty()) {
    write_shape(child.child.shape, out);
  } else {
    write_mesh_shape(child.mesh, child.child.shape, out);
  }
  write_pose(child.child.pose, out);
  return out;
}

Json json_of(const SceneHeightfield& field) {
  Json out;
  out["spacing"] = field.spacing;
  out["height_scale"] = field.height_scale;
  if (!field.file.empty()) {
    out["file"] = field.file;
    return out;
  }
  Json rows = Json::array();
  for (std::size_t k = 0; k < field.heights.size(); ++k) {
    if (k % field.samples_x == 0) rows.push_back(Json::array());
    const double height = field.heights[k];
    rows.back().push_back(std::isnan(height) ? Json(nullptr) : Json(height));
  }
  out["heights"] = std::move(rows);
  return out;
}

Json json_of(const SceneCollider& scene_collider) {
  const Collider& collider = scene_collider.collider;
  Json out;
  if (!scene_collider.mesh.empty()) {
    write_mesh_shape(scene_collider.mesh, collider.shape, out);
  } else if (!scene_collider.heightfield.empty()) {
    out["shape"] = "heightfield";
    out["heightfield"] = scene_collider.heightfield;
  } else if (!scene_collider.children.empty()) {
    out["shape"] = "compound";
    Json children = Json::array();
    for (const SceneChild& child : scene_collider.children) children.push_back(json_of(child));
    out["children"] = std::move(children);
  } else {
    write_shape(collider.shape, out);
  }
  write_pose(collider.pose, out);
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
  if (collider.filter.group != 0) out["group"] = collider.filter.group;
  if (collider.is_sensor) out["sensor"] = true;
  const SurfaceVelocity& running = collider.surface_velocity;
  if (running != SurfaceVelocity{})
    out["surface_velocity"] = {{"linear", list(running.linear)},
                               {"angular", list(running.angular)}};
  if (collider.one_way != Vec3::Zero()) out["one_way"] = list(collider.one_way);
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
  out["continuous"] = body.continuous;
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
  out["material_pairs"] = Json::array();
  for (const SceneMaterialPair& pair : scene.material_pairs)
    out["material_pairs"].push_back(json_of(pair));
  out["meshes"] = Json::object();
  for (const SceneMesh& mesh : scene.meshes) out["meshes"][mesh.name] = json_of(mesh);
  out["heightfields"] = Json::object();
  for (const SceneHeightfield& field : scene.heightfields)
    out["heightfields"][field.name] = json_of(field);
  out["bodies"] = Json::array();
  for (const SceneBody& body : scene.bodies) out["bodies"].push_back(json_of(body));
  out["joints"] = Json::array();
  for (const SceneJoint& joint : scene.joints) out["joints"].push_back(json_of_joint(joint));
  out["excluded_pairs"] = Json::array();
  for (const SceneExclusion& pair : scene.excluded_pairs)
    out["excluded_pairs"].push_back(json_of(pair));
  out["effects"] = Json::array();
  for (const SceneEffect& effect : scene.effects)
    out["effects"].push_back(scene::json_of_effect(effect));
  return out.dump(kIndent) + "\n";
}

}  // namespace plumb::inline PLUMB_ABI::assets
