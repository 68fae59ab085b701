#include <algorithm>
#include <string>
#include <utility>

#include "plumb/assets/certificate.h"
#include "plumb/assets/scene.h"
#include "scene/effects.h"
#include "scene/joint_notes.h"
#include "scene/place_joint.h"
#include "scene/prepared_mesh.h"
#include "scene/repeat.h"
#include "scene/shape_maker.h"

namespace plumb::inline PLUMB_ABI::assets {
namespace {

using scene::MeshStore;
using scene::ShapeMaker;

std::string place_of(const Scene& scene, int line) {
  return line > 0 ? scene.source + ":" + std::to_string(line) : scene.source;
}

// Puts the world back to what it was unless the build came to its end.
class Undo {
 public:
  explicit Undo(PhysicsWorld& world) : world_(world), settings_(world.settings()) {}
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;
  ~Undo() {
    if (done_) return;
    for (auto effect = effects_.rbegin(); effect != effects_.rend(); ++effect)
      (void)world_.destroy_effect(*effect);
    for (auto body = bodies_.rbegin(); body != bodies_.rend(); ++body)
      (void)world_.destroy_body(*body);
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair)
      (void)world_.set_material_pair(pair->kind_a, pair->kind_b, pair->values);
    (void)world_.set_settings(settings_);
  }
  void created(BodyId body) { bodies_.push_back(body); }
  void created(EffectId effect) { effects_.push_back(effect); }
  void changes_pair(std::uint32_t kind_a, std::uint32_t kind_b) {
    pairs_.push_back({kind_a, kind_b, world_.material_pair(kind_a, kind_b)});
  }
  void keep() { done_ = true; }

