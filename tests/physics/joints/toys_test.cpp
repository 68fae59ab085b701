// Proves that toys, random bodies joined at random, come down and stay finite and slow: whatever
// hangs together, overlaps or spins, nothing is quarantined and nothing is thrown. They fall from
// six metres; what is thrown is faster than any spring or fall could make it. Where some still are,
// the test says how many of the boxes.
#include "support/toys.h"

#include <gtest/gtest.h>

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;

constexpr double kThrown = 60;  // [m/s]

bool comes_down(std::uint32_t seed, int kind) {
  ToyBox toys(seed, kind);
  PhysicsWorld& world = toys.world();
  for (int step = 0; step < 360; ++step) {
    world.step(1.0 / 60);
    if (world.last_report().quarantined > 0) return false;
    for (const BodyId body : toys.bodies())
      if (static_cast<double>(world.state(body).linear_velocity.norm()) > kThrown) return false;
  }
  return true;
}

struct Kind {
  const char* name;
  int kind;     // -1: a mixture of all
  int boxes;    // that are played with
  int allowed;  // of them thrown
};
class Toys : public testing::TestWithParam<Kind> {};

TEST_P(Toys, ComeDown) {
  const Kind& of = GetParam();
  int thrown = 0;
  for (int i = 0; i < of.boxes; ++i) {
    const auto seed = static_cast<std::uint32_t>(1000 + i);
    if (comes_down(seed, of.kind)) continue;
    ++thrown;
    std::printf("[ figures  ] box %u of %s is thrown\n", seed, of.name);
  }
  EXPECT_LE(thrown, of.allowed);
}

INSTANTIATE_TEST_SUITE_P(All, Toys,
                         testing::Values(Kind{"ball", 0, 30, 0}, Kind{"hinge", 1, 30, 3},
                                         Kind{"slider", 2, 30, 0}, Kind{"fixed", 3, 30, 0},
                                         Kind{"distance", 4, 15, 0}, Kind{"rope", 5, 15, 0},
                                         Kind{"spring", 6, 15, 0}, Kind{"cone_twist", 7, 30, 0},
                                         Kind{"six_dof", 8, 30, 2}, Kind{"mixture", -1, 60, 1}),
                         [](const auto& played) { return std::string(played.param.name); });

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
