// What the rest of the world does with effects. Every call below is behind a test for their being
// any.
#pragma once

#include "plumb/snapshot.h"
#include "world/snapshot_table.h"
#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

// --- within run_substeps() ---
void begin_effects(WorldState& world);   // the step: who acts on whom
void act_effects(WorldState& world);     // a substep: forces, and the flight of what no row holds
void settle_effects(WorldState& world);  // ... done: the books
void end_effects(WorldState& world);     // the step done

// --- between steps ---
Status check_effect(const WorldState& world, const Effect& effect);
void note_effects(WorldState& world);  // after any was made or taken away
void remove_effects_of(WorldState& world, std::uint32_t body);
// Kinematic bodies sleep alone: when one is moved, what springs tie to it wakes.
void wake_tied(WorldState& world, std::uint32_t body);
void link_tied(WorldState& world);  // islands: springs link the bodies that they tie
// For the plan: effects of a kind, and dynamic bodies that are awake and within their reach.
inline PlanItem item_of_effect(std::size_t kind) {
  return static_cast<PlanItem>(static_cast<std::size_t>(PlanItem::PointGravity) + kind);
}
std::uint32_t effects_of_kind(const WorldState& world, std::size_t kind);
std::uint32_t bodies_reached(const WorldState& world, std::size_t kind);
double effect_potential(const WorldState& world);

void save_effects(ColumnWriter& out, const WorldState& world);
bool restore_effects(const Snapshot& in, WorldState& world);
std::uint64_t digest_of_effects(const WorldState& world);

}  // namespace plumb::inline PLUMB_ABI::detail
