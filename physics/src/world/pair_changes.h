// What a change of bodies or colliders between two steps does to the pairs that exist. Pairs that
// sleep are woken first, so that the awake ones are all that it concerns.
#pragma once

#include <cstddef>
#include <vector>

#include "world/world_state.h"

namespace plumb::inline PLUMB_ABI::detail {

inline bool involves(const Pair& pair, std::uint32_t collider) {
  return pair.collider_a() == collider || pair.collider_b() == collider;
}
inline bool involves_body(const Pair& pair, std::uint32_t body) {
  return pair.body_a == body || pair.body_b == body;
}

// A body and what lies on it, or it lies on.
inline void wake_with_neighbours(WorldState& world, std::uint32_t body) {
  wake_body(world, body);
  wake_around(world, body);
}

// The collider looks for others in the next step, wherever it is.
inline void seek_pairs(WorldState& world, std::uint32_t slot) {
  ColliderInfo& collider = world.colliders.info[slot];
  if (collider.query_pairs) return;
  collider.query_pairs = true;
  world.query_list.push_back(slot);
}

// Ends the pairs for which `gone` holds, with their events.
template <class Gone>
void end_pairs(WorldState& world, Gone&& gone) {
  world.pairs.remove_if([&](const Pair& pair) {
    if (!gone(pair)) return false;
    note_pair_end(world, pair);
    return true;
  });
}
// ... those that may not meet any more, among the ones that `concerns`.
template <class Concerns>
void refilter_pairs(WorldState& world, Concerns&& concerns) {
  end_pairs(world, [&](const Pair& pair) {
    return concerns(pair) && !may_meet(world, pair.collider_a(), pair.collider_b());
  });
}

// Gives pairs the numbers that their colliders have now.
template <class Concerns>
void remake_pairs(WorldState& world, Concerns&& concerns) {
  for (std::size_t i = 0; i < world.pairs.size(); ++i)
    if (concerns(world.pairs[i])) world.pairs[i] = remake_pair(world, world.pairs[i]);
}

// The pairs of one body over a change of its mass, shapes or motion type. Contacts are told from a
// centre of mass: where that moves, or another one takes its place, they stay where they are in the
// world. No pair may come or go in between.
class PairsOfBody {
 public:
  PairsOfBody(const WorldState& world, std::uint32_t body) {
    for (std::size_t i = 0; i < world.pairs.size(); ++i)
      if (involves_body(world.pairs[i], body))
        seen_.push_back({i, reference_of(world, world.pairs[i])});
  }
  void remake(WorldState& world) const {
    world.contacts_fit = 0;
    for (const Seen& seen : seen_) {
      Pair& pair = world.pairs[seen.pair];
      pair = remake_pair(world, pair);
      for (Contact& contact : contacts_of(pair, world.contacts)) contact.kept.margin = Real(-1);
      const Vec shift = cast<Real>(seen.from - reference_of(world, pair));
      if (!(length_squared(shift) > Real(0))) continue;
      for (Contact& contact : contacts_of(pair, world.contacts))
        for (int k = 0; k < contact.manifold.count; ++k)
          contact.manifold.points[k].position += shift;
    }
  }

 private:
  struct Seen {
    std::size_t pair;
    PosVec from;
  };
  static PosVec reference_of(const WorldState& world, const Pair& pair) {
    const std::uint32_t body = pair.relative_to_b ? pair.body_b : pair.body_a;
    return world.bodies.pose[world.bodies.info[body].dense].x;
  }
  std::vector<Seen> seen_;
};

// After its colliders have moved, grown or changed trees: their boxes, and what these reach.
inline void refresh_boxes(WorldState& world, std::uint32_t body) {
  for (const std::uint32_t slot : world.bodies.info[body].colliders)
    update_proxy(world, slot, true);
}

}  // namespace plumb::inline PLUMB_ABI::detail
