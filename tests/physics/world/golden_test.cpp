// Proves that eight scenes end with the bits that are written down here: for any number of threads,
// any vector length, after saving and restoring in the middle, and whichever compiler built them.
//
// A change of the physics changes the bits. Then, and only then, the hashes are taken over from
// what the test prints.
#include <functional>

#include "physics/world/golden_hashes.h"
#include "support/measure.h"
#include "support/scenes.h"
#include "support/surfaces.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using namespace testing_support;
using surfaces::field;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr int kSteps = 600;

// A bridge of planks on hinges, with a load on it, a spring and a motor.
void build_bridge(PhysicsWorld& world) {
  add_floor(world);
  BodyId before;
  for (int i = 0; i < 10; ++i) {
    const BodyId plank = add(world, body_at(at(i, 3, 0)), with(box(0.45, 0.05, 0.5)));
    Joint hinge;
    hinge.body_a = before;
    hinge.body_b = plank;
    hinge.frame_a.position = before.is_null() ? vec(-0.5, 3, 0) : vec(0.5, 0, 0);
    hinge.frame_b.position = vec(-0.5, 0, 0);
    hinge.frame_a.orientation = hinge.frame_b.orientation = turn(kPi / 2, {0, -1, 0});
    HingeJoint kind;
    if (i == 4) kind.axis.motor = JointMotor{JointMotor::Mode::Velocity, 1, 200};
    if (i == 7) kind.axis.spring = JointSpring{0, 400, 20};
    hinge.kind = kind;
    must(world.create_joint(hinge));
    before = plank;
  }
  Joint end;
  end.body_a = before;
  end.frame_a.position = vec(0.5, 0, 0);
  end.frame_b.position = vec(9.4, 3, 0);
  end.kind = BallJoint{};
  must(world.create_joint(end));
  add(world, body_at(at(4, 4, 0.1)), with(cube(0.3)));
}

// Shapes of every kind roll down a heightfield.
void build_hills(PhysicsWorld& world) {
  Collider ground = with(Heightfield{field(25, 25, 1, [](int i, int k) {
    return 0.02 * (i - 12) * (i - 12) + 0.3 * ((i * 7 + k * 3) % 5) / 5;
  })});
  add(world, body_at(at(0, 0, 0), MotionType::Static), ground);
  const Shape shapes[] = {sphere(0.3), capsule(0.3, 0.2), cube(0.25), cylinder(0.2, 0.3),
                          cone(0.3, 0.3)};
  for (int i = 0; i < 15; ++i)
    add(world, moving(at(-5 + 0.9 * (i % 5), 4 + i / 5, -3 + 2.0 * (i % 4)), vec(1, 0, 0.2 * i)),
        with(shapes[i % 5], material(0.5, 0.1 * (i % 4))));
}

// Each four times heavier than the one below, for the accurate solver.
void build_heavy_above(PhysicsWorld& world) {
  WorldSettings settings;
  settings.contact_solver = ContactSolver::Newton;
  must(world.set_settings(settings));
  add_floor(world);
  double density = 100;
  for (int i = 0; i < 5; ++i, density *= 4)
    add(world, body_at(at(0.01 * i, 0.5 + i, 0)), with(cube(0.5), {}, density));
}

struct Scene {
  const char* name;
  std::function<void(PhysicsWorld&)> build;
};
const std::vector<Scene>& all_scenes() {
  static const std::vector<Scene> all = {
      {"stack", [](PhysicsWorld& w) { build_stack(w); }},
      {"pyramid", [](PhysicsWorld& w) { build_pyramid(w, {.base = 8}); }},
      {"pile", [](PhysicsWorld& w) { build_pile(w, {.side = 4}); }},
      {"cluster", [](PhysicsWorld& w) { build_cluster(w); }},
      {"bouncing", [](PhysicsWorld& w) { build_ball_grid(w, {.restitution = 0.7, .side = 4}); }},
      {"bridge", build_bridge},
      {"hills", build_hills},
      {"heavy above light", build_heavy_above}};
  return all;
}

struct Way {
  int threads = 0;        // 0: the calling one alone
  int kernel_bits = 0;    // StepDiagnostics::kernel_bits
  bool restored = false;  // saved in the middle and restored into another world
};

std::uint64_t hash_of(const Scene& scene, const Way& way) {
  std::unique_ptr<JobSystem> pool;
  if (way.threads > 0) pool = make_thread_pool(way.threads);
  StepDiagnostics diagnostics;
  diagnostics.kernel_bits = way.kernel_bits;
  PhysicsWorld first, second;
  scene.build(first);
  PhysicsWorld* world = &first;
  for (int i = 0; i < kSteps; ++i) {
    if (way.restored && i == kSteps / 2) {
      must(second.restore(first.save()));
      world = &second;
    }
    world->set_job_system(pool.get());
    world->set_diagnostics(diagnostics);
    world->step(kDt);
  }
  return world->state_hash();
}

TEST(Golden, EightScenesEndWithTheBitsWrittenDown) {
  ASSERT_EQ(all_scenes().size(), std::size(kGoldenHashes));
  for (std::size_t i = 0; i < all_scenes().size(); ++i) {
    const Scene& scene = all_scenes()[i];
    const std::uint64_t plain = hash_of(scene, {});
    EXPECT_EQ(plain, kGoldenHashes[i].of_this_build())
        << scene.name << ": 0x" << std::hex << plain << " in " << kPrecisionName;
    for (const Way& way : {Way{.threads = 1}, Way{.threads = 2}, Way{.threads = 4},
                           Way{.kernel_bits = 1}, Way{.kernel_bits = 128}, Way{.kernel_bits = 256},
                           Way{.kernel_bits = 512}, Way{.threads = 2, .restored = true}})
      EXPECT_EQ(hash_of(scene, way), plain)
          << scene.name << ", " << way.threads << " threads, " << way.kernel_bits << " bits"
          << (way.restored ? ", restored" : "");
  }
}

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
