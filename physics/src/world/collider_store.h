// Colliders, by slot.
#pragma once

#include <cstdint>
#include <vector>

#include "collision/aabb_tree.h"
#include "collision/collision_shape.h"
#include "plumb/collider.h"
#include "plumb/ids.h"
#include "world/slots.h"

namespace plumb::inline PLUMB_ABI::detail {

struct ColliderInfo {
  std::uint32_t generation = 0;
  bool alive = false;
  bool is_static = false;  // of a static body
  bool asleep = false;     // of a body in a sleeping island
  std::uint32_t body = 0;  // slot
  std::int32_t proxy = AabbTree::kNull;
  bool query_pairs = false;  // its box grew since pairs were last sought
  Collider component;        // as given
  CollisionShape shape;
  Transform in_body;   // shape placed relative to the centre of mass, principal axes
  Real thickness = 0;  // [m]
  Real farthest = 0;   // [m] point from the body's centre of mass, at most
};

// The boxes of all colliders, in three trees: a step refits only that of what moves, and its
// queries pass over the others quickly however much lies in them.
struct ColliderTrees {
  AabbTree of_static, of_moving, of_sleeping;

  [[nodiscard]] AabbTree& of(const ColliderInfo& collider) {
    return collider.is_static ? of_static : collider.asleep ? of_sleeping : of_moving;
  }
  [[nodiscard]] const AabbTree& of(const ColliderInfo& collider) const {
    return collider.is_static ? of_static : collider.asleep ? of_sleeping : of_moving;
  }
  // visit(slot) for the colliders of bodies that are not static.
  template <class Visit>
  void query_movable(const WorldAabb& box, Visit&& visit) const {
    of_moving.query(box, visit);
    of_sleeping.query(box, visit);
  }
  // Into the tree of what sleeps, or back.
  void set_asleep(ColliderInfo& collider, std::uint32_t slot, bool asleep) {
    if (collider.is_static || collider.asleep == asleep) return;
    const WorldAabb box = of(collider).box(collider.proxy);
    of(collider).remove(collider.proxy);
    collider.asleep = asleep;
    collider.proxy = of(collider).insert(box, slot);
  }
};

class ColliderStore {
 public:
  std::uint32_t create() {
    const std::uint32_t slot = take_slot(info, free_slots);
    has_neighbours.resize(info.size(), 0);
    return slot;
  }
  void destroy(std::uint32_t slot) { free_slot(info, free_slots, slot); }
  [[nodiscard]] ColliderId id(std::uint32_t slot) const { return {slot, info[slot].generation}; }

  std::vector<ColliderInfo> info;
  // Per slot: whether other colliders may lie flush with it (inner_edges.h). Asked of every contact
  // in every step, so it lies by itself.
  std::vector<std::uint8_t> has_neighbours;
  std::vector<std::uint32_t> free_slots;
};

}  // namespace plumb::inline PLUMB_ABI::detail
