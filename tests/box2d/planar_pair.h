// The same planar scene in Box2D 2.4.1 and here, side by side.
//
// Here a body is three-dimensional, one metre thick, with the motion locks of a plane; its mass and
// its moment about z are those of the two-dimensional body. Box2D's polygons carry a skin: each is
// grown by b2_polygonRadius, and two of them rest with their skins overlapping by b2_linearSlop, so
// that a gap of kSkinGap stays visible between resting polygons (circles have no skin).
#pragma once

#include <box2d/box2d.h>

#include "support/measure.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace box2d_comparison {

using namespace scenes;

inline constexpr double kSkinGap =
    2 * static_cast<double>(b2_polygonRadius) - static_cast<double>(b2_linearSlop);  // [m] 0.015
inline constexpr double kDt = 1.0 / 60;                                              // [s]

inline float f(double value) { return static_cast<float>(value); }

struct Surface {
  double friction = 0.6, restitution = 0;
};
struct Start {
  double x = 0, y = 0, angle = 0;   // [m], [rad]
  double vx = 0, vy = 0, spin = 0;  // [m/s], [rad/s]
  double damping = 0;               // [1/s] linear and angular
};
// What is compared.
struct Planar {
  double x, y, angle, vx, vy, spin;
};

class PlanarPair {
 public:
  struct Body {
    b2Body* theirs = nullptr;
    BodyId ours;
  };

  explicit PlanarPair(double gravity = kGravity)
      : theirs_(b2Vec2(0, f(-gravity))), ours_(settings(gravity)) {
    theirs_.SetAllowSleeping(false);
  }

  // A static block 100 m long and 2 m high, its top through the origin, turned about it.
  void add_ground(const Surface& surface = {}, double angle = 0) {
    b2BodyDef def;
    def.angle = f(angle);
    b2PolygonShape polygon;
    polygon.SetAsBox(50, 1, b2Vec2(0, -1), 0);
    b2FixtureDef fixture = fixture_of(surface, 0);
    fixture.shape = &polygon;
    theirs_.CreateBody(&def)->CreateFixture(&fixture);

    Collider collider = with(box(50, 1, 5), material(surface.friction, surface.restitution));
    collider.pose.position = vec(0, -1, 0);
    add(ours_, body_at(at({0, 0, 0}, turn(angle, Eigen::Vector3d::UnitZ())), MotionType::Static),
        collider);
  }

  Body add_box(double hx, double hy, const Start& start, const Surface& surface = {},
               double density = 1000) {
    b2PolygonShape polygon;
    polygon.SetAsBox(f(hx), f(hy));
    Body body;
    body.theirs = create_theirs(polygon, start, surface, density);
    body.ours =
        add(ours_, spec_of(start),
            with(box(hx, hy, 0.5), material(surface.friction, surface.restitution), density));
    return body;
  }

  Body add_disc(double radius, const Start& start, const Surface& surface = {},
                double density = 1000) {
    b2CircleShape circle;
    circle.m_radius = f(radius);
    Body body;
    body.theirs = create_theirs(circle, start, surface, density);
    RigidBody spec = spec_of(start);
    MassProperties mass;
    mass.mass = density * kPi * radius * radius;
    mass.I_Bcm_B = Eigen::Matrix3d::Identity() * mass.mass * radius * radius / 2;
    spec.mass = mass;
    body.ours =
        add(ours_, spec, with(sphere(radius), material(surface.friction, surface.restitution)));
    return body;
  }

  // Of the bodies added from now on: whether locks keep them in the plane.
  void lock_to_plane(bool locked) { locked_ = locked; }

  void step() {
    const int velocity_iterations = 8, position_iterations = 3;  // Box2D's own advice
    theirs_.Step(f(kDt), velocity_iterations, position_iterations);
    ours_.step(kDt);
  }
  void run_both(double seconds) {
    for (long i = std::lround(seconds / kDt); i > 0; --i) step();
  }

  [[nodiscard]] static Planar theirs(const Body& body) {
    const b2Body& b = *body.theirs;
    return {static_cast<double>(b.GetPosition().x),
            static_cast<double>(b.GetPosition().y),
            static_cast<double>(b.GetAngle()),
            static_cast<double>(b.GetLinearVelocity().x),
            static_cast<double>(b.GetLinearVelocity().y),
            static_cast<double>(b.GetAngularVelocity())};
  }
  [[nodiscard]] Planar ours(const Body& body) const {
    const Eigen::Vector3d p = position(ours_, body.ours), v = velocity(ours_, body.ours);
    const Eigen::Quaterniond q = orientation(ours_, body.ours);
    return {p.x(), p.y(), 2 * std::atan2(q.z(), q.w()), v.x(), v.y(), spin(ours_, body.ours).z()};
  }
  PhysicsWorld& world() { return ours_; }
  b2World& their_world() { return theirs_; }
  // A static body at the origin, for joints to hold on to; here that is the world itself.
  Body ground() {
    if (!their_ground_) {
      b2BodyDef def;
      their_ground_ = theirs_.CreateBody(&def);
    }
    return {their_ground_, BodyId{}};
  }

 private:
  static WorldSettings settings(double gravity) {
    WorldSettings s = no_sleep();
    s.gravity = vec(0, -gravity, 0);
    return s;
  }
  static b2FixtureDef fixture_of(const Surface& surface, double density) {
    b2FixtureDef fixture;
    fixture.friction = f(surface.friction);
    fixture.restitution = f(surface.restitution);
    fixture.restitutionThreshold = f(0.1);  // [m/s]
    fixture.density = f(density);
    return fixture;
  }
  b2Body* create_theirs(const b2Shape& shape, const Start& start, const Surface& surface,
                        double density) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position = b2Vec2(f(start.x), f(start.y));
    def.angle = f(start.angle);
    def.linearVelocity = b2Vec2(f(start.vx), f(start.vy));
    def.angularVelocity = f(start.spin);
    def.linearDamping = f(start.damping);
    def.angularDamping = f(start.damping);
    b2FixtureDef fixture = fixture_of(surface, density);
    fixture.shape = &shape;
    b2Body* body = theirs_.CreateBody(&def);
    body->CreateFixture(&fixture);
    return body;
  }
  [[nodiscard]] RigidBody spec_of(const Start& start) const {
    RigidBody spec = moving(at({start.x, start.y, 0}, turn(start.angle, Eigen::Vector3d::UnitZ())),
                            vec(start.vx, start.vy, 0), vec(0, 0, start.spin));
    if (locked_) spec.locks = MotionLocks::planar();
    spec.linear_damping = spec.angular_damping = real(start.damping);
    return spec;
  }

  b2World theirs_;
  b2Body* their_ground_ = nullptr;
  bool locked_ = true;
  PhysicsWorld ours_;
};

}  // namespace box2d_comparison
}  // namespace plumb::inline PLUMB_ABI
