// Bodies side by side: those that go through the step in the plain way (body_kernel.h), as many at
// a time as the kernel has lanes. A body has the same bits in a lane as alone.
#pragma once

#include <algorithm>
#include <bit>

#include "solver/block_pass.h"
#include "solver/body_substep.h"
#include "world/tolerances.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// What the kernel takes: no damping, no locked axes, and the exact flow.
inline bool is_plain(const WorldState& world, std::uint32_t i) {
  const BodyForce& force = world.bodies.force[i];
  const BodyMass& mass = world.bodies.mass[i];
  return mass.mass > Real(0) && mass.angular_locks == 0 && !(force.linear_damping > Real(0)) &&
         !(force.angular_damping > Real(0)) &&
         rotation_of(world.settings) == RotationMethod::Exact &&
         !lacks_gyroscopic_term(world.settings, mass);
}

class PlainBodies {
 public:
  explicit PlainBodies(WorldState& world) : world_(world), kernel_(world.blocks.kernel) {
    BodyStore& bodies = world.bodies;
    static_assert(sizeof(BodyVelocity) == 8 * sizeof(Real) &&
                  sizeof(BodyDelta) == 8 * sizeof(Real) &&
                  sizeof(BodyMomentum) == 4 * sizeof(Real) &&
                  sizeof(BodyMass) == 12 * sizeof(Real) && sizeof(BodyForce) == 8 * sizeof(Real) &&
                  sizeof(SubstepBody) == 32 * sizeof(Real) && sizeof(BodyPose) % sizeof(Real) == 0);
    pass_.velocity = &bodies.velocity.data()->v.x;
    pass_.delta = &world.delta.data()->dp.x;
    pass_.momentum = &bodies.momentum.data()->L.x;
    pass_.orientation = &bodies.pose.data()->q.x;
    pass_.pose_stride = sizeof(BodyPose) / sizeof(Real);
    pass_.mass = &bodies.mass.data()->inverse_mass.x;
    pass_.force = &bodies.force.data()->force.x;
    pass_.substep = &world.substep.data()->v_start.x;
    pass_.h = world.h;
    pass_.dt = world.dt;
    world.body_ways.resize(bodies.awake_end);
    for_chunks([&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) {
        const SubstepBody& s = world.substep[i];
        // Effects may damp a body from substep to substep.
        world.body_ways[i] = !is_plain(world, i) || s.affected ? BodyWay::Other
                             : !s.constrained                  ? BodyWay::Free
                             : !s.split                        ? BodyWay::Held
                                                               : BodyWay::Other;
      }
    });
    all_fly_ = std::all_of(world.body_ways.begin() + bodies.awake_begin, world.body_ways.end(),
                           [](BodyWay way) { return way == BodyWay::Free; });
  }

  // Each runs the kernel on what goes that way; task(i) on what the kernel leaves, and on bodies
  // that go no plain way.
  template <class Task>
  void fly(Task&& task) {
    sweep(BodyWay::Free, task, [&](std::uint32_t first, std::uint32_t which) {
      return kernel_.fly(pass_, first, which);
    });
  }
  template <class Task>
  void kick(Task&& task) {
    sweep(BodyWay::Held, task, [&](std::uint32_t first, std::uint32_t which) {
      kernel_.kick(pass_, first, which);
      return 0u;
    });
  }
  template <class Task>
  void drift(Task&& task) {
    sweep(BodyWay::Held, task, [&](std::uint32_t first, std::uint32_t which) {
      return kernel_.drift(pass_, first, which);
    });
  }
  // weight(i) [s] of the trapezoid.
  template <class Weight, class Task>
  void finish(Weight&& weight, Task&& task) {
    sweep(BodyWay::Held, task, [&](std::uint32_t first, std::uint32_t which) {
      Real weights[BlockHead::kMostLanes]{};
      for (std::uint32_t left = which; left != 0; left &= left - 1) {
        const std::uint32_t lane = static_cast<std::uint32_t>(std::countr_zero(left));
        weights[lane] = weight(first + lane);
      }
      kernel_.finish(pass_, first, which, weights);
      return 0u;
    });
  }

 private:
  template <class Range>
  void for_chunks(Range&& range) {
    const std::uint32_t first = world_.bodies.awake_begin;
    parallel_for(
        world_, world_.bodies.awake_end - first, tolerance::kBodyGrain,
        [&](std::uint32_t begin, std::uint32_t end) { range(first + begin, first + end); });
  }
  template <class Task, class Run>
  void sweep(BodyWay way, Task&& task, Run&& run) {
    if (all_fly_ && way != BodyWay::Free) return;
    const std::uint32_t lanes = static_cast<std::uint32_t>(kernel_.lanes);
    for_chunks([&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t first = begin; first < end; first += lanes) {
        const std::uint32_t count = std::min(lanes, end - first);
        std::uint32_t which = 0, others = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
          which |= (world_.body_ways[first + k] == way ? 1u : 0u) << k;
          others |= (world_.body_ways[first + k] == BodyWay::Other ? 1u : 0u) << k;
        }
        // The kernel reads all its lanes: not past the last body.
        if (lanes == 1 || count < lanes) {
          others |= which;
        } else if (which != 0) {
          others |= run(first, which);
        }
        for (; others != 0; others &= others - 1)
          task(first + static_cast<std::uint32_t>(std::countr_zero(others)));
      }
    });
  }

  WorldState& world_;
  BlockKernel kernel_;
  BodyPass pass_;
  bool all_fly_ = false;
};

}  // namespace plumb::inline PLUMB_ABI::detail