 private:
  PhysicsWorld& world_;
  WorldSettings settings_;
  std::vector<BodyId> bodies_;
  std::vector<EffectId> effects_;
  struct Entry {
    std::uint32_t kind_a, kind_b;
    std::optional<MaterialPair> values;
  };
  std::vector<Entry> pairs_;  // of the table of materials, as it was
  bool done_ = false;
};

// Mass of the body's colliders together. Bodies of plain shapes alone leave it to the world, which
// counts the same way; a mesh has a mass of its own that its hull does not know.
Result<std::optional<MassProperties>> mass_of_body(const Scene& scene, const SceneBody& body,
                                                   const std::vector<Collider>& colliders,
                                                   MeshStore& meshes) {
  if (body.body.type != MotionType::Dynamic) return std::optional<MassProperties>{};
  bool needed = body.mass_scaled_to.has_value();
  for (const SceneCollider& collider : body.colliders) needed = needed || !collider.mesh.empty();
  if (!needed || body.body.mass) return body.body.mass;

  std::optional<MassProperties> sum;
  for (std::size_t k = 0; k < colliders.size(); ++k) {
    const SceneCollider& part = body.colliders[k];
    const Collider& collider = colliders[k];
    if (collider.is_sensor || part.density == 0.0) continue;
    MassProperties own;
    if (part.mesh.empty()) {
      const ShapeMass shape = mass_of(collider.shape, part.density.value_or(collider.density));
      if (!shape.status.ok())
        return Error{place_of(scene, part.line) + ": " + shape.status.message};
      own = shape.properties;
    } else {
      const Result<MassProperties> mesh_mass = meshes.mass_of(part.mesh, part.density);
      if (!mesh_mass.ok()) return Error{mesh_mass.error()};
      own = mesh_mass.value();
    }
    own = own.placed(collider.pose.position.cast<double>(),
                     Eigen::Quaterniond(collider.pose.orientation.cast<double>()));
    sum = sum ? sum->plus(own) : own;
  }
  if (!sum) {
    return Error{
        place_of(scene, body.line) + ": body '" + body.name +
        "' moves, but its colliders have no mass; give one of them a density or the body a mass"};
  }
  if (body.mass_scaled_to) sum = sum->scaled_to_mass(*body.mass_scaled_to);
  return sum;
}

// The body of the file as the world wants it, without its place in a repeat.
struct Template {
  RigidBody body;
  std::vector<Collider> colliders;
  std::vector<SceneVisual> visuals;
};

Result<Template> make_template(const Scene& scene, const SceneBody& body, MeshStore& meshes,
                               ShapeMaker& shapes) {
  Template out;
  out.body = body.body;
  for (const SceneCollider& part : body.colliders) {
    Collider collider = part.collider;
    if (part.density) collider.density = *part.density;
    Result<Shape> shape = shapes.make(part);
    if (!shape.ok()) return Error{shape.error()};
    collider.shape = std::move(shape).value();
    // A surface is drawn as what it collides as.
    if (!part.mesh.empty() && !std::holds_alternative<SurfaceMesh>(collider.shape))
      out.visuals.push_back({meshes.index_of(part.mesh).value(), collider.pose});
    out.colliders.push_back(std::move(collider));
  }
  Result<std::optional<MassProperties>> mass = mass_of_body(scene, body, out.colliders, meshes);
  if (!mass.ok()) return Error{mass.error()};
  out.body.mass = mass.value();
  return out;
}

// What there is to say about the mass of a body whose colliders bring none; empty if nothing.
std::string note_on_mass(const SceneBody& source, const Template& model) {
  if (source.body.type != MotionType::Dynamic || model.body.mass || model.colliders.empty())
    return {};
  for (const Collider& collider : model.colliders)
    if (!collider.is_sensor && collider.density > Real(0)) return {};
  return "body '" + source.name +
         "' has no collider with a mass, so that it is a point of 1 kg that does not turn; give "
         "one of them a density, or the body a mass";
}

// Files that no body needs are not read, so that nobody has looked whether they are sound.
void note_unused_files(const Scene& scene, const MeshStore& meshes, const ShapeMaker& shapes,
                       std::vector<std::string>& notes) {
  const auto note = [&](const std::string& what) {
    notes.push_back(what + " is used by no body; its file was not read");
  };
  for (const SceneMesh& mesh : scene.meshes)
    if (!meshes.has(mesh.name)) note("mesh '" + mesh.name + "'");
  for (const SceneHeightfield& field : scene.heightfields)
    if (!field.file.empty() && !shapes.has_heightfield(field.name))
      note("heightfield '" + field.name + "'");
}

std::string world_error(const Scene& scene, int line, const std::string& name,
                        const Status& status) {
  return place_of(scene, line) + ": body '" + name + "': " + status.message;
}

// Empty text: it went well.
std::string add_body(const Scene& scene, const SceneBody& source, const Template& model,
                     const std::string& name, const scene::RepeatPlace& place, PhysicsWorld& world,
                     SceneInstance& instance, Undo& undo) {
  RigidBody body = model.body;
  if (source.repeat) {
    body.pose.position = (body.pose.position.cast<double>() + place.offset).cast<PosReal>();
    body.pose.orientation =
        (place.turn * Eigen::Quaterniond(body.pose.orientation.cast<double>())).cast<Real>();
  }
  body.user_data = instance.bodies.size();
  const Created<BodyId> created = world.create_body(body);
  if (!created.ok()) return world_error(scene, source.line, name, created.status);
  undo.created(created.id);

  SceneInstanceBody& entry = instance.bodies.emplace_back();
  entry.name = name;
  entry.id = created.id;
  entry.visuals = model.visuals;
  for (std::size_t k = 0; k < model.colliders.size(); ++k) {
    const Created<ColliderId> collider = world.create_collider(created.id, model.colliders[k]);
    if (!collider.ok()) {
      return world_error(scene, source.colliders[k].line, name, collider.status);
    }
    entry.colliders.push_back(collider.id);
  }
  instance.index_of.emplace(name, instance.bodies.size() - 1);
  return {};
}

// Empty text: it went well.
std::string exclude_pair(const SceneExclusion& pair, const SceneInstance& instance,
                         PhysicsWorld& world) {
  const SceneInstanceBody* bodies[2] = {};
  for (const bool is_b : {false, true}) {
    const SceneExclusion::Side& side = is_b ? pair.b : pair.a;
    const auto found = instance.index_of.find(side.body);
    if (found == instance.index_of.end())
      return "excluded pair: there is no body '" + side.body + "'";
    bodies[is_b] = &instance.bodies[found->second];
    if (side.collider && *side.collider >= bodies[is_b]->colliders.size())
      return "excluded pair: body '" + side.body + "' has no collider " +
             std::to_string(*side.collider);
  }
  if (pair.a.collider.has_value() != pair.b.collider.has_value())
    return "excluded pair: a collider is named on one side only";
  const Status status = pair.a.collider ? world.exclude_pair(bodies[0]->colliders[*pair.a.collider],
                                                             bodies[1]->colliders[*pair.b.collider])
                                        : world.exclude_pair(bodies[0]->id, bodies[1]->id);
  return status.ok() ? std::string() : std::string("excluded pair: ") + status.message;
}

}  // namespace

