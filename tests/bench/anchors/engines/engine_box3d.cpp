// Box3D with its defaults: 4 substeps, soft contacts; compiled for this processor.
#include <box3d/box3d.h>

#include "bench/anchors/engines/engine.h"

namespace plumb::anchors {
namespace {

constexpr int kSubsteps = 4;

b3Vec3 vec(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
Vector3d vec(const b3Vec3& v) { return {v.x, v.y, v.z}; }

class Box3D : public Engine {
 public:
  Box3D(const Scene& scene, int threads) {
    b3WorldDef world = b3DefaultWorldDef();
    world.gravity = vec(scene.gravity);
    world.enableSleep = scene.sleeping;
    world.workerCount = static_cast<std::uint32_t>(threads);
    world_ = b3CreateWorld(&world);
    for (const Hull& hull : scene.hulls) {
      std::vector<b3Vec3> points;
      for (const Vector3d& p : hull.points) points.push_back(vec(p));
      const int count = static_cast<int>(points.size());
      hulls_.push_back(b3CreateHull(points.data(), count, count));
    }
    if (!scene.mesh.triangles.empty()) make_mesh(scene.mesh);
    for (const Body& body : scene.ground) add(scene, body, b3_staticBody);
    for (const Body& body : scene.bodies) {
      bodies_.push_back(add(scene, body, b3_dynamicBody));
      if (!body.force.isZero()) pulled_.emplace_back(bodies_.back(), vec(body.force));
    }
    b3BodyDef nowhere = b3DefaultBodyDef();
    const b3BodyId anchor = b3CreateBody(world_, &nowhere);
    for (const BallJoint& joint : scene.joints) {
      b3SphericalJointDef def = b3DefaultSphericalJointDef();
      def.base.bodyIdA = joint.a < 0 ? anchor : bodies_[static_cast<std::size_t>(joint.a)];
      def.base.bodyIdB = bodies_[static_cast<std::size_t>(joint.b)];
      def.base.localFrameA.p = vec(joint.at_a);
      def.base.localFrameB.p = vec(joint.at_b);
      b3CreateSphericalJoint(world_, &def);
    }
  }
  ~Box3D() override {
    b3DestroyWorld(world_);
    for (b3HullData* hull : hulls_) b3DestroyHull(hull);
    if (mesh_ != nullptr) b3DestroyMesh(mesh_);
  }
  void step(double dt) override {
    for (const auto& [body, force] : pulled_) b3Body_ApplyForceToCenter(body, force, true);
    b3World_Step(world_, static_cast<float>(dt), kSubsteps);
  }
  void read(std::vector<BodyState>& out) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const b3Quat q = b3Body_GetRotation(bodies_[i]);
      out[i] = {
          vec(b3Body_GetPosition(bodies_[i])), Quaterniond(q.s, q.v.x, q.v.y, q.v.z).normalized(),
          vec(b3Body_GetLinearVelocity(bodies_[i])), vec(b3Body_GetAngularVelocity(bodies_[i]))};
    }
  }

 private:
  void make_mesh(const Mesh& mesh) {
    std::vector<b3Vec3> vertices;
    std::vector<std::int32_t> corners;
    for (const Vector3d& p : mesh.vertices) vertices.push_back(vec(p));
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t c : t) corners.push_back(static_cast<std::int32_t>(c));
    b3MeshDef def{};
    def.vertices = vertices.data();
    def.indices = corners.data();
    def.vertexCount = static_cast<int>(vertices.size());
    def.triangleCount = static_cast<int>(mesh.triangles.size());
    def.identifyEdges = true;
    mesh_ = b3CreateMesh(&def, nullptr, 0);
  }
  b3BodyId add(const Scene& scene, const Body& body, b3BodyType type) {
    b3BodyDef def = b3DefaultBodyDef();
    def.type = type;
    def.position = vec(body.position);
    const Quaterniond& q = body.orientation;
    def.rotation = {vec(Vector3d(q.vec())), static_cast<float>(q.w())};
    def.linearVelocity = vec(body.velocity);
    def.angularVelocity = vec(body.spin);
    const b3BodyId made = b3CreateBody(world_, &def);
    b3ShapeDef shape = b3DefaultShapeDef();
    shape.density = static_cast<float>(body.density);
    const double among = scene.friction_of_bodies();  // Box3D takes the geometric mean
    const bool ground = type == b3_staticBody && among > 0;
    shape.baseMaterial.friction =
        static_cast<float>(ground ? scene.friction * scene.friction / among : among);
    shape.baseMaterial.restitution = static_cast<float>(scene.restitution);
    if (!scene.collide) shape.filter.maskBits = 0;
    const auto radius = static_cast<float>(body.shape.radius);
    switch (body.shape.kind) {
      case ShapeKind::Box: {
        const b3Vec3 h = vec(body.shape.half);
        const b3BoxHull box = b3MakeBoxHull(h.x, h.y, h.z);
        b3CreateHullShape(made, &shape, &box.base);
        break;
      }
      case ShapeKind::Plane: {  // it has none
        const b3Vec3 h = vec(body.shape.half);
        const b3BoxHull box = b3MakeOffsetBoxHull(h.x, h.y, h.z, {0, -h.y, 0});
        b3CreateHullShape(made, &shape, &box.base);
        break;
      }
      case ShapeKind::Sphere: {
        const b3Sphere sphere{{0, 0, 0}, radius};
        b3CreateSphereShape(made, &shape, &sphere);
        break;
      }
      case ShapeKind::Capsule: {
        const auto l = static_cast<float>(body.shape.half_length);
        const b3Capsule capsule{{0, -l, 0}, {0, l, 0}, radius};
        b3CreateCapsuleShape(made, &shape, &capsule);
        break;
      }
      case ShapeKind::Hull:
        b3CreateHullShape(made, &shape, hulls_[body.shape.hull]);
        break;
      case ShapeKind::Mesh:
        b3CreateMeshShape(made, &shape, mesh_, {1, 1, 1});
        break;
      case ShapeKind::None: {
        b3MassData mass{};
        mass.mass = static_cast<float>(body.mass);
        const b3Vec3 i = vec(body.inertia);
        mass.inertia = {{i.x, 0, 0}, {0, i.y, 0}, {0, 0, i.z}};
        b3Body_SetMassData(made, mass);
        break;
      }
    }
    return made;
  }

  b3WorldId world_{};
  std::vector<b3HullData*> hulls_;
  b3MeshData* mesh_ = nullptr;
  std::vector<b3BodyId> bodies_;
  std::vector<std::pair<b3BodyId, b3Vec3>> pulled_;  // [N]
};

}  // namespace

EngineKind box3d_kind() {
  const b3Version version = b3GetVersion();
  return {.name = "box3d",
          .settings = std::to_string(version.major) + "." + std::to_string(version.minor) +
                      ", f32, 4 substeps",
          .most_threads = 64,
          .make = [](const Scene& scene, const EngineOptions& o) -> std::unique_ptr<Engine> {
            return std::make_unique<Box3D>(scene, o.threads);
          }};
}

}  // namespace plumb::anchors
