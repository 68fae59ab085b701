// The scene that prove_sleep_is_free counts instructions of: boxes asleep on a floor.
//
//   sleepers_scene BOXES STEPS
#include <cstdlib>

#include "plumb/world.h"

using namespace plumb;

namespace {

void add(PhysicsWorld& world, double x, double y, double z, const Box& box, MotionType type) {
  RigidBody body;
  body.type = type;
  body.pose.position = Pos3(PosReal(x), PosReal(y), PosReal(z));
  Collider collider;
  collider.shape = box;
  (void)world.create_collider(world.create_body(body).id, collider);
}

}  // namespace

int main(int argc, char** argv) {
  const int boxes = argc > 1 ? std::atoi(argv[1]) : 100;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 10;
  WorldSettings settings;
  settings.time_to_sleep = 0;  // [s] at once
  PhysicsWorld world(settings);
  add(world, 0, -1, 0, Box{Vec3(1000, 1, 1000)}, MotionType::Static);
  for (int i = 0; i < boxes; ++i)
    add(world, 2.0 * (i % 320) - 320, 0.5, 2.0 * (i / 320) - 320, Box{Vec3::Constant(Real(0.5))},
        MotionType::Dynamic);
  constexpr int kUntilAsleep = 5;  // steps
  for (int i = 0; i < kUntilAsleep; ++i) world.step(1.0 / 60);
  for (int i = 0; i < steps; ++i) world.step(1.0 / 60);
  return world.last_report().awake_bodies == 0 ? 0 : 1;
}
