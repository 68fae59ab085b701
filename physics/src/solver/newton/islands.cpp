// Which bodies are solved together, and what of the world belongs to them.
#include <algorithm>
#include <limits>
#include <numeric>

#include "solver/joints/joint_groups.h"
#include "solver/newton/choose.h"
#include "solver/newton/newton_solver.h"
#include "solver/newton/tolerances.h"
#include "world/forced.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

using newton::Island;
using newton::Solver;

bool moves(const WorldState& world, std::uint32_t dense) {
  return dense < world.bodies.awake_end && world.bodies.mass[dense].mass > Real(0);
}

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}
// The smaller index becomes the root, so that roots do not depend on the order of the links.
void link(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
  a = root_of(parents, a);
  b = root_of(parents, b);
  parents[std::max(a, b)] = std::min(a, b);
}

// Calls task(dense a, dense b) for every two bodies that a contact or a joint connects; b may be
// one that does not move.
template <class Task>
void for_links(const WorldState& world, Task&& task) {
  for (const Contact& contact : world.contacts) {
    const Pair& pair = world.pairs[contact.pair];
    std::uint32_t a = world.bodies.dense_of[pair.body_a];
    std::uint32_t b = world.bodies.dense_of[pair.body_b];
    if (!moves(world, a)) std::swap(a, b);
    if (moves(world, a)) task(a, b);
  }
  for (std::uint32_t slot = 0; slot < world.joints.info.size(); ++slot) {
    if (!world.joints.info[slot].alive) continue;
    const JointBodies bodies = bodies_of(world, slot);
    std::uint32_t held[kMaxJointBodies];
    int count = 0;
    for (int k = 0; k < bodies.count; ++k)
      if (is_dynamic_awake(world, bodies.slot[k])) held[count++] = dense_of(world, bodies.slot[k]);
    if (count == 1) task(held[0], 0);
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j) task(held[i], held[j]);
  }
}

// The awake bodies by slot: where they lie in memory differs in a world that was restored.
StepList<std::uint32_t> awake_by_slot(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  StepList<std::uint32_t> slots(bodies.slot_of.begin() + bodies.awake_begin,
                                bodies.slot_of.begin() + bodies.awake_end, &world.memory);
  std::sort(slots.begin(), slots.end());
  return slots;
}

// Gives every component of bodies that something touches or holds an island, by smallest body.
void number_islands(WorldState& world, Solver& solver) {
  const std::uint32_t end = world.bodies.awake_end;
  solver.place.assign(end, {});
  solver.parents.resize(end);
  std::iota(solver.parents.begin(), solver.parents.end(), 0u);
  StepList<std::uint8_t> held(end, 0, &world.memory);
  for_links(world, [&](std::uint32_t a, std::uint32_t b) {
    held[a] = 1;
    if (!moves(world, b)) return;
    held[b] = 1;
    link(solver.parents, a, b);
  });
  solver.count = 0;
  StepList<std::uint32_t> island_of(end, kNone, &world.memory);
  for (const std::uint32_t slot : awake_by_slot(world)) {
    const std::uint32_t i = world.bodies.dense_of[slot];
    const std::uint32_t root = root_of(solver.parents, i);
    if (held[i] == 0) continue;
    if (island_of[root] == kNone) {
      island_of[root] = solver.count++;
      if (solver.islands.size() < solver.count) solver.islands.emplace_back();
      solver.islands[island_of[root]].bodies.clear();
      solver.islands[island_of[root]].edges.clear();
    }
    Island& island = solver.islands[island_of[root]];
    solver.place[i] = {island_of[root], static_cast<int>(island.bodies.size())};
    island.bodies.emplace_back();
    island.bodies.back().dense = i;
  }
  for_links(world, [&](std::uint32_t a, std::uint32_t b) {
    if (a == b || !moves(world, b)) return;
    const auto i = static_cast<std::uint32_t>(solver.place[a].body);
    const auto j = static_cast<std::uint32_t>(solver.place[b].body);
    solver.islands[solver.place[a].island].edges.emplace_back(std::min(i, j), std::max(i, j));
  });
}

void leave_to_fast_solver(Solver& solver, Island& island) {
  for (const newton::IslandBody& body : island.bodies) solver.place[body.dense] = {};
  island.bodies.clear();
  island.edges.clear();
}

// What joints hold together is left to their own direct solver, which takes turns with contacts.
void leave_jointed_islands(WorldState& world, Solver& solver) {
  for (std::uint32_t slot = 0; slot < world.joints.info.size(); ++slot) {
    if (!world.joints.info[slot].alive) continue;
    const JointBodies bodies = bodies_of(world, slot);
    for (int k = 0; k < bodies.count; ++k) {
      const std::uint32_t dense = dense_of(world, bodies.slot[k]);
      if (dense >= solver.place.size() || solver.place[dense].island == kNone) continue;
      Island& island = solver.islands[solver.place[dense].island];
      newton::hear_no_more(world, island);
      leave_to_fast_solver(solver, island);
    }
  }
}

