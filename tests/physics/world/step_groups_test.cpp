// Proves that which bodies go through the substeps together is a question of speed only: hundreds
// of small islands, most of which go apart in groups, have the same bits as where the ledger makes
// one thread take all of them together, one row at a time; whatever some of the islands do that
// others do not, in whatever order bodies lie in memory, for any number of threads.
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

constexpr double kDt = 1.0 / 60;  // [s]
constexpr int kIslands = 600;     // of three boxes: more rows than go into three groups
constexpr int kKinds = 9;
constexpr double kPitch = 5;  // [m]

enum class Order { IslandByIsland, LayerByLayer };  // in which bodies are made

// One body of an island: 0 lies on the ground, 1 on it, 2 comes from above.
BodyId add_part(PhysicsWorld& world, int island, int layer, Random& random) {
  const double x = kPitch * (island % 25), z = kPitch * (island / 25);
  const Pose place = at({x + 0.05 * layer, 0.5 + layer, z + 0.03 * layer},
                        turn(random.uniform(0, 0.3), {0, 1, 0}));
  const Collider block = with(cube(0.5));
  if (layer < 2) {
    const bool deep = layer == 1 && island % kKinds == 1;
    RigidBody body = body_at(place);
    if (deep) body.pose.position -= pos(0, 0.4, 0);
    return add(world, body, block);
  }
  switch (island % kKinds) {
    case 2:  // bounces
      return add(world, body_at(at(x, 3, z)), with(sphere(0.4), material(0.5, 0.8)));
    case 3:  // strikes an edge and sets what lies below spinning
      return add(world, moving(at(x + 0.6, 3, z), vec(0, -25, 0), vec(0, 0, 3)),
                 with(box(0.6, 0.1, 0.1)));
    case 4:  // fast: is seen coming
      return add(world, moving(at(x - 3, 1.4, z), vec(120, 0, 0)), with(sphere(0.2)));
    case 5: {  // does as it is told
      RigidBody sweeper = body_at(at(x - 1.6, 1.5, z), MotionType::Kinematic);
      sweeper.linear_velocity = vec(0.8, 0, 0.1);
      return add(world, sweeper, with(cube(0.4)));
    }
    case 6:  // rolls with resistance
      return add(world, moving(at(x, 2.4, z), vec(0.5, 0, 0)), [] {
        Material rough = material(0.6);
        rough.rolling_friction = real(0.02);
        return with(capsule(0.3, 0.4), rough);
      }());
    case 7:  // a thousand times as heavy as what it lies on
      return add(world, body_at(at(x, 2.5, z)), with(cube(0.5), {}, 1e6));
    case 8:  // meets nothing
      return add(world, moving(at(x, 30, z), vec(0, 5, 0), vec(1, 7, 0)), with(box(0.2, 0.4, 0.6)));
    default:
      return add(world, body_at(at(x, 2.5, z)), block);
  }
}

void build(PhysicsWorld& world, Order order) {
  Random random(11);
  add_slab(world, 200, 200);
  std::vector<BodyId> bodies(3 * kIslands);
  const auto make = [&](int island, int layer) {
    bodies[static_cast<std::size_t>(3 * island + layer)] = add_part(world, island, layer, random);
  };
  if (order == Order::IslandByIsland) {
    for (int island = 0; island < kIslands; ++island)
      for (int layer = 0; layer < 3; ++layer) make(island, layer);
  } else {
    for (int layer = 0; layer < 3; ++layer)
      for (int island = 0; island < kIslands; ++island) make(island, layer);
  }
  // Some fall through thick air.
  for (std::size_t island = 0; island < kIslands; island += 2 * kKinds)
    must(world.create_effect({bodies[3 * island + 2], Drag{.quadratic = real(50)}, 0}));
  // Two of the plain islands hang together by a joint.
  Joint rope;
  rope.body_a = bodies[2];
  rope.body_b = bodies[static_cast<std::size_t>(3 * kKinds + 2)];
  rope.kind = RopeJoint{real(9 * kPitch)};
  must(world.create_joint(rope));
}

std::vector<std::uint64_t> hashes(Order order, bool ledger, JobSystem* jobs = nullptr) {
  WorldSettings settings;
  settings.sleeping = false;
  PhysicsWorld world(settings);
  world.set_job_system(jobs);
  build(world, order);
  world.set_diagnostics({.ledger = ledger});
  std::vector<std::uint64_t> out;
  for (int i = 0; i < 90; ++i) {
    EXPECT_TRUE(world.step(kDt).status.ok());
    out.push_back(world.state_hash());
  }
  EXPECT_TRUE(all_finite(world));
  EXPECT_GT(world.last_report().touching_pairs, 2u * kIslands);
  return out;
}

class StepGroups : public testing::TestWithParam<Order> {};

TEST_P(StepGroups, GiveTheBitsOfAllBodiesTogether) {
  const std::vector<std::uint64_t> together = hashes(GetParam(), true);
  EXPECT_EQ(together, hashes(GetParam(), false));
  for (const int threads : {2, 4}) {
    const std::unique_ptr<JobSystem> pool = make_thread_pool(threads);
    EXPECT_EQ(together, hashes(GetParam(), false, pool.get())) << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(, StepGroups, testing::Values(Order::IslandByIsland, Order::LayerByLayer),
                         [](const auto& param) {
                           return std::string(param.param == Order::IslandByIsland
                                                  ? "IslandByIsland"
                                                  : "LayerByLayer");
                         });

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
