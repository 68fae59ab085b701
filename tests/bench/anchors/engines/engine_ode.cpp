// ODE in double precision: QuickStep with 20 iterations, hard contacts, one thread. It has no hull
// that collides with hulls.
#include <ode/ode.h>

#include <cmath>
#include <mutex>

#include "bench/anchors/engines/engine.h"

namespace plumb::anchors {
namespace {

constexpr int kMostPoints = 4;  // of a contact between two shapes

class Ode : public Engine {
 public:
  explicit Ode(const Scene& scene)
      : friction_(scene.friction),
        friction_among_(scene.friction_of_bodies()),
        bounce_(scene.restitution) {
    static std::once_flag once;
    std::call_once(once, [] { dInitODE2(0); });
    dRandSetSeed(0);  // QuickStep shuffles its rows: the same in every run
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
    dWorldSetAutoDisableFlag(world_, scene.sleeping ? 1 : 0);
    dWorldSetQuickStepNumIterations(world_, 20);
    for (const Body& body : scene.ground) add_ground(scene, body);
    for (const Body& body : scene.bodies) add(scene, body);
    for (const BallJoint& joint : scene.joints) {
      const dJointID made = dJointCreateBall(world_, nullptr);
      const Body& b = scene.bodies[static_cast<std::size_t>(joint.b)];
      const Vector3d anchor = b.position + b.orientation * joint.at_b;
      dJointAttach(made, joint.a < 0 ? nullptr : bodies_[static_cast<std::size_t>(joint.a)],
                   bodies_[static_cast<std::size_t>(joint.b)]);
      dJointSetBallAnchor(made, anchor.x(), anchor.y(), anchor.z());
    }
  }
  ~Ode() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    if (mesh_ != nullptr) dGeomTriMeshDataDestroy(mesh_);
  }
  void step(double dt) override {
    for (const auto& [body, force] : pulled_) dBodyAddForce(body, force.x(), force.y(), force.z());
    dSpaceCollide(space_, this, meet);
    dWorldQuickStep(world_, dt);
    dJointGroupEmpty(contacts_);
  }
  void read(std::vector<BodyState>& out) const override {
    const auto vec = [](const dReal* v) { return Vector3d(v[0], v[1], v[2]); };
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const dReal* q = dBodyGetQuaternion(bodies_[i]);
      out[i] = {vec(dBodyGetPosition(bodies_[i])), Quaterniond(q[0], q[1], q[2], q[3]).normalized(),
                vec(dBodyGetLinearVel(bodies_[i])), vec(dBodyGetAngularVel(bodies_[i]))};
    }
  }

 private:
  static void meet(void* self, dGeomID a, dGeomID b) {
    Ode& ode = *static_cast<Ode*>(self);
    const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
    if (body_a == nullptr && body_b == nullptr) return;
    dContactGeom points[kMostPoints];
    const int count = dCollide(a, b, kMostPoints, points, sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact{};
      contact.geom = points[i];
      contact.surface.mode = dContactApprox1;
      const bool among = body_a != nullptr && body_b != nullptr;
      contact.surface.mu = among ? ode.friction_among_ : ode.friction_;
      if (ode.bounce_ > 0) {
        contact.surface.mode |= dContactBounce;
        contact.surface.bounce = ode.bounce_;
      }
      dJointAttach(dJointCreateContact(ode.world_, ode.contacts_, &contact), body_a, body_b);
    }
  }
  // Null where the scene's bodies meet nothing: then ODE needs no shapes.
  dGeomID shape_of(const Scene& scene, const Shape& shape) {
    if (!scene.collide) return nullptr;
    switch (shape.kind) {
      case ShapeKind::Box:
        return dCreateBox(space_, 2 * shape.half.x(), 2 * shape.half.y(), 2 * shape.half.z());
      case ShapeKind::Sphere:
        return dCreateSphere(space_, shape.radius);
      case ShapeKind::Capsule:
        return dCreateCapsule(space_, shape.radius, 2 * shape.half_length);
      case ShapeKind::Mesh: {
        for (const Vector3d& p : scene.mesh.vertices)
          for (int k = 0; k < 3; ++k) vertices_.push_back(p[k]);
        for (const auto& t : scene.mesh.triangles)
          corners_.insert(corners_.end(), t.begin(), t.end());
        mesh_ = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildDouble(mesh_, vertices_.data(), 3 * sizeof(double),
                                    static_cast<int>(vertices_.size() / 3), corners_.data(),
                                    static_cast<int>(corners_.size()), 3 * sizeof(dTriIndex));
        return dCreateTriMesh(space_, mesh_, nullptr, nullptr, nullptr);
      }
      case ShapeKind::Hull:
      case ShapeKind::Plane:
      case ShapeKind::None:
        break;
    }
    return nullptr;
  }
  void add_ground(const Scene& scene, const Body& body) {
    if (body.shape.kind != ShapeKind::Plane) return place(shape_of(scene, body.shape), body);
    const Vector3d n = body.orientation * Vector3d::UnitY();  // a plane has no place of its own
    if (scene.collide) dCreatePlane(space_, n.x(), n.y(), n.z(), n.dot(body.position));
  }
  static void place(dGeomID shape, const Body& body) {
    if (shape == nullptr) return;
    const Quaterniond& q = body.orientation;
    const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
    dGeomSetPosition(shape, body.position.x(), body.position.y(), body.position.z());
    dGeomSetQuaternion(shape, turn);
  }
  void add(const Scene& scene, const Body& body) {
    const dBodyID made = dBodyCreate(world_);
    bodies_.push_back(made);
    if (!body.force.isZero()) pulled_.emplace_back(made, body.force);
    const Quaterniond& q = body.orientation;
    const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
    dMass mass;
    dMassSetParameters(&mass, body.mass, 0, 0, 0, body.inertia.x(), body.inertia.y(),
                       body.inertia.z(), 0, 0, 0);
    dBodySetMass(made, &mass);
    dBodySetPosition(made, body.position.x(), body.position.y(), body.position.z());
    dBodySetQuaternion(made, turn);
    dBodySetLinearVel(made, body.velocity.x(), body.velocity.y(), body.velocity.z());
    dBodySetAngularVel(made, body.spin.x(), body.spin.y(), body.spin.z());
    if (const dGeomID shape = shape_of(scene, body.shape); shape != nullptr) {
      dGeomSetBody(shape, made);
      if (body.shape.kind == ShapeKind::Capsule) {  // its axis is z, ours is y
        dMatrix3 R;
        dRFromAxisAndAngle(R, 1, 0, 0, std::acos(0.0));
        dGeomSetOffsetRotation(shape, R);
      }
    }
  }

  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  dTriMeshDataID mesh_ = nullptr;
  double friction_ = 0, friction_among_ = 0, bounce_ = 0;
  std::vector<double> vertices_;
  std::vector<dTriIndex> corners_;
  std::vector<dBodyID> bodies_;
  std::vector<std::pair<dBodyID, Vector3d>> pulled_;  // [N]
};

}  // namespace

EngineKind ode_kind() {
  return {.name = "ode",
          .settings = "0.16, f64, QuickStep with 20 iterations",
          .make = [](const Scene& scene, const EngineOptions&) -> std::unique_ptr<Engine> {
            if (!scene.hulls.empty()) return nullptr;
            return std::make_unique<Ode>(scene);
          }};
}

}  // namespace plumb::anchors