void leave_uncalled_islands(WorldState& world, Solver& solver) {
  for (std::uint32_t i = 0; i < solver.count; ++i) {
    Island& island = solver.islands[i];
    const bool called =
        std::any_of(island.bodies.begin(), island.bodies.end(), [&](const auto& body) {
          return world.bodies.info[world.bodies.slot_of[body.dense]].newton_steps > 0;
        });
    const bool too_large = island.bodies.size() > newton::tolerance::kMostBodies;
    if (called && too_large) newton::hear_no_more(world, island);
    if (!called || too_large) leave_to_fast_solver(solver, island);
  }
}

// The laws of the accurate solver have round cones only.
void leave_grained_islands(const WorldState& world, Solver& solver) {
  for (const Pair& pair : world.pairs) {
    if (!pair.grained || pair.contact_count == 0) continue;
    for (const std::uint32_t body : {pair.body_a, pair.body_b}) {
      const std::uint32_t dense = world.bodies.dense_of[body];
      if (dense >= solver.place.size() || solver.place[dense].island == kNone) continue;
      leave_to_fast_solver(solver, solver.islands[solver.place[dense].island]);
    }
  }
}

}  // namespace

void find_newton_islands(WorldState& world) {
  const ContactSolver wanted = solver_of(world.settings);
  const bool chooses = wanted == ContactSolver::Auto;
  if ((!chooses && wanted != ContactSolver::Newton) || (chooses && !newton::is_called(world))) {
    if (world.newton != nullptr) world.newton->count = 0;
    return;
  }
  if (world.newton == nullptr) world.newton = std::make_shared<Solver>();
  Solver& solver = *world.newton;
  number_islands(world, solver);
  if (chooses) leave_uncalled_islands(world, solver);
  if (chooses && !world.joints.empty()) leave_jointed_islands(world, solver);
  if (world.counts.grained > 0) leave_grained_islands(world, solver);
  solver.too_large = 0;
  StepList<std::uint8_t> fits(solver.count, 0, &world.memory);
  parallel_for(world, solver.count, 1, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      Island& island = solver.islands[i];
      if (island.bodies.empty()) continue;
      std::sort(island.edges.begin(), island.edges.end());
      island.edges.erase(std::unique(island.edges.begin(), island.edges.end()), island.edges.end());
      fits[i] = island.matrix.analyse(static_cast<std::uint32_t>(island.bodies.size()),
                                      island.edges, newton::tolerance::kMostBlocks)
                    ? 1
                    : 0;
    }
  });
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < solver.count; ++i) {
    Island& island = solver.islands[i];
    if (island.bodies.empty()) continue;
    if (fits[i] != 0 && (!chooses || newton::is_within_means(island))) {
      ++kept;
      continue;
    }
    ++solver.too_large;
    if (chooses) newton::hear_no_more(world, island);
    leave_to_fast_solver(solver, island);
  }
  for (std::uint32_t i = 0; i < solver.count; ++i) {
    Island& island = solver.islands[i];
    if (island.bodies.empty()) continue;
    island.budget =
        chooses ? newton::budget_of(island, kept) : std::numeric_limits<std::uint32_t>::max();
  }
}

bool in_newton_island(const WorldState& world, std::uint32_t dense) {
  return dense < world.newton->place.size() && world.newton->place[dense].island != kNone;
}

void gather_newton_islands(WorldState& world) {
  Solver& solver = *world.newton;
  for (std::uint32_t i = 0; i < solver.count; ++i) {
    solver.islands[i].rows.clear();
    solver.islands[i].pieces.clear();
    solver.islands[i].blocks.clear();
    solver.islands[i].total_factorizations = solver.islands[i].fallbacks = 0;
    solver.islands[i].worst_lack = 0;
  }
  const std::uint32_t first = world.colors.empty() ? 0 : world.colors.back().end;
  for (std::uint32_t k = first; k < world.rows.size(); ++k) {
    const ContactRow<Real>& row = world.rows[k];
    const std::uint32_t a = solver.place[row.body_a].island;
    solver.islands[a != kNone ? a : solver.place[row.body_b].island].rows.push_back(k);
  }
  if (!world.joints.empty()) {
    JointScratch& scratch = *world.joints.scratch;
    for (std::uint32_t p = 0; p < scratch.system.pieces.size(); ++p) {
      JointPiece& piece = scratch.system.pieces[p];
      const std::uint32_t body = scratch.members[scratch.order[piece.begin]].body[0];
      if (piece.split || !in_newton_island(world, body)) continue;
      piece.newton = true;
      Island& island = solver.islands[solver.place[body].island];
      island.pieces.push_back(p);
      for (std::uint32_t i = piece.begin; i < piece.end; ++i) island.blocks.push_back(i);
    }
  }
  // Joined bodies that touch nothing fly by themselves (joint_flight.cpp).
  for (std::uint32_t i = 0; i < solver.count; ++i)
    if (solver.islands[i].rows.empty() && solver.islands[i].pieces.empty())
      solver.islands[i].bodies.clear();
}

}  // namespace plumb::inline PLUMB_ABI::detail
