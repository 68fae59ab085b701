// MuJoCo in double precision: its Newton solver, one thread. Bodies that are joined are a tree in
// joint coordinates, as its users build them; hulls are meshes of its own; of meshes it only knows
// the hull, so that it has no ground of triangles.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stdexcept>

#include "bench/anchors/engines/engine.h"

namespace plumb::anchors {
namespace {

// Its arena takes 1.5 MB a body, and a step of 820 piled boxes 0.1 s: scenes of thousands of bodies
// are not for it.
constexpr std::size_t kMostBodies = 1200;

// Its capsules and the normals of its planes stand along z, ours along y.
const Quaterniond& from_z_to_y() {
  static const Quaterniond q(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX()));
  return q;
}

void put(double* to, const Vector3d& v) { std::copy_n(v.data(), 3, to); }
void put(double* to, const Quaterniond& q) {
  to[0] = q.w();
  put(to + 1, Vector3d(q.vec()));
}

// Its way to bounce is a spring with little damping: the damping ratio with which a ball that meets
// it leaves with `restitution` of its speed.
double damping_ratio(double restitution) {
  const double loss = -std::log(restitution);
  return loss / std::hypot(loss, std::numbers::pi);
}

// The tree: whose child a body is, and by which joint; false where the joints make none.
struct Tree {
  std::vector<const BallJoint*> joint;  // of each body; null: it is free
};
bool make_tree(const Scene& scene, Tree& tree) {
  tree.joint.assign(scene.bodies.size(), nullptr);
  for (const BallJoint& joint : scene.joints) {
    const BallJoint*& place = tree.joint[static_cast<std::size_t>(joint.b)];
    if (place != nullptr || joint.a >= joint.b) return false;
    place = &joint;
  }
  return true;
}

class MuJoCo : public Engine {
 public:
  MuJoCo(const Scene& scene, const Tree& tree, mjtIntegrator integrator, mjtCone cone)
      : restitution_(scene.restitution) {
    const std::unique_ptr<mjSpec, void (*)(mjSpec*)> spec(mj_makeSpec(), mj_deleteSpec);
    put(spec->option.gravity, scene.gravity);
    spec->option.integrator = integrator;
    spec->option.cone = cone;
    // What goes astray is to be seen, not to be set back to the start.
    spec->option.disableflags |= mjDSBL_AUTORESET;
    for (std::size_t i = 0; i < scene.hulls.size(); ++i) add_hull(*spec, scene.hulls[i], i);
    mjsBody* world = mjs_findBody(spec.get(), "world");
    for (const Body& body : scene.ground) add_shape(world, scene, body, true);
    std::vector<mjsBody*> made;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const BallJoint* joint = tree.joint[i];
      const bool child = joint != nullptr && joint->a >= 0;
      const auto parent = child ? static_cast<std::size_t>(joint->a) : 0;
      made.push_back(add(child ? made[parent] : world, scene, scene.bodies[i],
                         child ? &scene.bodies[parent] : nullptr, joint));
    }
    model_.reset(mj_compile(spec.get(), nullptr));
    if (model_ == nullptr) throw std::runtime_error(mjs_getError(spec.get()));
    data_.reset(mj_makeData(model_.get()));
    for (const mjsBody* body : made) bodies_.push_back(mjs_getId(body->element));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      set_velocity(scene, tree, i);
      put(data_->xfrc_applied + 6 * bodies_[i], scene.bodies[i].force);
    }
  }
  void step(double dt) override {
    if (dt != model_->opt.timestep || !begun_) begin(dt);
    mj_step(model_.get(), data_.get());
  }
  void read(std::vector<BodyState>& out) const override {
    // A step leaves places and velocities as they were at its start.
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    mj_comVel(model_.get(), data_.get());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const auto body = static_cast<std::ptrdiff_t>(bodies_[i]);
      const double* q = data_->xquat + 4 * body;
      double velocity[6];  // angular, linear
      mj_objectVelocity(model_.get(), data_.get(), mjOBJ_BODY, bodies_[i], velocity, 0);
      out[i] = {Vector3d(data_->xpos + 3 * body), Quaterniond(q[0], q[1], q[2], q[3]).normalized(),
                Vector3d(velocity + 3), Vector3d(velocity)};
    }
  }

 private:
  // Of springs that bounce the stiffest that it allows: time constants of two steps. (Contacts that
  // do not bounce keep its default, 0.02 s; it raises them to two steps by itself.)
  void begin(double dt) {
    begun_ = true;
    model_->opt.timestep = dt;
    if (!(restitution_ > 0)) return;
    const double rate = 1 / (2 * dt);  // [rad/s]
    for (int i = 0; i < model_->ngeom; ++i) {
      model_->geom_solref[mjNREF * i] = -rate * rate;
      model_->geom_solref[mjNREF * i + 1] = -2 * damping_ratio(restitution_) * rate;
    }
  }
  static std::string name_of_hull(std::size_t i) { return "hull" + std::to_string(i); }
  static void add_hull(mjSpec& spec, const Hull& hull, std::size_t i) {
    mjsMesh* mesh = mjs_addMesh(&spec, nullptr);
    mjs_setName(mesh->element, name_of_hull(i).c_str());
    std::vector<float> points;
    for (const Vector3d& p : hull.points)
      for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(p[k]));
    mjs_setFloat(mesh->uservert, points.data(), static_cast<int>(points.size()));
  }
  static void add_shape(mjsBody* to, const Scene& scene, const Body& body, bool fixed) {
    mjsGeom* geom = mjs_addGeom(to, nullptr);
    Quaterniond turn = fixed ? body.orientation : Quaterniond::Identity();
    const Shape& shape = body.shape;
    switch (shape.kind) {
      case ShapeKind::Box:
        geom->type = mjGEOM_BOX;
        put(geom->size, shape.half);
        break;
      case ShapeKind::Sphere:
        geom->type = mjGEOM_SPHERE;
        geom->size[0] = shape.radius;
        break;
      case ShapeKind::Capsule:
        geom->type = mjGEOM_CAPSULE;
        geom->size[0] = shape.radius;
        geom->size[1] = shape.half_length;
        turn = turn * from_z_to_y();
        break;
      case ShapeKind::Plane:
        geom->type = mjGEOM_PLANE;
        put(geom->size, Vector3d(0, 0, 1));  // without end
        turn = turn * from_z_to_y();
        break;
      case ShapeKind::Hull:
        geom->type = mjGEOM_MESH;
        mjs_setString(geom->meshname, name_of_hull(shape.hull).c_str());
        break;
      case ShapeKind::Mesh:
      case ShapeKind::None:
        break;
    }
    if (fixed) put(geom->pos, body.position);
    put(geom->quat, turn);
    geom->condim = scene.friction_of_bodies() > 0 ? 3 : 1;
    geom->friction[0] = fixed ? scene.friction : scene.friction_of_bodies();
    geom->priority = fixed ? 1 : 0;  // the ground's friction counts, whatever lies on it
    if (!scene.collide) geom->contype = geom->conaffinity = 0;
  }
  static mjsBody* add(mjsBody* to, const Scene& scene, const Body& body, const Body* parent,
                      const BallJoint* joint) {
    mjsBody* made = mjs_addBody(to, nullptr);
    const Quaterniond R = parent == nullptr ? Quaterniond::Identity() : parent->orientation;
    const Vector3d x = parent == nullptr ? Vector3d::Zero() : parent->position;
    put(made->pos, Vector3d(R.conjugate() * (body.position - x)));
    put(made->quat, Quaterniond(R.conjugate() * body.orientation));
    made->explicitinertial = 1;
    made->mass = body.mass;
    put(made->ipos, Vector3d(Vector3d::Zero()));
    put(made->inertia, body.inertia);
    if (joint == nullptr) {
      mjs_addFreeJoint(made);
    } else {
      mjsJoint* ball = mjs_addJoint(made, nullptr);
      ball->type = mjJNT_BALL;
      put(ball->pos, joint->at_b);
    }
    if (body.shape.kind != ShapeKind::None) add_shape(made, scene, body, false);
    return made;
  }
  // A free body's: linear along world axes, angular along its own. A ball joint's: angular against
  // the parent along the child's axes.
  void set_velocity(const Scene& scene, const Tree& tree, std::size_t i) {
    const Body& body = scene.bodies[i];
    double* v = data_->qvel + model_->jnt_dofadr[model_->body_jntadr[bodies_[i]]];
    Vector3d spin = body.spin;
    if (const BallJoint* joint = tree.joint[i]; joint == nullptr) {
      put(v, body.velocity);
      v += 3;
    } else if (joint->a >= 0) {
      spin -= scene.bodies[static_cast<std::size_t>(joint->a)].spin;
    }
    put(v, Vector3d(body.orientation.conjugate() * spin));
  }

  std::unique_ptr<mjModel, void (*)(mjModel*)> model_{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data_{nullptr, mj_deleteData};
  std::vector<int> bodies_;
  double restitution_;
  bool begun_ = false;
};

template <mjtIntegrator integrator, mjtCone cone>
std::unique_ptr<Engine> make(const Scene& scene, const EngineOptions&) {
  // Otherwise it writes them into a file where the program is run, and stops it.
  mju_user_warning = [](const char*) {};
  mju_user_error = [](const char* text) {
    std::fprintf(stderr, "MuJoCo: %s\n", text);
    std::_Exit(1);
  };
  Tree tree;
  if (!scene.mesh.triangles.empty() || scene.bodies.size() > kMostBodies || !make_tree(scene, tree))
    return nullptr;
  return std::make_unique<MuJoCo>(scene, tree, integrator, cone);
}

}  // namespace

std::vector<EngineKind> mujoco_kinds() {
  const std::string version = mj_versionString();
  return {{.name = "mujoco",
           .settings = version + ", f64, Newton, Euler, 4-facet cone",
           .make = make<mjINT_EULER, mjCONE_PYRAMIDAL>},
          {.name = "mujoco-rk4",
           .settings = version + " RK4, f64, Newton, elliptic cone",
           .make = make<mjINT_RK4, mjCONE_ELLIPTIC>}};
}

}  // namespace plumb::anchors
