// Drops a ball on a floor through the installed package and says where it came to rest.
#include <plumb/world.h>

#include <cmath>
#include <cstdio>

int main() {
  using plumb::Real;
  constexpr Real kRadius = Real(0.5);      // [m]
  constexpr int kSteps = 240;              // 4 s, several times the fall
  constexpr double kTimeStep = 1.0 / 60;   // [s]
  constexpr double kSettledWithin = 0.01;  // [m] a hundredth of the ball's size

  plumb::PhysicsWorld world;
  const auto floor = world.create_body({.type = plumb::MotionType::Static});
  const auto ball = world.create_body({.pose = {.position = {0, 2, 0}}});
  if (!floor.ok() || !world.create_collider(floor.id, {.shape = plumb::HalfSpace{}}).ok() ||
      !ball.ok() || !world.create_collider(ball.id, {.shape = plumb::Sphere{kRadius}}).ok()) {
    std::puts("the scene could not be built");
    return 1;
  }
  for (int step = 0; step < kSteps; ++step) {
    if (!world.step(kTimeStep).status.ok()) return 1;
  }
  const double height = static_cast<double>(world.pose(ball.id).position.y());
  std::printf("%s: the ball rests at height %.4f m\n", plumb::kPrecisionName, height);
  return std::abs(height - static_cast<double>(kRadius)) < kSettledWithin ? 0 : 1;
}
