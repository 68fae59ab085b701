// Scenes by lot. Their parts stand apart along the x axis, each with what some choice of the engine
// is about.
#include <cmath>

#include "audit/audit.h"
#include "audit/must.h"

namespace plumb::inline PLUMB_ABI::audit {
namespace {

// A 32-bit linear congruential generator, the same everywhere.
class Lot {
 public:
  explicit Lot(std::uint32_t seed) : state_(seed * 2654435761u + 12345u) {}
  // Uniform in [low, high).
  Real number(double low, double high) {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<Real>(low + (high - low) * static_cast<double>(state_ >> 8) / 16777216.0);
  }
  int below(int end) { return static_cast<int>(number(0, end)); }
  Vec3 vector(double size) {
    return {number(-size, size), number(-size, size), number(-size, size)};
  }
  Quat attitude() {
    const Quat q(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1));
    return q.norm() > Real(0.01) ? q.normalized() : Quat::Identity();
  }

 private:
  std::uint32_t state_;
};

struct Part {
  PhysicsWorld& world;
  Lot& lot;
  Real x;  // [m] where it stands

  [[nodiscard]] Pos3 at(double dx, double y, double z) const {
    return {static_cast<PosReal>(x) + static_cast<PosReal>(dx), static_cast<PosReal>(y),
            static_cast<PosReal>(z)};
  }
  BodyId add(const RigidBody& body, const Shape& shape, const Material& material = {},
             double density = 1000) {
    const BodyId id = must(world.create_body(body));
    Collider collider;
    collider.shape = shape;
    collider.material = material;
    collider.density = density;
    must(world.create_collider(id, collider));
    return id;
  }
  BodyId wall(const Pos3& p, const Vec3& half) {
    RigidBody body;
    body.type = MotionType::Static;
    body.pose.position = p;
    return add(body, Box{half});
  }
  Shape some_shape() {
    switch (lot.below(4)) {
      case 0:
        return Sphere{lot.number(0.15, 0.4)};
      case 1:
        return Capsule{lot.number(0.1, 0.3), lot.number(0.1, 0.4)};
      case 2:
        return Cylinder{lot.number(0.15, 0.4), lot.number(0.1, 0.4)};
      default:
        return Box{Vec3(lot.number(0.1, 0.4), lot.number(0.1, 0.4), lot.number(0.1, 0.4))};
    }
  }
};

void add_pile(Part part) {
  for (int i = 0; i < 12; ++i) {
    RigidBody body;
    body.pose.position = part.at(part.lot.number(-1, 1), 0.6 + 0.7 * i, part.lot.number(-1, 1));
    body.pose.orientation = part.lot.attitude();
    Material material;
    material.restitution = part.lot.number(0, 0.5);
    part.add(body, part.some_shape(), material);
  }
}

void add_tumblers(Part part) {
  for (int i = 0; i < 6; ++i) {
    RigidBody body;
    body.pose.position = part.at(0, 30 + 3 * i, 0);
    body.pose.orientation = part.lot.attitude();
    body.angular_velocity = part.lot.vector(std::pow(10.0, i - 3));
    part.add(body, part.some_shape());
  }
}

void add_bullets(Part part) {
  part.wall(part.at(0, 3, 0), Vec3(Real(0.02), 3, 3));
  for (int i = 0; i < 8; ++i) {
    RigidBody body;
    body.pose.position = part.at(-2.0 - 3 * i, 1 + 0.5 * i, part.lot.number(-2, 2));
    body.linear_velocity = Vec3(part.lot.number(5, 200), part.lot.number(0, 3), 0);
    body.angular_velocity = part.lot.vector(50);
    body.continuous = i % 2 == 0;
    Material material;
    material.restitution = part.lot.number(0, 0.9);
    part.add(body,
             i % 3 == 0 ? Shape{Sphere{Real(0.05)}}
                        : Shape{Box{Vec3(Real(0.04), Real(0.02), Real(0.3))}},
             material);
  }
}

void add_rollers(Part part) {
  for (int i = 0; i < 5; ++i) {
    RigidBody body;
    body.pose.position = part.at(0, 0.35, 2.0 * i - 4);
    body.linear_velocity = Vec3(part.lot.number(-3, 3), 0, 0);
    body.angular_velocity = Vec3(0, part.lot.number(-20, 20), 0);
    Material material;
    material.rolling_friction = part.lot.number(0.001, 0.02);
    material.torsional_friction = part.lot.number(0.001, 0.02);
    part.add(body, i % 2 == 0 ? Shape{Sphere{Real(0.3)}} : Shape{Capsule{Real(0.3), Real(0.2)}},
             material);
  }
}

void add_whip(Part part) {
  BodyId before;
  const int count = 3 + part.lot.below(12);
  for (int i = 0; i < count; ++i) {
    RigidBody body;
    body.pose.position = part.at(0.5 + i, 25, 0);
    if (i + 1 == count) body.linear_velocity = Vec3(0, part.lot.number(-30, 30), 0);
    const BodyId link = part.add(body, Box{Vec3(Real(0.5), Real(0.05), Real(0.05))}, {},
                                 i + 1 == count ? part.lot.number(1000, 50000) : Real(1000));
    Joint joint;
    joint.body_a = before;
    joint.body_b = link;
    joint.frame_a.position = before.is_null() ? Vec3(part.x, 25, 0) : Vec3(Real(0.5), 0, 0);
    joint.frame_b.position = Vec3(Real(-0.5), 0, 0);
    joint.kind = BallJoint{};
    must(part.world.create_joint(joint));
    before = link;
  }
}

void add_heavy_on_light(Part part) {
  double density = 100;
  for (int i = 0; i < 4; ++i, density *= 6) {
    RigidBody body;
    body.pose.position = part.at(0, 0.5 + i, 0);
    part.add(body, Box{Vec3::Constant(Real(0.5))}, {}, density);
  }
}

void add_deep(Part part) {
  for (int i = 0; i < 4; ++i) {
    RigidBody body;
    body.pose.position = part.at(0.2 * i, 0.3 + 0.5 * i, 0);
    part.add(body, Box{Vec3::Constant(Real(0.5))});
  }
}

void add_spinners(Part part) {
  for (int i = 0; i < 4; ++i) {
    RigidBody body;
    body.pose.position = part.at(2.0 * i, 0.5, 6);
    body.pose.orientation = part.lot.attitude();
    body.angular_velocity = part.lot.vector(40);
    part.add(body, part.some_shape());
  }
}

void add_air_and_water(Part part) {
  for (int i = 0; i < 6; ++i) {
    RigidBody body;
    body.pose.position = part.at(2.0 * i, -15 + 3 * i, 0);
    body.pose.orientation = part.lot.attitude();
    body.linear_velocity = part.lot.vector(4);
    const BodyId id = part.add(body, part.some_shape(), {}, part.lot.number(200, 2000));
    Effect effect;
    effect.body = id;
    if (i == 0) effect.kind = Drag{.linear = Real(1), .quadratic = Real(2)};
    if (i == 1) effect.kind = Wind{.velocity = Vec3(8, 0, 0)};
    if (i == 2) effect.kind = Thrust{.force = part.lot.vector(500)};
    if (i == 3) effect.kind = Magnus{.coefficient = Real(0.1)};
    if (i < 4) must(part.world.create_effect(effect));
  }
  must(part.world.create_effect({.kind = Buoyancy{.level = Real(-12)}}));
  must(part.world.create_effect(
      {.kind = Attractor{
           .center = part.at(5, -5, 0), .strength = part.lot.number(10, 300), .range = Real(6)}}));
  must(part.world.create_effect({.kind = Explosion{.center = part.at(5, -14, 3),
                                                   .impulse = part.lot.number(100, 1000),
                                                   .speed = part.lot.number(10, 100),
                                                   .thickness = Real(1),
                                                   .range = Real(20)}}));
}

using AddPart = void (*)(Part);
constexpr AddPart kParts[] = {add_pile,    add_tumblers, add_bullets,
                              add_rollers, add_whip,     add_heavy_on_light,
                              add_deep,    add_spinners, add_air_and_water};
constexpr int kPartCount = static_cast<int>(std::size(kParts));

}  // namespace

void build_drawn_scene(PhysicsWorld& world, std::uint32_t seed) {
  Lot lot(seed);
  WorldSettings settings;
  settings.contact_solver = lot.below(2) == 0 ? ContactSolver::SoftStep : ContactSolver::Auto;
  if (lot.below(5) == 0) settings.gravity = Vec3::Zero();
  settings.substeps = 1 + lot.below(6);
  must(world.set_settings(settings));
  // Floors under the parts but for water, which lies beside them.
  Part{world, lot, 0}.wall({30, -1, 0}, Vec3(60, 1, 60));
  const int parts = 2 + lot.below(2);
  for (int i = 0; i < parts; ++i) {
    const AddPart add = kParts[(static_cast<int>(seed) + 4 * i) % kPartCount];
    add({world, lot, add == add_air_and_water ? Real(150) : static_cast<Real>(25 * i)});
  }
}

}  // namespace plumb::inline PLUMB_ABI::audit
