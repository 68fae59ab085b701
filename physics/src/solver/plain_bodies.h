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

// How an awake body goes through this step, as far as is known before joints and effects.
inline void choose_body_way(WorldState& world, std::uint32_t i) {
  const SubstepBody& s = world.substep[i];
  // Effects may damp a body from substep to substep.
  world.body_ways[i] = !goes_plainly(world, i) || s.affected ? BodyWay::Other
                       : !s.constrained                      ? BodyWay::Free
                       : !s.split                            ? BodyWay::Held
                                                             : BodyWay::Other;
}
inline void choose_body_ways_anew(WorldState& world) {
  const std::uint32_t first = world.bodies.awake_begin;
  parallel_for(world, world.bodies.awake_end - first, tolerance::kBodyGrain,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t i = begin; i < end; ++i) choose_body_way(world, first + i);
               });
}
inline bool all_bodies_fly(const WorldState& world) {
  return std::all_of(world.body_ways.begin() + world.bodies.awake_begin, world.body_ways.end(),
                     [](BodyWay way) { return way == BodyWay::Free; });
}

class PlainBodies {
 public:
  // The bodies of a group; it keeps their chunks.
  PlainBodies(WorldState& world, BlockKernel kernel, StepGroup& group)
      : PlainBodies(world, kernel, group.h) {
    jobs_ = group.jobs;
    chunks_ = &group.chunks;
    group.chunks.clear();
    if (world.groups.all_fly) return;
    const std::uint32_t lanes = static_cast<std::uint32_t>(kernel_.lanes);
    for (std::uint32_t first = group.bodies.begin; first < group.bodies.end; first += lanes) {
      const BodyChunk chunk =
          chunk_at(first, group.bodies.end, BodyWay::Held,
                   [&](std::uint32_t i) { return world.groups.group_of[i] == group.number; });
      if ((chunk.kernel | chunk.alone) != 0) group.chunks.push_back(chunk);
    }
  }

  // All that are awake and held by nothing fly through the step; task(i) those that the kernel
  // leaves.
  template <class Task>
  static void fly(WorldState& world, BlockKernel kernel, Task&& task) {
    const PlainBodies bodies(world, kernel, world.h);
    const std::uint32_t first_body = world.bodies.awake_begin;
    parallel_for(world, world.bodies.awake_end - first_body, tolerance::kBodyGrain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   const std::uint32_t lanes = static_cast<std::uint32_t>(kernel.lanes);
                   for (std::uint32_t first = begin; first < end; first += lanes)
                     bodies.run(bodies.chunk_at(first_body + first, first_body + end, BodyWay::Free,
                                                [](std::uint32_t) { return true; }),
                                task, [&](std::uint32_t at, std::uint32_t which) {
                                  return kernel.fly(bodies.pass_, at, which);
                                });
                 });
  }

  // Each runs the kernel on what goes the plain way; task(i) on what the kernel leaves, and on
  // bodies that go no plain way.
  template <class Task>
  void kick(Task&& task) const {
    sweep(task, [&](std::uint32_t first, std::uint32_t which) {
      kernel_.kick(pass_, first, which);
      return 0u;
    });
  }
  template <class Task>
  void drift(Task&& task) const {
    sweep(task, [&](std::uint32_t first, std::uint32_t which) {
      return kernel_.drift(pass_, first, which);
    });
  }
  // weight(i) [s] of the trapezoid.
  template <class Weight, class Task>
  void finish(Weight&& weight, Task&& task) const {
    sweep(task, [&](std::uint32_t first, std::uint32_t which) {
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
  PlainBodies(WorldState& world, BlockKernel kernel, Real h) : world_(world), kernel_(kernel) {
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
    pass_.h = h;
    pass_.dt = world.dt;
  }

  template <class Mine>
  [[nodiscard]] BodyChunk chunk_at(std::uint32_t first, std::uint32_t end, BodyWay way,
                                   Mine&& mine) const {
    const std::uint32_t lanes = static_cast<std::uint32_t>(kernel_.lanes);
    const std::uint32_t count = std::min(lanes, end - first);
    BodyChunk chunk{.first = first};
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!mine(first + k)) continue;
      chunk.kernel |= (world_.body_ways[first + k] == way ? 1u : 0u) << k;
      chunk.alone |= (world_.body_ways[first + k] == BodyWay::Other ? 1u : 0u) << k;
    }
    if (lanes > 1 && count == lanes) return chunk;
    // The kernel reads all its lanes: not past the last body.
    chunk.alone |= chunk.kernel;
    chunk.kernel = 0;
    return chunk;
  }
  template <class Task, class Run>
  void run(const BodyChunk& chunk, Task&& task, Run&& kernel) const {
    std::uint32_t left = chunk.alone;
    if (chunk.kernel != 0) left |= kernel(chunk.first, chunk.kernel);
    for (; left != 0; left &= left - 1)
      task(chunk.first + static_cast<std::uint32_t>(std::countr_zero(left)));
  }
  template <class Task, class Run>
  void sweep(Task&& task, Run&& kernel) const {
    const std::uint32_t grain =
        std::max(tolerance::kBodyGrain / static_cast<std::uint32_t>(kernel_.lanes), 1u);
    parallel_for(jobs_, static_cast<std::uint32_t>(chunks_->size()), grain,
                 [&](std::uint32_t begin, std::uint32_t end) {
                   for (std::uint32_t k = begin; k < end; ++k) run((*chunks_)[k], task, kernel);
                 });
  }

  WorldState& world_;
  BlockKernel kernel_;
  JobSystem* jobs_ = nullptr;
  const std::vector<BodyChunk>* chunks_ = nullptr;
  BodyPass pass_;
};

template <class Task>
void for_bodies_of(const BodyChunk& chunk, Task&& task) {
  for (std::uint32_t left = chunk.kernel | chunk.alone; left != 0; left &= left - 1)
    task(chunk.first + static_cast<std::uint32_t>(std::countr_zero(left)));
}
// Calls task(dense) for the bodies of a group that its substeps concern.
template <class Task>
void for_bodies_of(const StepGroup& group, Task&& task) {
  for (const BodyChunk& chunk : group.chunks) for_bodies_of(chunk, task);
}
// The same by all threads, in any order.
template <class Task>
void for_bodies_at_once(const StepGroup& group, Task&& task) {
  parallel_for(group.jobs, static_cast<std::uint32_t>(group.chunks.size()),
               tolerance::kBodyGrain / BlockHead::kMostLanes,
               [&](std::uint32_t begin, std::uint32_t end) {
                 for (std::uint32_t k = begin; k < end; ++k) for_bodies_of(group.chunks[k], task);
               });
}

}  // namespace plumb::inline PLUMB_ABI::detail
