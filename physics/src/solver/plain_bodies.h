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
inline bool goes_plainly(const WorldState& world, std::uint32_t i) {
  const BodyForce& force = world.bodies.force[i];
  const BodyMass& mass = world.bodies.mass[i];
  return mass.mass > Real(0) && mass.angular_locks == 0 && !(force.linear_damping > Real(0)) &&
         !(force.angular_damping > Real(0)) &&
         rotation_of(world.settings) == RotationMethod::Exact &&
         !lacks_gyroscopic_term(world.settings, mass);
}

// How every awake body goes through this step.
inline void choose_body_ways(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  world.body_ways.resize(bodies.awake_end);
  parallel_for(world, bodies.awake_end - bodies.awake_begin, tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t k = begin; k < end; ++k) {
                   const std::uint32_t i = bodies.awake_begin + k;
                   const SubstepBody& s = world.substep[i];
                   // Effects may damp a body from substep to substep.
                   world.body_ways[i] = !goes_plainly(world, i) || s.affected ? BodyWay::Other
                                        : !s.constrained                      ? BodyWay::Free
                                        : !s.split                            ? BodyWay::Held
                                                                              : BodyWay::Other;
                 }
               });
  world.groups.all_fly =
      std::all_of(world.body_ways.begin() + bodies.awake_begin, world.body_ways.end(),
                  [](BodyWay way) { return way == BodyWay::Free; });
}

class PlainBodies {
 public:
  // The bodies of a group, or all that are awake.
  PlainBodies(WorldState& world, BlockKernel kernel, const StepGroup& group)
      : PlainBodies(world, kernel, group.bodies, group.jobs, group.number) {}
  PlainBodies(WorldState& world, BlockKernel kernel)
      : PlainBodies(world, kernel, {world.bodies.awake_begin, world.bodies.awake_end}, world.jobs,
                    kAllGroups) {}

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
  static constexpr std::uint32_t kAllGroups = kNone;

  PlainBodies(WorldState& world, BlockKernel kernel, IndexRange range, JobSystem* jobs,
              std::uint32_t group)
      : world_(world), kernel_(kernel), range_(range), jobs_(jobs), group_(group) {
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
  }

  [[nodiscard]] bool is_mine(std::uint32_t i) const {
    return group_ == kAllGroups || world_.groups.group_of[i] == group_;
  }
  template <class Task, class Run>
  void sweep(BodyWay way, Task&& task, Run&& run) {
    if (world_.groups.all_fly && way != BodyWay::Free) return;
    parallel_for(jobs_, range_.end - range_.begin, tolerance::kBodyGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   sweep_chunk(range_.begin + begin, range_.begin + end, way, task, run);
                 });
  }
  template <class Task, class Run>
  void sweep_chunk(std::uint32_t begin, std::uint32_t end, BodyWay way, Task&& task, Run&& run) {
    const std::uint32_t lanes = static_cast<std::uint32_t>(kernel_.lanes);
    for (std::uint32_t first = begin; first < end; first += lanes) {
      const std::uint32_t count = std::min(lanes, end - first);
      std::uint32_t which = 0, others = 0;
      for (std::uint32_t k = 0; k < count; ++k) {
        const BodyWay its = is_mine(first + k) ? world_.body_ways[first + k] : BodyWay::None;
        which |= (its == way ? 1u : 0u) << k;
        others |= (its == BodyWay::Other ? 1u : 0u) << k;
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
  }

  WorldState& world_;
  BlockKernel kernel_;
  IndexRange range_;
  JobSystem* jobs_;
  std::uint32_t group_;
  BodyPass pass_;
};

}  // namespace plumb::inline PLUMB_ABI::detail
