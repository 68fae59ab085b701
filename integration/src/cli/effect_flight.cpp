#include "cli/effect_flight.h"

namespace plumb::cli {
namespace {

FieldForce no_force(const FieldSample&, void*) { return {}; }

WorldSettings awake() {
  WorldSettings settings;
  settings.sleeping = false;
  return settings;
}

}  // namespace

std::vector<NamedEffect> every_effect() {
  PointGravity star;
  star.mu = Real(1);
  star.softening = Real(1);
  Attractor pull;
  pull.strength = Real(0.1);
  Drag linear, quadratic, turning;
  linear.linear = Real(0.1);
  quadratic.quadratic = Real(0.1);
  turning.angular_linear = Real(0.1);
  Magnus magnus;
  magnus.coefficient = Real(0.01);
  Wind wind;
  wind.velocity = Vec3(1, 0, 0);
  AeroSurface wing;
  wing.tensor = -Mat3::Identity();
  wing.point = Vec3(0, Real(0.5), 0);
  Buoyancy water;
  water.level = Real(1e4);
  Spring spring;
  spring.rest_length = Real(1e3);
  Thrust thrust;
  thrust.force = Vec3(0, 1, 0);
  Explosion blast;
  blast.updraft = Real(1);
  blast.updraft_duration = Real(1e6);
  blast.chimney_radius = blast.chimney_height = Real(1e6);
  return {{"point gravity", star},
          {"force field (empty)", ForceField{}},
          {"thrust", thrust},
          {"explosion (updraft)", blast},
          {"drag linear", linear},
          {"drag quadratic", quadratic},
          {"drag angular", turning},
          {"magnus", magnus},
          {"attractor", pull},
          {"wind on a box", wind},
          {"aero surface", wing},
          {"buoyancy of a box", water},
          {"spring to the world", spring}};
}

EffectFlight::EffectFlight(const EffectKind& kind, int bodies, int carriers) : world_(awake()) {
  (void)world_.set_force_field(0, no_force);
  for (int i = 0; i < bodies; ++i) {
    RigidBody body;
    body.pose.position = Pos3(PosReal(5 * (i % 32)), PosReal(5 * (i / 32)), 0);
    body.linear_velocity = Vec3(1, Real(0.5), 0);
    body.angular_velocity = Vec3(1, 2, 3);
    const BodyId id = world_.create_body(body).id;
    Collider collider;
    collider.shape = Box{Vec3(Real(0.5), Real(0.4), Real(0.3))};
    (void)world_.create_collider(id, collider);
    if (i < carriers) (void)world_.create_effect({id, kind, 0});
  }
}

void EffectFlight::step(int count) {
  for (int i = 0; i < count; ++i) world_.step(1.0 / 60);
}

}  // namespace plumb::cli
