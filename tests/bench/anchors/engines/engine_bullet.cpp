// Bullet in single precision with its defaults: sequential impulses, 10 iterations, one thread.
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "bench/anchors/engines/engine.h"

namespace plumb::anchors {
namespace {

btScalar num(double value) { return static_cast<btScalar>(value); }
btVector3 vec(const Vector3d& v) { return {num(v.x()), num(v.y()), num(v.z())}; }
btQuaternion quat(const Quaterniond& q) { return {num(q.x()), num(q.y()), num(q.z()), num(q.w())}; }
Vector3d vec(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

class Bullet : public Engine {
 public:
  explicit Bullet(const Scene& scene)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity(vec(scene.gravity));
    for (const Body& body : scene.ground) add(scene, body);
    for (const Body& body : scene.bodies) {
      bodies_.push_back(add(scene, body));
      if (!body.force.isZero()) pulled_.emplace_back(bodies_.back(), vec(body.force));
    }
    for (const BallJoint& joint : scene.joints) {
      btRigidBody& b = *bodies_[static_cast<std::size_t>(joint.b)];
      auto made = joint.a < 0 ? std::make_unique<btPoint2PointConstraint>(b, vec(joint.at_b))
                              : std::make_unique<btPoint2PointConstraint>(
                                    *bodies_[static_cast<std::size_t>(joint.a)], b, vec(joint.at_a),
                                    vec(joint.at_b));
      world_.addConstraint(made.get(), true);
      joints_.push_back(std::move(made));
    }
  }
  ~Bullet() override {
    for (auto& joint : joints_) world_.removeConstraint(joint.get());
    for (auto& body : owned_) world_.removeRigidBody(body.get());
  }
  void step(double dt) override {
    for (const auto& [body, force] : pulled_) body->applyCentralForce(force);
    world_.stepSimulation(num(dt), 0, num(dt));
  }
  void read(std::vector<BodyState>& out) const override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const btRigidBody& body = *bodies_[i];
      const btTransform& at = body.getCenterOfMassTransform();
      const btQuaternion q = at.getRotation();
      out[i] = {vec(at.getOrigin()), Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized(),
                vec(body.getLinearVelocity()), vec(body.getAngularVelocity())};
    }
  }

 private:
  // Margins: Bullet shrinks a box's core by its margin, so that the size is right with the default;
  // hulls are grown by theirs, so theirs is small.
  btCollisionShape* shape_of(const Scene& scene, const Shape& shape) {
    std::unique_ptr<btCollisionShape> made;
    switch (shape.kind) {
      case ShapeKind::Box:
        made = std::make_unique<btBoxShape>(vec(shape.half));
        break;
      case ShapeKind::Sphere:
        made = std::make_unique<btSphereShape>(num(shape.radius));
        break;
      case ShapeKind::Capsule:
        made = std::make_unique<btCapsuleShape>(num(shape.radius), num(2 * shape.half_length));
        break;
      case ShapeKind::Hull: {
        auto hull = std::make_unique<btConvexHullShape>();
        for (const Vector3d& p : scene.hulls[shape.hull].points) hull->addPoint(vec(p), false);
        hull->recalcLocalAabb();
        hull->setMargin(num(1e-3));
        made = std::move(hull);
        break;
      }
      case ShapeKind::Mesh: {
        for (const auto& t : scene.mesh.triangles)
          triangles_.addTriangle(vec(scene.mesh.vertices[t[0]]), vec(scene.mesh.vertices[t[1]]),
                                 vec(scene.mesh.vertices[t[2]]));
        made = std::make_unique<btBvhTriangleMeshShape>(&triangles_, true);
        break;
      }
      case ShapeKind::Plane:
        made = std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), num(0));
        break;
      case ShapeKind::None:
        made = std::make_unique<btEmptyShape>();
        break;
    }
    shapes_.push_back(std::move(made));
    return shapes_.back().get();
  }
  btRigidBody* add(const Scene& scene, const Body& body) {
    // One shape for all bodies of a hull, as users do; the other shapes are small.
    btCollisionShape* shape = nullptr;
    if (body.shape.kind == ShapeKind::Hull) {
      hulls_.resize(scene.hulls.size(), nullptr);
      btCollisionShape*& shared = hulls_[body.shape.hull];
      if (shared == nullptr) shared = shape_of(scene, body.shape);
      shape = shared;
    } else {
      shape = shape_of(scene, body.shape);
    }
    btRigidBody::btRigidBodyConstructionInfo info(num(body.mass), nullptr, shape,
                                                  vec(body.inertia));
    info.m_startWorldTransform = btTransform(quat(body.orientation), vec(body.position));
    const double among = std::sqrt(scene.friction_of_bodies());  // Bullet multiplies the two
    info.m_friction = num(body.mass > 0 || among == 0 ? among : scene.friction / among);
    info.m_restitution = num(std::sqrt(scene.restitution));  // likewise
    auto made = std::make_unique<btRigidBody>(info);
    made->setLinearVelocity(vec(body.velocity));
    made->setAngularVelocity(vec(body.spin));
    if (!scene.sleeping) made->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(made.get(), btBroadphaseProxy::DefaultFilter,
                        scene.collide ? btBroadphaseProxy::AllFilter : 0);
    owned_.push_back(std::move(made));
    return owned_.back().get();
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btTriangleMesh triangles_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<btCollisionShape*> hulls_;
  std::vector<std::unique_ptr<btRigidBody>> owned_;
  std::vector<btRigidBody*> bodies_;
  std::vector<std::pair<btRigidBody*, btVector3>> pulled_;  // [N]
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace

EngineKind bullet_kind() {
  const int version = btGetVersion();
  return {.name = "bullet",
          .settings = std::to_string(version / 100) + "." + std::to_string(version % 100) +
                      ", f32, 10 iterations",
          .make = [](const Scene& scene, const EngineOptions&) -> std::unique_ptr<Engine> {
            return std::make_unique<Bullet>(scene);
          }};
}

}  // namespace plumb::anchors
