// The scene that prove_zero_cost counts instructions of: boxes and balls fall onto a floor.
//
//   zero_cost_scene EFFECTS STEPS     EFFECTS: none, gone (made and taken away), all
#include <cstdlib>
#include <string>

#include "plumb/world.h"

using namespace plumb;

namespace {

BodyId add(PhysicsWorld& world, double x, double y, double z, const Shape& shape,
           MotionType type = MotionType::Dynamic) {
  RigidBody body;
  body.type = type;
  body.pose.position = Pos3(PosReal(x), PosReal(y), PosReal(z));
  const BodyId id = world.create_body(body).id;
  Collider collider;
  collider.shape = shape;
  (void)world.create_collider(id, collider);
  return id;
}

void add_all_effects(PhysicsWorld& world, BodyId body) {
  (void)world.set_force_field(0, [](const FieldSample&, void*) { return FieldForce{}; });
  PointGravity star;
  star.mu = Real(1);
  star.softening = Real(1);
  Drag drag;
  drag.linear = Real(1);
  Magnus magnus;
  magnus.coefficient = Real(1);
  Attractor pull;
  pull.strength = Real(1);
  Thrust thrust;
  thrust.force = Vec3(1, 0, 0);
  Explosion blast;
  blast.updraft = Real(1);
  Buoyancy lake;
  lake.level = Real(10);
  const EffectKind kinds[] = {star, ForceField{}, thrust,        blast, drag,    magnus,
                              pull, Wind{},       AeroSurface{}, lake,  Spring{}};
  for (const EffectKind& kind : kinds) (void)world.create_effect({body, kind, 0});
}

}  // namespace

int main(int argc, char** argv) {
  const std::string which = argc > 1 ? argv[1] : "none";
  const int steps = argc > 2 ? std::atoi(argv[2]) : 10;
  PhysicsWorld world;
  (void)add(world, 0, -1, 0, Box{Vec3(50, 1, 50)}, MotionType::Static);
  BodyId last;
  for (int i = 0; i < 200; ++i)
    last = add(world, 1.1 * (i % 10) - 5, 0.45 + 1.1 * (i / 50), 1.1 * (i / 10 % 5),
               i % 2 == 0 ? Shape(Sphere{Real(0.4)}) : Shape(Box{Vec3::Constant(Real(0.4))}));
  if (which == "gone") (void)world.destroy_effect(world.create_effect({last, Wind{}, 0}).id);
  if (which == "all") add_all_effects(world, last);
  for (int i = 0; i < steps; ++i) world.step(1.0 / 60);
  return world.body_count() == 201 ? 0 : 1;
}
