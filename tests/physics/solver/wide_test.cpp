// Proves that several numbers side by side are what each of them is alone, and that a step has the
// same bits whatever the vector length of the kernel, in every kind of scene.
#include "math/wide.h"

#include <gtest/gtest.h>

#include <numeric>

#include "solver/body_kernel.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace scenes;
using namespace detail;

template <int W>
void expect_quads_come_back() {
  constexpr std::uint32_t kRecords = 40;
  constexpr std::size_t kStride = 7;  // a record need not be a whole number of quads
  std::vector<Real> memory(kRecords * kStride);
  std::iota(memory.begin(), memory.end(), Real(1));
  std::uint32_t index[W];
  for (std::uint32_t i = 0; i < W; ++i) index[i] = (11 * i + 3) % kRecords;
  const Quad<Real, W> quad = gather_quad<Real, W>(memory.data() + 2, kStride, index);
  for (int i = 0; i < W; ++i) {
    const Real first = memory[2 + index[i] * kStride];
    EXPECT_EQ(quad.x.v[i], first);
    EXPECT_EQ(quad.y.v[i], first + 1);
    EXPECT_EQ(quad.z.v[i], first + 2);
    EXPECT_EQ(quad.w.v[i], first + 3);
  }
  std::vector<Real> other(memory.size(), Real(0));
  const std::uint32_t which = 0x5555u & ((1u << W) - 1u);
  scatter_quad<Real, W>(quad, other.data() + 2, kStride, index, which);
  for (std::size_t k = 0; k < other.size(); ++k) {
    bool written = false;
    for (std::uint32_t i = 0; i < W; ++i)
      written |=
          (which >> i & 1u) != 0 && k >= 2 + index[i] * kStride && k < 6 + index[i] * kStride;
    EXPECT_EQ(other[k], written ? memory[k] : Real(0)) << k;
  }
}
TEST(Wide, RecordsBecomeLanesAndComeBack) {
  expect_quads_come_back<2>();
  expect_quads_come_back<4>();
  expect_quads_come_back<8>();
  expect_quads_come_back<16>();
}

TEST(Wide, ComparesAndChoosesLaneByLane) {
  using Four = Wide<Real, 4>;
  Four a(Real(0)), b(Real(1));
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  const Real values[4] = {Real(-2), Real(0.5), Real(3), nan};
  for (int i = 0; i < 4; ++i) a.v[i] = values[i];
  EXPECT_EQ(bits_of(a < b), 0b0011u);
  EXPECT_EQ(bits_of(a > b), 0b0100u);
  EXPECT_EQ(bits_of(negate(a < b)), 0b1100u);
  EXPECT_FALSE(all(a < b));
  EXPECT_TRUE(any(a < b));
  const Four larger = larger_of(a, b), root = root_of(b + b);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(larger.v[i], larger_of(values[i], Real(1)));
    EXPECT_EQ(root.v[i], std::sqrt(Real(2)));
  }
  EXPECT_TRUE(std::isnan(larger.v[3]));  // the first one where they cannot be compared
  EXPECT_TRUE(std::isnan(larger_of(nan, Real(1))));
}

// The flow that bodies in contact take against the one that does everything.
TEST(Wide, TheShortFlowIsTheExactFlowWhereItTakesABody) {
  testing_support::Random random(9);
  // Each rounds an angle of up to 1.5 rad, in four components.
  const double tolerance = sizeof(Real) == 4 ? 1e-6 : 2e-15;
  int taken = 0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector3d w =
        std::pow(10.0, random.uniform(-6, 3)) *
        (random.rotation(testing_support::kPi).cast<double>() * Eigen::Vector3d::UnitX());
    const Quat start = random.rotation(testing_support::kPi);
    Rotation q{start.x(), start.y(), start.z(), start.w()}, exact = q;
    const auto moment = [&] { return real(1 / random.uniform(0.5, 3)); };
    const Vec J = k % 3 == 0 ? Vec{1, 1, 1} : Vec{moment(), moment(), moment()};
    const Vec L{real(w.x()), real(w.y()), real(w.z())};
    const Real h = real(1.0 / 240);
    if (!turn_by_one_piece(q, L, J, h)) {
      EXPECT_EQ(q.x, exact.x);
      EXPECT_EQ(q.w, exact.w);
      continue;
    }
    ++taken;
    advance_rotation(exact, L, J, h);
    const double error = std::abs(static_cast<double>(q.x - exact.x)) +
                         std::abs(static_cast<double>(q.y - exact.y)) +
                         std::abs(static_cast<double>(q.z - exact.z)) +
                         std::abs(static_cast<double>(q.w - exact.w));
    EXPECT_LE(error, tolerance) << w.transpose();
  }
  EXPECT_GT(taken, 1000);
  EXPECT_LT(taken, 2000);
}

// Everything that has a way of its own through the step: bounces, rolling friction, a belt,
// damping, locked axes, fast spins, joints, deep overlap.
Built build_everything(PhysicsWorld& world) {
  Built built = build_pile(world, {.side = 5});
  const auto add_body = [&](const RigidBody& body, const Collider& collider) {
    built.bodies.push_back(add(world, body, collider));
  };
  for (int i = 0; i < 9; ++i) {
    RigidBody body = moving(at(-3 + i, 9, 0.1 * i), vec(0, 0, 0), vec(0, 5.0 * i * i, 1));
    if (i % 3 == 1) body.angular_damping = body.linear_damping = real(0.4);
    if (i % 3 == 2) body.locks.angular_x = true;
    Collider collider = with(box(0.2, 0.3, 0.4), material(0.4, i % 2 == 0 ? 0.6 : 0));
    if (i % 4 == 3) collider.material.rolling_friction = real(0.02);
    add_body(body, collider);
  }
  Collider belt = with(box(2, 0.2, 2));
  belt.surface_velocity.linear = vec(1, 0, 0);
  add(world, body_at(at(0, 0.3, 0), MotionType::Static), belt);
  for (int i = 0; i < 6; ++i)  // inside one another
    add_body(body_at(at(3 + 0.1 * i, 12, 3)), with(cube(0.4)));
  Joint ball;
  ball.body_a = built.bodies[0];
  ball.body_b = built.bodies[1];
  must(world.create_joint(ball));
  return built;
}
std::vector<std::uint64_t> hashes(int kernel_bits, bool with_effects) {
  PhysicsWorld world;
  StepDiagnostics diagnostics;
  diagnostics.kernel_bits = kernel_bits;
  world.set_diagnostics(diagnostics);
  build_everything(world);
  if (with_effects) {
    must(world.create_effect({.kind = Drag{.linear = 2, .quadratic = real(0.3)}}));
    must(world.create_effect({.kind = Magnus{real(0.05)}}));
  }
  std::vector<std::uint64_t> out;
  for (int i = 0; i < 150; ++i) {
    world.step(1.0 / 60);
    out.push_back(world.state_hash());
  }
  return out;
}
void expect_the_same_bits(bool with_effects) {
  const std::vector<std::uint64_t> alone = hashes(1, with_effects);
  EXPECT_EQ(alone, hashes(128, with_effects));
  EXPECT_EQ(alone, hashes(256, with_effects));
  EXPECT_EQ(alone, hashes(512, with_effects));
  EXPECT_EQ(alone, hashes(0, with_effects));
}
TEST(Wide, AStepHasTheSameBitsForEveryVectorLength) { expect_the_same_bits(false); }
TEST(Wide, AStepHasTheSameBitsWhereEffectsActOnWhatTouches) { expect_the_same_bits(true); }

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
