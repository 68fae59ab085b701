// A toy engine with entities and components of its own, and all that it takes to hook Plumb in.
#include <cstdint>
#include <cstdio>
#include <unordered_map>

#include "plumb/integration/fixed_step_loop.h"
#include "plumb/integration/pose_sync.h"
#include "plumb/world.h"

// What the engine has anyway.
using Entity = std::uint64_t;
struct Transform {
  double x = 0, y = 0, z = 0;
  double qx = 0, qy = 0, qz = 0, qw = 1;
};
struct Engine {
  std::unordered_map<Entity, Transform> transforms;
};

// --- hook-in: begin ---
class Physics {
 public:
  explicit Physics(Engine& engine) : engine_(engine), loop_(world_), sync_(loop_) {}

  plumb::BodyId add(Entity entity, plumb::RigidBody body, const plumb::Collider& collider) {
    body.user_data = entity;  // the way back from the body to the entity
    const auto created = world_.create_body(body);
    if (!created.ok() || !world_.create_collider(created.id, collider).ok()) return {};
    sync_.place(world_, created.id);
    return created.id;
  }

  // Once a frame, with the seconds since the last one.
  void update(double elapsed) {
    loop_.tick(elapsed);
    sync_.write(world_, loop_.alpha(), [&](const plumb::integration::SyncedPose& moved) {
      const auto& p = moved.pose.position;
      const auto& q = moved.pose.orientation;
      engine_.transforms[moved.entity] = {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
    });
  }

  plumb::PhysicsWorld& world() { return world_; }

 private:
  Engine& engine_;
  plumb::PhysicsWorld world_;
  plumb::integration::FixedStepLoop loop_;
  plumb::integration::PoseSync sync_;
};
// --- hook-in: end ---

int main() {
  Engine engine;
  Physics physics(engine);
  constexpr Entity kGround = 1, kBall = 2;
  plumb::RigidBody body;
  plumb::Collider collider;
  body.pose.position.y() = 5;
  collider.shape = plumb::Sphere{plumb::Real(0.5)};
  physics.add(kBall, body, collider);
  body.type = plumb::MotionType::Static;
  body.pose.position.y() = 0;
  collider.shape = plumb::HalfSpace{};
  physics.add(kGround, body, collider);

  constexpr double kFrame = 1.0 / 144;  // [s] of the engine's display; physics keeps its own 1/60 s
  for (int frame = 0; frame <= 3 * 144; ++frame) {
    physics.update(kFrame);
    if (frame % 72 == 0)
      std::printf("%.1f s: ball at y = %.3f m\n", frame * kFrame, engine.transforms[kBall].y);
  }
}
