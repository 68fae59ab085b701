// Rapier with its defaults: 4 substeps, soft contacts, eight lanes; compiled for this processor.
#include "bench/anchors/engines/engine.h"
#include "bench/anchors/engines/rapier_c.h"

namespace plumb::anchors {
namespace {

template <std::size_t n, class From>
void copy(float (&to)[n], const From& from) {
  for (std::size_t k = 0; k < n; ++k)
    to[k] = static_cast<float>(from[static_cast<Eigen::Index>(k)]);
}

RapierBody flat(const Body& body, bool dynamic) {
  RapierBody out{};
  out.kind = static_cast<std::int32_t>(body.shape.kind);
  out.dynamic = dynamic ? 1 : 0;
  out.hull = static_cast<std::uint32_t>(body.shape.hull);
  copy(out.half, body.shape.half);
  out.radius = static_cast<float>(body.shape.radius);
  out.half_length = static_cast<float>(body.shape.half_length);
  copy(out.position, body.position);
  copy(out.turn, body.orientation.coeffs());  // x y z w
  copy(out.velocity, body.velocity);
  copy(out.spin, body.spin);
  out.mass = static_cast<float>(body.mass);
  copy(out.inertia, body.inertia);
  copy(out.force, body.force);
  return out;
}

class Rapier : public Engine {
 public:
  Rapier(const Scene& scene, int threads) : first_(scene.ground.size()) {
    std::vector<RapierBody> bodies;
    for (const Body& body : scene.ground) bodies.push_back(flat(body, false));
    for (const Body& body : scene.bodies) bodies.push_back(flat(body, true));
    std::vector<float> points, vertices;
    std::vector<std::uint32_t> starts = {0}, corners;
    const auto add = [](std::vector<float>& to, const Vector3d& p) {
      for (int k = 0; k < 3; ++k) to.push_back(static_cast<float>(p[k]));
    };
    for (const Hull& hull : scene.hulls) {
      for (const Vector3d& p : hull.points) add(points, p);
      starts.push_back(static_cast<std::uint32_t>(points.size() / 3));
    }
    for (const Vector3d& p : scene.mesh.vertices) add(vertices, p);
    for (const auto& t : scene.mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    std::vector<RapierJoint> joints;
    for (const BallJoint& joint : scene.joints) {
      const auto place = [&](int i) { return i < 0 ? -1 : i + static_cast<int>(first_); };
      RapierJoint& made = joints.emplace_back();
      made.a = place(joint.a);
      made.b = place(joint.b);
      copy(made.at_a, joint.at_a);
      copy(made.at_b, joint.at_b);
    }
    RapierScene flat{};
    copy(flat.gravity, scene.gravity);
    flat.friction = static_cast<float>(scene.friction);
    flat.friction_of_bodies = static_cast<float>(scene.friction_of_bodies());
    flat.restitution = static_cast<float>(scene.restitution);
    flat.collide = scene.collide ? 1 : 0;
    flat.sleeping = scene.sleeping ? 1 : 0;
    flat.bodies = bodies.data();
    flat.body_count = bodies.size();
    flat.points = points.data();
    flat.hull_starts = starts.data();
    flat.hull_count = scene.hulls.size();
    flat.vertices = vertices.data();
    flat.vertex_count = scene.mesh.vertices.size();
    flat.corners = corners.data();
    flat.triangle_count = scene.mesh.triangles.size();
    flat.joints = joints.data();
    flat.joint_count = joints.size();
    world_ = plumb_rapier_new(&flat, static_cast<std::size_t>(threads));
    numbers_.resize(13 * bodies.size());
  }
  ~Rapier() override { plumb_rapier_free(world_); }
  void step(double dt) override { plumb_rapier_step(world_, static_cast<float>(dt)); }
  void read(std::vector<BodyState>& out) const override {
    plumb_rapier_read(world_, numbers_.data());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float* n = &numbers_[13 * (first_ + i)];
      out[i] = {Vector3d(n[0], n[1], n[2]), Quaterniond(n[6], n[3], n[4], n[5]).normalized(),
                Vector3d(n[7], n[8], n[9]), Vector3d(n[10], n[11], n[12])};
    }
  }

 private:
  std::size_t first_;  // bodies of the ground stand before the others
  void* world_ = nullptr;
  mutable std::vector<float> numbers_;
};

}  // namespace

EngineKind rapier_kind() {
  return {.name = "rapier",
          .settings = "0.36.1, f32, 4 substeps, simd8",
          .most_threads = 64,
          .make = [](const Scene& scene, const EngineOptions& o) -> std::unique_ptr<Engine> {
            return std::make_unique<Rapier>(scene, o.threads);
          }};
}

}  // namespace plumb::anchors