BodyId SceneInstance::find(std::string_view name) const {
  const auto found = index_of.find(name);
  return found == index_of.end() ? BodyId{} : bodies[found->second].id;
}

JointId SceneInstance::find_joint(std::string_view name) const {
  const auto found =
      std::find_if(joints.begin(), joints.end(),
                   [&](const SceneInstanceJoint& joint) { return joint.name == name; });
  return found == joints.end() ? JointId{} : found->id;
}

EffectId SceneInstance::find_effect(std::string_view name) const {
  const auto found =
      std::find_if(effects.begin(), effects.end(),
                   [&](const SceneInstanceEffect& effect) { return effect.name == name; });
  return found == effects.end() ? EffectId{} : found->id;
}

Result<SceneInstance> instantiate(const Scene& scene, PhysicsWorld& world,
                                  const InstantiateOptions& options) {
  Undo undo(world);
  if (const Status status = world.set_settings(scene.settings); !status.ok()) {
    return Error{scene.source + ": settings: " + status.message};
  }
  for (const SceneMaterialPair& pair : scene.material_pairs) {
    undo.changes_pair(pair.kind_a, pair.kind_b);
    const Status status = world.set_material_pair(pair.kind_a, pair.kind_b, pair.values);
    if (!status.ok())
      return Error{place_of(scene, pair.line) + ": material pair: " + status.message};
  }
  SceneInstance instance;
  MeshStore meshes(scene, options);
  ShapeMaker shapes(scene, meshes);
  for (const SceneBody& body : scene.bodies) {
    const Result<Template> model = make_template(scene, body, meshes, shapes);
    if (!model.ok()) return Error{model.error()};
    if (std::string note = note_on_mass(body, model.value()); !note.empty())
      instance.notes.push_back(std::move(note));
    const std::vector<scene::RepeatPlace> places =
        body.repeat ? scene::places_of(*body.repeat) : std::vector<scene::RepeatPlace>(1);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::string name = body.repeat ? body.name + "[" + std::to_string(k) + "]" : body.name;
      std::string error =
          add_body(scene, body, model.value(), name, places[k], world, instance, undo);
      if (!error.empty()) return Error{std::move(error)};
    }
  }
  for (const SceneJoint& joint : scene.joints) {
    const Result<Joint> placed = scene::place_joint(joint, world, instance);
    if (!placed.ok()) return Error{place_of(scene, joint.line) + ": " + placed.error()};
    const Created<JointId> created = world.create_joint(placed.value());
    if (!created.ok()) {
      return Error{place_of(scene, joint.line) + ": joint '" + joint.name +
                   "': " + created.status.message};
    }
    instance.joints.push_back({joint.name, created.id});
    scene::note_slips_of(joint.name, created.id, world, instance.notes);
  }
  for (const SceneExclusion& pair : scene.excluded_pairs) {
    const std::string error = exclude_pair(pair, instance, world);
    if (!error.empty()) return Error{place_of(scene, pair.line) + ": " + error};
  }
  for (const SceneEffect& effect : scene.effects) {
    const Created<EffectId> created =
        world.create_effect(scene::place_effect(effect, world, instance));
    if (!created.ok())
      return Error{place_of(scene, effect.line) + ": effect '" + effect.name +
                   "': " + created.status.message};
    undo.created(created.id);
    instance.effects.push_back({effect.name, created.id});
  }
  note_unused_files(scene, meshes, shapes, instance.notes);
  meshes.move_into(instance);
  undo.keep();
  return instance;
}

}  // namespace plumb::inline PLUMB_ABI::assets
