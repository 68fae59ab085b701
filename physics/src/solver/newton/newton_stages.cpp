// The islands' part in the substeps.
#include "solver/body_substep.h"
#include "solver/joints/joint_motion.h"
#include "solver/joints/joint_scratch.h"
#include "solver/joints/joint_solver.h"
#include "solver/newton/island_build.h"
#include "solver/newton/newton_method.h"
#include "solver/row_end.h"
#include "world/forced.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using newton::Island;
using newton::Twist;

template <class Task>
void for_islands(WorldState& world, Task&& task) {
  newton::Solver& solver = *world.newton;
  parallel_for(world, solver.count, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i)
      if (!solver.islands[i].bodies.empty()) task(solver.islands[i]);
  });
}

void write_velocities(WorldState& world, const Island& island) {
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    BodyVelocity& velocity = world.bodies.velocity[island.bodies[i].dense];
    velocity.v = cast<Real>(island.v[i].v);
    velocity.w = cast<Real>(island.v[i].w);
  }
}

bool overlaps(const Island& island) {
  for (const newton::IslandContact& c : island.contacts)
    for (int i = 0; i < c.count; ++i)
      if (c.points[i].push != 0) return true;
  for (const newton::ScalarLaw& law : island.laws)
    if (law.push != 0) return true;
  return false;
}

void keep_as_warm(Island& island) {
  for (newton::IslandContact& c : island.contacts) {
    for (int i = 0; i < c.count; ++i) c.points[i].warm = c.points[i].center;
    c.turn_warm = c.turn_center;
  }
  for (newton::ScalarLaw& law : island.laws) law.warm = law.center;
}

void count_effort(Island& island) {
  island.total_factorizations += static_cast<std::uint32_t>(island.factorizations);
  if (island.fell_back) ++island.fallbacks;
  island.worst_lack = std::max(island.worst_lack, island.lack);
}

void solve_island(WorldState& world, Island& island) {
  for (const std::uint32_t b : island.blocks)
    note_approaches(world.joints.scratch->blocks[b], world);
  newton::fill_island(world, *world.newton, island);
  newton::solve(island);
  island.v_rest = island.v;
  newton::store_island(world, island);
  count_effort(island);
  if (overlaps(island) && island.total_factorizations < island.budget) {
    island.solves_positions = true;
    keep_as_warm(island);
    newton::solve(island);
    count_effort(island);
  }
  write_velocities(world, island);
}

// After the drift: what pushed bodies apart goes; joints are closed.
void settle_island(WorldState& world, Island& island) {
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const std::uint32_t dense = island.bodies[i].dense;
    const Twist push = island.v_rest[i] - island.v[i];
    BodyVelocity& velocity = world.bodies.velocity[dense];
    velocity.v = cast<Real>(island.v_rest[i].v);
    velocity.w += cast<Real>(push.w);
    collect_momentum(world, dense);
    world.substep[dense].w_in = velocity.w;
  }
  if (!island.blocks.empty()) {
    JointScratch& scratch = *world.joints.scratch;
    for (const std::uint32_t b : island.blocks) prepare_joint(world, scratch.blocks[b]);
    for (const std::uint32_t p : island.pieces) close_joints_of(world, scratch.system.pieces[p]);
    for (const std::uint32_t b : island.blocks) {
      sum_joint(scratch.blocks[b], world, JointPass::Relax);
      note_rates(scratch.blocks[b], world);
    }
  }
  for (const newton::IslandContact& contact : island.contacts) {
    ContactRow<Real>& row = world.rows[contact.row];
    if (contact.count > 0)
      note_load(world, row, static_cast<Real>(contact.load), static_cast<Real>(contact.sliding));
    if (contact.rests) mark_loaded_points(row);
    close_row(world, row);
  }
}

}  // namespace

void solve_newton_islands(WorldState& world) {
  for_islands(world, [&](Island& island) { solve_island(world, island); });
}

void settle_newton_islands(WorldState& world) {
  for_islands(world, [&](Island& island) { settle_island(world, island); });
}

void report_newton_islands(WorldState& world) {
  const bool chosen = solver_of(world.settings) == ContactSolver::Auto;
  StepReport& report = world.report;
  const newton::Solver& solver = *world.newton;
  report.newton_too_large = solver.too_large;
  for (std::uint32_t i = 0; i < solver.count; ++i) {
    const Island& island = solver.islands[i];
    if (island.bodies.empty()) continue;
    ++report.newton_islands;
    report.newton_factorizations += island.total_factorizations;
    report.newton_fallbacks += island.fallbacks;
    report.newton_residual = std::max(report.newton_residual, island.worst_lack);
    if (chosen) newton::note_effort(world, island);
  }
}

}  // namespace plumb::inline PLUMB_ABI::detail
