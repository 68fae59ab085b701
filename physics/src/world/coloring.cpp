// Graph colouring: rows of one colour share no dynamic body, so that they can be solved at once, by
// several threads or several lanes, with the same result in any order.
//
// Greedy, from nothing in every step, in the order of pairs; deterministic by construction.
// Contacts with what does not move come last in each colour's turn of choice: they take the lowest
// free colour of one body only.
#include <bit>

#include "solver/newton/newton_solver.h"
#include "solver/worst_first.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {
namespace {

constexpr int kColors = 64;  // bits of a body's mask; the last one is the overflow
constexpr int kOverflow = kColors - 1;
// Rows that the passes leave to Newton's method, or to the worst-first resolver: behind all others.
constexpr int kUncolored = kColors;

}  // namespace

void color_contacts(WorldState& world) {
  const BodyStore& bodies = world.bodies;
  world.color_mask.assign(bodies.awake_end, 0);
  const auto mask_of = [&](std::uint32_t body) -> std::uint64_t* {
    const std::uint32_t dense = bodies.dense_of[body];
    return bodies.mass[dense].mass > Real(0) && dense < bodies.awake_end ? &world.color_mask[dense]
                                                                         : nullptr;
  };
  const bool worst_first = resolves_worst_first(world);
  const bool newton = world.newton != nullptr && world.newton->count > 0;
  std::uint32_t counts[kColors + 1] = {};
  StepList<std::uint8_t> color_of(world.contacts.size(), &world.memory);
  for (std::size_t i = 0; i < world.contacts.size(); ++i) {
    const Pair& pair = world.pairs[world.contacts[i].pair];
    std::uint64_t* a = mask_of(pair.body_a);
    std::uint64_t* b = mask_of(pair.body_b);
    if (worst_first || (newton && (in_newton_island(world, bodies.dense_of[pair.body_a]) ||
                                   in_newton_island(world, bodies.dense_of[pair.body_b])))) {
      color_of[i] = kUncolored;
      continue;
    }
    const std::uint64_t used = (a != nullptr ? *a : 0) | (b != nullptr ? *b : 0);
    const int color = std::min(std::countr_one(used), kOverflow);
    if (color < kOverflow) {
      if (a != nullptr) *a |= std::uint64_t{1} << color;
      if (b != nullptr) *b |= std::uint64_t{1} << color;
    }
    color_of[i] = static_cast<std::uint8_t>(color);
    ++counts[static_cast<std::size_t>(color) + 1];
  }
  world.colors.clear();
  for (int c = 0; c < kColors; ++c) {
    const std::size_t k = static_cast<std::size_t>(c);
    const std::uint32_t begin = counts[k], size = counts[k + 1];
    counts[k + 1] += begin;
    if (size == 0) continue;
    if (c < kOverflow) {
      world.colors.push_back({begin, begin + size});
    } else {  // rows beyond the last colour share bodies: one after the other
      for (std::uint32_t i = 0; i < size; ++i) world.colors.push_back({begin + i, begin + i + 1});
    }
  }
  // counts[kColors]: where the rows without a colour begin.
  world.row_order.resize(world.contacts.size());
  for (std::uint32_t i = 0; i < world.contacts.size(); ++i)
    world.row_order[counts[color_of[i]]++] = i;
  world.report.colors = static_cast<std::uint32_t>(world.colors.size());
}

}  // namespace plumb::inline PLUMB_ABI::detail
