// What one body costs that tumbles freely, in the kernel that takes as many at a time as a vector
// holds: reading its records, the torque-free flow, writing them. `fly` is a whole step of a body
// that meets nothing, `drift` a substep of one that rows hold. Few enough that all stays in the
// processor's nearest caches.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "solver/block_pass.h"
#include "solver/contact_blocks.h"
#include "support/random.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI {
namespace {

using namespace detail;

constexpr std::uint32_t kBodies = 512;

// Boxes of 0.2 x 0.4 x 0.6 m and of water's density, as in the anchor scene S4.
struct Tumblers {
  std::vector<BodyVelocity> velocity{kBodies};
  std::vector<BodyDelta> delta{kBodies};
  std::vector<BodyMomentum> momentum{kBodies};
  std::vector<BodyPose> pose{kBodies};
  std::vector<BodyMass> mass{kBodies};
  std::vector<BodyForce> force{kBodies};
  std::vector<SubstepBody> substep{kBodies};

  explicit Tumblers(double spin) {  // [rad/s] about each axis, at most
    testing_support::Random random(4);
    const Vec moments{Real(2.08), Real(1.6), Real(0.8)};  // [kg m^2]
    for (std::uint32_t i = 0; i < kBodies; ++i) {
      const Quat start = random.rotation(testing_support::kPi);
      pose[i].q = {start.x(), start.y(), start.z(), start.w()};
      mass[i].mass = Real(48);
      mass[i].moments = moments;
      mass[i].inverse_moments = {1 / moments.x, 1 / moments.y, 1 / moments.z};
      const auto some = [&] { return static_cast<Real>(random.uniform(-spin, spin)); };
      momentum[i].L = multiply_each(moments, Vec{some(), some(), some()});
    }
  }
  BodyPass pass(Real dt) {
    BodyPass out;
    out.velocity = &velocity[0].v.x;
    out.delta = &delta[0].dp.x;
    out.momentum = &momentum[0].L.x;
    out.orientation = &pose[0].q.x;
    out.pose_stride = sizeof(BodyPose) / sizeof(Real);
    out.mass = &mass[0].inverse_mass.x;
    out.force = &force[0].force.x;
    out.substep = &substep[0].v_start.x;
    out.h = out.dt = dt;
    return out;
  }
};

// Bits of the vector; spin.
void tumble(benchmark::State& state,
            std::uint32_t (*BlockKernel::*what)(const BodyPass&, std::uint32_t, std::uint32_t)) {
  const int bits = static_cast<int>(state.range(0));
  const BlockKernel kernel = choose_block_kernel(bits);
  if (kernel.lanes * 8 * static_cast<int>(sizeof(Real)) != bits) {
    state.SkipWithError("this processor has no such vectors");
    return;
  }
  Tumblers bodies(static_cast<double>(state.range(1)));
  const BodyPass pass = bodies.pass(Real(1) / 60);
  const std::uint32_t lanes = static_cast<std::uint32_t>(kernel.lanes), all = (1u << lanes) - 1u;
  std::uint32_t left = 0;
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < kBodies; i += lanes) left |= (kernel.*what)(pass, i, all);
  }
  // Bodies that turn too fast for one piece would go another way, which is not timed here.
  if (left != 0) state.SkipWithError("some body turns too fast for one piece");
  state.counters["each"] =
      benchmark::Counter(kBodies, benchmark::Counter::kIsIterationInvariantRate |
                                      benchmark::Counter::kInvert);  // [s a body]
  state.counters["lanes"] = kernel.lanes;
}
#define PLUMB_FLOW_SIZES ArgNames({"bits", "spin"})->ArgsProduct({{128, 256, 512}, {1, 5}})
BENCHMARK_CAPTURE(tumble, fly, &BlockKernel::fly)->PLUMB_FLOW_SIZES;
BENCHMARK_CAPTURE(tumble, drift, &BlockKernel::drift)->PLUMB_FLOW_SIZES;

}  // namespace
}  // namespace plumb::inline PLUMB_ABI
