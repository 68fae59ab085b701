#include "plumb/integration/scene_recording.h"

#if defined(PLUMB_WITH_REPLAY)

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace plumb::inline PLUMB_ABI::integration {
namespace {

using assets::SceneInstance;
using assets::SceneVisual;

bool same(const SceneVisual& a, const SceneVisual& b) {
  return a.mesh == b.mesh && a.pose.position == b.pose.position &&
         a.pose.orientation.coeffs() == b.pose.orientation.coeffs();
}

bool same(const std::vector<SceneVisual>& a, const std::vector<SceneVisual>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!same(a[k], b[k])) return false;
  return true;
}

std::shared_ptr<replay::VisualMesh> joined(const SceneInstance& instance,
                                           const std::vector<SceneVisual>& visuals) {
  auto out = std::make_shared<replay::VisualMesh>();
  for (const SceneVisual& visual : visuals) {
    const assets::TriangleMesh& mesh = instance.meshes[visual.mesh].mesh;
    const auto first = static_cast<std::uint32_t>(out->vertices.size());
    const Eigen::Quaterniond R(visual.pose.orientation.cast<double>());
    const Eigen::Vector3d p = visual.pose.position.cast<double>();
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      out->vertices.emplace_back((R * vertex + p).cast<float>());
    }
    for (const assets::Triangle& triangle : mesh.triangles) {
      out->triangles.emplace_back(first + triangle[0], first + triangle[1], first + triangle[2]);
    }
  }
  return out;
}

}  // namespace

void show_meshes(replay::Recorder& recorder, const SceneInstance& instance) {
  // Copies made by a repeat look alike; they share one mesh. They stand one after the other.
  const std::vector<SceneVisual>* last_visuals = nullptr;
  std::shared_ptr<replay::VisualMesh> last_mesh;
  for (const assets::SceneInstanceBody& body : instance.bodies) {
    if (body.visuals.empty() || body.visuals.size() != body.colliders.size()) continue;
    if (!last_visuals || !same(*last_visuals, body.visuals)) {
      last_mesh = joined(instance, body.visuals);
      last_visuals = &body.visuals;
    }
    recorder.show_as(body.id, last_mesh);
  }
}

void show_labels(replay::Recorder& recorder, const assets::Scene& scene,
                 const SceneInstance& instance, const PhysicsWorld& world) {
  const auto is_special = [&](const assets::SceneInstanceBody& body) {
    return std::any_of(body.colliders.begin(), body.colliders.end(), [&](ColliderId id) {
      const Collider collider = world.collider(id);
      return collider.is_sensor || std::holds_alternative<SurfaceMesh>(collider.shape) ||
             std::holds_alternative<Heightfield>(collider.shape);
    });
  };
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const assets::SceneBody& source = scene.bodies[k];
    if (source.repeat || source.name == "body " + std::to_string(k)) continue;
    const auto found = instance.index_of.find(source.name);
    if (found == instance.index_of.end()) continue;
    const assets::SceneInstanceBody& body = instance.bodies[found->second];
    const bool is_seen = source.body.type != MotionType::Static || is_special(body);
    if (is_seen && world.joints_of(body.id).empty()) recorder.label(body.id, source.name);
  }
  std::set<std::string, std::less<>> coupled;
  for (const assets::SceneJoint& joint : scene.joints) coupled.insert({joint.first, joint.second});
  for (std::size_t k = 0; k < instance.joints.size(); ++k) {
    const assets::SceneInstanceJoint& joint = instance.joints[k];
    if (joint.name != "joint " + std::to_string(k) && !coupled.contains(joint.name))
      recorder.label(joint.id, joint.name);
  }
}

}  // namespace plumb::inline PLUMB_ABI::integration

#endif
